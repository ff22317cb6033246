// stability_contact.c - Cases `contact COLLIDER VERTICES`. Eight strands with fixed roots above a
// collider are released horizontally. They fall on the collider and should come to rest.
#include "tools/bench/stability.h"

#include <math.h>
#include <string.h>

#define STRANDS 8
#define LENGTH 0.3 // m

struct contact {
    const char* name;
    uint32_t vertices;
    double x, y; // position of the roots, m
    double dip; // angle of the strands below the horizontal, rad
    bool is_free; // roots are released too
    hair_shape shape;
    float position[3], rotation[4], size[3];
};

// clang-format off
#define UPRIGHT {0, 0, 0, 1}
#define ALONG_Z {0.70710678f, 0, 0, 0.70710678f} // maps local y to z

#define BOX      HAIR_SHAPE_BOX,      {0, -0.1f, 0},  UPRIGHT, {0.15f, 0.1f, 0.3f}
#define SPHERE   HAIR_SHAPE_SPHERE,   {0, -0.1f, 0},  UPRIGHT, {0.1f}
#define PLANE    HAIR_SHAPE_PLANE,    {0},            UPRIGHT, {0}
#define CAPSULE  HAIR_SHAPE_CAPSULE,  {0, -0.05f, 0}, ALONG_Z, {0.05f, 0.3f}
#define CYLINDER HAIR_SHAPE_CYLINDER, {0, -0.1f, 0},  UPRIGHT, {0.12f, 0.1f}
#define CONE     HAIR_SHAPE_CONE,     {0, -0.1f, 0},  UPRIGHT, {0.2f, 0.1f}

// The top of each collider is at height 0. With positive dip, the tips of strands hit the plane.
static const struct contact contacts[] = {
    {"box 32",          32,  0.02, 0.02,  0,   false, BOX},
    {"box 64",          64,  0.02, 0.02,  0,   false, BOX},
    {"sphere 32",       32, -0.05, 0.02,  0,   false, SPHERE},
    {"sphere 64",       64, -0.05, 0.02,  0,   false, SPHERE},
    {"plane 32",        32,  0,    0.1,   0,   false, PLANE},
    {"plane 64",        64,  0,    0.1,   0,   false, PLANE},
    {"capsule 32",      32, -0.03, 0.02,  0,   false, CAPSULE},
    {"capsule 64",      64, -0.03, 0.02,  0,   false, CAPSULE},
    {"cylinder 48",     48,  0.02, 0.02,  0,   false, CYLINDER},
    {"cone 48",         48, -0.05, 0.02,  0,   false, CONE},
    {"plane level 64",  64,  0,    0.1,   0,   true,  PLANE},
    {"plane upright 64", 64, 0,    0.35,  1.4, true,  PLANE},
    {"plane standing 64", 64, 0,   0.2,  -1.4, false, PLANE},
    {"plane pressed 64", 64, 0,    0.2,   1.4, false, PLANE},
};
// clang-format on
#define CONTACTS (sizeof contacts / sizeof *contacts)

// Make a fan of strands. Roots are 1 cm apart along z, and each strand is turned a little more than
// the previous one.
static hair_result make_groom(struct bench* bench, const struct contact* contact, hair_groom** out)
{
    float positions[3 * STRANDS * BENCH_MAX_VERTICES];
    uint32_t vertices[STRANDS];
    hair_groom_desc desc = hair_groom_desc_default();
    for (uint32_t s = 0; s < STRANDS; ++s) {
        double across = 0.01 * s - 0.035, turn = 0.05 * s - 0.175;
        vertices[s] = contact->vertices;
        for (uint32_t i = 0; i < contact->vertices; ++i) {
            float* p = positions + 3 * ((size_t)s * contact->vertices + i);
            double length = LENGTH * i / (contact->vertices - 1);
            double level = cos(contact->dip) * length;
            p[0] = (float)(contact->x + cos(turn) * level);
            p[1] = (float)(contact->y - sin(contact->dip) * length);
            p[2] = (float)(across + sin(turn) * level);
        }
    }
    desc.host = &bench->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = STRANDS;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = contact->vertices;
    desc.follower_count = 0;
    return hair_groom_create(&desc, out);
}

static hair_result add_collider(const struct contact* contact, hair_instance* hair)
{
    hair_collider collider = hair_collider_default();
    collider.shape = contact->shape;
    memcpy(collider.position, contact->position, sizeof collider.position);
    memcpy(collider.rotation, contact->rotation, sizeof collider.rotation);
    memcpy(collider.size, contact->size, sizeof collider.size);
    return hair_set_colliders(hair, &collider, 1, sizeof collider);
}

static bool run(struct bench* bench, const char* name, hair_instance* hair, const struct bench_scene* scene)
{
    struct bench_rest_desc desc = {20, 0.5, 30, bench_was_interrupted};
    struct bench_live_scene live = {.bench = bench, .scene = scene};
    hair_solver_stats solver_stats = hair_solver_stats_default();
    struct bench_rest rest;
    if (!bench_measure_rest(hair, STRANDS, scene->vertices, &desc, &rest)) return false;
    if (hair_get_solver_stats(hair, &solver_stats)) return false;
    json_t* row = bench_rows_add(&bench->rows);
    live.substep = (double)solver_stats.substep;
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", scene->vertices);
    bench_set_count(row, "guides", STRANDS);
    bench_set_flag(row, "colliders", true);
    bench_set_rest(row, scene->solver, &rest);
    bench_set_solver_stats(row, &solver_stats);
    bench_set_material(row, &live);
    return true;
}

static void measure(struct bench* bench, const struct contact* contact, hair_solver solver)
{
    char name[32];
    const char* method = bench_solver_name(solver);
    snprintf(name, sizeof name, "contact %s", contact->name);
    if (!bench_begin(bench, name, method)) return;
    hair_groom* groom = NULL;
    hair_instance* hair = NULL;
    struct bench_scene scene = bench_scene_default();
    hair_desc desc = hair_desc_default();
    scene.physics = hair_physics_default();
    scene.physics.shape.frequency_root = scene.physics.shape.frequency_tip =
        scene.physics.shape.gravity_preload = 0;
    scene.physics.damping = 4;
    scene.physics.root = contact->is_free ? HAIR_ROOT_FREE : HAIR_ROOT_CLAMPED;
    scene.vertices = contact->vertices;
    scene.solver = solver;
    scene.mapping = solver == HAIR_SOLVER_REDBLACK ? HAIR_THREAD_MAPPING_AUTO : bench->options.mapping;
    desc.physics = &scene.physics;
    desc.solver = solver;
    desc.thread_mapping = scene.mapping;
    if (make_groom(bench, contact, &groom) || hair_create(bench->context, groom, &desc, &hair) ||
        add_collider(contact, hair) || !run(bench, name, hair, &scene))
        bench_refuse(bench, name, method);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// Return whether the solver supports the shape. redblack supports spheres and capsules only.
static bool is_known(hair_solver solver, hair_shape shape)
{
    return solver != HAIR_SOLVER_REDBLACK || shape == HAIR_SHAPE_SPHERE || shape == HAIR_SHAPE_CAPSULE;
}

void bench_rest_contacts(struct bench* bench)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    bool quick = bench->options.quick;
    for (size_t i = 0; i < (quick ? 1 : CONTACTS); ++i)
        for (int s = 0; s < (quick ? 1 : 4); ++s)
            if (is_known(solvers[s], contacts[i].shape)) measure(bench, &contacts[i], solvers[s]);
}
