// buffers_memory_test.c - buffers of strands compute and keep only what the application asks for.
// Wrong arguments are refused.
#include "tests/support/scene.h"

#include <string.h>

static uint32_t runs_of(const struct hair_test_scene* scene, const char* pass)
{
    hair_timing timings[64];
    uint32_t count = hair_get_timings(scene->context, timings, 64), runs = 0;
    for (uint32_t i = 0; i < count && i < 64; ++i)
        if (strncmp(timings[i].pass, pass, strlen(pass)) == 0) runs += timings[i].runs;
    return runs;
}

static uint64_t bytes_of(const struct hair_test_scene* scene)
{
    hair_memory memory = hair_memory_default();
    hair_test_ok(scene->test, hair_get_memory(scene->context, &memory));
    return memory.bytes;
}

static void only_what_is_asked_for_is_computed_and_kept(void** state)
{
    struct hair_test_scene scene = hair_test_scene_make(*state, hair_egl_get_proc);
    hair_test_scene_add(&scene, NULL, NULL);
    hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
    uint64_t first = bytes_of(&scene);
    hair_buffers got =
        hair_test_get_buffers(&scene, HAIR_READ_SMOOTH, HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_TANGENT);
    uint64_t tangents = 16ull * got.tangent.count;
    assert_int_equal(bytes_of(&scene), first + tangents);
    assert_int_equal(runs_of(&scene, "strands/guide_tangents"), 1);
    assert_int_equal(runs_of(&scene, "strands/expand"), 0);
    for (int i = 0; i < 3; ++i) hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_ATTRIBUTE_POSITION);
    assert_int_equal(runs_of(&scene, "strands/expand"), 1);
    assert_int_equal(runs_of(&scene, "draw/reflectance"), 0);
    uint32_t vertices = (uint32_t)hair_geometry_count_vertices(&scene.hair->geometry);
    assert_int_equal(bytes_of(&scene), first + tangents + 24ull * vertices);
    for (int i = 0; i < 3; ++i) {
        got = hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS,
                                    HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_COLOR);
        hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
    }
    assert_int_equal(runs_of(&scene, "draw/reflectance"), 1); // Colours do not move.
    assert_int_equal(bytes_of(&scene), first + tangents + 32ull * vertices);
    assert_true(got.color.buffer && !got.strand.buffer && !got.prev_position.buffer && !got.radius.buffer);
    hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_TEST_FOLLOWER_ATTRIBUTES);
    assert_int_equal(bytes_of(&scene), first + tangents + 52ull * vertices);
    // Unused memory is freed.
    for (int i = 0; i < 245; ++i) hair_test_ok(scene.test, hair_step(scene.hair, 1e-4f));
    hair_test_get_buffers(&scene, HAIR_READ_SMOOTH, HAIR_ATTRIBUTE_POSITION);
    assert_int_equal(bytes_of(&scene), first);
    hair_test_scene_free(&scene);
}

static void hair_without_followers_has_empty_buffers(void** state)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.followers = 0;
    struct hair_test_scene scene = hair_test_scene_of(*state, &wanted, NULL);
    hair_buffers got = hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_TEST_FOLLOWER_ATTRIBUTES);
    assert_true(got.strand_count == 0 && got.position.buffer == 0 && got.position.count == 0);
    got = hair_test_get_buffers(&scene, HAIR_READ_SMOOTH, HAIR_TEST_GUIDE_ATTRIBUTES);
    assert_true(got.strand_count > 0 && got.position.buffer);
    hair_test_scene_free(&scene);
}

static void wrong_arguments_are_refused(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_scene scene = hair_test_scene_of(test, NULL, NULL);
    hair_buffers out = hair_buffers_default();
    hair_result error = HAIR_ERROR_ARGUMENT;
    hair_test_refused(test, hair_get_buffers(scene.hair, HAIR_READ_GUIDES, &out), error, "source is 0");
    hair_test_refused(test, hair_get_buffers(scene.hair, (hair_read_source)-1, &out), error, "source is -1");
    hair_test_refused(test, hair_get_buffers(scene.hair, HAIR_READ_SMOOTH, NULL), error, "hair_buffers");
    out.attributes = 128;
    hair_test_refused(test, hair_get_buffers(scene.hair, HAIR_READ_FOLLOWERS, &out), error,
                      "hair_buffers.attributes is 128, not in [0, 127]");
    out.attributes = HAIR_ATTRIBUTE_RADIUS;
    hair_test_refused(test, hair_get_buffers(scene.hair, HAIR_READ_SMOOTH, &out), error, "guides have only");
    assert_int_equal(hair_get_buffers(NULL, HAIR_READ_FOLLOWERS, &out), error);
    out.header.version = 0;
    hair_test_refused(test, hair_get_buffers(scene.hair, HAIR_READ_FOLLOWERS, &out), HAIR_ERROR_VERSION, "");
    out = hair_buffers_default();
    hair_egl_make_current(NULL);
    hair_test_refused(test, hair_get_buffers(scene.hair, HAIR_READ_FOLLOWERS, &out), HAIR_ERROR_OPENGL, "");
    hair_egl_make_current(test->egl);
    out.attributes = 0;
    hair_test_ok(test, hair_get_buffers(scene.hair, HAIR_READ_FOLLOWERS, &out));
    assert_true(!out.position.buffer && out.strand_count > 0);
    hair_test_scene_free(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(only_what_is_asked_for_is_computed_and_kept),
        HAIR_TEST(hair_without_followers_has_empty_buffers),
        HAIR_TEST(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
