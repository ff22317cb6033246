// wind_params.c - parameters of the wind that the solvers read.
#include "lib/wind/wind_params.h"

#include "lib/wind/gusts.h"

#include <string.h>

#define PI 3.14159265358979
#define LARGEST 0.5f // Maximum radius in metres of a collider that shelters like a ball.

// Orientation of the gust texture in the world. No axis of one is near an axis or a diagonal of the
// other. Air that the wind brings along a world axis is thus far in the texture from the air that
// came before.
static const hair_quat lie = {0.2896f, 0.4133f, 0.1497f, 0.8501f};

static bool blows(const hair_wind* wind)
{
    return wind->velocity[0] != 0 || wind->velocity[1] != 0 || wind->velocity[2] != 0;
}

bool hair_wind_is_on(const hair_wind* wind)
{
    int on = blows(wind) || wind->texture || wind->still_air;
    for (uint32_t i = 0; i < wind->source_count; ++i) on = on || wind->sources[i].speed != 0;
    return on;
}

bool hair_wind_is_unsteady(const hair_wind* wind)
{
    int moves =
        wind->texture || (wind->turbulence.intensity > 0 && blows(wind)) || wind->model != HAIR_WIND_AMBIENT;
    return moves && hair_wind_is_on(wind);
}

static hair_result ensure_gusts(struct hair_wind_state* state, struct hair_gl* gl, const hair_wind* wind)
{
    static const uint32_t size[3] = {HAIR_GUST_NODES, HAIR_GUST_NODES, HAIR_GUST_NODES};
    int wanted = wind->turbulence.intensity > 0 && blows(wind);
    if (state->gusts && (!wanted || state->gust_seed != wind->turbulence.seed))
        hair_gl_free_texture(gl, &state->gusts);
    if (!wanted || state->gusts) return HAIR_OK;
    float* texels = hair_gusts_make(&gl->host, wind->turbulence.seed);
    if (!texels) return hair_fail_memory(&gl->host, "gusts");
    hair_result result = hair_gl_texture_3d(gl, HAIR_GL_CATEGORY_WIND, "hair gusts", GL_RGBA16F, size,
                                            GL_LINEAR, &state->gusts);
    if (!result) {
        static const GLenum wraps[3] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
        for (int i = 0; i < 3; ++i) gl->TextureParameteri(state->gusts, wraps[i], GL_REPEAT);
        hair_gl_fill_texture_3d(gl, state->gusts, size, texels);
        state->gust_seed = wind->turbulence.seed;
    }
    hair_free(&gl->host, texels);
    return result;
}

hair_result hair_wind_ensure(struct hair_wind_state* state, struct hair_gl* gl, const hair_wind* wind)
{
    if (!hair_wind_is_on(wind)) {
        hair_wind_free_state(state, gl);
        return HAIR_OK;
    }
    HAIR_TRY(ensure_gusts(state, gl, wind));
    if (!state->params)
        HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_WIND, "hair wind", sizeof(struct hair_wind_params),
                                 &state->params));
    return HAIR_OK;
}

void hair_wind_free_state(struct hair_wind_state* state, struct hair_gl* gl)
{
    hair_gl_free_buffer(gl, &state->params);
    hair_gl_free_texture(gl, &state->gusts);
}

// Balls -------------------------------------------------------------------------------------------

// Insert a ball into at most HAIR_WIND_BALLS, the largest first. Leave out a ball with its centre
// in a larger one.
static void add_ball(struct hair_wind_params* params, hair_vec3 at, float radius)
{
    HAIR_ASSERT(radius > 0 && params->balls <= HAIR_WIND_BALLS);
    uint32_t place = 0;
    for (; place < params->balls && params->ball[place].w >= radius; ++place) {
        const hair_vec4* larger = &params->ball[place];
        if (hair_distance(at, hair_v3(larger->x, larger->y, larger->z)) < larger->w) return;
    }
    if (place == HAIR_WIND_BALLS) return;
    if (params->balls < HAIR_WIND_BALLS) ++params->balls;
    for (uint32_t i = params->balls - 1; i > place; --i) params->ball[i] = params->ball[i - 1];
    HAIR_ASSERT(place < params->balls);
    params->ball[place] = (hair_vec4){at.x, at.y, at.z, radius};
}

