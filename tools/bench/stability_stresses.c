// stability_stresses.c - Stresses of the suite `stability`.
#include "tools/bench/stability.h"

#include <math.h>

#define FRAME (1.0 / 60)

static const double up[3] = {0, 1, 0}, forward[3] = {0, 0, 1}, none[3] = {0, 0, 0};

// Yaw the head by 0.6 sin^2(pi t) rad from its rest pose. It is at rest at the end of every second.
static void yaw(struct bench_watch* watch, double time)
{
    double sine = sin(BENCH_PI * time);
    watch->head = bench_pose(up, 0.6 * sine * sine, watch->living->scene->head.position);
}

static bool shake(struct bench_watch* watch, double seconds, double dt)
{
    for (double t = 0; t < seconds - 1e-9;) {
        t += dt;
        yaw(watch, t);
        if (!bench_watch_step(watch, dt)) return false;
    }
    return true;
}

static bool stay(struct bench_watch* watch, double seconds, double dt)
{
    for (double t = 0; t < seconds - 1e-9; t += dt)
        if (!bench_watch_step(watch, dt)) return false;
    return true;
}

static bool shake_ordinarily(struct bench_watch* watch)
{
    return shake(watch, 2, FRAME);
}

// Time --------------------------------------------------------------------------------------------

static bool take_tenths(struct bench_watch* watch)
{
    return shake(watch, 2, 0.1);
}

static void allow_seconds(struct bench_scene* scene)
{
    scene->max_dt = 1;
}
static bool take_seconds(struct bench_watch* watch)
{
    for (int k = 1; k <= 4; ++k) { // at the maximum yaw and back
        yaw(watch, 0.5 * k);
        if (!bench_watch_step(watch, 1)) return false;
    }
    return true;
}

static bool take_nanoseconds(struct bench_watch* watch)
{
    return shake(watch, 1, FRAME) && stay(watch, 3e-7, 1e-9);
}

static bool take_nothing(struct bench_watch* watch)
{
    if (!shake(watch, 1, FRAME)) return false;
    for (int k = 0; k < 100; ++k) {
        yaw(watch, k / 100.0);
        if (!bench_watch_step(watch, 0)) return false;
    }
    yaw(watch, 1);
    return true;
}

static bool alternate(struct bench_watch* watch)
{
    double t = 0;
    for (int k = 0; k < 96; ++k) { // two seconds
        double dt = k % 2 ? 1.0 / 240 : 1.0 / 30;
        t += dt;
        yaw(watch, t);
        if (!bench_watch_step(watch, dt)) return false;
    }
    yaw(watch, 1);
    return bench_watch_step(watch, 1.0 / 30);
}

// Simulate a million substeps.
static bool rest_long(struct bench_watch* watch)
{
    double substeps = watch->living->bench->options.quick ? 1e4 : 1e6;
    return stay(watch, substeps * watch->living->substep, 0.1);
}

// The head ----------------------------------------------------------------------------------------

static bool jump(struct bench_watch* watch)
{
    if (!shake(watch, 0.5, FRAME)) return false;
    watch->head.position[0] += 10;
    return bench_watch_step(watch, FRAME);
}

static bool spin(struct bench_watch* watch)
{
    // Maximum speed in rad/s, after two seconds of acceleration, for one second, before two seconds
    // of deceleration.
    const double fastest = 2 * BENCH_PI * 10;
    double angle = 0;
    for (int k = 0; k < 300; ++k) {
        double t = (k + 0.5) * FRAME, fraction = fmin(fmin(t / 2, 1), (5 - t) / 2);
        angle += fraction * fastest * FRAME;
        watch->head = bench_pose(up, angle, none);
        if (!bench_watch_step(watch, FRAME)) return false;
    }
    return true;
}

// Turn the head by half a turn in one frame, about an axis perpendicular to the strand. The root
// then points the other way.
static bool flip(struct bench_watch* watch)
{
    if (!stay(watch, 0.5, FRAME)) return false;
    watch->head = bench_pose(forward, BENCH_PI, none);
    if (!bench_watch_step(watch, FRAME) || !stay(watch, 0.5, FRAME)) return false;
    watch->head = bench_pose(forward, 0, none);
    return bench_watch_step(watch, FRAME);
}

