#include "tests/support/live_hair.h"
#include "lib/api/api.h"
#include "lib/collide/distance.h"
#include "tests/reference/guide_rod.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hair_test_live(struct hair_test* test, const struct hair_test_strands* strands, const hair_desc* desc,
                    struct hair_test_living* out)
{
    *out = (struct hair_test_living){
        .test = test, .physics = hair_physics_default(), .wind = hair_wind_default()};
    hair_groom_desc of = hair_test_groom_desc(&test->host, strands);
    of.strand_set = HAIR_STRAND_SET_GUIDES;
    of.follower_count = strands->count;
    of.guide_vertices = 2;
    for (uint32_t i = 0; i < strands->count; ++i)
        if (strands->vertices[i] > of.guide_vertices) of.guide_vertices = strands->vertices[i];
    hair_test_ok(test, hair_groom_create(&of, &out->groom));
    if (desc->physics) out->physics = *desc->physics;
    hair_test_ok(test, hair_create(test->context, out->groom, desc, &out->hair));
    out->vertices = out->groom->info.guide_vertex_count;
    out->positions = calloc(out->vertices, 3 * sizeof *out->positions);
    out->before = calloc(out->vertices, 3 * sizeof *out->before);
    assert_int_equal(out->vertices, strands->vertex_count);
    hair_test_read_guides(out);
}

void hair_test_die(struct hair_test_living* living)
{
    hair_destroy(living->hair);
    hair_groom_destroy(living->groom);
    free(living->positions);
    free(living->before);
    memset(living, 0, sizeof *living);
}

void hair_test_add_straight(struct hair_test_strands* strands, uint32_t vertices, hair_vec3 root,
                            hair_vec3 way, float length)
{
    hair_vec3 step = hair_scale(hair_normalize(way, hair_v3(0, 1, 0)), length / (float)(vertices - 1));
    for (uint32_t i = 0; i < vertices; ++i)
        hair_store3(strands->positions + 3 * (size_t)strands->vertex_count++,
                    hair_add(root, hair_scale(step, (float)i)));
    strands->vertices[strands->count++] = vertices;
}

struct hair_test_strands hair_test_straight(uint32_t vertices, hair_vec3 root, hair_vec3 way, float length)
{
    struct hair_test_strands strands = hair_test_strands_make(1, vertices);
    hair_test_add_straight(&strands, vertices, root, way, length);
    return strands;
}

static void write_matrix(const struct hair_reference_rod_pose* pose, float out[16])
{
    static const hair_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double* q = pose->rotation;
    hair_quat turn = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
    memset(out, 0, 16 * sizeof *out);
    for (int i = 0; i < 3; ++i) hair_store3(out + 4 * i, hair_rotate(turn, axes[i]));
    for (int i = 0; i < 3; ++i) out[12 + i] = (float)pose->position[i];
    out[15] = 1;
}

struct hair_test_strands hair_test_straight_and_curl(void)
{
    struct hair_test_strands s = hair_test_strands_make(2, 24);
    hair_test_add_straight(&s, 16, hair_v3(0.1f, 0, 0), hair_v3(0.6f, -1, 0), 0.12f);
    for (uint32_t i = 0; i < 24; ++i) {
        float t = (float)i / 23;
        hair_store3(s.positions + 3 * (size_t)s.vertex_count++,
                    hair_v3(-0.1f + 0.015f * (1 - cosf(8 * t)), -0.2f * t, 0.015f * sinf(8 * t)));
    }
    s.vertices[s.count++] = 24;
    return s;
}

void hair_test_advance(struct hair_test_living* living, const struct hair_reference_rod_pose* head, double dt)
{
    float transform[16];
    if (head) {
        write_matrix(head, transform);
        hair_test_ok(living->test, hair_set_transform(living->hair, transform));
    }
    hair_test_ok(living->test, hair_step(living->hair, (float)dt));
}

void hair_test_wind_coupling(struct hair_test_living* living, const hair_wind* wind)
{
    living->wind = wind ? *wind : hair_wind_default();
    hair_test_ok(living->test, hair_set_wind(living->hair, wind));
}

void hair_test_wait(struct hair_test_living* living, uint32_t frames)
{
    for (uint32_t i = 0; i < frames; ++i) hair_test_advance(living, NULL, 1.0 / 60);
}

