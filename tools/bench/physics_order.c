// physics_order.c - Order of convergence in the substep, and conservation of energy.
#include <epoxy/gl.h> // before headers that include OpenGL's own

#include "lib/api/api.h"
#include "tools/bench/physics.h"

#include <math.h>
#include <stdlib.h>

#define FRAME (1.0 / 60)
#define LENGTH 0.3 // m

// Make a strand that is released at an angle from the horizontal, in degrees, upwards positive.
static struct bench_scene make_hair(const struct bench* bench, hair_solver solver, uint32_t vertices,
                                    double angle)
{
    const double radians = angle * BENCH_PI / 180;
    const double root[3] = {0, 0, 0}, along[3] = {cos(radians), sin(radians), 0};
    struct bench_scene scene = bench_scene_default();
    bench_scene_straight(&scene, vertices, LENGTH, root, along);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.fiber.youngs_modulus = 3e9f;
    scene.physics.fiber.radius = 5e-5f;
    return scene;
}

// Order -------------------------------------------------------------------------------------------

#define ORDER_VERTICES 8 // few enough that long substeps treat bending explicitly
#define ORDER_FRAMES 12

// Return the root mean square error of the vertices over the frames, against the converged rod,
// over the length. Return NaN if the library refused.
static double error_of(struct bench_live_scene* live, const double* ground_truth)
{
    double positions[3 * ORDER_VERTICES], squares = 0;
    uint32_t size = 3 * ORDER_VERTICES;
    for (int k = 0; k < ORDER_FRAMES; ++k) {
        if (!bench_step(live, NULL, FRAME) || !bench_read(live, positions)) return NAN;
        for (uint32_t i = 0; i < size; ++i)
            squares += pow(positions[i] - ground_truth[(uint32_t)k * size + i], 2);
    }
    return sqrt(squares / (ORDER_FRAMES * ORDER_VERTICES)) / LENGTH;
}

static void add_order_row(struct bench_live_scene* live, uint32_t substeps, const double error[2])
{
    json_t* row = bench_physics_row(live, "order", 2, log2(error[0] / error[1]), 0.1,
                                    "log2 of how the error shrinks with half the substep");
    bench_set_count(row, "substeps", substeps);
}

static void measure_order(struct bench* bench, hair_solver solver, uint32_t substeps)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "order", method)) return;
    double ground_truth[ORDER_FRAMES * 3 * ORDER_VERTICES], error[3] = {NAN, NAN, NAN};
    struct bench_scene scene = make_hair(bench, solver, ORDER_VERTICES, -30);
    struct hair_reference_rod* rod = bench_reference(&scene);
    if (!rod) return;
    hair_reference_rod_converge(rod, ORDER_FRAMES, NULL, FRAME, 256, 8192, 1e-8 * LENGTH, ground_truth);
    hair_reference_rod_destroy(rod);
    for (uint32_t i = 0; i < 3; ++i) {
        struct bench_live_scene live;
        scene.substep = FRAME / (substeps << i);
        if (!bench_live(bench, &scene, &live)) {
            bench_refuse(bench, "order", method);
            return;
        }
        error[i] = error_of(&live, ground_truth);
        if (i > 0) add_order_row(&live, substeps << (i - 1), error + i - 1);
        bench_free_live_scene(&live);
    }
}

void bench_order(struct bench* bench)
{
    if (bench->options.quick) return;
    measure_order(bench, HAIR_SOLVER_ACCURATE, 4);
    measure_order(bench, HAIR_SOLVER_DIRECT, 8);
}

// Energy ------------------------------------------------------------------------------------------

// Substeps that the energy is averaged over. They span several swings, because energy
// oscillates a little within one.
#define WINDOW 4000
#define VERTICES 32

// Compute the mean energy over a window. The velocity between two substeps is the difference
// quotient of their positions.
static bool average_energy(struct bench_live_scene* live, struct hair_reference_rod* rod, double* out)
{
    double before[3 * VERTICES], now[3 * VERTICES], velocity[3 * VERTICES], sum = 0;
    if (!bench_read(live, before)) return false;
    for (int k = 0; k < WINDOW; ++k) {
        if (!bench_step(live, NULL, live->substep) || !bench_read(live, now)) return false;
        for (int i = 0; i < 3 * VERTICES; ++i) velocity[i] = (now[i] - before[i]) / live->substep;
        hair_reference_rod_set_state(rod, before, velocity);
        sum += hair_reference_rod_energy_of(rod).total / 2;
        hair_reference_rod_set_state(rod, now, velocity);
        sum += hair_reference_rod_energy_of(rod).total / 2;
        for (int i = 0; i < 3 * VERTICES; ++i) before[i] = now[i];
        if (bench_was_interrupted()) return false;
    }
    *out = sum / WINDOW;
    return true;
}

static bool pass_substeps(struct bench_live_scene* live, uint32_t count)
{
    for (; count > 0 && !bench_was_interrupted(); count -= count < 50 ? count : 50)
        if (!bench_step(live, NULL, live->substep * (count < 50 ? count : 50))) return false;
    return true;
}

