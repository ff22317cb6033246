// motion.c - vertices of the previous frame. The vertex cache of a displayed frame is kept when new
// vertices replace it.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <string.h>

hair_result hair_draw_ensure_motion(struct hair_draw* draw)
{
    draw->used[HAIR_DRAW_MOTION] = draw->frame;
    struct hair_gl* gl = draw->gl;
    struct hair_motion* motion = &draw->motion;
    hair_result result = HAIR_OK;
    HAIR_ASSERT(draw->vertex_cache.vertices > 0);
    size_t size = draw->vertex_cache.vertices * sizeof(hair_vec4);
    if (!motion->buffer)
        result = hair_gl_storage(gl, "hair vertex cache before", size, NULL, &motion->buffer);
    if (!result && !motion->texture)
        result = hair_gl_buffer_texture(gl, "hair vertex cache before", GL_RGBA32F, motion->buffer,
                                        &motion->texture);
    return result;
}

void hair_draw_free_motion(struct hair_draw* draw)
{
    hair_gl_free_buffer_texture(draw->gl, &draw->motion.texture);
    hair_gl_free_buffer(draw->gl, &draw->motion.buffer);
    draw->motion.shown = 0;
}

static void swap(GLuint* a, GLuint* b)
{
    GLuint c = *a;
    *a = *b;
    *b = c;
}

void hair_draw_save_history(struct hair_draw* draw)
{
    struct hair_motion* motion = &draw->motion;
    struct hair_vertex_cache* vertex_cache = &draw->vertex_cache;
    if (!motion->buffer || !motion->shown || motion->shown != vertex_cache->writes) return;
    HAIR_ASSERT(motion->buffer != vertex_cache->position &&
                motion->texture != vertex_cache->position_texture);
    swap(&motion->buffer, &vertex_cache->position);
    swap(&motion->texture, &vertex_cache->position_texture);
}

void hair_draw_begin_motion(struct hair_draw* draw, const struct hair_pose* head, uint32_t frame)
{
    struct hair_motion* motion = &draw->motion;
    struct hair_was now = {.turn = {0, 0, 0, 1}};
    // This is another view of the same frame.
    if (motion->shown && frame && frame == motion->frame) return;
    memcpy(now.position, head->position, sizeof now.position);
    motion->still = !motion->shown || motion->shown == draw->vertex_cache.writes;
    motion->before = motion->shown ? motion->last : now;
    motion->last = now;
    motion->frame = frame;
    motion->shown = draw->vertex_cache.writes;
}

void hair_draw_teleport_history(struct hair_draw* draw, const struct hair_pose* from,
                                const struct hair_pose* to)
{
    struct hair_was* was = &draw->motion.last;
    if (!draw->motion.shown) return;
    hair_quat turn = hair_quat_multiply(to->rotation, hair_quat_conjugate(from->rotation));
    hair_vec3 away = {(float)(was->position[0] - from->position[0]),
                      (float)(was->position[1] - from->position[1]),
                      (float)(was->position[2] - from->position[2])};
    away = hair_rotate(turn, away);
    was->position[0] = to->position[0] + (double)away.x;
    was->position[1] = to->position[1] + (double)away.y;
    was->position[2] = to->position[2] + (double)away.z;
    was->turn = hair_quat_multiply(turn, was->turn);
}
