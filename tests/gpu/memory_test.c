// memory_test.c - buffers and textures are made when they are first needed, counted once, and freed
// when they are no longer needed. Their size stays within the limit of the application.
#include "tests/support/scene.h"

#include <stdio.h>

enum { SIZE = 48, VALUES = 4 * SIZE * SIZE };

static hair_result create(struct hair_test_scene* f, hair_instance** out)
{
    hair_desc desc = hair_desc_default();
    hair_physics physics = hair_physics_default();
    hair_groom* groom = hair_test_groom(&f->test->host.host, hair_test_handmade_default());
    physics.sleep_threshold = 0;
    desc.physics = &physics;
    hair_result result = hair_create(f->context, groom, &desc, out);
    hair_groom_destroy(groom);
    return result;
}

static struct hair_test_scene start(struct hair_test* test)
{
    struct hair_test_scene f = hair_test_scene_make(test, hair_egl_get_proc);
    hair_test_ok(test, create(&f, &f.hair));
    hair_test_frame_make(&f.frame, SIZE, SIZE, GL_RGBA32F, 0);
    return f;
}

static void draw(const struct hair_test_scene* f, const hair_view* view, float* pixels)
{
    hair_test_draw_in(&f->frame, f->test, f->hair, view, pixels);
}

static hair_memory memory_of(struct hair_test_scene* f)
{
    hair_memory memory = hair_memory_default();
    hair_test_ok(f->test, hair_get_memory(f->context, &memory));
    return memory;
}

static uint64_t reported(struct hair_test_scene* f)
{
    hair_report_info info = hair_report_info_default();
    uint32_t count;
    hair_test_ok(f->test, hair_report(f->hair, true, &info, NULL, 0, 0, &count));
    return info.bytes + hair_groom_follower_bytes(f->hair->groom) + hair_test_sample_bytes(f->context);
}

// Check that everything an instance can have is counted once, and freed.
static void memory_is_the_sum_of_instances_and_is_all_freed(void** state)
{
    static float pixels[VALUES];
    struct hair_test_scene f = start(*state);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_CACHED);
    hair_collider collider = hair_collider_default();
    hair_wind wind = hair_wind_default();
    hair_physics physics = hair_physics_default();
    hair_pin pin = hair_pin_default();
    hair_lod lod = hair_lod_default();
    uint64_t plain, all;
    hair_test_ok(f.test, hair_step(f.hair, 0.02f));
    assert_int_equal(memory_of(&f).bytes, reported(&f));
    plain = memory_of(&f).bytes;
    collider.size[0] = 0.05f, collider.position[1] = -0.1f;
    wind.model = HAIR_WIND_FLUID, wind.velocity[0] = 1, wind.turbulence.intensity = 0.2f,
    wind.fluid.resolution = 16;
    physics.hair_hair.cohesion = physics.hair_hair.pressure_stiffness = 1;
    pin.position[0] = 0.1f;
    hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.test, hair_set_wind(f.hair, &wind));
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    hair_test_ok(f.test, hair_set_pins(f.hair, &pin, 1, sizeof pin));
    for (int i = 0; i < 3; ++i) {
        collider.position[0] += 0.01f;
        hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
        hair_test_ok(f.test, hair_step(f.hair, 0.02f));
        view.pass = i == 1 ? HAIR_PASS_MOTION : HAIR_PASS_COLOR;
        view.coverage = i == 2 ? HAIR_COVERAGE_ALPHA : HAIR_COVERAGE_MSAA;
        view.render_path = i == 0 ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED;
        draw(&f, &view, pixels);
        view.lod = i == 0 ? &lod : NULL;
        if (view.lod) draw(&f, &view, pixels);
        view.lod = NULL;
        assert_int_equal(memory_of(&f).bytes, reported(&f));
    }
    all = memory_of(&f).bytes;
    print_message("    %llu bytes, %llu with all that there is\n", (unsigned long long)plain,
                  (unsigned long long)all);
    assert_true(all > 4 * plain);
    assert_true(memory_of(&f).peak >= all);
    hair_destroy(f.hair);
    f.hair = NULL;
    assert_int_equal(memory_of(&f).bytes, 0);
    hair_test_scene_free(&f);
}