void hair_test_read_guides(struct hair_test_living* living)
{
    float* later = living->before;
    uint32_t count = 0;
    living->before = living->positions;
    living->positions = later;
    hair_test_ok(living->test,
                 hair_read_positions(living->hair, HAIR_READ_GUIDES, later, living->vertices, &count));
    assert_int_equal(count, living->vertices);
    for (uint32_t i = 0; i < 3 * count; ++i)
        if (!isfinite(later[i])) fail_msg("coordinate %u of vertex %u is %g", i % 3, i / 3, (double)later[i]);
}

hair_vec3 hair_test_at(const struct hair_test_living* living, uint32_t guide, uint32_t vertex)
{
    return hair_load3(living->positions + 3 * (size_t)(living->groom->guides[guide].first + vertex));
}

hair_vec3 hair_test_tip(const struct hair_test_living* living, uint32_t guide)
{
    return hair_test_at(living, guide, living->groom->guides[guide].count - 1);
}

double hair_test_length(const struct hair_test_living* living, uint32_t guide)
{
    return (double)living->groom->guides[guide].arc_length;
}

static double distance(const float* a, const float* b)
{
    double x = (double)a[0] - (double)b[0], y = (double)a[1] - (double)b[1], z = (double)a[2] - (double)b[2];
    return sqrt(x * x + y * y + z * z);
}

double hair_test_stretch(const struct hair_test_living* living)
{
    double max = 0;
    for (uint32_t g = 0; g < living->groom->info.guide_count; ++g) {
        const struct hair_guide* guide = &living->groom->guides[g];
        for (uint32_t i = guide->first; i + 1 < guide->first + guide->count; ++i) {
            const float* p = living->positions + 3 * (size_t)i;
            max = fmax(max, fabs(distance(p, p + 3) / (double)living->groom->rest[i].position.w - 1));
        }
    }
    return max;
}

double hair_test_moved(const struct hair_test_living* living)
{
    double max = 0;
    for (size_t i = 0; i < 3 * (size_t)living->vertices; i += 3)
        max = fmax(max, distance(living->positions + i, living->before + i));
    return max;
}

double hair_test_from_rest(const struct hair_test_living* living)
{
    double max = 0;
    for (size_t i = 0; i < living->vertices; ++i)
        max = fmax(max, distance(living->positions + 3 * i, &living->groom->rest[i].position.x));
    return max;
}

hair_collider hair_test_body(hair_shape shape, float x, float y, float z)
{
    hair_collider collider = hair_collider_default();
    collider.shape = shape;
    collider.position[0] = x;
    collider.position[1] = y;
    collider.position[2] = z;
    return collider;
}

void hair_test_turn(hair_collider* collider, int axis, double angle)
{
    for (int k = 0; k < 3; ++k) collider->rotation[k] = k == axis ? (float)sin(angle / 2) : 0;
    collider->rotation[3] = (float)cos(angle / 2);
}

void hair_test_set_colliders(struct hair_test_living* living, const hair_collider* colliders, uint32_t count)
{
    hair_test_ok(living->test, hair_set_colliders(living->hair, colliders, count, sizeof *colliders));
}

double hair_test_depth(const struct hair_test_living* living, const hair_collider* collider)
{
    double max = -INFINITY;
    for (uint32_t g = 0; g < living->groom->info.guide_count; ++g)
        for (uint32_t i = living->physics.root == HAIR_ROOT_FREE ? 0 : 1; i < living->groom->guides[g].count;
             ++i) {
            hair_vec3 p = hair_test_at(living, g, i);
            const double xyz[] = {(double)p.x, (double)p.y, (double)p.z};
            max = fmax(max, -hair_distance_to_collider(collider, xyz, NULL));
        }
    return max;
}

void hair_test_check_slide(struct hair_test_living* living, const hair_collider* slope, double friction)
{
    double a = 9.81 * (sin(0.4) - friction * cos(0.4)), far = fmax(a, 0) * 0.125;
    hair_test_read_guides(living);
    double before = (double)hair_test_at(living, 0, 10).x;
    hair_test_set_colliders(living, slope, 1);
    hair_test_wait(living, 30);
    hair_test_read_guides(living);
    double slid = (before - (double)hair_test_at(living, 0, 10).x) / cos(0.4);
    print_message("    friction %g: slides %.4f m of %.4f m\n", friction, slid, far);
    hair_test_near("slid", 0, slid, far, 0.02 * far + 1e-4);
}

