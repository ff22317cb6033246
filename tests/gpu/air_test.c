// air_test.c - the motion of the wind: gusts, shelter, sources, and the application's texture.
// Short light strands that move with the wind measure it.
#include "tests/support/live_hair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/reference/air.h"
#include "tests/support/motion.h"

#define STEP (1.0 / 270) // Four substeps.

// Make free strands of two vertices, 2 mm long, which damping moves at the speed of the wind.
static struct hair_test_living tracers(struct hair_test* test, const hair_vec3* at, uint32_t count)
{
    struct hair_test_living living;
    struct hair_test_strands strands = hair_test_strands_make(count, 2);
    hair_physics physics = hair_test_bare();
    for (uint32_t i = 0; i < count; ++i) hair_test_add_straight(&strands, 2, at[i], hair_v3(0, 1, 0), 2e-3f);
    physics.gravity[1] = 0, physics.damping = 1000, physics.drag = 0;
    physics.root = HAIR_ROOT_FREE;
    hair_desc desc =
        hair_test_rods(HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 1.0 / 1080, &physics);
    hair_test_live(test, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    // A radius of 0 removes the sphere of the head, which roots determine.
    living.hair->sim.wind_state.ball.w = 0;
    return living;
}

// Return the speed of a strand's first vertex in the last step, in m/s. Earlier steps have given
// the strand the speed of the wind.
static hair_vec3 speed_of(const struct hair_test_living* living, uint32_t i)
{
    hair_vec3 now = hair_test_at(living, i, 0), then = hair_load3(living->before + 6 * (size_t)i);
    return hair_scale(hair_sub(now, then), (float)(1 / STEP));
}

static void measure(struct hair_test_living* living)
{
    for (int k = 0; k < 3; ++k) {
        hair_test_advance(living, NULL, STEP);
        hair_test_read_guides(living);
    }
}

static void expect(hair_vec3 got, double x, double y, double z, double tolerance)
{
    double off = sqrt(pow((double)got.x - x, 2) + pow((double)got.y - y, 2) + pow((double)got.z - z, 2));
    if (!(off <= tolerance))
        fail_msg("air of (%g, %g, %g) m/s, not (%g, %g, %g)", (double)got.x, (double)got.y, (double)got.z, x,
                 y, z);
}

static void gusts_have_the_set_intensity_and_are_alike_nearby(void** state)
{
    enum { COUNT = 400 };
    hair_vec3 at[COUNT];
    uint32_t random = 1;
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = 4, wind.velocity[2] = 3;
    wind.turbulence.intensity = 0.3f, wind.turbulence.length = 0.5f;
    for (int i = 0; i < COUNT; ++i) // Pairs are a tenth of the turbulence length apart.
        at[i] =
            i % 2 ? hair_add(at[i - 1], hair_v3(0.05f, 0, 0))
                  : hair_v3(10 * hair_random(&random), 10 * hair_random(&random), 10 * hair_random(&random));
    struct hair_test_living living = tracers(*state, at, COUNT);
    hair_test_wind_coupling(&living, &wind);
    measure(&living);
    double square = 0, alike = 0, far = 0;
    for (uint32_t i = 0; i < COUNT; ++i) {
        hair_vec3 mean = hair_v3(4, 0, 3), u = hair_sub(speed_of(&living, i), mean);
        square += (double)hair_dot(u, u) / (3 * COUNT);
        if (i % 2) alike += (double)hair_dot(u, hair_sub(speed_of(&living, i - 1), mean)) / (1.5 * COUNT);
        if (i > 1) far += (double)hair_dot(u, hair_sub(speed_of(&living, i - 2), mean)) / (3 * COUNT);
    }
    print_message("    standard deviation %.3f m/s; correlation near %.3f, far %.3f\n", sqrt(square),
                  alike / square, far / square);
    assert_true(fabs(sqrt(square) / 1.5 - 1) < 0.1);
    assert_true(alike > 0.7 * square && fabs(far) < 0.15 * square);
    hair_test_die(&living);
}

// Find the texture coordinates in the gusts of a point of the world, by the parameters that the
// solver was given last.
static void place_in_gusts(const struct hair_test_living* living, const double world[3], double out[3])
{
    struct hair_wind_params params;
    const struct hair_sim* sim = &living->hair->sim;
    glGetNamedBufferSubData(sim->wind_state.params, 0, sizeof params, &params);
    hair_quat turn = {params.gust_turn.x, params.gust_turn.y, params.gust_turn.z, params.gust_turn.w};
    hair_vec3 from = hair_v3((float)(world[0] - sim->last_after.position[0]),
                             (float)(world[1] - sim->last_after.position[1]),
                             (float)(world[2] - sim->last_after.position[2]));
    hair_vec3 way = hair_scale(hair_rotate(turn, from), params.gust_from.w);
    out[0] = (double)(params.gust_from.x + way.x), out[1] = (double)(params.gust_from.y + way.y);
    out[2] = (double)(params.gust_from.z + way.z);
}

// Check that gusts move with the wind, for any frame times, motion of the head, and change of the
// wind's direction.
static void gusts_travel_with_the_wind(void** state)
{
    const hair_vec3 origin = {0, 0, 0};
    struct hair_test_living living = tracers(*state, &origin, 1);
    hair_wind wind = hair_wind_default();
    double start[3], end[3], world[3] = {0.3, 0.1, -0.2};
    wind.turbulence.intensity = 0.2f;
    wind.velocity[0] = 2, wind.velocity[1] = -1;
    hair_test_wind_coupling(&living, &wind);
    hair_test_advance(&living, NULL, STEP);
    place_in_gusts(&living, world, start);
    for (int k = 0; k < 30; ++k) {
        struct hair_reference_rod_pose head =
            hair_test_pose_of(hair_v3(0.1f * (float)k, 0, 0), hair_v3(0, 1, 0), 0.1 * k);
        if (k == 15) wind.velocity[0] = 0, wind.velocity[2] = 5;
        hair_test_wind_coupling(&living, &wind);
        hair_test_advance(&living, &head, k % 2 ? STEP : 3 * STEP);
        for (int c = 0; c < 3; ++c) world[c] += (double)wind.velocity[c] * (k % 2 ? STEP : 3 * STEP);
    }
    place_in_gusts(&living, world, end);
    for (int c = 0; c < 3; ++c) assert_true(fabs(end[c] - start[c] - round(end[c] - start[c])) < 1e-4);
    hair_test_die(&living);
}

static void a_ball_shelters_what_is_behind_it(void** state)
{
    const hair_vec3 at[] = {{0, 0, -0.101f}, {0, 0, -0.5f}, {0.1f, 0, 0}, {0, 0.3f, 0},
                            {0, 0, 0.11f},   {0, 0, 0.2f},  {0, 0, 0.5f}, {0.4f, 0, 0.3f}};
    struct hair_test_living living = tracers(*state, at, 8);
    hair_wind wind = hair_wind_default();
    hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0, 0, 0);
    double fraction[8];
    ball.size[0] = 0.1f;
    wind.velocity[2] = 1;
    hair_test_set_colliders(&living, &ball, 1);
    hair_test_wind_coupling(&living, &wind);
    measure(&living);
    for (uint32_t i = 0; i < 8; ++i) {
        hair_vec3 middle = hair_add(hair_test_at(&living, i, 0), hair_load3(living.before + 6 * (size_t)i));
        const double one[3] = {0, 0, 1},
                     place[3] = {5 * (double)middle.x, 5 * (double)middle.y, 5 * (double)middle.z};
        double twin[3];
        fraction[i] = (double)speed_of(&living, i).z;
        hair_reference_around_ball(one, place, twin);
        if (i > 0)
            expect(speed_of(&living, i), twin[0], twin[1], twin[2],
                   0.02); // The first point is at the ball's margin.
        print_message("    at (%g, %g, %g) m: %.3f of the wind\n", (double)at[i].x, (double)at[i].y,
                      (double)at[i].z, fraction[i]);
    }
    // At the ball's margin, and before the ball.
    assert_true(fabs(fraction[0]) < 0.05 && fraction[1] > 0.97);
    assert_true(fraction[2] > 1.1 && fraction[3] > 1); // Beside the ball.
    assert_true(fraction[4] < 0.1 && fraction[5] < 0.4 && fraction[6] < 0.9 && fraction[6] > fraction[5]);
    assert_true(fraction[7] > 0.9);
    wind.shelter = 0;
    hair_test_wind_coupling(&living, &wind);
    measure(&living);
    for (uint32_t i = 1; i < 8; ++i) assert_true(fabs((double)speed_of(&living, i).z - 1) < 0.02);
    hair_test_die(&living);
}

