// physics_capstan.c - A chain over a rough cylinder with both ends hanging, which holds or slips.
#include "tools/bench/physics.h"

#include <math.h>

#define RADIUS 0.05 // radius of the collider, m
#define SHORT 0.02 // length that hangs on the root's side, m
#define SLIPPED 0.01 // threshold of slip in two seconds, m
#define CREEP 5e-5 // maximum creep of a chain that holds, m/s

// Return the length of the long side beyond which the chain slips.
//
// Let t be the angle over the cylinder, T(t) the tension, w the weight per metre, m the friction
// coefficient and R the radius. At the limit of slip, T' = m T + w R (cos t + m sin t). The
// solution is T = C e^(m t) + w R (A cos t + (m A + 1) sin t) with A = -2 m / (1 + m^2). T(0) = w
// SHORT determines C. The result is T(pi) / w.
static double find_limit(double friction, double radius)
{
    double a = -2 * friction / (1 + friction * friction);
    return radius * ((SHORT / radius - a) * exp(friction * BENCH_PI) - a);
}

// Compute the chain's position at arc length `at` from its root. The chain goes up, over the
// cylinder about the origin, and down.
static void find_place(double at, double radius, double out[2])
{
    double angle = (at - SHORT) / radius;
    if (angle <= 0) {
        out[0] = -radius;
        out[1] = at - SHORT;
    } else if (angle < BENCH_PI) {
        out[0] = -radius * cos(angle);
        out[1] = radius * sin(angle);
    } else {
        out[0] = radius;
        out[1] = BENCH_PI * radius + SHORT - at;
    }
}

static struct bench_scene make_scene(const struct bench* bench, hair_solver solver, uint32_t vertices,
                                     double friction, double fraction)
{
    struct bench_scene scene = bench_scene_default();
    double margin = 0.001, radius = RADIUS + margin;
    double length = SHORT + BENCH_PI * radius + fraction * find_limit(friction, radius);
    scene.vertices = vertices;
    for (uint32_t i = 0; i < vertices; ++i) {
        double at[2];
        find_place(length * i / (vertices - 1), radius, at);
        scene.positions[3 * i] = (float)at[0];
        scene.positions[3 * i + 1] = (float)at[1];
    }
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.root = HAIR_ROOT_FREE;
    scene.physics.fiber.youngs_modulus = 0;
    scene.physics.damping = 4;
    scene.physics.collision.friction = (float)friction;
    scene.physics.collision.margin = (float)margin;
    return scene;
}

static bool wait_and_read(struct bench_live_scene* live, int frames, double* out)
{
    for (int k = 0; k < frames; ++k)
        if (!bench_step(live, NULL, 1.0 / 60) || bench_was_interrupted()) return false;
    return bench_read(live, out);
}

static void add_row(struct bench_live_scene* live, double friction, double fraction, double slipped,
                    double creep)
{
    bool slips = fraction > 1;
    json_t* row = bench_physics_row(live, "capstan", slips, slipped > SLIPPED, 0,
                                    "weights over a rough cylinder: 1 slips, 0 holds");
    bench_set_number(row, "friction", friction);
    bench_set_number(row, "load", fraction);
    bench_set_number(row, "creep", creep);
    bench_set_null(row, "relative_error");
    bench_set_number(row, "limit", slips ? NAN : CREEP);
    bench_set_flag(row, "pass", slips ? slipped > SLIPPED : slipped <= SLIPPED && creep <= CREEP);
}

static void measure(struct bench* bench, hair_solver solver, uint32_t vertices, double friction,
                    double fraction)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "capstan", method)) return;
    double first[3 * BENCH_MAX_VERTICES], middle[3 * BENCH_MAX_VERTICES], last[3 * BENCH_MAX_VERTICES];
    struct bench_scene scene = make_scene(bench, solver, vertices, friction, fraction);
    struct bench_live_scene live;
    hair_collider cylinder = hair_collider_default();
    cylinder.shape = HAIR_SHAPE_CAPSULE;
    cylinder.size[0] = (float)RADIUS;
    cylinder.size[1] = 0.2f;
    cylinder.rotation[0] = cylinder.rotation[3] = (float)sqrt(0.5); // maps local y to z
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "capstan", method);
        return;
    }
    uint32_t tip = 3 * (vertices - 1) + 1;
    if (!hair_set_colliders(live.hair, &cylinder, 1, sizeof cylinder) && bench_read(&live, first) &&
        wait_and_read(&live, 60, middle) && wait_and_read(&live, 60, last))
        add_row(&live, friction, fraction, first[tip] - last[tip], fabs(middle[tip] - last[tip]));
    else
        bench_refuse(bench, "capstan", method);
    bench_free_live_scene(&live);
}

void bench_capstan(struct bench* bench)
{
    static const double frictions[] = {0.2, 0.5}, fractions[] = {0.95, 1.05};
    bool quick = bench->options.quick;
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t vertices = 32; vertices <= (quick ? 32 : 128); vertices *= 2)
            for (int f = 0; f < (quick ? 1 : 2); ++f)
                for (int k = 0; k < 2; ++k)
                    measure(bench, bench_rod_solvers[s], vertices, frictions[f], fractions[k]);
}
