// physics_body.c - A free spinning helix, whose angular momentum is conserved and whose motion must
// match the reference.
#include "tools/bench/coil.h"
#include "tools/bench/physics.h"

#include <math.h>
#include <string.h>

#define VERTICES 48
#define SPIN 8.0 // rad/s
#define PULL 10.0f // pull in Hz that moves the helix with the head until its release
#define DRAG 20.0f // damping in 1/s during the pull
#define SECONDS_UP 1.0
#define STEP (1.0 / 240)

struct body {
    struct bench_live_scene living;
    double positions[3 * VERTICES], velocities[3 * VERTICES];
};

static struct bench_scene make_helix(const struct bench* bench, hair_solver solver)
{
    const struct bench_coil coil = {.radius = 0.02, .pitch = 0.04, .turns = 3, .vertices = VERTICES};
    struct bench_scene scene = bench_scene_default();
    bench_scene_coil(&scene, &coil);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.root = HAIR_ROOT_FREE;
    scene.physics.gravity[1] = 0;
    return scene;
}

// Return the head's pose. It rotates about an axis through the middle of the helix, first with
// constant acceleration, then at constant speed.
static struct hair_reference_rod_pose find_head(const double axis[3], double time)
{
    const double middle[3] = {-0.02, -0.06, 0};
    double rise = SECONDS_UP / 2;
    double angle = SPIN * (time < rise ? time * time / (2 * rise) : time - rise / 2);
    double s = sin(angle), c = 1 - cos(angle), move[3];
    for (int k = 0; k < 3; ++k) { // middle - R middle, by Rodrigues' formula
        int a = (k + 1) % 3, b = (k + 2) % 3;
        double cross = axis[a] * middle[b] - axis[b] * middle[a];
        double along = axis[0] * middle[0] + axis[1] * middle[1] + axis[2] * middle[2];
        move[k] = -(s * cross + c * (axis[k] * along - middle[k]));
    }
    return bench_pose(axis, angle, move);
}

// Pull the helix around with the head, then release it.
static bool spin_up(struct body* body, const double axis[3])
{
    struct bench_live_scene* live = &body->living;
    hair_physics calm = live->scene->physics, pulled = calm;
    pulled.shape.frequency_root = pulled.shape.frequency_tip = PULL;
    pulled.damping = DRAG;
    if (hair_set_physics(live->hair, &pulled)) return false;
    for (double time = STEP; time < SECONDS_UP + STEP / 2; time += STEP) {
        struct hair_reference_rod_pose head = find_head(axis, time);
        if (!bench_step(live, &head, STEP) || bench_was_interrupted()) return false;
    }
    return !hair_set_physics(live->hair, &calm) && bench_step(live, NULL, 4 * live->substep);
}

// Measure positions and velocities. Velocities are central differences, therefore the hair is
// advanced by two substeps.
static bool look(struct body* body)
{
    double before[3 * VERTICES], after[3 * VERTICES], h = body->living.substep;
    if (!bench_read(&body->living, before) || !bench_step(&body->living, NULL, h) ||
        !bench_read(&body->living, body->positions) || !bench_step(&body->living, NULL, h) ||
        !bench_read(&body->living, after))
        return false;
    for (int i = 0; i < 3 * VERTICES; ++i) body->velocities[i] = (after[i] - before[i]) / (2 * h);
    return true;
}

// Compute the angular momentum about the centre of mass, without the motion of the centre.
static void find_momentum(const struct body* body, const double* masses, double out[3])
{
    double centre[3] = {0}, drift[3] = {0}, mass = 0;
    for (int i = 0; i < VERTICES; ++i) {
        mass += masses[i];
        for (int k = 0; k < 3; ++k) {
            centre[k] += masses[i] * body->positions[3 * i + k];
            drift[k] += masses[i] * body->velocities[3 * i + k];
        }
    }
    memset(out, 0, 3 * sizeof *out);
    for (int i = 0; i < VERTICES; ++i)
        for (int k = 0; k < 3; ++k) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            double xa = body->positions[3 * i + a] - centre[a] / mass;
            double xb = body->positions[3 * i + b] - centre[b] / mass;
            double va = body->velocities[3 * i + a] - drift[a] / mass;
            double vb = body->velocities[3 * i + b] - drift[b] / mass;
            out[k] += masses[i] * (xa * vb - xb * va);
        }
}

static bool wait(struct body* body, double seconds)
{
    double count = round(seconds / body->living.substep);
    for (double k = 0; k < count; ++k)
        if (!bench_step(&body->living, NULL, body->living.substep)) return false;
    return !bench_was_interrupted();
}

static double length_of(const double v[3])
{
    return hypot(hypot(v[0], v[1]), v[2]);
}

// Return the maximum distance of a vertex from the reference after half a second, over the length.
// The reference starts from the solver's state.
static double compare(struct body* body, struct hair_reference_rod* rod)
{
    double ground_truth[3 * VERTICES], max = 0, h = body->living.substep;
    double count = round(0.5 / h);
    hair_reference_rod_set_state(rod, body->positions, body->velocities);
    struct hair_reference_rod_report report =
        hair_reference_rod_converge(rod, 1, NULL, count * h, 4096, 65536, 1e-5, ground_truth);
    if (!isfinite(report.change) || !wait(body, (count - 1) * h)) return NAN;
    if (!bench_read(&body->living, body->positions)) return NAN;
    for (int i = 0; i < 3 * VERTICES; i += 3) {
        double off[3];
        for (int k = 0; k < 3; ++k) off[k] = body->positions[i + k] - ground_truth[i + k];
        max = fmax(max, length_of(off));
    }
    return max / body->living.length;
}

static bool run(struct body* body, struct hair_reference_rod* rod, bool precesses)
{
    const double axes[2][3] = {{0, 1, 0}, {0.6, 0.8, 0}};
    double masses[VERTICES], first[3], last[3], turned = 0;
    hair_reference_rod_masses(rod, masses);
    if (!spin_up(body, axes[precesses]) || !look(body)) return false;
    if (precesses) {
        double off = compare(body, rod);
        bench_physics_row(&body->living, "precession", 0, off, 0.01,
                          "rod in double precision, farthest after 0.5 s over the length");
        return isfinite(off);
    }
    find_momentum(body, masses, first);
    if (!wait(body, 1) || !look(body)) return false;
    find_momentum(body, masses, last);
    for (int k = 0; k < 3; ++k) turned += first[k] * last[k];
    bench_physics_row(&body->living, "helix_spin", 1, turned / pow(length_of(first), 2), 0.01,
                      "angular momentum after 1 s over that at the start");
    return true;
}

static void measure(struct bench* bench, hair_solver solver, bool precesses)
{
    const char *name = precesses ? "precession" : "helix_spin", *method = bench_solver_name(solver);
    if (!bench_begin(bench, name, method)) return;
    struct bench_scene scene = make_helix(bench, solver);
    struct body body;
    struct hair_reference_rod* rod = bench_reference(&scene);
    if (!rod || !bench_live(bench, &scene, &body.living)) {
        bench_refuse(bench, name, method);
        hair_reference_rod_destroy(rod);
        return;
    }
    if (!run(&body, rod, precesses)) bench_refuse(bench, name, method);
    hair_reference_rod_destroy(rod);
    bench_free_live_scene(&body.living);
}

void bench_free_bodies(struct bench* bench)
{
    for (int s = 0; s < BENCH_RODS; ++s)
        for (int precesses = 0; precesses < (bench->options.quick ? 1 : 2); ++precesses)
            measure(bench, bench_rod_solvers[s], precesses);
}
