// hits.c - follower collision, which finds the followers inside colliders and pushes them out.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <string.h>

// Distance in metres, beyond the margin of guides, to which followers are pushed out.
#define OUTSIDE 5e-4f

// Return the pass that finds hits. GPUs need many threads with short loops. A software rasteriser
// needs the least total work.
static hair_gl_pass pass_of(const struct hair_draw* draw)
{
    if (draw->hits.prepass) return HAIR_GL_PREPASS_HIT;
    return hair_draw_styled(draw, draw->gl->software ? HAIR_GL_HIT : HAIR_GL_HIT_GROUP);
}

hair_result hair_draw_need_hit_programs(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    hair_result result = hair_gl_need(gl, pass_of(draw));
    if (!result && draw->hits.prepass) result = hair_gl_need(gl, hair_draw_styled(draw, HAIR_GL_PREPASS));
    if (!result && draw->look.follower_collision == HAIR_FOLLOWER_COLLISION_PUSH_OUT)
        result = hair_gl_need(gl, hair_draw_styled(draw, HAIR_GL_REPAIR));
    return result;
}

static hair_result make(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    struct hair_hits* hits = &draw->hits;
    hair_result result = HAIR_OK;
    size_t count = draw->followers;
    int pushes = draw->look.follower_collision == HAIR_FOLLOWER_COLLISION_PUSH_OUT;
    if (!hits->hit) result = hair_gl_storage(gl, "hair hits", count * sizeof(float), NULL, &hits->hit);
    if (!result && !hits->hit_texture)
        result = hair_gl_buffer_texture(gl, "hair hits", GL_R32F, hits->hit, &hits->hit_texture);
    if (!result && !hits->list)
        result = hair_gl_storage(gl, "hair hit list", (count + 2) * sizeof(uint32_t), NULL, &hits->list);
    if (!result && pushes && !hits->repair)
        result = hair_gl_storage(gl, "hair repairs", count * HAIR_REPAIR_CONTROLS * 8, NULL, &hits->repair);
    if (!result && pushes && !hits->repair_texture)
        result = hair_gl_buffer_texture(gl, "hair repairs", GL_RGBA16F, hits->repair, &hits->repair_texture);
    if (!result && hits->prepass) result = hair_draw_make_prepass(draw);
    return result ? result : hair_draw_need_hit_programs(draw);
}

void hair_draw_free_hits(struct hair_draw* draw)
{
    struct hair_hits* hits = &draw->hits;
    hair_gl_free_buffer_texture(draw->gl, &hits->hit_texture);
    hair_gl_free_buffer_texture(draw->gl, &hits->repair_texture);
    hair_gl_free_buffer(draw->gl, &hits->hit);
    hair_gl_free_buffer(draw->gl, &hits->repair);
    hair_gl_free_buffer(draw->gl, &hits->list);
    if (hits->frame) draw->gl->DeleteFramebuffers(1, &hits->frame);
    hits->frame = 0;
    hair_gl_free_texture(draw->gl, &hits->image);
}

static void run(struct hair_draw* draw, const struct hair_smooth* smooth,
                const struct hair_collider_field* field, float margin)
{
    struct hair_gl* gl = draw->gl;
    struct hair_hits* hits = &draw->hits;
    struct hair_draw_params params;
    hair_draw_write_params(draw, NULL, NULL, &params);
    HAIR_ASSERT(hits->turn < 2 && hits->hit && hits->list);
    hits->turn = 1 - hits->turn;
    params.turn = hits->turn;
    params.collision_margin = margin + OUTSIDE;
    hair_gl_write_uniform(gl, draw->params, sizeof params, &params);
    hair_draw_bind(draw, smooth);
    hair_field_bind(field);
    GLuint buffers[] = {hits->hit, hits->repair, hits->list};
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_HIT, 3, buffers);
    if (hits->prepass) hair_draw_run_prepass(draw);
    int by_group = !hits->prepass && !gl->software;
    uint32_t each = by_group ? HAIR_HIT_FOLLOWERS : HAIR_GROUP_SIZE;
    if (by_group) {
        gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_POSITION, 3, smooth->buffer);
        gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_FOLLOWER, 1, &draw->follower);
    }
    hair_gl_run(gl, pass_of(draw), (draw->followers + each - 1) / each);
    // Work groups beyond the end of the list return at once.
    if (draw->look.follower_collision == HAIR_FOLLOWER_COLLISION_PUSH_OUT)
        hair_gl_run(gl, hair_draw_styled(draw, HAIR_GL_REPAIR),
                    (draw->followers + HAIR_REPAIR_THREADS - 1) / HAIR_REPAIR_THREADS);
}

bool hair_draw_has_met_colliders(const struct hair_draw* draw, const struct hair_smooth* smooth)
{
    return draw->hits.fresh && draw->hits.smoothed == smooth->runs;
}

hair_result hair_draw_meet_colliders(struct hair_draw* draw, const struct hair_smooth* smooth,
                                     const struct hair_collider_field* field, float margin)
{
    struct hair_hits* hits = &draw->hits;
    hits->active = field != NULL;
    hits->field = field;
    if (field) {
        hair_result result = make(draw);
        if (result) return result;
        run(draw, smooth, field, margin);
    }
    ++hits->met;
    hits->fresh = 1;
    hits->smoothed = smooth->runs;
    return HAIR_OK;
}
