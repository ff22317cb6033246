// scalp_skin.h - joints of the application that skin the scalp on the GPU.
#ifndef HAIR_SIM_SCALP_SKIN_H
#define HAIR_SIM_SCALP_SKIN_H

#include "lib/gl/commands.h"

// All members are 0 while the scalp's vertices have no joints.
struct hair_scalp_skin {
    struct hair_vertex_joints* vertex_joints; // Joints of each vertex, on the CPU.
    uint32_t joint_count;
    // Buffers, as in shared.h. 0 until the joints are first set.
    GLuint vertex_buffer, joint_buffer;
    GLuint upload; // Buffer from which the GPU copies the joints.
};

// Take joints per vertex, which hair_alloc() has allocated. NULL ends skinning. Buffers of earlier
// joints are freed.
void hair_scalp_skin_adopt(struct hair_gl* gl, struct hair_scalp_skin* skin,
                           struct hair_vertex_joints* vertex_joints, uint32_t joint_count);
// Adopt a copy of the joints of `vertices` vertices of another skin, if the skin has any.
hair_result hair_scalp_skin_copy(struct hair_gl* gl, const struct hair_scalp_skin* from, uint32_t vertices,
                                 struct hair_scalp_skin* to);
// Free the buffers. The joints of vertices stay.
void hair_scalp_skin_free_buffers(struct hair_gl* gl, struct hair_scalp_skin* skin);
// Create program and buffers, once. On failure nothing has changed.
hair_result hair_scalp_skin_create(struct hair_gl* gl, struct hair_scalp_skin* skin, uint32_t vertices);
// Skin `vertices` vertices. The scalp at rest, the buffer that receives the scalp, and the
// parameters are bound.
void hair_scalp_skin_run(struct hair_gl* gl, const struct hair_scalp_skin* skin,
                         const struct hair_joint* joints, uint32_t vertices);

#endif