static void go_far(struct bench_scene* scene)
{
    scene->head.position[0] = 1e5;
    scene->head.position[1] = -1e5;
}
// Floats in world space resolve 8 mm here. For measurements, the hair is teleported to the origin,
// which does not move it relative to the head.
static bool shake_far(struct bench_watch* watch)
{
    float here[16], there[16];
    for (int k = 1; k <= 120; ++k) {
        double sine = sin(BENCH_PI * k * FRAME);
        watch->head = bench_pose(up, 0.6 * sine * sine, watch->living->scene->head.position);
        if (!bench_step(watch->living, &watch->head, FRAME)) return false;
        if (k % 10) continue;
        struct hair_reference_rod_pose near = bench_pose(up, 0.6 * sine * sine, none);
        bench_matrix(&near, there);
        bench_matrix(&watch->head, here);
        if (hair_teleport(watch->living->hair, there) || !bench_read(watch->living, watch->before))
            return false;
        watch->head = near;
        if (!bench_watch_step(watch, 0) || hair_teleport(watch->living->hair, here)) return false;
    }
    watch->head = bench_pose(up, 0, none);
    bench_matrix(&watch->head, there);
    return !hair_teleport(watch->living->hair, there) && bench_read(watch->living, watch->before);
}

// Material and forces -----------------------------------------------------------------------------

static void hang_ten(struct bench_scene* scene)
{
    scene->physics.tip_mass = 10;
}
static void hang_thousand(struct bench_scene* scene)
{
    scene->physics.tip_mass = 1000;
}
static void make_stiff(struct bench_scene* scene)
{
    // Use the maximum, and a section that makes up for the rest.
    scene->physics.fiber.youngs_modulus = 1e12f;
    scene->physics.fiber.radius *= sqrtf(3);
}
static void make_limp(struct bench_scene* scene)
{
    scene->physics.fiber.youngs_modulus = 0;
}

static bool shake_under(struct bench_watch* watch, const hair_physics* physics)
{
    return !hair_set_physics(watch->living->hair, physics) && shake(watch, 2, FRAME);
}
static bool shake_in_honey(struct bench_watch* watch)
{
    hair_physics physics = watch->calm;
    physics.damping = 1000;
    return shake_under(watch, &physics);
}
static bool wind_coupling(struct bench_watch* watch)
{
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = 600;
    wind.velocity[2] = 800;
    return !hair_set_wind(watch->living->hair, &wind) && shake(watch, 2, FRAME);
}
// Use coincident strands, the highest possible density, which the hair-hair grid pushes apart.
static void hair_grid(struct bench_scene* scene)
{
    scene->strands = 64;
}
static bool shake_in_hair_grid(struct bench_watch* watch)
{
    hair_physics physics = watch->calm;
    physics.hair_hair.cohesion = 1000;
    physics.hair_hair.pressure_stiffness = 100;
    return shake_under(watch, &physics);
}
static bool weigh(struct bench_watch* watch)
{
    hair_physics physics = watch->calm;
    physics.gravity[1] = -1000;
    return shake_under(watch, &physics);
}

// Shapes ------------------------------------------------------------------------------------------

static void resize(struct bench_scene* scene, uint32_t vertices)
{
    const double root[3] = {0.1, 0, 0}, along[3] = {cos(BENCH_PI / 6), -sin(BENCH_PI / 6), 0};
    bench_scene_straight(scene, vertices, 0.3, root, along);
}
static void have_2(struct bench_scene* scene)
{
    resize(scene, 2);
}
static void have_3(struct bench_scene* scene)
{
    resize(scene, 3);
}
static void have_64(struct bench_scene* scene)
{
    resize(scene, 64);
}
static void have_256(struct bench_scene* scene)
{
    resize(scene, 256);
}

