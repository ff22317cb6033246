// history.c - vertices of the previous frame, of followers and of smoothed guides. The buffer of a
// displayed frame is kept when new vertices replace it.
#include "lib/strands/geometry.h"

#include <string.h>

hair_result hair_geometry_ensure_history(struct hair_geometry* geometry, struct hair_vertex_history* history)
{
    size_t vertices = geometry->vertex_cache.vertices;
    HAIR_ASSERT(vertices > 0);
    return hair_gl_ensure_array(geometry->gl, HAIR_GL_CATEGORY_EXPAND, "hair vertex cache before",
                                vertices * sizeof(hair_vec4), &history->buffer, GL_RGBA32F,
                                &history->texture);
}

void hair_geometry_free_history(struct hair_geometry* geometry, struct hair_vertex_history* history)
{
    hair_gl_free_array(geometry->gl, &history->buffer, &history->texture);
    history->shown = 0;
}

bool hair_geometry_has_history(const struct hair_geometry* geometry)
{
    return geometry->history.buffer || geometry->host_history.buffer;
}

static void swap_buffers(GLuint* a, GLuint* b)
{
    GLuint c = *a;
    *a = *b;
    *b = c;
}

// Return whether a history displayed the buffer with this number of writes, so that it keeps it.
static bool is_displayed(const struct hair_vertex_history* history, uint32_t writes)
{
    return history->buffer && history->shown && history->shown == writes;
}

// Exchange the buffer of the frame that was displayed for that of the frame before, which may be
// overwritten. `writes` is the number of writes of the displayed buffer.
static void save(struct hair_vertex_history* history, uint32_t writes, GLuint* buffer, GLuint* texture)
{
    if (!is_displayed(history, writes)) return;
    HAIR_ASSERT(history->buffer != *buffer && history->texture != *texture);
    swap_buffers(&history->buffer, buffer);
    swap_buffers(&history->texture, texture);
}

// Only one history can take the displayed buffer. The other copies it.
void hair_geometry_save_history(struct hair_geometry* geometry)
{
    struct hair_vertex_cache* cache = &geometry->vertex_cache;
    struct hair_vertex_history *history = &geometry->history, *host = &geometry->host_history;
    save(history, cache->writes, &cache->position, &cache->position_texture);
    if (!is_displayed(history, cache->writes))
        save(host, cache->writes, &cache->position, &cache->position_texture);
    else if (is_displayed(host, cache->writes))
        hair_gl_copy_buffer(geometry->gl, history->buffer, host->buffer, 0, 0,
                            (GLsizeiptr)(cache->vertices * sizeof(hair_vec4)));
}

void hair_geometry_save_guide_history(struct hair_geometry* geometry)
{
    struct hair_smooth* smooth = &geometry->smooth;
    save(&geometry->guide_history, smooth->runs, &smooth->buffer[0], &smooth->texture[0]);
}

static void begin_history(struct hair_vertex_history* history, uint32_t writes, const struct hair_pose* head,
                          uint32_t frame)
{
    struct hair_history_pose now = {.turn = {0, 0, 0, 1}};
    // This is another view of the same frame.
    if (history->shown && frame && frame == history->frame) return;
    memcpy(now.position, head->position, sizeof now.position);
    history->still = !history->shown || history->shown == writes;
    history->before = history->shown ? history->last : now;
    history->last = now;
    history->frame = frame;
    history->shown = writes;
}

void hair_geometry_begin_history(struct hair_geometry* geometry, struct hair_vertex_history* history,
                                 const struct hair_pose* head, uint32_t frame)
{
    begin_history(history, geometry->vertex_cache.writes, head, frame);
}

hair_result hair_geometry_begin_guide_history(struct hair_geometry* geometry, const struct hair_pose* head,
                                              uint32_t frame)
{
    struct hair_vertex_history* history = &geometry->guide_history;
    HAIR_TRY(hair_gl_ensure_array(geometry->gl, HAIR_GL_CATEGORY_SMOOTH, "hair position before",
                                  geometry->smooth.vertices * sizeof(hair_vec4), &history->buffer, GL_RGBA32F,
                                  &history->texture));
    begin_history(history, geometry->smooth.runs, head, frame);
    return HAIR_OK;
}

void hair_geometry_forget_history(struct hair_geometry* geometry)
{
    geometry->history.shown = 0;
    geometry->host_history.shown = 0;
    geometry->guide_history.shown = 0;
}

// Move the positions of the frame drawn last with a head that is teleported.
static void teleport(struct hair_vertex_history* history, const struct hair_pose* from,
                     const struct hair_pose* to)
{
    struct hair_history_pose* was = &history->last;
    if (!history->shown) return;
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

void hair_geometry_teleport_history(struct hair_geometry* geometry, const struct hair_pose* from,
                                    const struct hair_pose* to)
{
    HAIR_ASSERT(geometry->history.shown <= geometry->vertex_cache.writes);
    teleport(&geometry->history, from, to);
    teleport(&geometry->host_history, from, to);
    teleport(&geometry->guide_history, from, to);
}

void hair_geometry_bind_history(struct hair_geometry* geometry)
{
    GLuint texture =
        geometry->history.still ? geometry->vertex_cache.position_texture : geometry->history.texture;
    HAIR_ASSERT(texture);
    hair_gl_bind_texture(geometry->gl, HAIR_UNIT_BEFORE, texture);
}
