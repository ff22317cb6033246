// sleep.c - detection of guides that have come to rest, and of events that disturb them.
//
// Hair comes to rest about geometrically. Let d_0 and d be the distances moved in one round of
// measurements and in the next, and q = d / d_0. The distance still to go is then
//
//   d q / (1 - q)
//
// Motion that does not decay is taken for rounding, or for a slow creep. NEARLY_ALL is the maximum
// of q, and limits that creep.
#include "lib/sim/sleep.h"
#include "lib/sim/sim.h"

#include <string.h>

#define ROUND 3 // Number of measurements in a round.
// Minimum number of steps from a measurement to the use of its answer. A GPU is at most three
// frames behind.
#define MIN_STEPS 4
// Minimum time from a measurement to the use of its answer, s. A frame may have several steps.
#define MIN_TIME 0.1
#define NEARLY_ALL 0.95 // Maximum of q. 19 times d is then still to go.
// Minimum duration of a round, relative to the round before, for which the two can be compared.
// Answers may be late.
#define LIKE 0.75
// Time in which hair at the measured speed may not exceed the allowed distance, s.
#define SPEED_SPAN 0.03
// Fraction of hair_physics.sleep_threshold that the distance still to go may have. The head may
// move a quarter. The rest is for motion between measurements.
#define FRACTION 0.5f
// Fraction of hair_physics.sleep_threshold that motion of the head may have.
#define HEAD_FRACTION 0.25f
// Distance from the hair beyond which a collider has no effect, without the margin, m.
#define AROUND ((float)HAIR_CONTACT_FIT + HAIR_CONTACT_SLACK)
#define MAX_GROUPS 256
#define LONGEST_WAIT 1000000000u // Maximum wait of a save, ns. Steps never wait.

#define FIRST 0.2 // Time until the first measurement, s.
// Times from each measurement to the next, s. They differ, so that an oscillation is not sampled at
// the same phase each time.
static const double gaps[ROUND] = {0.10, 0.13, 0.17};

static void drop_answer(struct hair_sim* sim)
{
    struct hair_sleep* sleep = &sim->sleep;
    if (sleep->fence) sim->gl->DeleteSync(sleep->fence);
    sleep->fence = NULL;
    sleep->waits = sleep->known = 0;
}

void hair_sleep_free(struct hair_sim* sim)
{
    struct hair_sleep* sleep = &sim->sleep;
    drop_answer(sim);
    hair_gl_free_buffer(sim->gl, &sleep->anchor);
    hair_gl_free_buffer(sim->gl, &sleep->activity);
    hair_gl_free_buffer(sim->gl, &sleep->readback); // Deletion unmaps the buffer.
    hair_gl_free_buffer(sim->gl, &sleep->params);
    sleep->mapped = NULL;
}

void hair_sleep_wake(struct hair_sim* sim)
{
    sim->sleep.disturbed = 1;
}

// Events that disturb hair ------------------------------------------------------------------------

// Return an upper bound on the distance that any point of hair moves between two poses.
static float distance_between(const struct hair_pose* a, const struct hair_pose* b, float reach)
{
    hair_quat p = a->rotation, q = b->rotation;
    float sign = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0 ? -1.0f : 1.0f;
    float x = p.x - sign * q.x, y = p.y - sign * q.y, z = p.z - sign * q.z, w = p.w - sign * q.w;
    return hair_length(hair_pose_offset(a, b)) + 2.01f * sqrtf(x * x + y * y + z * z + w * w) * reach;
}

// Return whether a collider comes near the hair on its way from `a` to `b`.
static bool comes_near(const struct hair_sim* sim, const hair_collider* a, const hair_collider* b)
{
    const hair_collider* ends[] = {a, b};
    struct hair_pose at[2];
    float radius = 0;
    if (a->shape == HAIR_SHAPE_MESH && !(a->mesh && b->mesh)) return true;
    for (int i = 0; i < 2; ++i) {
        hair_vec3 middle, half;
        hair_collider_extent(ends[i], &middle, &half);
        radius = fmaxf(radius, hair_length(middle) + hair_length(half) + ends[i]->rounding);
        for (int k = 0; k < 3; ++k) at[i].position[k] = (double)ends[i]->position[k];
    }
    hair_vec3 away = hair_pose_offset(&at[0], &sim->head), way = hair_pose_offset(&at[1], &at[0]);
    float max = HAIR_SIM_LOOSE * sim->reach + AROUND + sim->physics.collision.margin + radius +
                0.5f * hair_length(way);
    hair_vec3 mid = hair_add(away, hair_scale(way, 0.5f));
    return hair_sim_may_leave(sim) || !(hair_length(mid) > max);
}

