// workgroup.glsl - the number of a work group, and the synchronisation of its threads.
#ifndef HAIR_WORKGROUP_GLSL
#define HAIR_WORKGROUP_GLSL

// Return the number of this work group. Dispatches have two dimensions, because OpenGL guarantees
// only 65,535 groups in one.
uint hair_group() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// Wait for all threads of the work group, and make their writes to shared memory visible. barrier()
// alone orders only the threads, and one driver does move shared writes across it.
void synchronise()
{
    memoryBarrierShared();
    barrier();
}

#endif