static void wind_sources_blow_with_their_settings(void** state)
{
    const hair_vec3 at[] = {{0, 0, 0.5f}, {0, 0, -1}, {1.1f, 0, 1}, {1.3f, 0, 0}};
    struct hair_test_living living = tracers(*state, at, 4);
    hair_wind wind = hair_wind_default();
    hair_wind_source sources[2] = {hair_wind_source_default(), hair_wind_source_default()};
    sources[0].radius = 0.1f, sources[0].speed = 4;
    sources[1].position[0] = 1.1f;
    sources[1].direction[2] = 7;
    wind.sources = sources;
    wind.source_count = 2;
    hair_test_wind_coupling(&living, &wind);
    sources[0].speed = 1000; // The library has copied the sources.
    measure(&living);
    expect(speed_of(&living, 0), 0, 0, 4 * 0.04, 0.01);
    expect(speed_of(&living, 1), 0, 0, -4 * 0.01, 0.01);
    double jet = 5 * 0.05 / (0.05 + 0.094);
    expect(speed_of(&living, 2), 4 * 0.01 * 1.1 / pow(2.21, 1.5), 0, jet + 4 * 0.01 / pow(2.21, 1.5), 0.02);
    expect(speed_of(&living, 3), 4 * 0.01 / 1.69, 0, 0, 0.01);
    hair_test_die(&living);
}