// Destroy the first instance of a groom, whose strands another goes on to draw.
static void instances_share_the_strands_of_their_groom(void** state)
{
    static float pixels[3][VALUES];
    struct hair_test_scene f = start(*state);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION);
    hair_instance *first = f.hair, *other = NULL;
    hair_group_look look = hair_group_look_default();
    uint64_t strands = hair_groom_follower_bytes(first->groom), one = memory_of(&f).bytes;
    hair_desc desc = hair_desc_default();
    hair_test_ok(f.test, hair_create(f.context, first->groom, &desc, &other));
    uint64_t two = memory_of(&f).bytes;
    print_message("    %llu shared bytes, %llu with one instance, %llu with two\n",
                  (unsigned long long)strands, (unsigned long long)one, (unsigned long long)two);
    assert_true(strands > 1000 && two <= 2 * one - strands);
    draw(&f, &view, pixels[0]);
    f.hair = other;
    draw(&f, &view, pixels[1]);
    assert_memory_equal(pixels[0], pixels[1], sizeof pixels[0]);
    look.radius = 4; // Only this instance has wider strands.
    hair_test_ok(f.test, hair_set_group_look(other, 0, &look));
    draw(&f, &view, pixels[2]);
    assert_true(hair_test_max_difference(pixels[0], pixels[2], VALUES) > 0.1f);
    f.hair = first;
    draw(&f, &view, pixels[1]);
    assert_memory_equal(pixels[0], pixels[1], sizeof pixels[0]);
    f.hair = other;
    hair_destroy(first);
    draw(&f, &view, pixels[1]);
    assert_memory_equal(pixels[1], pixels[2], sizeof pixels[1]);
    hair_destroy(other);
    f.hair = NULL;
    assert_int_equal(memory_of(&f).bytes, 0);
    hair_test_scene_free(&f);
}

static void memory_over_the_limit_is_refused_and_changes_nothing(void** state)
{
    static float pixels[2][VALUES];
    struct hair_test_scene f = start(*state);
    hair_view plain = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION),
              view = hair_test_view_by(HAIR_RENDER_PATH_CACHED);
    hair_instance* other = NULL;
    draw(&f, &plain, pixels[0]);
    uint64_t bytes = memory_of(&f).bytes, used = bytes;
    hair_test_ok(f.test, hair_set_memory_limit(f.context, bytes + 1000));
    assert_int_equal(memory_of(&f).limit, bytes + 1000);
    hair_test_refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_MEMORY,
                      "in use would be beyond the limit of");
    hair_test_refused(f.test, create(&f, &other), HAIR_ERROR_MEMORY, "in use would be beyond the limit of");
    assert_null(other);
    assert_true(memory_of(&f).bytes <= bytes + 1000);
    hair_test_ok(f.test, hair_step(f.hair, 0.05f)); // The instance has all that it needs.
    hair_test_ok(f.test, hair_reset(f.hair));
    draw(&f, &plain, pixels[1]);
    assert_memory_equal(pixels[0], pixels[1], sizeof pixels[0]);
    hair_test_ok(f.test, hair_set_memory_limit(f.context, 0));
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    hair_test_ok(f.test, create(&f, &other));
    hair_destroy(other);
    assert_true(memory_of(&f).bytes > used);
    assert_int_equal(hair_get_memory(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_memory_limit(NULL, 0), HAIR_ERROR_ARGUMENT);
    hair_test_scene_free(&f);
}