static bool are_same_colliders(const hair_collider* a, const hair_collider* b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

static bool has_collider_near(const struct hair_sim* sim)
{
    const struct hair_colliders* colliders = &sim->colliders;
    const struct hair_collider_list *now = &colliders->current, *before = &colliders->previous;
    if (!colliders->changed && !hair_colliders_have_deformed(colliders)) return false;
    for (uint32_t i = 0; i < now->count; ++i) {
        const hair_collider* was = hair_colliders_previous(colliders, i);
        int is = was != &now->collider[i] && are_same_colliders(was, &now->collider[i]) &&
                 !hair_colliders_has_deformed(colliders, i);
        if (!is && comes_near(sim, was, &now->collider[i])) return true;
    }
    for (uint32_t i = 0; i < before->count; ++i) {
        int is = i < now->count && are_same_colliders(&before->collider[i], &now->collider[i]);
        if (!is && comes_near(sim, &before->collider[i], &before->collider[i])) return true;
    }
    return false;
}

bool hair_sleep_is_disturbed(const struct hair_sim* sim)
{
    const struct hair_sleep* sleep = &sim->sleep;
    if (sleep->disturbed || sim->scalp_motion.changed || sim->targets.disturbs ||
        sim->targets.blend_left > 0 || sleep->program_generation != sim->gl->program_generation)
        return true;
    if (hair_impulses_are_on(sim)) return true; // Hair at rest presses on colliders.
    if (memcmp(&sleep->physics, &sim->physics, sizeof sim->physics) != 0) return true;
    if (memcmp(&sleep->wind, &sim->wind, sizeof sim->wind) != 0) return true;
    if (hair_wind_is_unsteady(&sim->wind)) return true;
    // Colliders deflect the wind at any distance.
    if ((sim->colliders.changed || hair_colliders_have_deformed(&sim->colliders)) && sim->wind_state.params &&
        sim->colliders.current.count + sim->colliders.previous.count > 0)
        return true;
    float far = distance_between(&sleep->head, &sim->head, HAIR_SIM_LOOSE * sim->reach);
    return !(far <= HEAD_FRACTION * sim->physics.sleep_threshold) || has_collider_near(sim);
}

// Restart the quiet time under the current conditions.
static void reset_quiet_time(struct hair_sim* sim)
{
    struct hair_sleep* sleep = &sim->sleep;
    drop_answer(sim);
    sleep->asleep = 0;
    sleep->disturbed = 0;
    sleep->quiet_time = 0;
    sleep->due = FIRST;
    sleep->samples = 0;
    sleep->head = sim->head;
    sleep->physics = sim->physics;
    sleep->wind = sim->wind;
    sleep->program_generation = sim->gl->program_generation;
}

// Measurements ------------------------------------------------------------------------------------

static hair_result make_sleep(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_sleep* sleep = &sim->sleep;
    size_t size = sim->guide_vertices * sizeof(hair_vec4);
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_ACTIVITY));
    if (!sleep->anchor)
        HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_ACTIVITY, "hair anchors", size, NULL, &sleep->anchor));
    if (!sleep->activity)
        HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_ACTIVITY, "hair activity", 4 * sizeof(uint32_t), NULL,
                                 &sleep->activity));
    if (!sleep->params)
        HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_ACTIVITY, "hair activity",
                                 sizeof(struct hair_activity_params), &sleep->params));
    if (sleep->mapped) return HAIR_OK;
    return hair_gl_mapped(gl, HAIR_GL_CATEGORY_ACTIVITY, "hair activity readback", 4 * sizeof(uint32_t),
                          &sleep->readback, (const void**)&sleep->mapped);
}

hair_result hair_sleep_create(struct hair_sim* sim)
{
    hair_result result = make_sleep(sim);
    if (result) hair_sleep_free(sim);
    return result;
}

static void request_measurement(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_sleep* sleep = &sim->sleep;
    HAIR_ASSERT(!sleep->fence && !sleep->waits && sleep->parity < 2);
    uint32_t groups = (sim->guide_vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE;
    struct hair_activity_params params = {.vertices = sim->guide_vertices,
                                          .parity = sleep->parity,
                                          .anchors = sleep->samples % ROUND == 0,
                                          .rate = (float)(1 / sim->last_substep)};
    GLuint storage[] = {sim->state, sleep->anchor, sleep->activity};
    GLintptr at = (GLintptr)(2 * sizeof(uint32_t) * sleep->parity);
    hair_gl_write_uniform(gl, sleep->params, sizeof params, &params);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_ACTIVITY_PARAMS, 1, &sleep->params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STATE, 3, storage);
    hair_gl_run(gl, HAIR_GL_ACTIVITY, groups < MAX_GROUPS ? groups : MAX_GROUPS);
    hair_gl_copy_buffer(gl, sleep->activity, sleep->readback, at, at, 2 * sizeof(uint32_t));
    sleep->due = sleep->quiet_time + gaps[sleep->samples % ROUND];
    sleep->waits = sleep->samples > 0; // The first has no anchors.
    // A list sets the fence only when it has recorded all instances.
    if (sleep->waits) hair_gl_fence(gl, &sleep->fence);
    sleep->steps = 0;
    sleep->time = 0;
    ++sleep->samples;
    if (!sleep->waits) {
        sleep->now = (struct hair_activity){0, 0};
        sleep->before = -1;
        sleep->since = sleep->quiet_time;
    }
    if (params.anchors) {
        sleep->span_before = sleep->span;
        sleep->span = sleep->quiet_time - sleep->since;
        sleep->since = sleep->quiet_time;
    }
}

