// hair_body_loss_test.c - a context with bodies is restored after its OpenGL context is lost:
// bodies that live, bodies that are destroyed, and memory that runs out meanwhile.
#include "tests/support/deforming.h"
#include "tests/support/context_loss.h"
#include "tests/support/live_hair.h"

#include <math.h>
#include <stdlib.h>

#include "lib/api/api.h"

struct fixture {
    struct hair_test* test;
    struct hair_test_restorable restorable;
    struct hair_test_mesh mesh;
    struct hair_test_strands strands;
    struct hair_test_living living;
    hair_body* body;
};

// Hang a strand of 0.3 m beside a ball of 0.06 m.
static void begin(struct hair_test* test, struct fixture* f)
{
    hair_physics physics = hair_test_loose(0.3f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    *f = (struct fixture){.test = test, .mesh = hair_test_ball_mesh(0.06f, 16, 24)};
    hair_test_restorable_begin(test, &f->restorable);
    f->strands = hair_test_straight(16, hair_v3(0, 0, 0), hair_v3(0, -1, 0), 0.3f);
    hair_test_live(test, &f->strands, &desc, &f->living);
    f->body = hair_test_deforming(test, &f->mesh, 0.16f, 16);
    hair_collider collider = hair_test_body(HAIR_SHAPE_MESH, 0.05f, -0.2f, 0.01f);
    collider.mesh = hair_body_get_mesh(f->body);
    hair_test_set_colliders(&f->living, &collider, 1);
    hair_test_wait(&f->living, 2);
}

static void end(struct fixture* f)
{
    hair_body_destroy(f->body);
    hair_test_die(&f->living);
    hair_test_strands_free(&f->strands);
    assert_int_equal(f->test->context->sdf_pool.nodes, 0);
    hair_test_restorable_end(f->test, &f->restorable);
    hair_test_mesh_free(&f->mesh);
}

// Move the collider through the strand. Return the maximum distance of the tip from the line on
// which the strand hangs, m.
static double sweep(struct fixture* f)
{
    hair_collider collider = hair_sim_colliders(&f->living.hair->sim)->collider[0];
    double max = 0;
    for (int frame = 0; frame < 40; ++frame) {
        collider.position[0] = 0.2f - 0.01f * (float)frame;
        hair_test_set_colliders(&f->living, &collider, 1);
        hair_test_wait(&f->living, 1);
        hair_test_read_guides(&f->living);
        hair_vec3 tip = hair_test_tip(&f->living, 0);
        max = fmax(max, (double)hypotf(tip.x, tip.z));
    }
    print_message("    the tip is up to %.3f m away\n", max);
    return max;
}

static void restored_body_pushes_hair_away(void** state)
{
    struct fixture f;
    begin(*state, &f);
    hair_test_restorable_lose(f.test, &f.restorable);
    hair_test_ok(f.test, hair_context_restore(f.test->context));
    assert_true(sweep(&f) > 0.03);
    end(&f);
}

// Lose the distances to a body that is destroyed. Nobody can compute them again.
static void lost_shape_of_a_destroyed_body_touches_nothing(void** state)
{
    struct fixture f;
    begin(*state, &f);
    hair_body_destroy(f.body);
    f.body = NULL;
    hair_test_restorable_lose(f.test, &f.restorable);
    hair_test_ok(f.test, hair_context_restore(f.test->context));
    assert_true(sweep(&f) < 1e-4);
    end(&f);
}

// Load hair whose body is not among the colliders, so that a collider has no mesh.
static void hair_that_misses_a_body_is_restored(void** state)
{
    struct fixture f;
    size_t size = 0;
    begin(*state, &f);
    hair_test_ok(f.test, hair_save(f.living.hair, NULL, 0, &size));
    unsigned char* bytes = malloc(size);
    hair_test_ok(f.test, hair_save(f.living.hair, bytes, size, &size));
    hair_test_set_colliders(&f.living, NULL, 0);
    hair_test_wait(&f.living, 2);
    hair_test_ok(f.test, hair_load(f.living.hair, bytes, size));
    free(bytes);
    hair_test_restorable_lose(f.test, &f.restorable);
    hair_test_ok(f.test, hair_context_restore(f.test->context));
    const struct hair_collider_list* list = hair_sim_colliders(&f.living.hair->sim);
    assert_int_equal(list->count, 1);
    assert_null(list->collider[0].mesh);
    hair_test_wait(&f.living, 2);
    end(&f);
}

static void refused_memory_keeps_bodies_for_the_next_attempt(void** state)
{
    struct fixture f;
    begin(*state, &f);
    hair_test_restorable_lose(f.test, &f.restorable);
    hair_test_restore_against_refusals(f.test, f.living.hair);
    assert_true(sweep(&f) > 0.03);
    end(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(restored_body_pushes_hair_away),
        HAIR_TEST(lost_shape_of_a_destroyed_body_touches_nothing),
        HAIR_TEST(hair_that_misses_a_body_is_restored),
        HAIR_TEST(refused_memory_keeps_bodies_for_the_next_attempt),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
