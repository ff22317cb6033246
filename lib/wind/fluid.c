// fluid.c - buffers of the fluid, and its steps.
#include "lib/wind/fluid.h"

#include <string.h>

// Maximum number of colliders with a velocity. Colliders with higher numbers count as resting.
#define MAX_MOVING 65536u
#define FASTEST 1000.0f // Maximum speed of a collider, in m/s.

// Making ------------------------------------------------------------------------------------------

// Halve the grid until the coarsest level is small enough. Return the number of slots of all
// levels.
static uint32_t find_levels(struct hair_fluid* fluid)
{
    struct hair_fluid_level_at at = {.cells = fluid->desc.cells};
    for (fluid->levels = 0;; at.cells /= 2) {
        HAIR_ASSERT(fluid->levels < HAIR_FLUID_LEVELS);
        HAIR_ASSERT(at.cells % 2 == 0 || at.cells <= HAIR_FLUID_COARSEST);
        fluid->level[fluid->levels++] = at;
        at.slot += (at.cells + 1) * (at.cells + 1) * (at.cells + 1);
        at.cell += at.cells * at.cells * at.cells;
        if (at.cells <= HAIR_FLUID_COARSEST) break;
    }
    fluid->level[fluid->levels] = at;
    return at.slot;
}

// Return the relaxation factor. The default for relaxation is optimal for the slowest wave in the
// box (Young 1954).
static float suitable(const struct hair_fluid_desc* desc)
{
    if (desc->relax > 0) return desc->relax;
    if (desc->method == HAIR_FLUID_RELAXATION) return 2 / (1 + sinf(3.14159265f / (float)desc->cells));
    return desc->method == HAIR_FLUID_JACOBI ? 1 : 1.15f;
}

// Write the level parameters once, with a part for each level and color.
static hair_result make_levels(struct hair_fluid* fluid)
{
    unsigned char bytes[2 * HAIR_FLUID_LEVELS * HAIR_FLUID_ALIGNMENT] = {0};
    for (uint32_t i = 0; i < 2 * fluid->levels; ++i) {
        const struct hair_fluid_level_at* at = &fluid->level[i / 2];
        struct hair_fluid_level level = {.cells = at->cells,
                                         .slot = at->slot,
                                         .cell = at->cell,
                                         .coarse_slot = at[1].slot,
                                         .coarse_cell = at[1].cell,
                                         .color = i % 2,
                                         .relax = suitable(&fluid->desc)};
        memcpy(bytes + (size_t)i * HAIR_FLUID_ALIGNMENT, &level, sizeof level);
    }
    HAIR_TRY(hair_gl_uniform(fluid->gl, HAIR_GL_CATEGORY_WIND, "hair fluid levels", sizeof bytes,
                             &fluid->level_params));
    hair_gl_write_uniform(fluid->gl, fluid->level_params, sizeof bytes, bytes);
    return HAIR_OK;
}

static hair_result make_fluid(struct hair_fluid* fluid)
{
    struct hair_gl* gl = fluid->gl;
    hair_fluid_method method = fluid->desc.method;
    uint32_t n = fluid->desc.cells, slots = find_levels(fluid), cells = fluid->level[fluid->levels].cell;
    const uint32_t size[3] = {n, n, n};
    size_t faces = 3 * hair_fluid_slots(fluid);
    HAIR_TRY(hair_fluid_ensure_programs(gl, method, 0));
    for (int i = 0; i < 3; ++i)
        HAIR_TRY(hair_fluid_make_buffer(fluid, "hair fluid velocity", faces, GL_R32F, &fluid->velocity[i]));
    HAIR_TRY(hair_fluid_make_buffer(fluid, "hair fluid walls", faces, GL_R32F, &fluid->wall_velocity));
    HAIR_TRY(hair_fluid_make_buffer(fluid, "hair fluid openings", slots, GL_R32UI, &fluid->face_fraction));
    HAIR_TRY(hair_fluid_make_buffer(fluid, "hair fluid divergence", cells, GL_R32F, &fluid->rhs));
    for (int i = 0; i < (method == HAIR_FLUID_JACOBI ? 2 : 1); ++i)
        HAIR_TRY(hair_fluid_make_buffer(fluid, "hair fluid pressure", cells, GL_R32F, &fluid->pressure[i]));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_WIND, "hair fluid", sizeof(struct hair_fluid_params),
                             &fluid->params));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_WIND, "hair fluid motion", sizeof(struct hair_fluid_motion),
                             &fluid->motion));
    HAIR_TRY(make_levels(fluid));
    return hair_gl_texture_3d(gl, HAIR_GL_CATEGORY_WIND, "hair air", GL_RGBA16F, size, GL_LINEAR,
                              &fluid->air);
}

