// physics_swing.c - Chains without stiffness, with small swings of a hanging chain and large swings
// of one and two links.
#include "tests/reference/continuum.h"
#include "tools/bench/frequency.h"
#include "tools/bench/physics.h"

#include <math.h>

#define FRAME (1.0 / 60)
#define LENGTH 0.3 // m

static struct bench_scene make_chain(const struct bench* bench, hair_solver solver)
{
    struct bench_scene scene = bench_scene_default();
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.fiber.youngs_modulus = 0;
    scene.physics.root = HAIR_ROOT_HINGED;
    return scene;
}

// Small swings ------------------------------------------------------------------------------------

#define VERTICES 32
#define LINKS (VERTICES - 1)
#define FRAMES 720
// Angle of the steepest link, rad. Frequencies drop by a sixteenth of its square.
#define WIDEST 0.01

struct mode {
    double frequency; // rad/s
    double y[VERTICES]; // transverse displacement, up to a factor
    double mass[VERTICES];
};

// Compute a mode from the tip upwards. Each vertex balances its inertia, m w^2 y = sum of both
// links' transverse forces. m is the vertex mass, w the angular frequency and y the displacement.
static struct mode find_mode(uint32_t number)
{
    struct mode mode = {0};
    double lengths[LINKS], link = LENGTH / LINKS, hanging = 0;
    for (int j = 0; j < LINKS; ++j) {
        lengths[j] = link;
        mode.mass[j + 1] = j + 1 < LINKS ? link : link / 2;
    }
    mode.frequency = hair_reference_linkage_frequency(number, LINKS, lengths, mode.mass + 1, BENCH_GRAVITY);
    mode.y[LINKS] = 1;
    double pull = 0; // transverse force of the links below
    for (int i = LINKS; i > 0; --i) {
        hanging += mode.mass[i];
        pull += mode.mass[i] * mode.frequency * mode.frequency * mode.y[i];
        mode.y[i - 1] = mode.y[i] - pull * link / (hanging * BENCH_GRAVITY);
    }
    return mode;
}

static void place(const struct mode* mode, struct bench_scene* scene)
{
    double link = LENGTH / LINKS, steepest = 0, at[2] = {0, 0};
    for (int j = 0; j < LINKS; ++j) steepest = fmax(steepest, fabs(mode->y[j + 1] - mode->y[j]) / link);
    scene->vertices = VERTICES;
    for (int i = 0; i < VERTICES; ++i) {
        scene->positions[3 * i] = (float)at[0];
        scene->positions[3 * i + 1] = (float)at[1];
        if (i == LINKS) break;
        double angle = WIDEST * (mode->y[i + 1] - mode->y[i]) / link / steepest;
        at[0] += link * sin(angle);
        at[1] -= link * cos(angle);
    }
}

static bool record(struct bench_live_scene* live, const struct mode* mode, double* samples)
{
    double positions[3 * VERTICES];
    for (int k = 0; k < FRAMES; ++k) {
        if (!bench_read(live, positions) || bench_was_interrupted()) return false;
        samples[k] = 0;
        for (int i = 0; i < VERTICES; ++i) samples[k] += mode->mass[i] * mode->y[i] * positions[3 * i];
        if (!bench_step(live, NULL, FRAME)) return false;
    }
    return true;
}

static void measure_mode(struct bench* bench, hair_solver solver, uint32_t number)
{
    static const double far[] = {0.001, 0.005, 0.02}; // limits against the continuous chain
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "chain_modes", method)) return;
    double samples[FRAMES];
    struct mode mode = find_mode(number);
    struct bench_scene scene = make_chain(bench, solver);
    struct bench_live_scene live;
    place(&mode, &scene);
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "chain_modes", method);
        return;
    }
    if (record(&live, &mode, samples)) {
        double expected[] = {mode.frequency,
                             hair_reference_chain_frequency(number, LENGTH, BENCH_GRAVITY, 0)};
        double measured = bench_frequency(samples, FRAMES, FRAME, 0.8 * mode.frequency, 1.2 * mode.frequency);
        bool held = solver == HAIR_SOLVER_ACCURATE;
        for (int i = 0; i < 2; ++i) {
            json_t* row = bench_physics_row(&live, "chain_modes", expected[i] / (2 * BENCH_PI),
                                            measured / (2 * BENCH_PI),
                                            !held ? BENCH_NO_LIMIT
                                            : i   ? far[number - 1]
                                                  : 0.0005,
                                            i ? "continuous chain, Hz" : "chain of as many links, Hz");
            bench_set_count(row, "mode", number);
        }
    } else
        bench_refuse(bench, "chain_modes", method);
    bench_free_live_scene(&live);
}

void bench_chain_modes(struct bench* bench)
{
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t number = 1; number <= 3 && !bench->options.quick; ++number)
            measure_mode(bench, bench_rod_solvers[s], number);
}

// Large swings ------------------------------------------------------------------------------------

// Return the maximum distance from the exact linkage at the ends of all frames of a second. Return
// a negative value if the library refused.
static double farthest(struct bench_live_scene* live)
{
    uint32_t links = live->scene->vertices - 1;
    double lengths[2], masses[2], angles[2], rates[2] = {0, 0}, positions[9], max = 0;
    for (uint32_t j = 0; j < links; ++j) {
        lengths[j] = LENGTH / links;
        masses[j] = j + 1 < links ? 1 : 0.5;
        angles[j] = BENCH_PI / 2;
    }
    for (int k = 0; k < 60; ++k) {
        if (!bench_step(live, NULL, FRAME) || !bench_read(live, positions)) return -1;
        hair_reference_linkage_advance(links, lengths, masses, BENCH_GRAVITY, FRAME, 4, angles, rates);
        double x = 0, y = 0;
        for (uint32_t j = 0; j < links; ++j) {
            const double* p = positions + 3 * (j + 1);
            x += lengths[j] * sin(angles[j]);
            y -= lengths[j] * cos(angles[j]);
            max = fmax(max, hypot(hypot(p[0] - x, p[1] - y), p[2]));
        }
    }
    return max;
}

static void measure_pendulum(struct bench* bench, hair_solver solver, uint32_t vertices)
{
    const char* name = vertices == 2 ? "pendulum" : "double_pendulum";
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, name, method)) return;
    const double root[3] = {0, 0, 0}, along[3] = {1, 0, 0};
    struct bench_scene scene = make_chain(bench, solver);
    struct bench_live_scene live;
    bench_scene_straight(&scene, vertices, LENGTH, root, along);
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, name, method);
        return;
    }
    double max = farthest(&live);
    if (max >= 0)
        bench_physics_row(&live, name, 0, max / LENGTH,
                          solver == HAIR_SOLVER_ACCURATE ? 0.001 : BENCH_NO_LIMIT,
                          "linkage in its angles, farthest in 1 s over the length");
    else
        bench_refuse(bench, name, method);
    bench_free_live_scene(&live);
}

void bench_pendulums(struct bench* bench)
{
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t vertices = 2; vertices <= 3; ++vertices)
            measure_pendulum(bench, bench_rod_solvers[s], vertices);
}
