// report.c - reports of an instance's work in a frame: whether it ran and why not, its duration and
// its memory.
#include "lib/api/api.h"

#include <string.h>

#define MOST_BUFFERS 17 // Maximum for one kind of work.
#define MOST_TEXTURES 2 // Maximum for one kind of work, without buffer textures.

const char* hair_skip_reason_string(hair_skip_reason why)
{
    static const char* const names[] = {
        [HAIR_SKIP_REASON_NONE] = "done",           [HAIR_SKIP_REASON_ASLEEP] = "asleep",
        [HAIR_SKIP_REASON_UNCHANGED] = "unchanged", [HAIR_SKIP_REASON_OUT_OF_VIEW] = "out of view",
        [HAIR_SKIP_REASON_NONE_NEAR] = "none near", [HAIR_SKIP_REASON_NOT_WANTED] = "not wanted",
        [HAIR_SKIP_REASON_NOT_DUE] = "not due",     [HAIR_SKIP_REASON_NOT_CALLED] = "not called",
    };
    return (unsigned)why < sizeof names / sizeof *names ? names[why] : NULL;
}

void hair_enter(hair_instance* hair)
{
    HAIR_ASSERT(!hair->context->gl.ledger);
    hair_gl_enter(&hair->context->gl);
    hair->context->gl.ledger = &hair->ledger;
}

struct hair_asked* hair_asked_now(hair_instance* hair)
{
    return &hair->asked[hair->ledger.number % HAIR_GL_FRAMES];
}

void hair_begin_frame(hair_instance* hair)
{
    hair_gl_ledger_next(&hair->ledger);
    *hair_asked_now(hair) = (struct hair_asked){0};
}

// Reasons -----------------------------------------------------------------------------------------

// Return the reason why work for views has not run.
static hair_skip_reason why_not_shown(const struct hair_asked* asked)
{
    uint32_t views = 0, unseen = 0;
    for (int i = 0; i < 3; ++i) views += asked->views[i], unseen += asked->unseen[i];
    if (views == 0) return HAIR_SKIP_REASON_NOT_CALLED;
    if (views == unseen) return HAIR_SKIP_REASON_OUT_OF_VIEW;
    return HAIR_SKIP_REASON_UNCHANGED;
}

static hair_skip_reason why_not_met(const hair_instance* hair, const struct hair_asked* asked, int pushes)
{
    const hair_look* look = &hair->draw.look;
    int off = look->follower_collision == HAIR_FOLLOWER_COLLISION_NONE || look->density <= 0 ||
              !hair->draw.followers;
    if (off || (pushes && look->follower_collision != HAIR_FOLLOWER_COLLISION_PUSH_OUT))
        return HAIR_SKIP_REASON_NOT_WANTED;
    if (!hair->sim.colliders.now.count) return HAIR_SKIP_REASON_NONE_NEAR;
    hair_skip_reason why = why_not_shown(asked);
    return why == HAIR_SKIP_REASON_UNCHANGED && !hair_field_is_near(&hair->field) ? HAIR_SKIP_REASON_NONE_NEAR
                                                                                  : why;
}

static hair_skip_reason why_not_drawn(const hair_instance* hair, const struct hair_asked* asked, int kind)
{
    if (asked->views[kind] == 0) return HAIR_SKIP_REASON_NOT_CALLED;
    if (hair->draw.look.density <= 0) return HAIR_SKIP_REASON_NOT_WANTED;
    return HAIR_SKIP_REASON_OUT_OF_VIEW;
}

// Return the reason why occlusion culling has not run. If a view uses it, hair is in no depth
// image, or the depth test does not tell near from far.
static hair_skip_reason why_not_hidden(const struct hair_asked* asked)
{
    hair_skip_reason shown = why_not_shown(asked);
    if (shown != HAIR_SKIP_REASON_UNCHANGED) return shown;
    return asked->hides ? HAIR_SKIP_REASON_OUT_OF_VIEW : HAIR_SKIP_REASON_NOT_WANTED;
}

static hair_skip_reason why_not_simulated(const struct hair_asked* asked, int wanted)
{
    if (!wanted) return HAIR_SKIP_REASON_NOT_WANTED;
    return asked->asleep ? HAIR_SKIP_REASON_ASLEEP : HAIR_SKIP_REASON_NOT_DUE;
}