// Add a collider as a ball of about the same frontal area, from the two larger of its half sides.
static void add_collider(struct hair_wind_params* params, const hair_collider* collider,
                         const struct hair_pose* head)
{
    hair_vec3 middle, half;
    const float* q = collider->rotation;
    hair_quat turn = {q[0], q[1], q[2], q[3]};
    struct hair_pose at = {
        {(double)collider->position[0], (double)collider->position[1], (double)collider->position[2]}, turn};
    if (collider->shape == HAIR_SHAPE_PLANE || (collider->shape == HAIR_SHAPE_MESH && !collider->mesh))
        return;
    hair_collider_extent(collider, &middle, &half);
    float min = fminf(half.x, fminf(half.y, half.z));
    float radius = sqrtf(half.x * half.y * half.z / fmaxf(min, 1e-6f)) + collider->rounding;
    if (!(radius > 0.01f && radius <= LARGEST)) return;
    hair_vec3 from = hair_add(hair_pose_offset(&at, head), hair_rotate(turn, middle));
    if (hair_dot(from, from) < 25) add_ball(params, from, radius); // Within 5 m.
}

static void write_balls(const struct hair_wind_state* state, const struct hair_wind_step* step,
                        struct hair_wind_params* params)
{
    const hair_vec4* own = &state->ball;
    if (!(step->wind->shelter > 0)) return;
    if (own->w > 0)
        add_ball(params, hair_rotate(step->head.rotation, hair_v3(own->x, own->y, own->z)), own->w);
    for (uint32_t i = 0; i < step->colliders->current.count; ++i)
        add_collider(params, &step->colliders->current.collider[i], &step->head);
}

// The rest ----------------------------------------------------------------------------------------

static void write_sources(const struct hair_wind_step* step, struct hair_wind_params* params)
{
    HAIR_ASSERT(step->wind->source_count <= HAIR_WIND_SOURCES);
    for (uint32_t i = 0; i < step->wind->source_count; ++i) {
        const hair_wind_source* from = &step->wind->sources[i];
        hair_vec3 way = hair_load3(from->direction);
        float length = hair_length(way);
        way = length > 0 ? hair_scale(way, 1 / length) : hair_v3(0, 0, 0);
        params->source[i] =
            (hair_vec4){(float)((double)from->position[0] - step->head.position[0]),
                        (float)((double)from->position[1] - step->head.position[1]),
                        (float)((double)from->position[2] - step->head.position[2]), from->radius};
        params->jet[i] = (hair_vec4){way.x, way.y, way.z, from->speed};
    }
    params->sources = step->wind->source_count;
}

// Compute in double, because the wind may have carried the gusts far.
struct hair_wind_gusts hair_wind_find_gusts(const struct hair_wind_state* state, const hair_wind* wind,
                                            const struct hair_pose* head)
{
    double side = HAIR_GUST_LENGTHS * (double)wind->turbulence.length, at[3], place[3];
    double r[9], x = (double)lie.x, y = (double)lie.y, z = (double)lie.z, w = (double)lie.w;
    double n = x * x + y * y + z * z + w * w, speed = 0;
    r[0] = 1 - 2 * (y * y + z * z) / n, r[1] = 2 * (x * y - w * z) / n, r[2] = 2 * (x * z + w * y) / n;
    r[3] = 2 * (x * y + w * z) / n, r[4] = 1 - 2 * (x * x + z * z) / n, r[5] = 2 * (y * z - w * x) / n;
    r[6] = 2 * (x * z - w * y) / n, r[7] = 2 * (y * z + w * x) / n, r[8] = 1 - 2 * (x * x + y * y) / n;
    for (int k = 0; k < 3; ++k) {
        double u = (double)wind->velocity[k];
        at[k] = head->position[k] - state->moved[k];
        speed += u * u;
    }
    for (int k = 0; k < 3; ++k) {
        place[k] = (r[3 * k] * at[0] + r[3 * k + 1] * at[1] + r[3 * k + 2] * at[2]) / side;
        place[k] -= floor(place[k]);
        HAIR_ASSERT(0 <= place[k] && place[k] <= 1);
    }
    hair_quat q = hair_quat_normalize(lie);
    return (struct hair_wind_gusts){
        .texture = state->gusts,
        .turn = {q.x, q.y, q.z, q.w},
        .from = {(float)place[0], (float)place[1], (float)place[2], (float)(1 / side)},
        .speed = state->gusts ? (float)(sqrt(speed) * (double)wind->turbulence.intensity) : 0,
    };
}

