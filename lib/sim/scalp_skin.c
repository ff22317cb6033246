// scalp_skin.c - the buffers of joints, and the pass that skins the scalp.
#include "lib/sim/scalp_skin.h"

#include <string.h>

void hair_scalp_skin_free_buffers(struct hair_gl* gl, struct hair_scalp_skin* skin)
{
    hair_gl_free_buffer(gl, &skin->vertex_buffer);
    hair_gl_free_buffer(gl, &skin->joint_buffer);
    hair_gl_free_buffer(gl, &skin->upload);
}

void hair_scalp_skin_adopt(struct hair_gl* gl, struct hair_scalp_skin* skin,
                           struct hair_vertex_joints* vertex_joints, uint32_t joint_count)
{
    HAIR_ASSERT(vertex_joints ? joint_count > 0 : joint_count == 0);
    hair_scalp_skin_free_buffers(gl, skin);
    hair_free(&gl->host, skin->vertex_joints);
    skin->vertex_joints = vertex_joints;
    skin->joint_count = joint_count;
}

hair_result hair_scalp_skin_copy(struct hair_gl* gl, const struct hair_scalp_skin* from, uint32_t vertices,
                                 struct hair_scalp_skin* to)
{
    if (!from->vertex_joints) return HAIR_OK;
    struct hair_vertex_joints* copy = hair_alloc(&gl->host, vertices, sizeof *copy);
    if (!copy) return hair_fail_memory(&gl->host, "the joints of vertices");
    memcpy(copy, from->vertex_joints, vertices * sizeof *copy);
    hair_scalp_skin_adopt(gl, to, copy, from->joint_count);
    return HAIR_OK;
}

static hair_result create_buffers(struct hair_gl* gl, struct hair_scalp_skin* skin, uint32_t vertices)
{
    size_t size = skin->joint_count * sizeof(struct hair_joint);
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_SKIN_SCALP, "hair joints of vertices",
                             vertices * sizeof *skin->vertex_joints, skin->vertex_joints,
                             &skin->vertex_buffer));
    HAIR_TRY(
        hair_gl_storage(gl, HAIR_GL_CATEGORY_SKIN_SCALP, "hair joints", size, NULL, &skin->joint_buffer));
    return hair_gl_uniform(gl, HAIR_GL_CATEGORY_SKIN_SCALP, "hair joints upload", size, &skin->upload);
}

hair_result hair_scalp_skin_create(struct hair_gl* gl, struct hair_scalp_skin* skin, uint32_t vertices)
{
    HAIR_ASSERT(skin->vertex_joints && vertices > 0);
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_SKIN_SCALP));
    if (skin->upload) return HAIR_OK;
    hair_result result = create_buffers(gl, skin, vertices);
    if (result) hair_scalp_skin_free_buffers(gl, skin);
    return result;
}

void hair_scalp_skin_run(struct hair_gl* gl, const struct hair_scalp_skin* skin,
                         const struct hair_joint* joints, uint32_t vertices)
{
    size_t size = skin->joint_count * sizeof *joints;
    HAIR_ASSERT(skin->upload && vertices > 0);
    // The GPU copies the joints, because writes of the CPU may overtake earlier dispatches.
    hair_gl_write_uniform(gl, skin->upload, size, joints);
    hair_gl_copy_buffer(gl, skin->upload, skin->joint_buffer, 0, 0, (GLsizeiptr)size);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_VERTEX_JOINTS, 1, &skin->vertex_buffer);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_JOINT, 1, &skin->joint_buffer);
    hair_gl_run(gl, HAIR_GL_SKIN_SCALP, (vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}
