// physics_rest.c - Hair at rest as heavy cantilevers, straight and curved, the catenary, and rods
// that leave their plane.
#include "tests/reference/continuum.h"
#include "tools/bench/physics.h"

#include <math.h>

#define ARRAY_SIZE(a) (sizeof(a) / sizeof *(a))
// Segments of the chain that an arc is compared with, limited by BENCH_MAX_VERTICES.
#define FINE_SEGMENTS 254u

static const double nowhere[3] = {0, 0, 0};

static double degrees(double angle)
{
    return angle * BENCH_PI / 180;
}

// Add the distance of the tip from its expected position, over the length.
static void add_tip_row(struct bench_live_scene* live, const char* name, const double* positions,
                        double across, double down, double gamma, double angle, const char* reference)
{
    const double* tip = positions + 3 * (live->scene->vertices - 1);
    double off = hypot(hypot(tip[0] - across, tip[1] + down), tip[2]) / live->length;
    double limit = live->scene->vertices == 32 ? 0.005 : 0.001;
    json_t* row = bench_physics_row(live, name, 0, off, limit, reference);
    bench_set_number(row, "gamma", gamma);
    bench_set_number(row, "angle", angle);
}

// Measure a strand clamped at an angle in degrees from the horizontal, upwards positive. One row is
// the height that the tip hangs down (H) over its horizontal reach (W). A limp strand reaches
// little, therefore the relative error of H/W is much larger than the distance error over the
// length.
static void measure_cantilever(struct bench* bench, hair_solver solver, uint32_t vertices, double gamma,
                               double angle)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "cantilever", method)) return;
    const double length = 0.1, along[3] = {cos(degrees(angle)), sin(degrees(angle)), 0};
    double positions[3 * BENCH_MAX_VERTICES];
    struct bench_live_scene live;
    struct bench_scene scene = bench_scene_default();
    bench_scene_straight(&scene, vertices, length, nowhere, along);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.fiber.radius = 1e-4f;
    scene.physics.damping = 20;
    bench_scene_set_gamma(&scene, length, gamma);
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "cantilever", method);
        return;
    }
    if (bench_settle(&live, positions)) {
        struct hair_reference_elastica rest = hair_reference_elastica(gamma, 0, -degrees(angle));
        const double* tip = positions + 3 * (vertices - 1);
        double limit = vertices == 32 ? 0.01 : 0.004;
        if (gamma > 200) limit = vertices == 32 ? 0.03 : 0.015;
        json_t* row = bench_physics_row(&live, "cantilever", rest.down / rest.across, -tip[1] / tip[0], limit,
                                        "elastica, H/W");
        bench_set_number(row, "gamma", gamma);
        bench_set_number(row, "angle", angle);
        add_tip_row(&live, "cantilever", positions, length * rest.across, length * rest.down, gamma, angle,
                    "elastica, off by over L");
    } else
        bench_refuse(bench, "cantilever", method);
    bench_free_live_scene(&live);
}

// Compute the rest position of the tip of the scene's arc. The result is extrapolated from two
// chains, one with twice as many segments, because their errors are proportional to the squared
// segment length.
static bool find_arc_at_rest(const struct bench_scene* scene, double length, double turn, double tip[2])
{
    const double along[3] = {1, 0, 0}, across[3] = {0, -1, 0};
    struct bench_scene fine = *scene;
    double positions[3 * BENCH_MAX_VERTICES], found[2][2];
    for (uint32_t k = 0; k < 2; ++k) {
        uint32_t vertices = (FINE_SEGMENTS >> k) + 1;
        bench_scene_arc(&fine, vertices, length, turn, along, across);
        struct hair_reference_rod* rod = bench_reference(&fine);
        bool rest = rod && hair_reference_rod_rest(rod).converged;
        if (rest) hair_reference_rod_positions(rod, positions);
        hair_reference_rod_destroy(rod);
        if (!rest) return false;
        for (uint32_t c = 0; c < 2; ++c) found[k][c] = positions[3 * (vertices - 1) + c];
    }
    for (uint32_t c = 0; c < 2; ++c) tip[c] = found[0][c] + (found[0][c] - found[1][c]) / 3;
    return true;
}

// Measure a strand that is a circle at rest. It leaves its clamp horizontally and curls down.
// `turn` is in degrees.
static void measure_arc(struct bench* bench, hair_solver solver, uint32_t vertices, double gamma, double turn)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "cantilever_arc", method)) return;
    const double length = 0.1, along[3] = {1, 0, 0}, across[3] = {0, -1, 0};
    double positions[3 * BENCH_MAX_VERTICES], tip[2];
    struct bench_live_scene live;
    struct bench_scene scene = bench_scene_default();
    bench_scene_arc(&scene, vertices, length, degrees(turn), along, across);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.fiber.radius = 1e-4f;
    scene.physics.damping = 20;
    bench_scene_set_gamma(&scene, length, gamma);
    snprintf(bench->sentence, sizeof bench->sentence, "the reference does not come to rest");
    if (!find_arc_at_rest(&scene, length, degrees(turn), tip) || !bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "cantilever_arc", method);
        return;
    }
    if (bench_settle(&live, positions))
        add_tip_row(&live, "cantilever_arc", positions, tip[0], -tip[1], gamma, turn,
                    "rod in double precision, off by over L");
    else
        bench_refuse(bench, "cantilever_arc", method);
    bench_free_live_scene(&live);
}