static GLuint make_texture(const float velocity[3])
{
    GLuint texture = 0;
    float texels[8 * 3];
    for (int i = 0; i < 24; ++i) texels[i] = velocity[i % 3];
    glCreateTextures(GL_TEXTURE_3D, 1, &texture);
    glTextureStorage3D(texture, 1, GL_RGB32F, 2, 2, 2);
    glTextureSubImage3D(texture, 0, 0, 0, 0, 2, 2, 2, GL_RGB, GL_FLOAT, texels);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    return texture;
}

static void wind_texture_blows_only_where_it_is_finite(void** state)
{
    struct hair_test* test = *state;
    const hair_vec3 at[] = {{1, 1, 1}, {5, 1, 1}};
    const float flow[3] = {1, -2, 3}, none[3] = {NAN, INFINITY, 0};
    struct hair_test_living living = tracers(test, at, 2);
    GLuint sound = make_texture(flow), broken = make_texture(none);
    hair_wind wind = hair_wind_default();
    for (int k = 0; k < 3; ++k) wind.texture_transform[5 * k] = 0.5f; // Maps a box from 0 to 2 m.
    wind.texture = sound;
    hair_test_wind_coupling(&living, &wind);
    measure(&living);
    expect(speed_of(&living, 0), 1, -2, 3, 0.01);
    expect(speed_of(&living, 1), 0, 0, 0, 0.01);
    wind.texture = broken;
    wind.velocity[0] = 1;
    hair_test_wind_coupling(&living, &wind);
    measure(&living);
    expect(speed_of(&living, 0), 1, 0, 0, 0.01);
    wind.texture = sound;
    hair_test_wind_coupling(&living, &wind);
    glDeleteTextures(1, &sound);
    // The flag must hold no OpenGL error afterwards, which the end of every test checks.
    measure(&living);
    expect(speed_of(&living, 0), 1, 0, 0, 0.01);
    hair_test_refused(test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT, "not a 3D texture");
    glDeleteTextures(1, &broken);
    hair_test_die(&living);
}

static void wind_out_of_range_is_refused(void** state)
{
    struct hair_test* test = *state;
    const hair_vec3 origin = {0, 0, 0};
    struct hair_test_living living = tracers(test, &origin, 1);
    hair_wind wind = hair_wind_default();
    hair_wind_source source = hair_wind_source_default();
    wind.source_count = 1;
    hair_test_refused(test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT, "sources is NULL");
    wind.sources = &source;
    source.speed = NAN;
    hair_test_refused(test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT,
                      "sources[0].speed is nan");
    source.speed = 1;
    source.radius = 0;
    hair_test_refused(test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT, "sources[0].radius is 0");
    wind = hair_wind_default();
    wind.source_count = 5;
    hair_test_refused(test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT, "source_count is 5");
    wind = hair_wind_default();
    wind.velocity[1] = NAN;
    hair_test_refused(test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT, "velocity[1] is nan");
    hair_test_ok(test, hair_set_wind(living.hair, NULL));
    hair_test_die(&living);
}

static void gusts_continue_from_a_saved_state(void** state)
{
    const hair_vec3 at[] = {{0, 0, 0}, {1, 0.5f, 0}};
    struct hair_test_living first = tracers(*state, at, 2), second = tracers(*state, at, 2);
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = 3, wind.turbulence.intensity = 0.5f;
    hair_test_wind_coupling(&first, &wind);
    hair_test_wait(&first, 7);
    struct hair_test_blob blob = hair_test_save(*state, first.hair);
    hair_test_wait(&first, 5);
    hair_test_wait(&second, 2);
    hair_test_wind_coupling(&second, &wind);
    hair_test_ok(*state, hair_load(second.hair, blob.bytes, blob.size));
    hair_test_wait(&second, 5);
    hair_test_read_guides(&first);
    hair_test_read_guides(&second);
    assert_memory_equal(first.positions, second.positions, 12 * first.vertices);
    free(blob.bytes);
    hair_test_die(&first);
    hair_test_die(&second);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(gusts_have_the_set_intensity_and_are_alike_nearby),
        HAIR_TEST(gusts_travel_with_the_wind),
        HAIR_TEST(a_ball_shelters_what_is_behind_it),
        HAIR_TEST(wind_sources_blow_with_their_settings),
        HAIR_TEST(wind_texture_blows_only_where_it_is_finite),
        HAIR_TEST(wind_out_of_range_is_refused),
        HAIR_TEST(gusts_continue_from_a_saved_state),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
