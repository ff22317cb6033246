// step.c - public calls that step one instance or many, reset and teleport.
#include "lib/api/api.h"
#include "lib/gl/capture.h"

// Return the time that a step advances by `dt`.
static double bound_time(hair_instance* hair, double dt)
{
    if (dt <= hair->max_dt) return dt;
    if (!hair->has_slowed)
        hair_log(&hair->context->host, HAIR_LOG_WARNING, "%s: dt is %g s, beyond max_dt %g s: time slows",
                 hair->label, dt, hair->max_dt);
    hair->has_slowed = 1;
    return hair->max_dt;
}

static hair_result check_dt(const hair_instance* hair, float dt)
{
    if (dt >= 0) return HAIR_OK; // NaN fails.
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: dt is %g, not 0 or more", hair->label,
                     (double)dt);
}

static bool may_sleep(const hair_instance* hair)
{
    return hair->pace.pending == 0 && hair_sleep_through(&hair->sim);
}

// Pass the time of a step in which hair is asleep. Return false if the hair is awake.
static bool sleep_through(hair_instance* hair, double time)
{
    if (!may_sleep(hair)) return false;
    hair_sim_pass_time(&hair->sim, time);
    hair_begin_frame(hair);
    hair_current_requests(hair)->asleep = 1;
    return true;
}

static hair_result check_feedback(const hair_instance* hair)
{
    if (!hair->sim.feedback.wanted || hair_scalp_motion_is_on(&hair->sim)) return HAIR_OK;
    return hair_gl_check_capture(&hair->context->gl, hair->label);
}

// Everything of an instance that a failing step restores.
struct undo {
    double unseen;
    struct hair_gl_profiler profiler;
    struct hair_frame_requests requests;
};

static struct undo begin_undo(const hair_instance* hair)
{
    return (struct undo){.unseen = hair->sim.unseen,
                         .profiler = hair->profiler,
                         .requests = hair->requests[(hair->profiler.number + 1) % HAIR_GL_FRAMES]};
}

static void undo_step(hair_instance* hair, const struct undo* was)
{
    if (hair->profiler.number != was->profiler.number) {
        HAIR_ASSERT(hair->profiler.number == was->profiler.number + 1);
        *hair_current_requests(hair) = was->requests;
        hair_gl_profiler_undo(&hair->profiler, &was->profiler);
    }
    hair_sim_set_unseen_time(&hair->sim, was->unseen);
}

// Begin the next frame of the budget if this instance was stepped in the current one, and views
// have shown hair since. Choose the substep rate of the instance.
static void follow_budget(hair_instance* hair)
{
    struct hair_budget* budget = &hair->context->budget;
    struct hair_budget_part* part = &hair->budget;
    if (!budget->ms) {
        hair_sim_scale_substep_rate(&hair->sim, 1);
        return;
    }
    if (part->stepped == budget->timer.number && budget->has_drawn) hair_budget_next_frame(budget);
    if (part->stepped == budget->timer.number) return;
    float rate = hair_budget_find_rate(budget, part->pixels, hair->sim.rate_factor);
    hair_sim_scale_substep_rate(&hair->sim, rate);
    *part = (struct hair_budget_part){.stepped = budget->timer.number};
}

// Step an instance with the context entered. A time of 0 advances by the pending time alone.
static hair_result step(hair_instance* hair, double time)
{
    const struct hair_pose next = hair->sim.head;
    hair_result result = HAIR_OK;
    if (time > 0)
        hair_begin_frame(hair);
    else
        hair->sim.head = hair->pace.head;
    // The field is that at the end of the step, because it moves along with the head.
    if (hair_wind_coupling_is_on(&hair->sim)) result = hair_update_field_for_step(hair, &hair->sim.head);
    if (!result) result = hair_sim_step(&hair->sim, time + hair->pace.pending);
    hair->sim.head = next;
    if (result) return result;
    hair->pace.pending = 0;
    hair_tell_softened(hair);
    hair_geometry_invalidate_guides(&hair->geometry);
    hair_draw_free_unused(&hair->renderer, hair->profiler.number);
    return HAIR_OK;
}

hair_result hair_step(hair_instance* hair, float dt)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_context* context = hair->context;
    HAIR_TRY(check_dt(hair, dt));
    bool sleeps = may_sleep(hair); // Sleeping hair needs no OpenGL.
    if (dt > 0 && (!sleeps || context->gl.is_lost)) HAIR_TRY(hair_check_current(context));
    follow_budget(hair);
    if (dt == 0) return HAIR_OK;
    double time = bound_time(hair, (double)dt);
    struct undo was = begin_undo(hair);
    hair_sim_set_unseen_time(&hair->sim, was.unseen + time);
    if (sleep_through(hair, time) || hair_pace_wait(hair, time)) return HAIR_OK;
    hair_result result = sleeps ? hair_check_current(context) : HAIR_OK;
    if (!result) result = check_feedback(hair);
    if (!result) {
        hair_enter_frame(hair);
        result = hair_leave_frame(context, step(hair, time));
    }
    if (result) undo_step(hair, &was);
    return result;
}

