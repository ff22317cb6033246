// workgroup.glsl - the number of a work group, and the synchronisation of its threads.
#ifndef HAIR_WORKGROUP_GLSL
#define HAIR_WORKGROUP_GLSL
#include "shared/slots.h"

// First work group of this dispatch and number of groups of the whole pass, if the pass is divided
// into several dispatches. Otherwise both are 0.
layout(location = HAIR_LOCATION_GROUPS) uniform uvec2 hair_dispatch;

// Return the number of this work group in the pass. Dispatches have two dimensions, because OpenGL
// guarantees only 65,535 groups in one.
uint hair_group()
{
    return hair_dispatch.x + gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Return the number of work groups of the pass.
uint hair_group_count()
{
    return hair_dispatch.y > 0u ? hair_dispatch.y : gl_NumWorkGroups.x * gl_NumWorkGroups.y;
}

// Wait for all threads of the work group, and make their writes to shared memory visible. barrier()
// alone orders only the threads, and one driver does move shared writes across it.
void synchronise()
{
    memoryBarrierShared();
    barrier();
}

#endif
