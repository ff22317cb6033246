// hair_body_step_test.c - hair meets bodies that deform: guides are pushed out, hair wakes up, and
// the field follows.
#include "tests/support/deforming.h"
#include "tests/support/live_hair.h"

#include <math.h>
#include <stdlib.h>

#include "lib/api/api.h"

// Scale a ball of radius 1 and move it along x.
static void place_ball(struct hair_test_mesh* mesh, const struct hair_test_mesh* unit, float radius, float x)
{
    for (uint32_t i = 0; i < 3 * unit->vertex_count; ++i)
        mesh->positions[i] = radius * unit->positions[i] + (i % 3 == 0 ? x : 0);
}

static hair_collider collider_of(const hair_body* body)
{
    hair_collider collider = hair_test_body(HAIR_SHAPE_MESH, 0.05f, -0.2f, 0.01f);
    collider.mesh = hair_body_get_mesh(body);
    return collider;
}

struct fixture {
    struct hair_test* test;
    struct hair_test_mesh unit, mesh;
    struct hair_test_strands strands;
    struct hair_test_living living;
    hair_body* body;
    hair_collider collider;
};

// Hang a strand of 0.3 m beside a ball of `radius`.
static void begin(struct hair_test* test, hair_solver solver, float radius, struct fixture* f)
{
    hair_physics physics = hair_test_loose(0.3f);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    *f = (struct fixture){
        .test = test, .unit = hair_test_ball_mesh(1, 24, 36), .mesh = hair_test_ball_mesh(1, 24, 36)};
    place_ball(&f->mesh, &f->unit, radius, 0);
    f->strands = hair_test_straight(32, hair_v3(0, 0, 0), hair_v3(0, -1, 0), 0.3f);
    hair_test_live(test, &f->strands, &desc, &f->living);
    f->body = hair_test_deforming(test, &f->mesh, 0.16f, 32);
    f->collider = collider_of(f->body);
    hair_test_set_colliders(&f->living, &f->collider, 1);
}

static void end(struct fixture* f)
{
    hair_test_die(&f->living);
    hair_test_strands_free(&f->strands);
    hair_body_destroy(f->body);
    hair_test_mesh_free(&f->unit);
    hair_test_mesh_free(&f->mesh);
    assert_int_equal(f->test->context->sdf_pool.nodes, 0);
}

// Let a ball grow into a strand and push it aside. It grows by 1.2 mm a frame.
static void growing_body_pushes_guides_out(void** state)
{
    const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_FOLLOW};
    for (size_t s = 0; s < sizeof solvers / sizeof *solvers; ++s) {
        struct fixture f;
        double deepest = -INFINITY;
        begin(*state, solvers[s], 0.04f, &f);
        for (int frame = 0; frame < 60; ++frame) {
            float radius = 0.04f + 1.2e-3f * (float)(frame < 50 ? frame : 50);
            place_ball(&f.mesh, &f.unit, radius, 0);
            hair_test_deform(f.test, f.body, &f.mesh);
            hair_test_wait(&f.living, 1);
            hair_test_read_guides(&f.living);
            struct hair_triangles triangles = hair_test_triangles(f.test, &f.mesh);
            deepest = fmax(deepest, hair_test_depth_in_body(&f.living, &triangles, &f.collider));
            hair_triangles_free(&f.test->host.host, &triangles);
        }
        hair_vec3 tip = hair_test_tip(&f.living, 0);
        print_message("    solver %d: up to %.2g m deep, the tip ends at x = %.3f m\n", (int)solvers[s],
                      deepest, (double)tip.x);
        // Nearest to the axis of the ball, the strand is 0.05 m from its centre at first.
        assert_true(deepest < 1e-3 && tip.x < -0.02f);
        end(&f);
    }
}

static void sleeping_hair_wakes_when_a_body_near_it_deforms(void** state)
{
    struct fixture f;
    begin(*state, HAIR_SOLVER_DIRECT, 0.04f, &f);
    for (int frame = 0; frame < 900 && !f.living.hair->sim.sleep.asleep; ++frame) {
        hair_test_wait(&f.living, 1);
        glFinish();
    }
    assert_true(f.living.hair->sim.sleep.asleep);
    hair_test_deform(f.test, f.body, &f.mesh); // Nothing has changed.
    hair_test_wait(&f.living, 1);
    assert_true(f.living.hair->sim.sleep.asleep);
    place_ball(&f.mesh, &f.unit, 0.06f, 0);
    hair_test_deform(f.test, f.body, &f.mesh);
    hair_test_wait(&f.living, 1);
    assert_false(f.living.hair->sim.sleep.asleep);
    end(&f);
}