hair_result hair_fluid_create(struct hair_fluid* fluid, struct hair_gl* gl,
                              const struct hair_fluid_desc* desc)
{
    HAIR_ASSERT(desc->side > 0 && 16 <= desc->cells && desc->cells <= 128 && desc->cells % 16 == 0);
    *fluid = (struct hair_fluid){.gl = gl, .desc = *desc};
    hair_result result = make_fluid(fluid);
    if (result)
        hair_fluid_destroy(fluid);
    else
        hair_fluid_reset(fluid);
    return result;
}

void hair_fluid_destroy(struct hair_fluid* fluid)
{
    if (!fluid->gl) return;
    for (int i = 0; i < 3; ++i) hair_fluid_free_buffer(fluid, &fluid->velocity[i]);
    for (int i = 0; i < 2; ++i) hair_fluid_free_buffer(fluid, &fluid->pressure[i]);
    hair_fluid_free_buffer(fluid, &fluid->wall_velocity);
    hair_fluid_free_buffer(fluid, &fluid->face_fraction);
    hair_fluid_free_buffer(fluid, &fluid->rhs);
    hair_fluid_free_hair(fluid);
    hair_gl_free_buffer(fluid->gl, &fluid->params);
    hair_gl_free_buffer(fluid->gl, &fluid->level_params);
    hair_gl_free_buffer(fluid->gl, &fluid->motion);
    hair_gl_free_texture(fluid->gl, &fluid->air);
    hair_free(&fluid->gl->host, fluid->motion_of);
    *fluid = (struct hair_fluid){0};
}

void hair_fluid_reset(struct hair_fluid* fluid)
{
    static const float still[4];
    if (fluid->gl) {
        hair_gl_flush(fluid->gl);
        fluid->gl->ClearTexImage(fluid->air, 0, GL_RGBA, GL_FLOAT, still);
    }
    fluid->is_reset = 1;
}

// A step ------------------------------------------------------------------------------------------

static hair_vec3 limited(hair_vec3 v)
{
    float length = hair_length(v);
    if (length <= FASTEST) return v;
    // NaN also gives 0.
    return length < INFINITY ? hair_scale(v, FASTEST / length) : hair_v3(0, 0, 0);
}

// Return the rotation vector of the shortest turn between two orientations, in radians.
static hair_vec3 turn_between(const float before[4], const float now[4])
{
    hair_quat a = {before[0], before[1], before[2], before[3]}, b = {now[0], now[1], now[2], now[3]};
    hair_quat q = hair_quat_multiply(b, hair_quat_conjugate(a));
    hair_vec3 axis = hair_scale(hair_v3(q.x, q.y, q.z), q.w < 0 ? -1.0f : 1.0f);
    float sine = hair_length(axis);
    return sine > 1e-7f ? hair_scale(axis, 2 * atan2f(sine, fabsf(q.w)) / sine) : hair_v3(0, 0, 0);
}

static struct hair_fluid_motion motion_of(const struct hair_fluid_now* now, uint32_t i)
{
    const hair_collider *to = &now->colliders->current.collider[i],
                        *from = hair_colliders_previous(now->colliders, i);
    HAIR_ASSERT(now->colliders_dt > 0);
    float rate = (float)(1 / now->colliders_dt);
    hair_vec3 moved = hair_sub(hair_load3(to->position), hair_load3(from->position));
    hair_vec3 speed = limited(hair_scale(moved, rate));
    hair_vec3 spin = limited(hair_scale(turn_between(from->rotation, to->rotation), rate));
    hair_vec3 arm = hair_v3((float)((double)to->position[0] - now->head.position[0]),
                            (float)((double)to->position[1] - now->head.position[1]),
                            (float)((double)to->position[2] - now->head.position[2]));
    hair_vec3 at = hair_sub(speed, hair_cross(spin, arm));
    return (struct hair_fluid_motion){{at.x, at.y, at.z, 0}, {spin.x, spin.y, spin.z, 0}};
}

