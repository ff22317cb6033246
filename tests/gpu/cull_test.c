// cull_test.c - hair out of view is not drawn, existing strand lists are not made again, and
// nothing waits for the GPU.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/trace.h"
#include "tests/support/tessellated.h"

enum { SIZE = 48, VALUES = 4 * SIZE * SIZE, MAX = 4096 };

static struct hair_test_scene start(void** state)
{
    struct hair_test_scene f = hair_test_scene_make(*state, hair_test_trace_proc);
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    look.strand.segments = 12;
    look.strand.radius = 1e-3f;
    look.shading.model = HAIR_SHADING_LINES;
    desc.look = &look;
    hair_test_scene_add(&f, NULL, &desc);
    hair_test_frame_make(&f.frame, SIZE, SIZE, GL_RGBA32F, 0);
    return f;
}

// Make a view matrix from `eye`, looking along `way`.
static void look_along(hair_vec3 eye, hair_vec3 way, float view[16])
{
    hair_vec3 z = hair_scale(hair_normalize(way, hair_v3(0, 0, -1)), -1), x = hair_perpendicular(z);
    hair_vec3 y = hair_cross(z, x);
    const float m[16] = {x.x,
                         y.x,
                         z.x,
                         0,
                         x.y,
                         y.y,
                         z.y,
                         0,
                         x.z,
                         y.z,
                         z.z,
                         0,
                         -hair_dot(x, eye),
                         -hair_dot(y, eye),
                         -hair_dot(z, eye),
                         1};
    memcpy(view, m, sizeof m);
}

// Make a projection as games have it: perspective, orthographic, reversed and infinite, or one that
// shows only its left half.
static void project(int kind, float projection[16])
{
    const float n = 0.05f, f = 3, g = 1.6f;
    const float kinds[4][16] = {
        {g, 0, 0, 0, 0, g, 0, 0, 0, 0, (f + n) / (n - f), -1, 0, 0, 2 * f * n / (n - f), 0},
        {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -2 / (f - n), 0, 0, 0, -(f + n) / (f - n), 1},
        {g, 0, 0, 0, 0, g, 0, 0, 0, 0, 0, -1, 0, 0, n, 0},
        {2 * g, 0, 0, 0, 0, g, 0, 0, 1, 0, (f + n) / (n - f), -1, 0, 0, 2 * f * n / (n - f), 0}};
    memcpy(projection, kinds[kind], 16 * sizeof *projection);
}

static int is_inside(const hair_view* view, const float at[3], int zero_to_one)
{
    float eye[4], clip[4];
    for (int i = 0; i < 4; ++i)
        eye[i] = view->view[i] * at[0] + view->view[4 + i] * at[1] + view->view[8 + i] * at[2] +
                 view->view[12 + i];
    for (int i = 0; i < 4; ++i) {
        clip[i] = 0;
        for (int k = 0; k < 4; ++k) clip[i] += view->projection[4 * k + i] * eye[k];
    }
    return fabsf(clip[0]) <= clip[3] && fabsf(clip[1]) <= clip[3] && clip[2] <= clip[3] &&
           clip[2] >= (zero_to_one ? 0 : -clip[3]);
}