// Compare the field with that of a sphere, after the body has moved.
static void field_follows_the_shape(void** state)
{
    struct fixture f;
    hair_field_info info = hair_field_info_default();
    begin(*state, HAIR_SOLVER_DIRECT, 0.04f, &f);
    for (int shape = 0; shape < 3; ++shape) {
        float radius = 0.04f + 0.02f * (float)shape, x = -0.03f * (float)shape;
        place_ball(&f.mesh, &f.unit, radius, x);
        hair_test_deform(f.test, f.body, &f.mesh);
        hair_test_wait(&f.living, 1);
        hair_test_ok(f.test, hair_get_field(f.living.hair, &info));
        assert_true(info.distance_texture);
        size_t count = (size_t)info.size[0] * info.size[1] * info.size[2], near = 0;
        float* distance = malloc(count * sizeof *distance);
        glGetTextureImage(info.distance_texture, 0, GL_RED, GL_FLOAT, (GLsizei)(count * sizeof *distance),
                          distance);
        const struct hair_field_box* box = &f.living.hair->field.box;
        for (size_t i = 0; i < count; ++i) {
            float at[3] = {(float)(i % info.size[0]), (float)(i / info.size[0] % info.size[1]),
                           (float)(i / info.size[0] / info.size[1])};
            hair_vec3 p = hair_add(box->lower,
                                   hair_scale(hair_v3(at[0] + 0.5f, at[1] + 0.5f, at[2] + 0.5f), box->voxel));
            p = hair_sub(p,
                         hair_v3(f.collider.position[0] + x, f.collider.position[1], f.collider.position[2]));
            float exact = fminf(hair_length(p) - radius, info.far);
            // The CPU knows no distance inside, and a few per cent are allowed there.
            if (fabsf(exact) > 2 * info.voxel) continue;
            hair_test_near("voxel", i, (double)distance[i], (double)exact, 0.5 * (double)info.voxel);
            ++near;
        }
        print_message("    %zu voxels\n", near);
        assert_true(near > 500);
        free(distance);
    }
    end(&f);
}

// Destroy a body while a collider uses its mesh. The mesh keeps its last shape.
static void destroyed_body_keeps_its_shape_while_a_collider_uses_it(void** state)
{
    struct fixture f;
    begin(*state, HAIR_SOLVER_DIRECT, 0.06f, &f);
    hair_body_destroy(f.body);
    f.body = NULL;
    for (int frame = 0; frame < 60; ++frame) hair_test_wait(&f.living, 1);
    hair_test_read_guides(&f.living);
    struct hair_triangles triangles = hair_test_triangles(f.test, &f.mesh);
    double deepest = hair_test_depth_in_body(&f.living, &triangles, &f.collider);
    hair_triangles_free(&f.test->host.host, &triangles);
    print_message("    %.2g m deep\n", deepest);
    assert_true(deepest < 1e-3 && deepest > -0.005);
    end(&f);
}

static void body_of_another_context_is_refused(void** state)
{
    struct fixture f;
    begin(*state, HAIR_SOLVER_DIRECT, 0.04f, &f);
    hair_context* other = hair_test_context(f.test, hair_egl_get_proc);
    hair_body_desc desc = hair_test_body_desc(&f.mesh, 0.16f, 16);
    hair_body* body = NULL;
    hair_test_ok(f.test, hair_body_create(other, &desc, &body));
    hair_collider collider = collider_of(body);
    hair_test_refused(f.test, hair_set_colliders(f.living.hair, &collider, 1, sizeof collider),
                      HAIR_ERROR_ARGUMENT, "colliders[0].mesh is that of a hair_body of another context");
    hair_context_destroy(other); // The body is an orphan.
    hair_test_refused(f.test, hair_body_set_positions(body, f.mesh.positions, f.mesh.vertex_count, 12),
                      HAIR_ERROR_ARGUMENT, "hair_body: its context is destroyed or abandoned");
    assert_null(hair_body_get_mesh(body));
    hair_body_destroy(body);
    end(&f);
}