// Read the answer if it arrives within `wait`, ns. If the answer cannot be had, assume that all
// hair moves.
static void read_answer(struct hair_sim* sim, GLuint64 wait)
{
    struct hair_sleep* sleep = &sim->sleep;
    if (sleep->known) return;
    HAIR_ASSERT(sleep->waits && sleep->mapped);
    GLenum status = GL_WAIT_FAILED; // The driver may have refused the fence.
    if (sleep->fence) status = sim->gl->ClientWaitSync(sleep->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (status == GL_TIMEOUT_EXPIRED && wait > 0)
        status = sim->gl->ClientWaitSync(sleep->fence, GL_SYNC_FLUSH_COMMANDS_BIT, wait);
    if (status == GL_TIMEOUT_EXPIRED && wait == 0) return;
    const float* seen = sleep->mapped + 2 * sleep->parity;
    int came = status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
    sleep->answer = came ? (struct hair_activity){seen[0], seen[1]} : (struct hair_activity){1e9f, 1e9f};
    drop_answer(sim);
    sleep->waits = sleep->known = 1;
}

static bool has_come_to_rest(const struct hair_sim* sim)
{
    const struct hair_sleep* sleep = &sim->sleep;
    float may = FRACTION * sim->physics.sleep_threshold;
    if (sleep->before < 0 || sleep->span < LIKE * sleep->span_before) return false;
    double way = (double)sleep->now.far, q = way > 0 ? fmin(way / (double)sleep->before, NEARLY_ALL) : 0;
    return way * fmax(1, q / (1 - q)) <= (double)may && sleep->now.speed * (float)SPEED_SPAN <= may;
}

static void use_answer(struct hair_sim* sim)
{
    struct hair_sleep* sleep = &sim->sleep;
    HAIR_ASSERT(sleep->waits && sleep->known);
    sleep->waits = sleep->known = 0;
    sleep->now.far = fmaxf(sleep->now.far, sleep->answer.far);
    sleep->now.speed = fmaxf(sleep->now.speed, sleep->answer.speed);
    if ((sleep->samples - 1) % ROUND) return;
    sleep->asleep = has_come_to_rest(sim);
    sleep->before = sleep->now.far;
    sleep->now = (struct hair_activity){0, 0};
}

static bool is_due(const struct hair_sim* sim, double dt)
{
    return sim->physics.sleep_threshold > 0 && sim->sleep.quiet_time + dt >= sim->sleep.due;
}

hair_result hair_sleep_ensure(struct hair_sim* sim, int disturbed, double dt)
{
    return !disturbed && is_due(sim, dt) ? hair_sleep_create(sim) : HAIR_OK;
}

void hair_sleep_submit_query(struct hair_sim* sim, int disturbed, double dt)
{
    struct hair_sleep* sleep = &sim->sleep;
    bool due = is_due(sim, dt);
    if (disturbed) {
        reset_quiet_time(sim);
        return;
    }
    sleep->quiet_time += dt;
    ++sleep->steps;
    sleep->time += dt;
    if (sleep->waits && sleep->steps >= MIN_STEPS && sleep->time >= MIN_TIME) {
        read_answer(sim, 0);
        if (sleep->known) use_answer(sim);
    }
    if (!due || sleep->waits || sleep->asleep) return;
    sleep->parity = 1 - sleep->parity;
    request_measurement(sim);
}

bool hair_sleep_through(const struct hair_sim* sim)
{
    return sim->sleep.asleep && !hair_sleep_is_disturbed(sim);
}

// Saved states ------------------------------------------------------------------------------------

void hair_sleep_settle(struct hair_sim* sim)
{
    if (!hair_sleep_is_disturbed(sim)) return;
    reset_quiet_time(sim);
    hair_sleep_wake(sim);
}

void hair_sleep_resolve_query(struct hair_sim* sim)
{
    hair_sleep_settle(sim);
    if (sim->sleep.waits) read_answer(sim, LONGEST_WAIT);
}

void hair_sleep_load(struct hair_sim* sim, const struct hair_sleep* was)
{
    struct hair_sleep* sleep = &sim->sleep;
    if (was->fence) sim->gl->DeleteSync(was->fence);
    sleep->fence = NULL;
    sleep->known = sleep->waits;
    sleep->physics = sim->physics;
    sleep->wind = sim->wind;
    sleep->program_generation = sim->gl->program_generation;
}
