// scene.c - Strands, materials and heads, and their conversion to rods of tests/reference.
#include "tools/bench/scene.h"

#include <math.h>
#include <stdbool.h>

#include "lib/rod/rod.h"

struct bench_scene bench_scene_default(void)
{
    struct bench_scene scene = {.strands = 1, .max_dt = 0.1, .head = {{0, 0, 0}, {0, 0, 0, 1}}};
    hair_physics* p = &scene.physics;
    *p = hair_physics_default();
    scene.wind = hair_wind_default();
    p->damping = p->shape.frequency_root = p->shape.frequency_tip = p->collision.margin =
        p->shape.gravity_preload = p->sleep_threshold = 0;
    p->redblack.angular_hz = 0;
    return scene;
}

void bench_scene_straight(struct bench_scene* scene, uint32_t vertices, double length, const double root[3],
                          const double along[3])
{
    scene->vertices = vertices;
    for (uint32_t i = 0; i < vertices; ++i)
        for (uint32_t k = 0; k < 3; ++k)
            scene->positions[3 * i + k] = (float)(root[k] + along[k] * (length * i / (vertices - 1)));
}

void bench_scene_arc(struct bench_scene* scene, uint32_t vertices, double length, double turn,
                     const double along[3], const double across[3])
{
    // Each chord is parallel to the arc in its middle.
    double piece = length / (vertices - 1), at[3] = {0, 0, 0};
    scene->vertices = vertices;
    for (uint32_t i = 0; i < vertices; ++i) {
        double angle = turn * (i + 0.5) / (vertices - 1);
        for (uint32_t k = 0; k < 3; ++k) {
            scene->positions[3 * i + k] = (float)at[k];
            at[k] += piece * (cos(angle) * along[k] + sin(angle) * across[k]);
        }
    }
}

void bench_scene_set_gamma(struct bench_scene* scene, double length, double gamma)
{
    hair_physics* p = &scene->physics;
    double radius = (double)p->fiber.radius;
    p->fiber.youngs_modulus = (float)(4 * (double)p->fiber.density * BENCH_GRAVITY * length * length *
                                      length / (gamma * radius * radius));
}

double bench_scene_length(const struct bench_scene* scene)
{
    double length = 0;
    for (uint32_t i = 0; i + 1 < scene->vertices; ++i) {
        const float* p = scene->positions + 3 * i;
        length += hypot(hypot((double)p[3] - (double)p[0], (double)p[4] - (double)p[1]),
                        (double)p[5] - (double)p[2]);
    }
    return length;
}

// The section is an ellipse of half axes a >= b with a b = R^2 and b / a = flatness, with the long
// axis along x. The second moments are I = pi a b^3 / 4 about x and pi a^3 b / 4 about z, and J =
// pi a^3 b^3 / (a^2 + b^2).
struct bench_section bench_section_of(const hair_physics* physics)
{
    double radius = (double)physics->fiber.radius, flat = (double)physics->fiber.flatness;
    double round = BENCH_PI * pow(radius, 4) / 4 * (double)physics->fiber.youngs_modulus;
    return (struct bench_section){
        .bend = {round * flat, round / flat},
        .twist = 2 * round / (1 + (double)physics->fiber.poisson_ratio) * flat / (1 + flat * flat),
        .line_density = (double)physics->fiber.density * BENCH_PI * radius * radius};
}

struct hair_reference_rod_pose bench_pose(const double axis[3], double angle, const double move[3])
{
    struct hair_reference_rod_pose pose;
    for (uint32_t k = 0; k < 3; ++k) {
        pose.position[k] = move[k];
        pose.rotation[k] = sin(angle / 2) * axis[k];
    }
    pose.rotation[3] = cos(angle / 2);
    return pose;
}

void bench_matrix(const struct hair_reference_rod_pose* pose, float matrix[16])
{
    const double* q = pose->rotation;
    double x = q[0], y = q[1], z = q[2], w = q[3];
    const double m[16] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),     0,
                          2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),     0,
                          2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y), 0,
                          pose->position[0],       pose->position[1],       pose->position[2],       1};
    for (int i = 0; i < 16; ++i) matrix[i] = (float)m[i];
}

// Compute the smallest rotation from y to the first segment. The groom computes it for strands with
// equal directions.
static void find_root_frame(const double* positions, double frame[4])
{
    double d[3], length = 0;
    for (uint32_t k = 0; k < 3; ++k) {
        d[k] = positions[3 + k] - positions[k];
        length += d[k] * d[k];
    }
    for (int k = 0; k < 3; ++k) d[k] /= sqrt(length);
    if (d[1] < -0.999999) { // any axis perpendicular to y, here x
        frame[0] = 1;
        frame[1] = frame[2] = frame[3] = 0;
        return;
    }
    double norm = sqrt(2 * (1 + d[1]));
    frame[0] = d[2] / norm; // y cross d
    frame[1] = 0;
    frame[2] = -d[0] / norm;
    frame[3] = norm / 2;
}

