// redblack_test.c - every stage of the solver redblack on the GPU moves guides as the
// double-precision reference does.
#include "tests/support/redblack.h"

#include <stdio.h>

#include "lib/base/math.h"

static void integration_equals_the_reference(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
    f.params.gravity = (hair_vec4){0.5f, -9.81f, -0.25f, 1.0f / 120};
    f.params.keep = 0.97f;
    f.params.shape_frequency_root = 25;
    f.params.shape_frequency_tip = 3;
    hair_test_redblack_move_head(&f);
    hair_test_redblack_compare(&f, "integrate");
    hair_test_scene_free(&f.scene);
}

static void angular_forces_equal_the_reference(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
    f.params.angular = 5000;
    hair_test_redblack_scatter(&f, 0.002f, 0);
    hair_test_redblack_compare(&f, "angular");
    hair_test_scene_free(&f.scene);
}

static void distance_constraints_equal_the_reference(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
    f.params.iterations = 1;
    hair_test_redblack_scatter(&f, 0.002f, 0);
    hair_test_redblack_compare(&f, "1 iteration");
    f.params.iterations = 20;
    hair_test_redblack_scatter(&f, 0.002f, 0);
    hair_test_redblack_compare(&f, "20 iterations");
    hair_test_scene_free(&f.scene);
}

// Compare angular constraints. In the rest pose the distance constraints have nothing to do. The
// distances over two segments at rest are then increased.
static void angular_constraints_equal_the_reference(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
    for (uint32_t i = 0; i < f.scene.groom->info.guide_vertex_count; ++i)
        for (int k = 0; k < 3; ++k) (&f.scene.groom->rest[i].position.x)[k] *= 1.1f;
    glNamedBufferSubData(f.scene.hair->sim.rest, 0,
                         f.scene.groom->info.guide_vertex_count * sizeof *f.scene.groom->rest,
                         f.scene.groom->rest);
    f.params.bend = 0.5f;
    f.params.iterations = 1;
    hair_test_redblack_scatter(&f, 0, 0);
    hair_test_redblack_compare(&f, "bend");
    hair_test_scene_free(&f.scene);
}

static void collisions_equal_the_reference(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
    f.params.iterations = 1;
    hair_test_redblack_add_colliders(&f);
    hair_test_redblack_scatter(&f, 0, 0);
    hair_test_redblack_compare(&f, "collide");
    hair_test_scene_free(&f.scene);
}

static void vertices_end_outside_of_colliders(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
    hair_test_redblack_switch_on(&f);
    f.params.colliders = 1;
    f.params.substeps = 5;
    hair_test_redblack_run(&f);
    for (uint32_t g = 0; g < f.params.guides; ++g)
        for (uint32_t i = 2; i < f.scene.groom->guides[g].count; ++i) {
            hair_vec4 p = f.state[f.scene.groom->guides[g].first + i].position;
            assert_true(hair_length(hair_v3(p.x, p.y, p.z)) > 0.091f - 1e-6f);
        }
    hair_test_scene_free(&f.scene);
}

static void one_to_five_substeps_equal_the_reference(void** state)
{
    for (uint32_t substeps = 1; substeps <= 5; ++substeps) {
        struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
        hair_test_redblack_switch_on(&f);
        f.params.substeps = substeps;
        char what[32];
        snprintf(what, sizeof what, "%u substeps", substeps);
        hair_test_redblack_compare(&f, what);
        hair_test_scene_free(&f.scene);
    }
}

// Switch parts off, one bit of `off` each: angular forces, bend, collisions, pull, and all
// iterations except one.
static void switch_off(struct hair_test_redblack* f, int off)
{
    if (off & 1) f->params.angular = 0;
    if (off & 2) f->params.bend = 0;
    if (off & 4) f->params.colliders = 0;
    if (off & 8) f->params.shape_frequency_root = f->params.shape_frequency_tip = 0;
    if (off & 16) f->params.iterations = 1;
}

// Check with every part off alone, and on alone.
static void stages_switched_off_or_alone_equal_the_reference(void** state)
{
    for (int i = 0; i < 10; ++i) {
        struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
        int bit = 1 << (i % 5), off = i < 5 ? bit : 31 - bit;
        hair_test_redblack_switch_on(&f);
        f.params.substeps = 3;
        switch_off(&f, off);
        char what[32];
        snprintf(what, sizeof what, "without %c%c%c%c%c", off & 1 ? 'a' : '-', off & 2 ? 'b' : '-',
                 off & 4 ? 'c' : '-', off & 8 ? 'p' : '-', off & 16 ? 'i' : '-');
        hair_test_redblack_compare(&f, what);
        hair_test_scene_free(&f.scene);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(integration_equals_the_reference),
        HAIR_TEST(angular_forces_equal_the_reference),
        HAIR_TEST(distance_constraints_equal_the_reference),
        HAIR_TEST(angular_constraints_equal_the_reference),
        HAIR_TEST(collisions_equal_the_reference),
        HAIR_TEST(vertices_end_outside_of_colliders),
        HAIR_TEST(one_to_five_substeps_equal_the_reference),
        HAIR_TEST(stages_switched_off_or_alone_equal_the_reference),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