static void write_gusts(struct hair_wind_state* state, const struct hair_wind_step* step,
                        struct hair_wind_params* params)
{
    for (int k = 0; k < 3; ++k)
        state->moved[k] += (double)step->wind->velocity[k] * step->substep * step->substeps;
    struct hair_wind_gusts gusts = hair_wind_find_gusts(state, step->wind, &step->head);
    params->gust_turn = gusts.turn;
    params->gust_from = gusts.from;
    params->velocity.w = gusts.speed;
}

static bool has_volume(const struct hair_gl* gl, const hair_wind* wind)
{
    return hair_gl_find_texture_target(gl, wind->texture) == GL_TEXTURE_3D;
}

// Write the transform to the texture of velocities. It applies to positions from the head's origin
// at the end of the dispatch.
static void write_volume(const struct hair_gl* gl, const struct hair_wind_step* step,
                         struct hair_wind_params* params)
{
    const float* m = step->wind->texture_transform;
    params->volume = (hair_uint)has_volume(gl, step->wind);
    double shift[3];
    for (int k = 0; k < 3; ++k) {
        shift[k] = (double)m[12 + k];
        for (int j = 0; j < 3; ++j) shift[k] += (double)m[4 * j + k] * step->head.position[j];
    }
    for (int j = 0; j < 3; ++j)
        params->to_volume.column[j] = (hair_vec4){m[4 * j], m[4 * j + 1], m[4 * j + 2], 0};
    params->to_volume.column[3] = (hair_vec4){(float)shift[0], (float)shift[1], (float)shift[2], 1};
}

static void write_starts(const struct hair_wind_step* step, struct hair_wind_params* params)
{
    HAIR_ASSERT(0 < step->substeps && step->substeps <= HAIR_STEP_SUBSTEPS);
    hair_vec3 origin = {0, 0, 0};
    for (uint32_t i = step->substeps; i-- > 0;) {
        hair_vec4 moved = step->step->substep[i].displacement;
        origin = hair_sub(origin, hair_v3(moved.x, moved.y, moved.z));
        params->at[i] =
            (hair_vec4){origin.x, origin.y, origin.z, (float)(-step->substep * (step->substeps - i))};
    }
}

static void bind_wind(const struct hair_wind_state* state, struct hair_gl* gl, GLuint volume)
{
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_WIND, 1, &state->params);
    if (state->gusts) { // Binding 0 would also unbind the application's textures of other targets.
        hair_gl_bind_texture(gl, HAIR_UNIT_GUST, state->gusts);
        hair_gl_bind_sampler(gl, HAIR_UNIT_GUST, 0);
    }
    if (volume) {
        hair_gl_bind_texture(gl, HAIR_UNIT_VOLUME, volume);
        hair_gl_bind_sampler(gl, HAIR_UNIT_VOLUME, 0);
    }
}

void hair_wind_write(struct hair_wind_state* state, struct hair_gl* gl, const struct hair_wind_step* step)
{
    const hair_wind* wind = step->wind;
    const hair_physics* physics = step->physics;
    double radius = (double)physics->fiber.radius;
    double mass = (double)physics->fiber.density * PI * radius * radius;
    HAIR_ASSERT(state->params && mass > 0);

    struct hair_wind_params params = {
        .velocity = {wind->velocity[0], wind->velocity[1], wind->velocity[2], 0},
        .box = state->box,
        .per_speed = (float)(2 * radius * (double)wind->density / (double)wind->viscosity),
        .viscous = (float)((double)physics->drag * (double)wind->viscosity / mass),
        .shelter = wind->shelter,
    };
    write_gusts(state, step, &params);
    if (blows(wind) && state->box.w == 0) write_balls(state, step, &params);
    write_sources(step, &params);
    write_volume(gl, step, &params);
    write_starts(step, &params);
    hair_gl_write_uniform(gl, state->params, sizeof params, &params);
    bind_wind(state, gl, params.volume ? wind->texture : 0);
}

void hair_wind_bind(const struct hair_wind_state* state, struct hair_gl* gl, const hair_wind* wind)
{
    bind_wind(state, gl, has_volume(gl, wind) ? wind->texture : 0);
}