hair_solver_stats hair_test_solver_stats(struct hair_test_living* living)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    hair_test_ok(living->test, hair_get_solver_stats(living->hair, &solver_stats));
    return solver_stats;
}

void hair_test_healthy(struct hair_test_living* living)
{
    hair_solver_stats solver_stats = hair_test_solver_stats(living);
    assert_int_equal(solver_stats.euler_fallbacks, 0);
    assert_int_equal(solver_stats.parts, 0);
    assert_int_equal(solver_stats.overstretched, 0);
    assert_int_equal(solver_stats.follow_fallbacks, 0);
    assert_int_equal(solver_stats.reset, 0);
}

struct hair_reference_rod* hair_test_reference(const struct hair_test_living* living, uint32_t guide,
                                               const struct hair_reference_rod_pose* head)
{
    const struct hair_guide* of = &living->groom->guides[guide];
    const struct hair_reference_guide_rod desc = {.guide = of,
                                                  .rest = living->groom->rest + of->first,
                                                  .physics = &living->physics,
                                                  .wind = &living->wind,
                                                  .is_mixed = hair_sim_is_mixed(&living->hair->sim),
                                                  .head = head};
    struct hair_reference_rod* rod = hair_reference_guide_rod_create(&desc);
    assert_non_null(rod);
    return rod;
}

double hair_test_off(const struct hair_test_living* living, uint32_t guide,
                     const struct hair_reference_rod* rod)
{
    double x[3 * HAIR_REFERENCE_ROD_MAX_VERTICES], max = 0;
    uint32_t count = hair_reference_rod_vertices(rod);
    hair_reference_rod_positions(rod, x);
    for (uint32_t i = 0; i < count; ++i) {
        hair_vec3 p = hair_test_at(living, guide, i);
        double a = (double)p.x - x[3 * i], b = (double)p.y - x[3 * i + 1], c = (double)p.z - x[3 * i + 2];
        max = fmax(max, sqrt(a * a + b * b + c * c));
    }
    return max;
}

struct hair_reference_rod_pose hair_test_pose_of(hair_vec3 position, hair_vec3 axis, double angle)
{
    hair_vec3 unit = hair_normalize(axis, hair_v3(0, 1, 0));
    double s = sin(angle / 2);
    return (struct hair_reference_rod_pose){
        {(double)position.x, (double)position.y, (double)position.z},
        {s * (double)unit.x, s * (double)unit.y, s * (double)unit.z, cos(angle / 2)}};
}

hair_physics hair_test_bare(void)
{
    hair_physics physics = hair_physics_default();
    physics.fiber.youngs_modulus = 3e9f;
    physics.fiber.radius = 5e-5f;
    physics.damping = 1;
    physics.shape.gravity_preload = 0;
    physics.shape.frequency_root = physics.shape.frequency_tip = physics.sleep_threshold = 0;
    return physics;
}

hair_physics hair_test_loose(float friction)
{
    hair_physics physics = hair_physics_default();
    physics.shape.gravity_preload = 0;
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.collision.friction = friction;
    return physics;
}

hair_desc hair_test_rods(hair_solver solver, hair_thread_mapping mapping, double substep,
                         const hair_physics* physics)
{
    hair_desc desc = hair_desc_default();
    desc.solver = solver;
    desc.thread_mapping = mapping;
    desc.substep = (float)substep;
    desc.physics = physics;
    return desc;
}

struct hair_test_strands hair_test_slanting(uint32_t vertices)
{
    return hair_test_straight(vertices, hair_v3(0.1f, 0, 0), hair_v3(sqrtf(0.75f), -0.5f, 0), 0.3f);
}

struct hair_reference_rod_pose hair_test_shaken(double time)
{
    double s = sin(3.14159265358979 * time);
    return hair_test_pose_of(hair_v3(0, 0, 0), hair_v3(0, 1, 0), 0.6 * s * s);
}
