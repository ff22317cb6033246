// workgroup.glsl - which work group this is, and where its threads meet.
#ifndef HAIR_WORKGROUP_GLSL
#define HAIR_WORKGROUP_GLSL

// Number of this work group: dispatches have two dimensions, since one is promised only 65,535 groups.
uint hair_group() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// The work group meets here, and sees what each of its threads wrote to shared memory: barrier() alone orders only
// the threads, and one driver does move shared writes across it.
void synchronise()
{
    memoryBarrierShared();
    barrier();
}

#endif