void bench_cantilever(struct bench* bench)
{
    static const double horizontal[] = {0.1, 0.3, 1, 3, 5, 10, 30, 50, 100, 200, 300, 1000};
    static const double inclined[] = {7, 42, 150, 700}, angles[] = {-40, 35};
    static const double arcs[] = {1000, 100, 10, 1};
    bool quick = bench->options.quick;
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t vertices = 32; vertices <= (quick ? 32 : 64); vertices *= 2) {
            for (size_t i = quick ? 5 : 0; i < (quick ? 6 : ARRAY_SIZE(horizontal)); ++i)
                measure_cantilever(bench, bench_rod_solvers[s], vertices, horizontal[i], 0);
            for (size_t i = 0; i < (quick ? 0 : ARRAY_SIZE(inclined) * ARRAY_SIZE(angles)); ++i)
                measure_cantilever(bench, bench_rod_solvers[s], vertices, inclined[i / 2], angles[i % 2]);
            for (size_t i = 0; i < (quick ? 1 : ARRAY_SIZE(arcs)); ++i)
                measure_arc(bench, bench_rod_solvers[s], vertices, arcs[i], 360);
        }
}

// Return the sag of a chain of length 1 between two ends at one height, `span` apart. With x = span
// / (2 a) and the catenary's parameter a, sinh(x) / x = 1 / span.
static double catenary_sag(double span)
{
    double low = 1e-6, high = 700;
    for (int i = 0; i < 200; ++i) {
        double x = (low + high) / 2;
        if (sinh(x) * span < x)
            low = x;
        else
            high = x;
    }
    return span / (2 * low) * (cosh(low) - 1);
}

// Measure a chain that is hinged at its root and pinned at its tip.
static void measure_catenary(struct bench* bench, hair_solver solver, uint32_t vertices, double span)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "catenary", method)) return;
    const double length = 0.3, along[3] = {sqrt(0.5), -sqrt(0.5), 0};
    double positions[3 * BENCH_MAX_VERTICES], lowest = 0;
    struct bench_live_scene live;
    struct bench_scene scene = bench_scene_default();
    hair_pin pin = hair_pin_default();
    bench_scene_straight(&scene, vertices, length, nowhere, along);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.damping = 6;
    scene.physics.fiber.youngs_modulus = 0;
    scene.physics.root = HAIR_ROOT_HINGED;
    pin.position[0] = (float)(span * length);
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "catenary", method);
        return;
    }
    if (!hair_set_pins(live.hair, &pin, 1, sizeof pin) && bench_settle(&live, positions)) {
        for (uint32_t i = 0; i < vertices; ++i) lowest = fmin(lowest, positions[3 * i + 1]);
        bench_physics_row(&live, "catenary", catenary_sag(span), -lowest / length, 0.005,
                          span < 0.6 ? "catenary of span 0.5, sag/L" : "catenary of span 0.8, sag/L");
    } else
        bench_refuse(bench, "catenary", method);
    bench_free_live_scene(&live);
}

void bench_catenary(struct bench* bench)
{
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t vertices = 32; vertices <= (bench->options.quick ? 32 : 64); vertices *= 2)
            for (int i = 0; i < 2; ++i)
                measure_catenary(bench, bench_rod_solvers[s], vertices, i ? 0.8 : 0.5);
}

// Out of the plane --------------------------------------------------------------------------------

// Threshold of leaving the plane, as a fraction of the rod's length. The rod lies in the plane z =
// 0, disturbed by 1e-4 of its length. Gravity rises slowly to 9.81 m/s^2 and then stays constant.
// The rod counts as plane if its maximum distance from the plane is below the threshold.
#define THRESHOLD 0.02
#define RISE 6.0 // s

struct buckling {
    const char* name;
    struct bench_scene scene;
    double critical; // critical gamma
    double fraction; // fraction of the critical gamma at the end
    bool leaves; // whether the rod leaves the plane
    double phi; // natural turn for the row, degrees
};

static void disturb(struct bench_scene* scene, double length)
{
    for (uint32_t i = 0; i < scene->vertices; ++i) {
        double s = (double)i / (scene->vertices - 1);
        scene->positions[3 * i + 2] = (float)(1e-4 * length * s * s);
    }
}