// Compare the pictures before, meanwhile and after, on every render path.
static void unused_view_memory_is_freed_and_made_again_on_use(void** state)
{
    static float pixels[2][VALUES];
    struct hair_test_scene f = start(*state);
    hair_view plain = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION),
              view = hair_test_view_by(HAIR_RENDER_PATH_CACHED);
    hair_look look = f.hair->geometry.look;
    look.shading.model = HAIR_SHADING_LINES;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    draw(&f, &plain, pixels[0]);
    uint64_t min = memory_of(&f).bytes;
    for (int kind = 0; kind < 4; ++kind) {
        view.pass = kind == 2 ? HAIR_PASS_MOTION : HAIR_PASS_COLOR;
        view.coverage = kind == 1 ? HAIR_COVERAGE_ALPHA : HAIR_COVERAGE_MSAA;
        look.shading.model = kind == 3 ? HAIR_SHADING_FIBRES : HAIR_SHADING_LINES;
        for (int turn = 0; turn < 2; ++turn) {
            hair_test_ok(f.test, hair_reset(f.hair));
            hair_test_ok(f.test, hair_set_look(f.hair, &look));
            draw(&f, &view, pixels[turn]);
            assert_true(memory_of(&f).bytes > min);
            look.shading.model = HAIR_SHADING_LINES;
            hair_test_ok(f.test, hair_set_look(f.hair, &look));
            for (int i = 0; i < 250; ++i) {
                hair_test_ok(f.test, hair_step(f.hair, 1e-4f));
                // The memory is not freed at once.
                if (i == 100) assert_true(memory_of(&f).bytes > min);
                if (i % 50 == 0) hair_test_ok(f.test, hair_draw(f.hair, &plain));
            }
            assert_int_equal(memory_of(&f).bytes, min);
            look.shading.model = kind == 3 ? HAIR_SHADING_FIBRES : HAIR_SHADING_LINES;
        }
        // Equally distant fragments of segments are blended in any order.
        assert_true(hair_test_max_difference(pixels[0], pixels[1], VALUES) <= (kind == 1 ? 0.05f : 0));
    }
    hair_test_scene_free(&f);
}

// Check a depth pass after colour. It draws the vertices that the colour pass wrote, and does not
// keep their shaded colours.
static void cached_vertices_stay_for_depth_when_colors_are_freed(void** state)
{
    static float pixels[VALUES];
    struct hair_test_scene f = start(*state);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_CACHED);
    hair_look look = f.hair->geometry.look;
    look.shading.model = HAIR_SHADING_LINES;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    view.pass = HAIR_PASS_DEPTH;
    draw(&f, &view, pixels);
    uint64_t min = memory_of(&f).bytes;
    view.pass = HAIR_PASS_COLOR;
    draw(&f, &view, pixels);
    assert_true(memory_of(&f).bytes > min);
    view.pass = HAIR_PASS_DEPTH;
    for (int i = 0; i < 250; ++i) {
        hair_test_ok(f.test, hair_step(f.hair, 1e-4f));
        if (i % 50 == 0) hair_test_ok(f.test, hair_draw(f.hair, &view));
    }
    assert_int_equal(memory_of(&f).bytes, min);
    hair_test_scene_free(&f);
}

// Return the memory of guides after a step and a draw, in bytes per guide vertex.
static double bytes_per_vertex(struct hair_test* test, float turn)
{
    static float pixels[VALUES];
    struct hair_test_scene f = hair_test_scene_make(test, hair_egl_get_proc);
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_desc desc = hair_desc_default();
    hair_physics physics = hair_physics_default();
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION);
    if (turn == 0) physics.shape.gravity_preload = 0; // The preload bends guides at rest.
    desc.physics = &physics;
    wanted.guides = 64;
    wanted.fewest = wanted.max = 32;
    wanted.turn = turn;
    desc.thread_mapping = HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
    hair_test_scene_add(&f, &wanted, &desc);
    hair_test_frame_make(&f.frame, SIZE, SIZE, GL_RGBA32F, 0);
    hair_test_ok(test, hair_step(f.hair, 0.02f));
    draw(&f, &view, pixels);
    assert_int_equal(turn > 0, f.hair->sim.rods->mixed != 0);
    uint64_t bytes = hair_test_report_row(test, f.hair, "solve").bytes;
    bytes += hair_test_report_row(test, f.hair, "smooth").bytes;
    hair_test_scene_free(&f);
    return (double)bytes / (wanted.guides * wanted.max);
}

static void guide_vertex_takes_a_limited_number_of_bytes(void** state)
{
    double straight = bytes_per_vertex(*state, 0), curled = bytes_per_vertex(*state, 0.1f);
    printf("a guide vertex takes %.1f bytes if straight, %.1f if curled\n", straight, curled);
    assert_true(straight > 0 && straight <= 284);
    assert_true(curled > 0 && curled <= 252);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(guide_vertex_takes_a_limited_number_of_bytes),
        HAIR_TEST(memory_is_the_sum_of_instances_and_is_all_freed),
        HAIR_TEST(instances_share_the_strands_of_their_groom),
        HAIR_TEST(memory_over_the_limit_is_refused_and_changes_nothing),
        HAIR_TEST(unused_view_memory_is_freed_and_made_again_on_use),
        HAIR_TEST(cached_vertices_stay_for_depth_when_colors_are_freed),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