// Save and load hair between two bodies of equal triangles. Their keys tell them apart.
static void loaded_hair_finds_its_bodies_by_key(void** state)
{
    struct fixture f;
    begin(*state, HAIR_SOLVER_DIRECT, 0.04f, &f);
    hair_body_desc desc = hair_test_body_desc(&f.mesh, 0.16f, 16);
    hair_body* bodies[2] = {NULL, NULL};
    hair_collider colliders[2] = {f.collider, f.collider};
    unsigned char* bytes;
    size_t size = 0;
    for (uint64_t i = 0; i < 2; ++i) {
        desc.key = 7 + i;
        hair_test_ok(f.test, hair_body_create(f.test->context, &desc, &bodies[i]));
        colliders[i].mesh = hair_body_get_mesh(bodies[i]);
        colliders[i].position[0] = 0.1f + 0.1f * (float)i;
    }
    hair_test_set_colliders(&f.living, colliders, 2);
    hair_test_wait(&f.living, 3);
    hair_test_ok(f.test, hair_save(f.living.hair, NULL, 0, &size));
    bytes = malloc(size);
    hair_test_ok(f.test, hair_save(f.living.hair, bytes, size, &size));
    const hair_collision_mesh* first = colliders[0].mesh;
    colliders[0].mesh = colliders[1].mesh, colliders[1].mesh = first;
    hair_test_set_colliders(&f.living, colliders, 2);
    hair_test_wait(&f.living, 3);
    hair_test_ok(f.test, hair_load(f.living.hair, bytes, size));
    const struct hair_collider_list* list = hair_sim_colliders(&f.living.hair->sim);
    for (uint32_t i = 0; i < 2; ++i) assert_ptr_equal(list->collider[i].mesh, hair_body_get_mesh(bodies[i]));
    hair_test_wait(&f.living, 3);
    free(bytes);
    hair_test_set_colliders(&f.living, NULL, 0);
    hair_test_wait(&f.living, 2); // The instance refers to the meshes of its last step too.
    for (int i = 0; i < 2; ++i) hair_body_destroy(bodies[i]);
    end(&f);
}

// Restore a context in another OpenGL context, of which nothing has the distances.
static void restored_body_has_its_last_shape(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(12, 16, 0, 0), next = hair_test_lump(12, 16, 1, 0);
    hair_context_desc desc = hair_context_desc_default();
    hair_context *context = NULL, *own = test->context;
    hair_egl* egl = NULL;
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.restorable = true;
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &egl));
    hair_test_ok(test, hair_context_create(&desc, &context));
    test->context = context;
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    hair_test_deform(test, body, &next);
    float* before = hair_test_body_nodes(body);
    hair_egl_destroy(egl);
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &egl));
    hair_test_ok(test, hair_context_restore(context));
    float* after = hair_test_body_nodes(body);
    assert_memory_equal(before, after, body->mesh->size[0] * body->mesh->size[1] * sizeof *after);
    hair_test_deform(test, body, &mesh);
    hair_body_destroy(body);
    assert_int_equal(context->sdf_pool.nodes, 0);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    hair_egl_make_current(test->egl);
    test->context = own;
    free(before);
    free(after);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&next);
}

// Step hair among other colliders.
static void context_without_a_body_has_no_pass_of_bodies(void** state)
{
    struct fixture f;
    begin(*state, HAIR_SOLVER_DIRECT, 0.04f, &f);
    hair_context *other = hair_test_context(f.test, hair_egl_get_proc), *own = f.test->context;
    hair_instance* hair = NULL;
    hair_desc desc = hair_desc_default();
    hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0.05f, 0, 0);
    ball.size[0] = 0.03f;
    f.test->context = other;
    hair_test_ok(f.test, hair_create(other, f.living.groom, &desc, &hair));
    hair_test_ok(f.test, hair_set_colliders(hair, &ball, 1, sizeof ball));
    hair_test_ok(f.test, hair_step(hair, 1.0f / 60));
    for (hair_gl_pass pass = HAIR_GL_BODY_SCATTER; pass <= HAIR_GL_BODY_LINE_LAST; ++pass) {
        assert_null(hair_gl_find(&other->gl, pass));
        assert_non_null(hair_gl_find(&own->gl, pass));
    }
    assert_int_equal(other->sdf_pool.nodes, 0);
    assert_int_not_equal(own->sdf_pool.nodes, 0);
    hair_destroy(hair);
    hair_context_destroy(other);
    f.test->context = own;
    end(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(growing_body_pushes_guides_out),
        HAIR_TEST(sleeping_hair_wakes_when_a_body_near_it_deforms),
        HAIR_TEST(field_follows_the_shape),
        HAIR_TEST(destroyed_body_keeps_its_shape_while_a_collider_uses_it),
        HAIR_TEST(body_of_another_context_is_refused),
        HAIR_TEST(loaded_hair_finds_its_bodies_by_key),
        HAIR_TEST(restored_body_has_its_last_shape),
        HAIR_TEST(context_without_a_body_has_no_pass_of_bodies),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