// Put vertex i on the straight strand, at the fraction `at` of its length.
static void put(struct bench_scene* scene, uint32_t i, double at)
{
    for (uint32_t k = 0; k < 3; ++k) {
        double root = (double)scene->positions[k],
               tip = (double)scene->positions[3 * (scene->vertices - 1) + k];
        scene->positions[3 * i + k] = (float)(root + at * (tip - root));
    }
}
// Vertices are hardly farther apart than 1e-5 of the length, below which the groom merges them. The
// groom spaces the vertices of guides out.
static void let_three_coincide(struct bench_scene* scene)
{
    put(scene, 16, 15.0 / 31 + 2e-5);
    put(scene, 17, 15.0 / 31 + 4e-5);
}
static void gather_at_root(struct bench_scene* scene)
{
    for (uint32_t i = 1; i + 1 < scene->vertices; ++i) put(scene, i, 2e-5 * i);
}

// Colliders ---------------------------------------------------------------------------------------

static hair_collider ball_at(double x, double y, double z)
{
    return (hair_collider){.shape = HAIR_SHAPE_SPHERE,
                           .position = {(float)x, (float)y, (float)z},
                           .rotation = {0, 0, 0, 1},
                           .size = {0.05f, 0},
                           .scale = 1,
                           .friction = 1};
}

// Move a ball past the hair at 5 m/s.
static bool sweep(struct bench_watch* watch)
{
    if (!stay(watch, 2, FRAME)) return false;
    for (int k = 0; k < 24; ++k) {
        watch->colliders[0] = ball_at(0.15, -0.2, -1 + 5 * k * FRAME);
        watch->collider_count = 1;
        if (!bench_watch_step(watch, FRAME)) return false;
    }
    return true;
}

// Start with the middle of the strand inside a ball. The strand has a second to come out.
static bool start_inside(struct bench_watch* watch)
{
    watch->colliders[0] = ball_at(0.1 + 0.15 * cos(BENCH_PI / 6), -0.15 * sin(BENCH_PI / 6) - 0.01, 0.005);
    watch->collider_count = 1;
    watch->spared = 1;
    return stay(watch, 3, FRAME);
}

const struct bench_stress bench_stresses[] = {
    {"ordinary", NULL, shake_ordinarily, false},
    {"frame_100_ms", NULL, take_tenths, false},
    {"frame_1_s", allow_seconds, take_seconds, false},
    {"frame_1_ns", NULL, take_nanoseconds, false},
    {"frame_0", NULL, take_nothing, false},
    {"frame_alternating", NULL, alternate, false},
    {"rest_long", NULL, rest_long, false},
    {"jump_10_m", NULL, jump, false},
    {"spin_10_hz", NULL, spin, false},
    {"root_flip", NULL, flip, false},
    {"head_at_100_km", go_far, shake_far, false},
    {"tip_mass_10", hang_ten, shake_ordinarily, true},
    {"tip_mass_1000", hang_thousand, shake_ordinarily, true},
    {"young_x1000", make_stiff, shake_ordinarily, true},
    {"young_0", make_limp, shake_ordinarily, true},
    {"damping_1000", NULL, shake_in_honey, false},
    {"wind_1000", NULL, wind_coupling, true},
    {"crowd_of_1", NULL, shake_in_hair_grid, true},
    {"crowd_coincident", hair_grid, shake_in_hair_grid, true},
    {"gravity_1000", NULL, weigh, false},
    {"coincident_vertices", let_three_coincide, shake_ordinarily, false},
    {"vertices_at_root", gather_at_root, shake_ordinarily, false},
    {"collider_at_5_m_s", NULL, sweep, false},
    {"started_in_collider", NULL, start_inside, false},
    {"vertices_2", have_2, shake_ordinarily, false},
    {"vertices_3", have_3, shake_ordinarily, false},
    {"vertices_64", have_64, shake_ordinarily, false},
    {"vertices_256", have_256, shake_ordinarily, false},
    {NULL, NULL, NULL, false},
};
