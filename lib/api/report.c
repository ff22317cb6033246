// report.c - reports of an instance's work in a frame: whether it ran and why not, its duration and
// its memory.
#include "lib/api/api.h"

#include <string.h>

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
    hair_gl_enter_for(&hair->context->gl, &hair->memory, &hair->profiler);
}

void hair_enter_unprofiled(hair_instance* hair)
{
    hair_gl_enter_for(&hair->context->gl, &hair->memory, NULL);
}

void hair_enter_frame(hair_instance* hair)
{
    hair_context* context = hair->context;
    hair_enter(hair);
    if (!context->budget.ms) return;
    hair_budget_update(&context->gl, &context->budget);
    hair_gl_frame_timer_begin(&context->gl, &context->budget.timer);
}

hair_result hair_leave_frame(hair_context* context, hair_result result)
{
    hair_gl_frame_timer_end(&context->gl, &context->budget.timer);
    return hair_leave(context, result);
}

struct hair_frame_requests* hair_current_requests(hair_instance* hair)
{
    return &hair->requests[hair->profiler.number % HAIR_GL_FRAMES];
}

void hair_begin_frame(hair_instance* hair)
{
    hair_gl_profiler_next_frame(&hair->profiler);
    *hair_current_requests(hair) = (struct hair_frame_requests){0};
}

// Reasons -----------------------------------------------------------------------------------------

// Return the reason why work for views has not run.
static hair_skip_reason why_not_shown(const struct hair_frame_requests* requests)
{
    uint32_t views = 0, unseen = 0;
    for (int i = 0; i < 3; ++i) views += requests->views[i], unseen += requests->unseen[i];
    if (views == 0) return HAIR_SKIP_REASON_NOT_CALLED;
    if (views == unseen) return HAIR_SKIP_REASON_OUT_OF_VIEW;
    return HAIR_SKIP_REASON_UNCHANGED;
}

// Return the reason why work with colliders has not run, which the look wants if `is_wanted`.
static hair_skip_reason why_not_collided(const hair_instance* hair,
                                         const struct hair_frame_requests* requests, bool is_wanted)
{
    if (!is_wanted || !hair_geometry_shows_followers(&hair->geometry) || !hair->geometry.followers)
        return HAIR_SKIP_REASON_NOT_WANTED;
    if (!hair_sim_colliders(&hair->sim)->count) return HAIR_SKIP_REASON_NONE_NEAR;
    hair_skip_reason why = why_not_shown(requests);
    return why == HAIR_SKIP_REASON_UNCHANGED && !hair_field_is_near(&hair->field) ? HAIR_SKIP_REASON_NONE_NEAR
                                                                                  : why;
}

static hair_skip_reason why_not_drawn(const hair_instance* hair, const struct hair_frame_requests* requests,
                                      int kind)
{
    if (requests->views[kind] == 0) return HAIR_SKIP_REASON_NOT_CALLED;
    if (!hair_geometry_shows_followers(&hair->geometry)) return HAIR_SKIP_REASON_NOT_WANTED;
    return HAIR_SKIP_REASON_OUT_OF_VIEW;
}

// Return the reason why occlusion culling has not run. If a view uses it, hair is in no depth
// image, or the depth test does not tell near from far.
static hair_skip_reason why_not_culled(const struct hair_frame_requests* requests)
{
    hair_skip_reason shown = why_not_shown(requests);
    if (shown != HAIR_SKIP_REASON_UNCHANGED) return shown;
    return requests->occlusion ? HAIR_SKIP_REASON_OUT_OF_VIEW : HAIR_SKIP_REASON_NOT_WANTED;
}

static hair_skip_reason why_not_simulated(const struct hair_frame_requests* requests, int wanted)
{
    if (!wanted) return HAIR_SKIP_REASON_NOT_WANTED;
    return requests->asleep ? HAIR_SKIP_REASON_ASLEEP : HAIR_SKIP_REASON_NOT_DUE;
}