hair_result hair_fluid_make_room(struct hair_fluid* fluid, uint32_t colliders)
{
    const hair_host* host = &fluid->gl->host;
    if (colliders > MAX_MOVING) colliders = MAX_MOVING;
    if (colliders <= fluid->room) return HAIR_OK;
    struct hair_fluid_motion* motion = hair_alloc(host, colliders, sizeof *motion);
    if (!motion) return hair_fail_memory(host, "the velocities of colliders");
    hair_result result =
        hair_gl_resize(fluid->gl, "hair fluid motion", colliders * sizeof *motion, motion, fluid->motion);
    if (result) {
        hair_free(host, motion);
        return result;
    }
    hair_free(host, fluid->motion_of);
    fluid->motion_of = motion;
    fluid->room = colliders;
    fluid->moving = 0;
    return HAIR_OK;
}

// Write the velocities of colliders. While all of them rest, the buffer stays as it is.
static void write_motion(struct hair_fluid* fluid, const struct hair_fluid_now* now)
{
    static const struct hair_fluid_motion still;
    uint32_t count = now->colliders_dt > 0 ? now->colliders->current.count : 0;
    int moved = fluid->moving;
    fluid->moving = 0;
    if (count > fluid->room) count = fluid->room;
    HAIR_ASSERT(count <= fluid->room);
    for (uint32_t i = 0; i < fluid->room; ++i) {
        fluid->motion_of[i] = i < count ? motion_of(now, i) : still;
        fluid->moving |= memcmp(&fluid->motion_of[i], &still, sizeof still) != 0;
    }
    if (fluid->moving || moved)
        hair_gl_write_uniform(fluid->gl, fluid->motion, fluid->room * sizeof still, fluid->motion_of);
}

// Move the centre of the box with the head, by whole cells.
static void place_box(struct hair_fluid* fluid, const struct hair_fluid_now* now, float shift[3])
{
    double cell = (double)hair_fluid_cell(fluid);
    hair_vec3 off = hair_rotate(now->head.rotation, now->middle);
    float *from = &off.x, *lower = &fluid->lower.x;
    for (int k = 0; k < 3; ++k) {
        double middle = now->head.position[k] + (double)from[k];
        double origin = floor(middle / cell + 0.5) - fluid->desc.cells / 2;
        double max = 8.0 * fluid->desc.cells; // Farther off, nothing of the old box is left.
        shift[k] = (float)fmin(fmax(origin - fluid->origin[k], -max), max);
        if (fluid->is_reset) shift[k] = (float)max;
        fluid->origin[k] = origin;
        lower[k] = (float)(origin * cell - now->head.position[k]);
    }
}

static bool is_as_made(const struct hair_fluid* fluid, const struct hair_fluid_params* params,
                       const struct hair_collider_field* field)
{
    const struct hair_fluid_params* made = &fluid->made_for;
    HAIR_ASSERT(field || !params->colliders);
    return !memcmp(&made->lower, &params->lower, sizeof params->lower) &&
           !memcmp(&made->rotation, &params->rotation, sizeof params->rotation) &&
           made->colliders == params->colliders && made->cells == params->cells && !fluid->moving &&
           (!params->colliders || fluid->writes == field->writes);
}

// Return the metres of strands in a cubic metre for a unit of mass at a node.
static float thickness(const struct hair_fluid* fluid, const struct hair_fluid_now* now)
{
    double node = (double)fluid->desc.side / hair_fluid_nodes(fluid);
    return fluid->hair.grid.buffer ? (float)(now->strands.metres / (node * node * node)) : 0;
}

