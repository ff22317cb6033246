// drag.c - Drag of a straight strand across a uniform wind, against published drag of cylinders.
#include "tools/bench/physics.h"

#include <math.h>
#include <stdio.h>

#define SUBSTEPS 20
#define FALL 4.0 // s: after which a hair falls at its terminal speed
#define LAST 0.1 // s: the end of the fall, in which its speed is measured

// Return the drag coefficient of a cylinder in an unbounded viscous flow (Kaplun 1957).
static double slow_drag(double reynolds)
{
    double e = 1 / (0.5 - 0.57721566 - log(reynolds / 8));
    return 8 * BENCH_PI / reynolds * e * (1 - 0.87 * e * e);
}

static const struct {
    double reynolds, published; // 0 uses slow_drag()
    const char* reference;
} rows[] = {{0.1, 0, "Kaplun 1957"},
            {0.2, 0, "Kaplun 1957"},
            {0.728, 13.2, "Wieselsberger 1922"},
            {3.18, 4.87, "Wieselsberger 1922"},
            {5, 4.116, "Dennis, Chang 1970"},
            {7, 3.421, "Dennis, Chang 1970"},
            {10, 2.846, "Dennis, Chang 1970"},
            {20, 2.045, "Dennis, Chang 1970"},
            {31.7, 1.73, "Wieselsberger 1922"},
            {40, 1.522, "Dennis, Chang 1970"},
            {60, 1.39, "Park, Kwon, Choi 1998"},
            {80, 1.35, "Park, Kwon, Choi 1998"},
            {100, 1.33, "Park, Kwon, Choi 1998"}};

// Measure the drag by the acceleration of a free strand. The velocity difference decays by a
// fraction `rate` per second.
static bool measure(struct bench* bench, double speed, double guess, double* rate)
{
    const double root[3] = {0, 0, 0}, along[3] = {1, 0, 0};
    struct bench_live_scene live;
    struct bench_scene scene = bench_scene_default();
    double now[3 * BENCH_MAX_VERTICES];
    bench_scene_straight(&scene, 8, 0.1, root, along);
    scene.solver = HAIR_SOLVER_ACCURATE;
    scene.mapping = bench->options.mapping;
    scene.substep = (double)(float)fmax(1e-3 / guess, 1.1e-5);
    scene.physics.gravity[1] = 0;
    scene.physics.drag = 1;
    scene.physics.root = HAIR_ROOT_FREE;
    scene.wind.velocity[2] = (float)speed;
    if (!bench_live(bench, &scene, &live)) return false;
    bool ok = bench_step(&live, NULL, (SUBSTEPS + 0.5) * scene.substep) && bench_read(&live, now);
    double time = SUBSTEPS * scene.substep;
    // From rest z = speed (t - (1 - exp(-rate t)) / rate) = speed rate t^2 / 2 (1 - rate t / 3 +
    // ...). z is the distance and t the time.
    if (ok) *rate = 2 * now[2] / (speed * time * time);
    if (ok) *rate *= 1 + *rate * time / 3;
    bench_free_live_scene(&live);
    return ok;
}

void bench_drag(struct bench* bench)
{
    if (!bench_begin(bench, "drag", "accurate")) return;
    struct bench_scene scene = bench_scene_default();
    struct bench_section section = bench_section_of(&scene.physics);
    double diameter = 2 * (double)scene.physics.fiber.radius, density = (double)scene.wind.density;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        double re = rows[i].reynolds, speed = re * (double)scene.wind.viscosity / (density * diameter);
        double published = rows[i].published > 0 ? rows[i].published : slow_drag(re), rate;
        // Factor from a rate to a coefficient.
        double by_rate = 2 * section.line_density / (density * diameter * speed);
        if (!measure(bench, speed, published / by_rate, &rate)) {
            bench_refuse(bench, "drag", "accurate");
            return;
        }
        json_t* row = bench_rows_add(&bench->rows);
        double measured = rate * by_rate, error = fabs(measured / published - 1);
        bench_set_text(row, "case", "drag");
        bench_set_text(row, "method", "accurate");
        bench_set_number(row, "reynolds", re);
        bench_set_number(row, "expected", published);
        bench_set_number(row, "measured", measured);
        bench_set_number(row, "relative_error", error);
        bench_set_number(row, "limit", 0.1);
        bench_set_flag(row, "pass", error <= 0.1);
        bench_set_text(row, "reference", rows[i].reference);
    }
}

// Return the speed at which the law of the library balances gravity across a level hair.
static double terminal_speed(const struct bench_scene* scene)
{
    struct bench_section section = bench_section_of(&scene->physics);
    double diameter = 2 * (double)scene->physics.fiber.radius, density = (double)scene->wind.density;
    double low = 0, high = 100;
    for (int i = 0; i < 60; ++i) {
        double speed = (low + high) / 2, re = speed * diameter * density / (double)scene->wind.viscosity;
        double force = hair_reference_drag_across(re) * density * diameter / 2 * speed * speed;
        *((double)scene->physics.drag * force < section.line_density * BENCH_GRAVITY ? &low : &high) = speed;
    }
    return low;
}

static bool fall(struct bench_live_scene* live, double* speed)
{
    double before[3 * BENCH_MAX_VERTICES], now[3 * BENCH_MAX_VERTICES];
    for (double t = 0; t < FALL - LAST / 2; t += LAST)
        if (!bench_step(live, NULL, LAST)) return false;
    if (!bench_read(live, before) || !bench_step(live, NULL, LAST) || !bench_read(live, now)) return false;
    *speed = (before[1] - now[1]) / LAST;
    return true;
}

static void measure_fall(struct bench* bench, hair_solver solver, uint32_t still_air, float drag)
{
    const char* method = bench_solver_name(solver);
    struct bench_scene scene = bench_level_scene(bench, solver, 16, 0, 0.2);
    struct bench_live_scene live;
    double speed;
    scene.physics.root = HAIR_ROOT_FREE;
    scene.physics.drag = drag;
    scene.wind.still_air = still_air;
    if (!bench_live_in_step(bench, &scene, LAST, &live)) {
        bench_refuse(bench, "still_air", method);
        return;
    }
    if (fall(&live, &speed)) {
        json_t* row = bench_physics_row(&live, "still_air", terminal_speed(&scene), speed,
                                        still_air ? 0.01 : 0.1, "1 + 9.75 Re^-0.744, White 1991");
        bench_set_count(row, "still_air", still_air);
        bench_set_number(row, "drag", (double)drag);
    } else
        bench_refuse(bench, "still_air", method);
    bench_free_live_scene(&live);
}

// Without the law, damping stands for a drag of 0.1.
void bench_still_air(struct bench* bench)
{
    for (int s = 0; s < BENCH_RODS; ++s) {
        if (!bench_begin(bench, "still_air", bench_solver_name(bench_rod_solvers[s]))) continue;
        measure_fall(bench, bench_rod_solvers[s], 0, 0.1f);
        measure_fall(bench, bench_rod_solvers[s], 1, 0.1f);
        measure_fall(bench, bench_rod_solvers[s], 1, 1);
    }
}