static hair_skip_reason why_not(const hair_instance* hair, const struct hair_frame_requests* requests,
                                hair_gl_category work)
{
    const struct hair_sim* sim = &hair->sim;
    hair_skip_reason shown = why_not_shown(requests);
    int skin = hair_scalp_motion_is_on(sim);
    hair_follower_collision collision = hair->geometry.look.followers.collision;
    bool collides = collision != HAIR_FOLLOWER_COLLISION_NONE,
         has_density_grid = hair->geometry.look.self_shadow.method == HAIR_SELF_SHADOW_STRANDS;
    switch (work) {
    case HAIR_GL_CATEGORY_TARGETS: return why_not_simulated(requests, hair_targets_are_on(sim));
    case HAIR_GL_CATEGORY_UNPACK_POSITIONS:
        return skin || hair_targets_are_on(sim) ? HAIR_SKIP_REASON_NOT_CALLED : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_CATEGORY_SKIN_SCALP:
        return sim->scalp_motion.skin.vertex_joints ? HAIR_SKIP_REASON_NOT_CALLED
                                                    : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_CATEGORY_ROOT_TRANSFORMS: return why_not_simulated(requests, skin);
    case HAIR_GL_CATEGORY_WIND: return why_not_simulated(requests, sim->wind.model != HAIR_WIND_AMBIENT);
    case HAIR_GL_CATEGORY_HAIR_GRID: return why_not_simulated(requests, hair_grid_is_on(sim));
    case HAIR_GL_CATEGORY_DIAGNOSE: return why_not_simulated(requests, hair_sim_is_diagnosed(sim));
    case HAIR_GL_CATEGORY_IMPULSES: return why_not_simulated(requests, hair_impulses_are_on(sim));
    case HAIR_GL_CATEGORY_ACTIVITY: return why_not_simulated(requests, sim->physics.sleep_threshold > 0);
    case HAIR_GL_CATEGORY_SOLVE: return why_not_simulated(requests, 1);
    case HAIR_GL_CATEGORY_SMOOTH: return shown;
    case HAIR_GL_CATEGORY_BIND_FOLLOWERS: return skin ? shown : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_CATEGORY_FIELD: return why_not_collided(hair, requests, collides || has_density_grid);
    case HAIR_GL_CATEGORY_HIT: return why_not_collided(hair, requests, collides);
    case HAIR_GL_CATEGORY_REPAIR:
        return why_not_collided(hair, requests, collision == HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    case HAIR_GL_CATEGORY_EXPAND:
        return requests->vertex_cache || shown != HAIR_SKIP_REASON_UNCHANGED ? shown
                                                                             : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_CATEGORY_SELF_SHADOW: return has_density_grid ? shown : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_CATEGORY_OCCLUSION: return why_not_culled(requests);
    case HAIR_GL_CATEGORY_SCAN_STRANDS:
    case HAIR_GL_CATEGORY_COMPACT_STRANDS:
        return requests->strand_list || shown != HAIR_SKIP_REASON_UNCHANGED ? shown
                                                                            : HAIR_SKIP_REASON_NOT_WANTED;
    case HAIR_GL_CATEGORY_DEPTH: return why_not_drawn(hair, requests, 1);
    case HAIR_GL_CATEGORY_OPACITY: return why_not_drawn(hair, requests, 2);
    case HAIR_GL_CATEGORY_COLOR: return why_not_drawn(hair, requests, 0);
    default: return HAIR_SKIP_REASON_NOT_CALLED;
    }
}

// The report --------------------------------------------------------------------------------------

static const struct hair_gl_frame* find_frame(hair_instance* hair, int waits, float ms[HAIR_GL_CATEGORIES])
{
    uint32_t newest = hair->profiler.number;
    for (uint32_t number = newest; number > 0 && number + HAIR_GL_FRAMES > newest; --number) {
        const struct hair_gl_frame* frame = hair_gl_profiler_frame(&hair->profiler, number);
        if (hair_gl_profiler_read(&hair->context->gl, frame, waits, ms)) return frame;
    }
    return NULL;
}

static hair_report_row report_row_of(const hair_instance* hair, const struct hair_gl_frame* frame,
                                     hair_gl_category work, float ms)
{
    const struct hair_frame_requests* requests = &hair->requests[frame->number % HAIR_GL_FRAMES];
    hair_report_row row = {.stage = hair_gl_category_label(work),
                           .runs = frame->runs[work],
                           .ms = ms,
                           .bytes = hair->memory.bytes[work]};
    HAIR_ASSERT(frame->number <= hair->profiler.number);
    HAIR_ASSERT(!row.runs || hair_gl_find(&hair->context->gl, frame->pass[work]));
    if (row.runs) row.pass = hair_gl_find(&hair->context->gl, frame->pass[work])->label;
    row.skip_reason = row.runs ? HAIR_SKIP_REASON_NONE : why_not(hair, requests, work);
    return row;
}

static void write_budget(const hair_instance* hair, hair_report_info* out)
{
    const struct hair_budget* budget = &hair->context->budget;
    out->budget_substep_rate = out->budget_samples = 1;
    if (!budget->ms) return;
    out->budget_used = (float)budget->frame_ms;
    out->budget_importance = budget->importance;
    out->budget_substep_rate = hair->sim.rate_factor;
    out->budget_samples = 1 / (float)budget->sample_divisor;
}

hair_result hair_report(hair_instance* hair, bool waits, hair_report_info* info, hair_report_row* rows,
                        size_t stride, uint32_t capacity, uint32_t* count)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    hair_report_info own = hair_report_info_default();
    float ms[HAIR_GL_CATEGORIES];
    HAIR_TRY(HAIR_COPY_OUT(host, hair_report_info, &own, info));
    if (!count) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: count is NULL", hair->label);
    if (!rows && capacity)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: rows is NULL but capacity is %u", hair->label,
                         capacity);
    if (capacity && (stride < sizeof *rows || stride > 4096))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: stride is %zu, not in [%zu, 4096]", hair->label,
                         stride, sizeof *rows);
    HAIR_TRY(hair_check_current(hair->context));
    const struct hair_gl_frame* frame = find_frame(hair, waits != 0, ms);
    HAIR_TRY(hair_check_lost(hair->context, HAIR_OK));
    *count = 0;
    own.compiled_programs = hair->context->gl.compiled;
    write_budget(hair, &own);
    if (!frame) return HAIR_COPY_OUT(host, hair_report_info, &own, info);
    own.frame = frame->number;
    own.age = hair->profiler.number - frame->number;
    for (int work = 0; work < HAIR_GL_CATEGORIES; ++work) {
        hair_report_row row = report_row_of(hair, frame, (hair_gl_category)work, ms[work]);
        own.ms += row.ms;
        own.bytes += row.bytes;
        if (*count < capacity) memcpy((unsigned char*)rows + *count * stride, &row, sizeof row);
        ++*count;
    }
    return HAIR_COPY_OUT(host, hair_report_info, &own, info);
}