void hair_fluid_place(struct hair_fluid* fluid, const struct hair_fluid_now* now)
{
    HAIR_ASSERT(fluid->gl && now->dt > 0);
    float shift[3], cell = hair_fluid_cell(fluid);
    int moved = fluid->moving; // Walls keep these velocities until they are written again.
    write_motion(fluid, now);
    place_box(fluid, now, shift);
    hair_vec3 wind = limited(now->wind);
    hair_vec3 gain = fluid->is_reset ? hair_v3(0, 0, 0) : hair_sub(wind, fluid->wind);
    hair_quat q = now->head.rotation;
    struct hair_fluid_params params = {
        .lower = {fluid->lower.x, fluid->lower.y, fluid->lower.z, cell},
        .shift = {shift[0], shift[1], shift[2], (float)(now->dt / (double)cell)},
        .wind = {wind.x, wind.y, wind.z, now->gusts.speed},
        .gain = {gain.x, gain.y, gain.z, 0},
        .rotation = {q.x, q.y, q.z, q.w},
        .gust_turn = now->gusts.turn,
        .gust_from = now->gusts.from,
        .cells = fluid->desc.cells,
        .colliders = now->field && hair_field_is_near(now->field),
        .open = !fluid->desc.closed,
        .nodes = hair_fluid_nodes(fluid),
        .thick = thickness(fluid, now),
        .per_speed = now->strands.per_speed,
        .viscous = (float)((double)now->strands.viscous * now->dt),
    };
    hair_gl_write_uniform(fluid->gl, fluid->params, sizeof params, &params);
    fluid->wind = wind;
    fluid->gusts = now->gusts.texture;
    fluid->is_reset = 0;
    if (moved || !is_as_made(fluid, &params, now->field)) fluid->made_for.cells = 0;
    if (!fluid->made_for.cells) {
        hair_fluid_find_face_fractions(fluid, now);
        fluid->made_for = params;
        HAIR_ASSERT(now->field || !params.colliders);
        fluid->writes = params.colliders ? now->field->writes : 0;
    }
}

void hair_fluid_find_face_fractions(struct hair_fluid* fluid, const struct hair_fluid_now* now)
{
    if (now->field && hair_field_is_near(now->field)) {
        HAIR_ASSERT(now->field->number);
        hair_field_bind(now->field);
    }
    hair_fluid_run(fluid, HAIR_GL_FLUID_FACE_FRACTIONS, 0, 0, (uint32_t)hair_fluid_slots(fluid));
    if (!fluid->hair.grid.buffer) hair_fluid_coarsen(fluid);
}

void hair_fluid_advect(struct hair_fluid* fluid)
{
    struct hair_gl* gl = fluid->gl;
    hair_fluid_bind(fluid);
    if (fluid->gusts) {
        hair_gl_bind_texture(gl, HAIR_UNIT_GUST, fluid->gusts);
        hair_gl_bind_sampler(gl, HAIR_UNIT_GUST, 0);
    }
    hair_fluid_run(fluid, HAIR_GL_FLUID_ADVECT, 0, 0, (uint32_t)hair_fluid_slots(fluid));
    hair_fluid_run(fluid, HAIR_GL_FLUID_MACCORMACK_CORRECT, 0, 0, (uint32_t)hair_fluid_slots(fluid));
}

// Publish the next velocities and make them current.
static void show_next(struct hair_fluid* fluid)
{
    struct hair_gl* gl = fluid->gl;
    uint32_t n = fluid->desc.cells;
    hair_gl_bind_image(gl, HAIR_IMAGE_AIR, fluid->air, true, GL_WRITE_ONLY, GL_RGBA16F);
    hair_fluid_run(fluid, HAIR_GL_FLUID_EXPORT_VELOCITY, 0, 0, n * n * n);
    // Order these writes before later writes or clears of the texture.
    hair_gl_barrier(gl, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    fluid->now = (fluid->now + 2) % 3;
}

void hair_fluid_project(struct hair_fluid* fluid)
{
    hair_fluid_run(fluid, HAIR_GL_FLUID_PROJECT, 0, 0, (uint32_t)hair_fluid_slots(fluid));
    show_next(fluid);
}

void hair_fluid_publish(struct hair_fluid* fluid)
{
    // The fluid may not have made a step.
    struct hair_fluid_params params = {.cells = fluid->desc.cells};
    hair_gl_write_uniform(fluid->gl, fluid->params, sizeof params, &params);
    fluid->now = (fluid->now + 1) % 3;
    show_next(fluid);
}

void hair_fluid_step(struct hair_fluid* fluid, const struct hair_fluid_now* now)
{
    hair_fluid_place(fluid, now);
    hair_fluid_move(fluid);
}

void hair_fluid_move(struct hair_fluid* fluid)
{
    hair_fluid_advect(fluid);
    if (fluid->hair.grid.buffer) hair_fluid_apply_porosity(fluid);
    hair_fluid_solve(fluid);
    hair_fluid_project(fluid);
}

void hair_fluid_bind(const struct hair_fluid* fluid)
{
    hair_gl_bind_texture(fluid->gl, HAIR_UNIT_AIR, fluid->air);
    hair_gl_bind_sampler(fluid->gl, HAIR_UNIT_AIR, 0);
}