hair_result hair_check_list(hair_instance* const* list, uint32_t count)
{
    if (!count) return HAIR_OK;
    if (!list) return HAIR_ERROR_ARGUMENT;
    hair_result result = HAIR_OK;
    uint32_t checked = 0;
    for (; checked < count && !result; ++checked) {
        result = hair_check_instance(list[checked]);
        if (result) break;
        const hair_host* host = &list[checked]->context->host;
        if (list[checked]->context != list[0]->context)
            result =
                hair_fail(host, HAIR_ERROR_ARGUMENT, "list[%u] is of another context than list[0]", checked);
        else if (list[checked]->is_listed)
            result = hair_fail(host, HAIR_ERROR_ARGUMENT, "list[%u] is in the list before", checked);
        if (result) break;
        list[checked]->is_listed = true;
    }
    for (uint32_t i = 0; i < checked; ++i) list[i]->is_listed = false;
    return result;
}

// Instances of a list that are awake, and are stepped side by side.
struct step_batch {
    hair_instance* hair[HAIR_GL_STREAMS];
    double time[HAIR_GL_STREAMS]; // 0 for the pending time alone.
    uint32_t count;
};

static hair_result step_entered(hair_instance* hair, double time)
{
    struct undo was = begin_undo(hair);
    hair_sim_set_unseen_time(&hair->sim, was.unseen + time);
    hair_result result = check_feedback(hair);
    if (!result) result = step(hair, time);
    if (result) undo_step(hair, &was);
    return result;
}

// Step all instances of a batch, and empty the batch. Return the first failure.
static hair_result step_all(hair_context* context, struct step_batch* batch)
{
    struct hair_gl* gl = &context->gl;
    uint32_t count = batch->count;
    batch->count = 0;
    if (!count) return HAIR_OK;
    hair_result first = hair_check_current(context);
    if (first) return first;
    hair_enter_frame(batch->hair[0]);
    bool records = count > 1 && hair_gl_begin_recording(gl, count);
    for (uint32_t i = 0; i < count; ++i) {
        hair_instance* hair = batch->hair[i];
        hair_gl_set_owner(gl, &hair->memory, &hair->profiler);
        if (records) hair_gl_begin_stream(gl);
        hair_result result = step_entered(hair, batch->time[i]);
        if (!first) first = result;
    }
    if (records) hair_gl_end_recording(gl);
    return hair_leave_frame(context, first);
}

// Pass the time of an instance that is asleep, or whose step waits. Return false if the instance is
// to be stepped.
static bool passes_time(hair_instance* hair, double time)
{
    double unseen = hair->sim.unseen;
    hair_sim_set_unseen_time(&hair->sim, unseen + time);
    if (sleep_through(hair, time) || hair_pace_wait(hair, time)) return true;
    hair_sim_set_unseen_time(&hair->sim, unseen);
    return false;
}

hair_result hair_step_list(hair_instance* const* list, uint32_t count, float dt)
{
    HAIR_TRY(hair_check_list(list, count));
    if (!count) return HAIR_OK;
    hair_context* context = list[0]->context;
    HAIR_TRY(check_dt(list[0], dt));
    bool all_sleep = true;
    for (uint32_t i = 0; i < count; ++i) all_sleep &= may_sleep(list[i]);
    if (dt > 0 && (!all_sleep || context->gl.is_lost)) HAIR_TRY(hair_check_current(context));
    for (uint32_t i = 0; i < count; ++i) follow_budget(list[i]);
    if (dt == 0) return HAIR_OK;
    struct step_batch batch = {.count = 0};
    hair_result first = HAIR_OK, result;
    for (uint32_t i = 0; i < count; ++i) {
        double time = bound_time(list[i], (double)dt);
        if (passes_time(list[i], time)) continue;
        batch.hair[batch.count] = list[i];
        batch.time[batch.count++] = time;
        if (batch.count < HAIR_GL_STREAMS) continue;
        result = step_all(context, &batch);
        if (!first) first = result;
        if (result == HAIR_ERROR_CONTEXT_LOST) return result;
    }
    result = step_all(context, &batch);
    return result == HAIR_ERROR_CONTEXT_LOST || !first ? result : first;
}

hair_result hair_catch_up(hair_instance* const* list, uint32_t count)
{
    struct step_batch batch = {.count = 0};
    hair_result first = HAIR_OK;
    for (uint32_t i = 0; i <= count; ++i) {
        if (i < count && list[i]->pace.pending > 0) {
            batch.time[batch.count] = 0;
            batch.hair[batch.count++] = list[i];
        }
        if (batch.count < HAIR_GL_STREAMS && i < count) continue;
        hair_result result = step_all(list[0]->context, &batch);
        if (!first || result == HAIR_ERROR_CONTEXT_LOST) first = result;
    }
    return first;
}

hair_result hair_reset(hair_instance* hair)
{
    HAIR_TRY(hair_check_instance(hair));
    HAIR_TRY(hair_check_current(hair->context));
    hair_enter(hair);
    hair->pace.pending = 0;
    hair_sim_reset(&hair->sim);
    hair_geometry_invalidate_guides(&hair->geometry);
    hair_geometry_forget_history(&hair->geometry);
    return hair_leave(hair->context, HAIR_OK);
}

hair_result hair_teleport(hair_instance* hair, const float transform[16])
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_pose pose;
    HAIR_TRY(hair_check_transform(hair, "transform", transform, &pose));
    HAIR_TRY(hair_check_current(hair->context));
    HAIR_TRY(hair_catch_up(&hair, 1));
    hair_enter(hair);
    struct hair_pose was = hair->sim.head_at_last_step;
    hair_result result = hair_sim_teleport(&hair->sim, &pose);
    if (!result) {
        hair_geometry_teleport_history(&hair->geometry, &was, &pose);
        hair_geometry_invalidate_guides(&hair->geometry);
    }
    return hair_leave(hair->context, result);
}