static double between(float root, float tip, uint32_t i, uint32_t count)
{
    return (double)root + ((double)tip - (double)root) * i / (count - 1);
}

static int is_straight(const struct bench_scene* scene, const double* strain)
{
    double max = 0;
    for (uint32_t i = 0; i < 3 * (scene->vertices - 1); ++i) max = fmax(max, fabs(strain[i]));
    return scene->physics.fiber.flatness == 1 && max < 1e-4;
}

// Return whether the mixed scheme solves the strand, which is straight. Only the scheme of straight
// rods has the energy of the chord between tangents.
static bool is_mixed(const struct bench_scene* scene, const double root_frame[4])
{
    struct hair_rest rest[BENCH_MAX_VERTICES] = {0};
    struct hair_rod_borne borne[BENCH_MAX_VERTICES] = {0};
    struct hair_rods_report report;
    const hair_vec4 frame = {(float)root_frame[0], (float)root_frame[1], (float)root_frame[2],
                             (float)root_frame[3]};
    struct hair_guide guide = {.root_frame = frame, .count = scene->vertices};
    if (scene->solver != HAIR_SOLVER_DIRECT && scene->solver != HAIR_SOLVER_ACCURATE) return false;
    for (uint32_t i = 0; i < scene->vertices; ++i) {
        const float* p = scene->positions + 3 * i;
        bool tip = i + 1 == scene->vertices;
        rest[i].position =
            (hair_vec4){p[0], p[1], p[2], tip ? 0 : hypotf(hypotf(p[3] - p[0], p[4] - p[1]), p[5] - p[2])};
        rest[i].frame = frame;
        guide.arc_length += rest[i].position.w;
    }
    if (hair_rods_preload_gravity(NULL, &guide, rest, 1, &scene->physics, borne, &report)) return false;
    return hair_rods_are_mixed(&guide, rest, borne, 1, &scene->physics, scene->solver, false, scene->substep);
}

bool bench_has_chord_energy(const struct bench_scene* scene)
{
    double positions[3 * BENCH_MAX_VERTICES] = {0}, strain[3 * BENCH_MAX_VERTICES], root_frame[4];
    for (uint32_t i = 0; i < 3 * scene->vertices; ++i) positions[i] = (double)scene->positions[i];
    find_root_frame(positions, root_frame);
    hair_reference_rod_strain(scene->vertices, positions, root_frame, strain);
    return is_straight(scene, strain) && !is_mixed(scene, root_frame);
}

struct hair_reference_rod* bench_reference(const struct bench_scene* scene)
{
    double positions[3 * BENCH_MAX_VERTICES] = {0}, strain[3 * BENCH_MAX_VERTICES];
    double scale[BENCH_MAX_VERTICES], pull[BENCH_MAX_VERTICES];
    const hair_physics* p = &scene->physics;
    struct bench_section section = bench_section_of(p);
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    for (uint32_t i = 0; i < 3 * scene->vertices; ++i) positions[i] = (double)scene->positions[i];
    for (uint32_t i = 0; i < scene->vertices; ++i) {
        scale[i] = between(p->shape.stiffness_root, p->shape.stiffness_tip, i, scene->vertices);
        pull[i] = 2 * BENCH_PI * between(p->shape.frequency_root, p->shape.frequency_tip, i, scene->vertices);
    }
    find_root_frame(positions, desc.root_frame);
    hair_reference_rod_strain(scene->vertices, positions, desc.root_frame, strain);
    desc.vertices = scene->vertices;
    desc.positions = positions;
    desc.line_density = section.line_density;
    desc.tip_mass = (double)p->tip_mass * section.line_density * bench_scene_length(scene);
    desc.bend[0] = section.bend[0];
    desc.bend[1] = section.bend[1];
    desc.twist = section.twist;
    desc.scale = scale;
    desc.rest_strain = is_straight(scene, strain) ? NULL : strain;
    desc.straight = bench_has_chord_energy(scene);
    desc.root = (enum hair_reference_rod_root)p->root;
    desc.damping = (double)p->damping;
    desc.pull = pull;
    desc.head = scene->head;
    for (uint32_t k = 0; k < 3; ++k) {
        desc.gravity[k] = (double)p->gravity[k];
        desc.wind[k] = (double)scene->wind.velocity[k];
        if (desc.wind[k] != 0 || scene->wind.still_air) desc.drag = (double)p->drag;
    }
    desc.diameter = 2 * (double)p->fiber.radius;
    desc.air = (struct hair_reference_air){(double)scene->wind.density, (double)scene->wind.viscosity};
    return hair_reference_rod_create(&desc);
}

const char* bench_solver_name(hair_solver solver)
{
    static const char* const names[] = {"direct", "accurate", "follow", "redblack"};
    return names[solver];
}