static hair_skip_reason why_not(const hair_instance* hair, const struct hair_asked* asked, hair_gl_work work)
{
    const struct hair_sim* sim = &hair->sim;
    hair_skip_reason shown = why_not_shown(asked);
    int skin = hair_skin_is_on(sim);
    switch (work) {
    case HAIR_GL_WORK_SCALP: return skin ? HAIR_SKIP_REASON_NOT_CALLED : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_WORK_RIDE: return why_not_simulated(asked, skin);
    case HAIR_GL_WORK_WIND: return why_not_simulated(asked, sim->wind.model != HAIR_WIND_AMBIENT);
    case HAIR_GL_WORK_CROWD: return why_not_simulated(asked, hair_crowd_is_on(sim));
    case HAIR_GL_WORK_DIAGNOSE: return why_not_simulated(asked, sim->diagnosis.wanted);
    case HAIR_GL_WORK_STIR: return why_not_simulated(asked, sim->physics.sleep_threshold > 0);
    case HAIR_GL_WORK_SOLVE: return why_not_simulated(asked, 1);
    case HAIR_GL_WORK_SMOOTH: return shown;
    case HAIR_GL_WORK_SEAT: return skin ? shown : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_WORK_FIELD:
    case HAIR_GL_WORK_HIT: return why_not_met(hair, asked, 0);
    case HAIR_GL_WORK_REPAIR: return why_not_met(hair, asked, 1);
    case HAIR_GL_WORK_EXPAND:
        return asked->expanded || shown != HAIR_SKIP_REASON_UNCHANGED ? shown : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_WORK_LIGHT:
        return hair->draw.look.self_shadow != HAIR_SELF_SHADOW_STRANDS ? HAIR_SKIP_REASON_NOT_WANTED : shown;
    case HAIR_GL_WORK_HIDE: return why_not_hidden(asked);
    case HAIR_GL_WORK_COUNT_STRANDS:
    case HAIR_GL_WORK_LIST:
        return asked->listed || shown != HAIR_SKIP_REASON_UNCHANGED ? shown : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_WORK_DEPTH: return why_not_drawn(hair, asked, 1);
    case HAIR_GL_WORK_OPACITY: return why_not_drawn(hair, asked, 2);
    case HAIR_GL_WORK_COLOR: return why_not_drawn(hair, asked, 0);
    default: return HAIR_SKIP_REASON_NOT_CALLED;
    }
}

// Memory ------------------------------------------------------------------------------------------

// Return the bytes of an instance's buffers and textures for one kind of work. Missing objects are
// 0.
static uint64_t bytes_of(const hair_instance* hair, hair_gl_work work)
{
    const struct hair_sim* sim = &hair->sim;
    const struct hair_draw* draw = &hair->draw;
    const struct hair_fluid* air = &sim->blow.fluid;
    const struct hair_gl* gl = &hair->context->gl;
    const GLuint buffers[HAIR_GL_WORKS][MOST_BUFFERS] = {
        [HAIR_GL_WORK_SCALP] = {sim->skin.scalp[0], sim->skin.scalp[1], sim->skin.rest, sim->skin.params},
        [HAIR_GL_WORK_RIDE] = {sim->skin.ride, sim->skin.seat},
        [HAIR_GL_WORK_WIND] = {sim->air.params, air->velocity[0].buffer, air->velocity[1].buffer,
                               air->velocity[2].buffer, air->wall.buffer, air->open.buffer, air->right.buffer,
                               air->pressure[0].buffer, air->pressure[1].buffer, air->params,
                               air->level_params, air->motion, air->hair.grid.buffer, air->hair.wall.buffer,
                               air->hair.open.buffer, sim->blow.share, sim->blow.params},
        [HAIR_GL_WORK_CROWD] = {sim->crowd.params, sim->crowd.grid, sim->crowd.share, sim->crowd.limit,
                                sim->crowd.push},
        [HAIR_GL_WORK_STIR] = {sim->sleep.anchor, sim->sleep.stir, sim->sleep.seen, sim->sleep.params},
        [HAIR_GL_WORK_DIAGNOSE] = {sim->diagnosis.energy, sim->diagnosis.energy_params, sim->diagnosis.found,
                                   sim->diagnosis.motion_params},
        [HAIR_GL_WORK_SOLVE] = {sim->guide, sim->rest, sim->state, sim->solver_stats, sim->step, sim->rod,
                                sim->history, sim->material, sim->reduction, sim->bend, sim->pins.buffer,
                                sim->feedback.owner, sim->feedback.buffer[0], sim->feedback.buffer[1]},
        [HAIR_GL_WORK_SMOOTH] = {hair->smooth.buffer[0], hair->smooth.buffer[1], hair->smooth.buffer[2]},
        [HAIR_GL_WORK_FIELD] = {hair->field.params, hair->field.work, sim->contacts.collider,
                                sim->contacts.cell},
        [HAIR_GL_WORK_HIT] = {draw->hits.hit, draw->hits.list},
        [HAIR_GL_WORK_REPAIR] = {draw->hits.repair},
        [HAIR_GL_WORK_EXPAND] = {draw->expanded.position, draw->expanded.tangent, draw->expanded.shaded,
                                 draw->motion.buffer, draw->staged.buffer[0], draw->staged.buffer[1],
                                 draw->staged.buffer[2]},
        [HAIR_GL_WORK_LIGHT] = {draw->self_shadow.density, draw->self_shadow.box, draw->self_shadow.nodes,
                                draw->self_shadow.light},
        [HAIR_GL_WORK_HIDE] = {draw->hidden.params, draw->hidden.depth, draw->hidden.box},
        [HAIR_GL_WORK_LIST] = {draw->listed.start, draw->listed.strand, draw->listed.command,
                               draw->listed.indices[0].index, draw->listed.indices[1].index},
        [HAIR_GL_WORK_COLOR] = {draw->follower, draw->patch, draw->params, draw->sorted.bucket,
                                draw->sorted.index, draw->uv, draw->paint, draw->raster.params,
                                draw->raster.nearest, draw->raster.tile},
    };
    const GLuint textures[HAIR_GL_WORKS][MOST_TEXTURES] = {
        [HAIR_GL_WORK_WIND] = {air->air, sim->air.gusts},
        [HAIR_GL_WORK_FIELD] = {hair->field.distance, hair->field.number},
        [HAIR_GL_WORK_HIT] = {draw->hits.image},
        [HAIR_GL_WORK_COLOR] = {draw->fibres.texture},
    };
    HAIR_ASSERT((unsigned)work < HAIR_GL_WORKS);
    uint64_t bytes = 0;
    for (int i = 0; i < MOST_BUFFERS; ++i) bytes += hair_gl_buffer_bytes(gl, buffers[work][i]);
    for (int i = 0; i < MOST_TEXTURES; ++i) bytes += hair_gl_texture_bytes(gl, textures[work][i]);
    return bytes;
}