// Check eyes around and inside the hair, with any direction. Hair is drawn if a vertex is in view,
// and mostly culled if it is wholly out of view.
static void only_hair_out_of_view_is_culled(void** state)
{
    static float at[3 * MAX];
    struct hair_test_scene f = start(state);
    uint32_t random = 3, count, unseen = 0, culled = 0, wrong = 0;
    hair_view view = hair_test_tessellated();
    const float head[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 6, -7, 1};
    hair_test_ok(f.test, hair_teleport(f.hair, head));
    hair_test_ok(f.test, hair_read_positions(f.hair, HAIR_READ_FOLLOWERS, at, MAX, &count));
    assert_in_range(count, 100, MAX);
    for (int i = 0; i < 800; ++i) {
        float away = i % 5 ? 1.5f : 0.2f;
        hair_vec3 eye, way;
        float* numbers[] = {&eye.x, &eye.y, &eye.z, &way.x, &way.y, &way.z};
        for (int k = 0; k < 6; ++k) *numbers[k] = (2 * hair_random(&random) - 1) * (k < 3 ? away : 1);
        look_along(hair_add(eye, hair_v3(5, 6, -7)), way, view.view);
        project(i % 4, view.projection);
        view.pass = i % 3 ? HAIR_PASS_COLOR : HAIR_PASS_DEPTH;
        int seen = 0;
        for (uint32_t k = 0; k < count && !seen; ++k) seen = is_inside(&view, at + 3 * k, i % 4 == 2);
        glClipControl(GL_LOWER_LEFT, i % 4 == 2 ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
        hair_test_trace_clear();
        hair_test_ok(f.test, hair_draw(f.hair, &view));
        uint32_t draws = hair_test_trace_count("glDraw") + hair_test_trace_count("glMultiDraw");
        wrong += seen && !draws;
        unseen += (uint32_t)!seen;
        culled += !draws;
        if (!draws) assert_int_equal(hair_test_trace_count("glDispatch"), 0);
    }
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    print_message("    of 800 views %u show no vertex, %u of which are not drawn\n", unseen, culled);
    assert_int_equal(wrong, 0);
    assert_true(culled > unseen / 2);
    hair_test_scene_free(&f);
}

static void depth_clamp_disables_near_and_far_culling(void** state)
{
    struct hair_test_scene f = start(state);
    hair_view view = hair_test_tessellated();
    for (int clamps = 0; clamps < 2; ++clamps) {
        look_along(hair_v3(0, 0, 9), hair_v3(0, 0, -1), view.view);
        project(0, view.projection);
        (clamps ? glEnable : glDisable)(GL_DEPTH_CLAMP);
        hair_test_trace_clear();
        hair_test_ok(f.test, hair_draw(f.hair, &view));
        assert_true((hair_test_trace_count("glDraw") > 0) == clamps);
    }
    glDisable(GL_DEPTH_CLAMP);
    hair_test_scene_free(&f);
}

// Check that hair that may be anywhere is drawn.
static void hair_with_free_roots_is_never_view_culled(void** state)
{
    struct hair_test_scene f = start(state);
    hair_view view = hair_test_tessellated();
    hair_physics physics = hair_physics_default();
    look_along(hair_v3(0, 0, 2), hair_v3(0, 0, 1), view.view);
    project(0, view.projection);
    physics.root = HAIR_ROOT_FREE;
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    hair_test_trace_clear();
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    assert_true(hair_test_trace_count("glDraw") > 0);
    hair_test_scene_free(&f);
}

static void read(const struct hair_test_scene* f, const hair_view* view, float* pixels)
{
    hair_test_draw_in(&f->frame, f->test, f->hair, view, pixels);
}

// Return how many passes have run. A software rasteriser divides a pass into several dispatches if
// the pass took long before, as it does on a busy machine.
static uint64_t count_runs(const struct hair_gl* gl)
{
    uint64_t runs = 0;
    for (uint32_t i = 0; i < gl->programs; ++i) runs += gl->program[i]->timer.begun;
    return runs;
}

// Compare the picture with one for which everything is computed anew.
static void strand_list_is_reused_while_nothing_changes(void** state)
{
    static float kept[VALUES], anew[VALUES];
    struct hair_test_scene f = start(state);
    hair_view view = hair_test_tessellated();
    hair_lod lod = hair_lod_default();
    hair_look look = f.hair->geometry.look;
    view.render_path = HAIR_RENDER_PATH_PROCEDURAL;
    lod.strand_pixels = 4;
    project(0, view.projection);
    for (int i = 0; i < 10; ++i) {
        // The cases: again, another view, lower density, with a level of detail, again, another
        // view, stepped, and again.
        static const uint64_t computed[] = {4, 0, 0, 2, 2, 0, 2, 4, 0, 0};
        look_along(hair_v3(0, 0.1f, i >= 2 && i < 6 ? 0.7f : 0.8f), hair_v3(0, 0, -1), view.view);
        look.followers.density = i >= 3 ? 0.6f : 1;
        view.lod = i >= 4 ? &lod : NULL;
        hair_test_ok(f.test, hair_set_look(f.hair, &look));
        if (i == 7) hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
        uint64_t before = count_runs(f.hair->geometry.gl);
        read(&f, &view, kept);
        // The last pass draws.
        uint64_t runs = count_runs(f.hair->geometry.gl) - before - 1;
        if (i != 0 && i != 7) assert_int_equal(runs, computed[i]);
        if (f.hair->renderer.strand_list.key) f.hair->renderer.strand_list.key->program_generation = 0;
        ++f.hair->geometry.follower_collision.generation;
        read(&f, &view, anew);
        assert_true(hair_test_max_difference(kept, anew, VALUES) == 0);
    }
    hair_test_scene_free(&f);
}

static uint32_t count_primitives(const struct hair_test_scene* f, const hair_view* view, float* pixels)
{
    GLuint query = hair_test_count_begin();
    read(f, view, pixels);
    return hair_test_count_end(query);
}

// Check close views with every kind of projection. With free roots no patch may be left out.
static void culled_patches_do_not_change_the_picture(void** state)
{
    static float some[VALUES], all[VALUES];
    struct hair_test_scene f = start(state);
    hair_view view = hair_test_tessellated();
    hair_physics physics = hair_physics_default(), lets_go = physics;
    uint32_t random = 7, drawn[2] = {0, 0};
    hair_look look = f.hair->geometry.look;
    look.strand.radius = 4e-3f;
    lets_go.root = HAIR_ROOT_FREE;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    for (int i = 0; i < 120; ++i) {
        hair_vec3 eye, way;
        float* numbers[] = {&eye.x, &eye.y, &eye.z, &way.x, &way.y, &way.z};
        for (int k = 0; k < 6; ++k) *numbers[k] = (2 * hair_random(&random) - 1) * (k < 3 ? 0.3f : 1);
        look_along(eye, way, view.view);
        project(i % 4, view.projection);
        view.primitive = i % 3 ? HAIR_PRIMITIVE_RIBBONS : HAIR_PRIMITIVE_LINES;
        hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
        drawn[0] += count_primitives(&f, &view, some);
        hair_test_ok(f.test, hair_set_physics(f.hair, &lets_go));
        drawn[1] += count_primitives(&f, &view, all);
        assert_true(hair_test_max_difference(some, all, VALUES) == 0);
    }
    print_message("    %u primitives of %u\n", drawn[0], drawn[1]);
    // Strands are as long as all of the hair is wide, so few patches are out of view.
    assert_true(drawn[0] < drawn[1]);
    hair_test_scene_free(&f);
}

static hair_memory memory_of(struct hair_test_scene* f)
{
    hair_memory memory = hair_memory_default();
    hair_test_ok(f->test, hair_get_memory(f->context, &memory));
    return memory;
}

// Check draws without lights, with a light, and with a light that has a shadow map. Only the shadow
// map makes the library bind a texture and a sampler, and bind the application's sampler again.
static void lights_cost_nothing_when_there_are_none(void** state)
{
    static float pixels[VALUES];
    struct hair_test_scene f = start(state);
    hair_view view = hair_test_tessellated();
    hair_light light = hair_light_default();
    GLuint shadow = 0;
    uint32_t binds[3], samplers[3];
    uint64_t bytes[3];
    glCreateTextures(GL_TEXTURE_2D, 1, &shadow);
    glTextureStorage2D(shadow, 1, GL_DEPTH_COMPONENT32F, 4, 4);
    look_along(hair_v3(0, 0.1f, 0.8f), hair_v3(0, 0, -1), view.view);
    project(0, view.projection);
    read(&f, &view, pixels); // The first draw makes all that is made once.
    for (int i = 0; i < 3; ++i) {
        light.hair_shadow_map = i == 2 ? shadow : 0;
        view.lights = &light;
        view.light_count = i > 0;
        hair_test_trace_clear();
        hair_test_ok(f.test, hair_draw(f.hair, &view));
        binds[i] = hair_test_trace_count("glBindTextureUnit");
        samplers[i] = hair_test_trace_count("glBindSampler");
        bytes[i] = memory_of(&f).bytes;
        assert_int_equal(hair_test_trace_count("glDispatch"), 0);
        assert_int_equal(hair_test_trace_count("glDrawArrays"), 1);
    }
    assert_int_equal(binds[0], binds[1]);
    assert_int_equal(samplers[0], samplers[1]);
    assert_int_equal(binds[0], binds[2] - 1);
    assert_int_equal(samplers[0], samplers[2] - 2);
    assert_true(bytes[0] == bytes[1] && bytes[1] == bytes[2]);
    glDeleteTextures(1, &shadow);
    hair_test_scene_free(&f);
}

// Check frames of a step and a draw, with colliders in reach of followers and all passes timed.
static void frames_do_not_wait_for_the_gpu(void** state)
{
    struct hair_test_scene f = start(state);
    hair_view view = hair_test_tessellated();
    hair_collider collider = hair_collider_default();
    uint32_t looked = 0;
    look_along(hair_v3(0, 0.1f, 0.8f), hair_v3(0, 0, -1), view.view);
    project(0, view.projection);
    collider.size[0] = 0.05f, collider.position[1] = 0.2f;
    hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
    for (int path = 0; path < 3; ++path) {
        view.render_path = hair_test_paths[path];
        for (int frame = 0; frame < 40; ++frame) {
            if (frame == 1) hair_test_trace_clear();
            hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
            hair_test_ok(f.test, hair_draw(f.hair, &view));
            glFlush(); // An application that shows the picture flushes too.
        }
        if (hair_test_trace_waits())
            fail_msg("%u waits: %s", hair_test_trace_waits(), hair_test_trace_list());
        static const char* const waiting[] = {"glFinish", "glReadPixels", "glGetError", "glGetTexImage",
                                              "glMapBuffer"};
        for (int i = 0; i < 5; ++i) assert_int_equal(hair_test_trace_count(waiting[i]), 0);
        looked += hair_test_trace_count("glClientWaitSync");
    }
    assert_true(looked > 0); // Guides were examined until they rested.
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(only_hair_out_of_view_is_culled),
        HAIR_TEST(depth_clamp_disables_near_and_far_culling),
        HAIR_TEST(hair_with_free_roots_is_never_view_culled),
        HAIR_TEST(strand_list_is_reused_while_nothing_changes),
        HAIR_TEST(culled_patches_do_not_change_the_picture),
        HAIR_TEST(lights_cost_nothing_when_there_are_none),
        HAIR_TEST(frames_do_not_wait_for_the_gpu),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