static bool raise_gravity(struct bench_live_scene* live, hair_physics physics)
{
    for (int k = 1; k <= 60 * RISE; ++k) {
        physics.gravity[1] = (float)(-BENCH_GRAVITY * k / (60 * RISE));
        if (hair_set_physics(live->hair, &physics) || !bench_step(live, NULL, 1.0 / 60)) return false;
        if (bench_was_interrupted()) return false;
    }
    return true;
}

static void measure_buckling(struct bench* bench, hair_solver solver, struct buckling* buckling)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, buckling->name, method)) return;
    double positions[3 * BENCH_MAX_VERTICES], max = 0;
    struct bench_live_scene live;
    struct bench_scene* scene = &buckling->scene;
    hair_physics full = scene->physics;
    scene->solver = solver;
    scene->mapping = bench->options.mapping;
    scene->physics.gravity[1] = 0;
    if (!bench_live(bench, scene, &live)) {
        bench_refuse(bench, buckling->name, method);
        return;
    }
    if (raise_gravity(&live, full) && bench_settle(&live, positions)) {
        for (uint32_t i = 0; i < scene->vertices; ++i)
            max = fmax(max, fabs(positions[3 * i + 2]) / live.length);
        json_t* row = bench_physics_row(&live, buckling->name, buckling->leaves, max, BENCH_NO_LIMIT,
                                        "continuum: 1 leaves the plane, 0 stays");
        bench_set_number(row, "gamma", buckling->critical * buckling->fraction);
        bench_set_number(row, "angle", buckling->phi);
        bench_set_null(row, "relative_error");
        bench_set_number(row, "limit", THRESHOLD);
        bench_set_flag(row, "pass", (max > THRESHOLD) == buckling->leaves);
    } else
        bench_refuse(bench, buckling->name, method);
    bench_free_live_scene(&live);
}

// Test a rod of natural curvature that hangs from a downward clamp. The rod is helical between two
// critical weights (table of solver.md for a Poisson's ratio of 0.45).
void bench_bend_twist(struct bench* bench)
{
    static const struct {
        double turns, critical[2]; // of the natural circle
    } rows[] = {{1, {12.548, 44.759}}, {2, {36.23, 452.48}}};
    const double down[3] = {0, -1, 0}, across[3] = {1, 0, 0}, length = 0.1;
    for (int s = 0; s < BENCH_RODS && !bench->options.quick; ++s)
        for (size_t i = 0; i < 8; ++i) {
            struct buckling b = {.name = "bend_twist", .scene = bench_scene_default()};
            b.phi = 360 * rows[i / 4].turns;
            b.critical = rows[i / 4].critical[i / 2 % 2];
            b.fraction = i % 2 ? 1.05 : 0.95;
            // It leaves the plane above the first and below the second critical weight.
            b.leaves = i / 2 % 2 != i % 2;
            bench_scene_arc(&b.scene, 64, length, degrees(b.phi), down, across);
            disturb(&b.scene, length);
            b.scene.physics.fiber.radius = 1e-4f;
            b.scene.physics.damping = 10;
            bench_scene_set_gamma(&b.scene, length, b.critical * b.fraction);
            measure_buckling(bench, bench_rod_solvers[s], &b);
        }
}

// A deep horizontal cantilever buckles sideways if w L^3 / sqrt(EI GJ) exceeds 13.0452. w is the
// weight per length, L the length, EI the bending stiffness in the weak direction and GJ the
// torsional stiffness. The value holds if EI is 0.01 and GJ is 0.0138 of the bending stiffness in
// the strong direction.
void bench_lateral_buckling(struct bench* bench)
{
    const double along[3] = {1, 0, 0}, length = 0.1, critical = 13.0452;
    for (int s = 0; s < BENCH_RODS && !bench->options.quick; ++s)
        for (int i = 0; i < 2; ++i) {
            struct buckling b = {
                .name = "lateral_buckling", .scene = bench_scene_default(), .critical = critical};
            b.fraction = i ? 1.05 : 0.95;
            b.leaves = i;
            bench_scene_straight(&b.scene, 64, length, nowhere, along);
            disturb(&b.scene, length);
            hair_physics* p = &b.scene.physics;
            p->fiber.radius = 1e-4f;
            p->damping = 10;
            p->fiber.flatness = 0.1f;
            p->fiber.poisson_ratio = 0.43493f;
            // Stiffness is proportional to Young's modulus.
            struct bench_section section = bench_section_of(p);
            double root = sqrt(section.bend[0] * section.twist);
            p->fiber.youngs_modulus *= (float)(section.line_density * BENCH_GRAVITY * pow(length, 3) /
                                               (root * critical * b.fraction));
            measure_buckling(bench, bench_rod_solvers[s], &b);
        }
}