// The report --------------------------------------------------------------------------------------

static const struct hair_gl_frame* find_frame(hair_instance* hair, int waits, float ms[HAIR_GL_WORKS])
{
    uint32_t newest = hair->ledger.number;
    for (uint32_t number = newest; number > 0 && number + HAIR_GL_FRAMES > newest; --number) {
        const struct hair_gl_frame* frame = hair_gl_ledger_frame(&hair->ledger, number);
        if (hair_gl_ledger_read(&hair->context->gl, frame, waits, ms)) return frame;
    }
    return NULL;
}

static hair_report_row row_of(const hair_instance* hair, const struct hair_gl_frame* frame, hair_gl_work work,
                              float ms)
{
    const struct hair_asked* asked = &hair->asked[frame->number % HAIR_GL_FRAMES];
    hair_report_row row = {.stage = hair_gl_work_label(work),
                           .runs = frame->runs[work],
                           .ms = ms,
                           .bytes = bytes_of(hair, work)};
    HAIR_ASSERT(frame->number <= hair->ledger.number);
    HAIR_ASSERT(!row.runs || hair_gl_find(&hair->context->gl, frame->pass[work]));
    if (row.runs) row.pass = hair_gl_find(&hair->context->gl, frame->pass[work])->label;
    row.skip_reason = row.runs ? HAIR_SKIP_REASON_NONE : why_not(hair, asked, work);
    return row;
}

hair_result hair_report(hair_instance* hair, uint32_t waits, hair_report_info* info, hair_report_row* rows,
                        size_t stride, uint32_t capacity, uint32_t* count)
{
    if (!hair) return HAIR_ERROR_ARGUMENT;
    const hair_host* host = &hair->context->host;
    hair_report_info own = hair_report_info_default();
    float ms[HAIR_GL_WORKS];
    hair_result result = HAIR_GIVE(host, hair_report_info, &own, info);
    if (result) return result;
    if (!count) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: count is NULL", hair->label);
    if (!rows && capacity)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: rows is NULL but capacity is %u", hair->label,
                         capacity);
    if (capacity && (stride < sizeof *rows || stride > 4096))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: stride is %zu, not in [%zu, 4096]", hair->label,
                         stride, sizeof *rows);
    result = hair_check_current(hair->context);
    if (result) return result;
    const struct hair_gl_frame* frame = find_frame(hair, waits != 0, ms);
    *count = 0;
    if (!frame) return HAIR_OK;
    own.frame = frame->number;
    own.age = hair->ledger.number - frame->number;
    for (int work = 0; work < HAIR_GL_WORKS; ++work) {
        hair_report_row row = row_of(hair, frame, (hair_gl_work)work, ms[work]);
        own.ms += row.ms;
        own.bytes += row.bytes;
        if (*count < capacity) memcpy((unsigned char*)rows + *count * stride, &row, sizeof row);
        ++*count;
    }
    return HAIR_GIVE(host, hair_report_info, &own, info);
}