// Measure the drift of the energy. Only swings of 30 degrees to both sides have a limit. A strand
// released from higher up cracks like a whip, which few substeps do not resolve.
static void measure_energy(struct bench* bench, hair_solver solver, double angle)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "energy", method)) return;
    struct bench_live_scene live;
    struct bench_scene scene = make_hair(bench, solver, VERTICES, angle);
    struct hair_reference_rod* rod = bench_reference(&scene);
    double first, last;
    if (!rod || !bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "energy", method);
        hair_reference_rod_destroy(rod);
        return;
    }
    if (average_energy(&live, rod, &first) && pass_substeps(&live, 100000 - 2 * WINDOW) &&
        average_energy(&live, rod, &last)) {
        double mass = bench_section_of(&scene.physics).line_density * LENGTH;
        json_t* row =
            bench_physics_row(&live, "energy", 0, (last - first) / (mass * BENCH_GRAVITY * LENGTH / 2),
                              solver == HAIR_SOLVER_ACCURATE && angle < -45 ? 1e-5 : BENCH_NO_LIMIT,
                              "drift in 100,000 substeps over m g L / 2");
        bench_set_number(row, "substeps", bench_substeps(&live));
        bench_set_number(row, "angle", angle);
    } else
        bench_refuse(bench, "energy", method);
    bench_free_live_scene(&live);
    hair_reference_rod_destroy(rod);
}

void bench_energy(struct bench* bench)
{
    for (int i = 0; i < 2 * BENCH_RODS && !bench->options.quick; ++i)
        measure_energy(bench, bench_rod_solvers[i / 2], i % 2 ? -30 : -60);
}

// Whips -------------------------------------------------------------------------------------------

#define WHIP_SECONDS 5
#define WHIP_READS 10 // Substeps from one reading of the energy to the next.

// Compute the energy in the middle of the last substep, or of its last part. The velocity is what
// the solver keeps, because positions at the ends of substeps do not show the motion within.
static bool find_whip_energy(struct bench_live_scene* live, struct hair_reference_rod* rod, double* out)
{
    double at[3 * BENCH_MAX_VERTICES], before[3 * BENCH_MAX_VERTICES], velocity[3 * BENCH_MAX_VERTICES];
    struct hair_state state[BENCH_MAX_VERTICES];
    uint32_t vertices = live->scene->vertices;
    if (!bench_read(live, at)) return false;
    glGetNamedBufferSubData(live->hair->sim.state, 0, vertices * (GLsizeiptr)sizeof *state, state);
    double part = fmin((double)state[0].position.w, 1); // as a fraction of the substep
    for (uint32_t i = 0; i < 3 * vertices; ++i) {
        double moved = (double)(&state[i / 3].displacement.x)[i % 3];
        velocity[i] = moved / live->substep;
        before[i] = at[i] - part * moved;
    }
    hair_reference_rod_set_state(rod, before, velocity);
    *out = hair_reference_rod_energy_of(rod).total / 2;
    hair_reference_rod_set_state(rod, at, velocity);
    *out += hair_reference_rod_energy_of(rod).total / 2;
    return true;
}

// Measure the energy of a strand five seconds after its level release, relative to hanging down.
// Measure its maximum until then too.
static bool run_whip(struct bench_live_scene* live, struct hair_reference_rod* rod)
{
    double weight = bench_section_of(&live->scene->physics).line_density * LENGTH * BENCH_GRAVITY;
    double energy = 0, peak = 0, count = round(WHIP_SECONDS / (WHIP_READS * live->substep));
    for (double k = 0; k < count; ++k) {
        if (!bench_step(live, NULL, WHIP_READS * live->substep) || bench_was_interrupted()) return false;
        if (!find_whip_energy(live, rod, &energy)) return false;
        energy = energy / (weight * LENGTH / 2) + 1;
        peak = fmax(peak, energy);
    }
    json_t* row = bench_physics_row(live, "whip_energy", 1, energy,
                                    live->scene->solver == HAIR_SOLVER_ACCURATE ? 0.05 : BENCH_NO_LIMIT,
                                    "energy above hanging down, after 5 s, over that at the start");
    bench_set_number(row, "peak", peak);
    bench_set_number(row, "substeps", bench_substeps(live));
    return true;
}

static void measure_whip(struct bench* bench, hair_solver solver, uint32_t vertices)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "whip_energy", method)) return;
    struct bench_live_scene live;
    struct bench_scene scene = make_hair(bench, solver, vertices, 0);
    struct hair_reference_rod* rod = bench_reference(&scene);
    if (!rod || !bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "whip_energy", method);
        hair_reference_rod_destroy(rod);
        return;
    }
    if (!run_whip(&live, rod)) bench_refuse(bench, "whip_energy", method);
    bench_free_live_scene(&live);
    hair_reference_rod_destroy(rod);
}

void bench_whip_energy(struct bench* bench)
{
    static const uint32_t vertices[] = {16, 32, 64, 128};
    if (bench->options.quick) return;
    for (size_t i = 0; i < sizeof vertices / sizeof *vertices; ++i)
        measure_whip(bench, HAIR_SOLVER_ACCURATE, vertices[i]);
    measure_whip(bench, HAIR_SOLVER_DIRECT, VERTICES);
}
