// compile_test.c - programs are compiled when they are first needed, and kept in the cache of the
// application.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/passes.h"
#include "tests/support/scene.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/support/trace.h"

enum { SIZE = 48, VALUES = 4 * SIZE * SIZE, KEPT = 32, FLIPS = 60 };

// The application's cache, in memory --------------------------------------------------------------

struct kept {
    uint64_t key;
    unsigned char* bytes;
    size_t size;
};

struct cache {
    struct kept kept[KEPT];
    uint32_t count, puts;
};

static struct kept* find(struct cache* cache, uint64_t key)
{
    for (uint32_t i = 0; i < cache->count; ++i)
        if (cache->kept[i].key == key) return &cache->kept[i];
    return NULL;
}

static size_t get(uint64_t key, void* bytes, size_t capacity, void* user)
{
    const struct kept* kept = find(user, key);
    if (kept && bytes && kept->size <= capacity) memcpy(bytes, kept->bytes, kept->size);
    return kept ? kept->size : 0;
}

static void put(uint64_t key, const void* bytes, size_t size, void* user)
{
    struct cache* cache = user;
    struct kept* kept = find(cache, key);
    if (!kept) {
        assert_true(cache->count < KEPT);
        kept = &cache->kept[cache->count++];
    }
    free(kept->bytes);
    *kept = (struct kept){key, malloc(size), size};
    memcpy(kept->bytes, bytes, size);
    ++cache->puts;
}

static void empty(struct cache* cache)
{
    for (uint32_t i = 0; i < cache->count; ++i) free(cache->kept[i].bytes);
}

// Hair --------------------------------------------------------------------------------------------

static hair_context* make_context(struct hair_test* test, struct cache* cache)
{
    hair_context* context = NULL;
    hair_cache own = {get, put, cache};
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = hair_test_trace_proc;
    desc.cache = cache ? &own : NULL;
    hair_test_ok(test, hair_context_create(&desc, &context));
    return context;
}

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

static struct hair_test_scene start(struct hair_test* test, struct cache* cache)
{
    struct hair_test_scene f = hair_test_scene_make(test, NULL);
    f.context = make_context(test, cache);
    hair_test_ok(test, create(&f, &f.hair));
    hair_test_frame_make(&f.frame, SIZE, SIZE, GL_RGBA32F, 0);
    return f;
}

static void draw(const struct hair_test_scene* f, const hair_view* view, float* pixels)
{
    hair_test_draw_in(&f->frame, f->test, f->hair, view, pixels);
}

// Programs ----------------------------------------------------------------------------------------

static void programs_are_compiled_on_first_use(void** state)
{
    static float pixels[VALUES];
    struct hair_test_scene f = hair_test_scene_make(*state, NULL);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION);
    const float head[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.1f, 1};
    f.context = make_context(f.test, NULL);
    assert_int_equal(hair_test_count_programs(&f.context->gl), 0);
    hair_test_ok(f.test, create(&f, &f.hair));
    // The instance is placed, solved and smoothed.
    assert_int_equal(hair_test_count_programs(&f.context->gl), 3);
    hair_test_frame_make(&f.frame, SIZE, SIZE, GL_RGBA32F, 0);
    hair_test_ok(f.test, hair_step(f.hair, 0.05f));
    assert_int_equal(hair_test_count_programs(&f.context->gl), 3);
    draw(&f, &view, pixels);
    assert_int_equal(hair_test_count_programs(&f.context->gl), 4);
    hair_test_ok(f.test, hair_teleport(f.hair, head));
    assert_int_equal(hair_test_count_programs(&f.context->gl), 5);
    view.pass = HAIR_PASS_GUIDES;
    draw(&f, &view, pixels);
    assert_int_equal(hair_test_count_programs(&f.context->gl), 6);
    view.pass = HAIR_PASS_COLLIDERS;
    draw(&f, &view, pixels);
    assert_int_equal(hair_test_count_programs(&f.context->gl), 7);
    hair_test_scene_free(&f);
}

static int has_binaries(void)
{
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (!formats) print_message("    this driver gives no programs away\n");
    return formats > 0;
}

static double now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void cached_programs_are_not_recompiled_and_draw_the_same(void** state)
{
    static float pixels[2][VALUES];
    struct cache cache = {0};
    uint32_t puts = 0;
    if (!has_binaries()) return;
    for (int run = 0; run < 2; ++run) {
        hair_test_trace_clear();
        double begin = now_ms();
        struct hair_test_scene f = start(*state, &cache);
        hair_view view = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION);
        hair_test_ok(f.test, hair_step(f.hair, 0.05f));
        draw(&f, &view, pixels[run]);
        print_message("    the first picture %s the cache after %.0f ms\n", run ? "with" : "without",
                      now_ms() - begin);
        assert_int_equal(hair_test_trace_count("glLinkProgram"), run ? 0 : cache.puts);
        assert_int_equal(hair_test_trace_count("glCompileShader") > 0, !run);
        if (!run) puts = cache.puts;
        assert_int_equal(cache.puts, puts);
        assert_int_equal(cache.count, puts);
        hair_test_scene_free(&f);
    }
    assert_true(puts >= 5); // Four programs and the self-test.
    assert_memory_equal(pixels[0], pixels[1], sizeof pixels[0]);
    empty(&cache);
}

// Link the program of the smallest shader, from the cache if possible. Return the number of links.
static uint32_t count_links(struct hair_gl* gl)
{
    GLuint program = 0;
    hair_test_trace_clear();
    hair_gl_enter(gl);
    assert_int_equal(hair_gl_link(gl, "activity", "sim/activity.comp", NULL, &program), HAIR_OK);
    hair_gl_leave(gl);
    assert_true(glIsProgram(program));
    glDeleteProgram(program);
    return hair_test_trace_count("glLinkProgram");
}

static void damaged_cache_entries_are_recompiled_and_replaced(void** state)
{
    struct cache cache = {0};
    hair_context* context = make_context(*state, &cache);
    uint32_t random = 5, before = cache.count;
    if (has_binaries()) {
        assert_int_equal(count_links(&context->gl), 1);
        assert_int_equal(count_links(&context->gl), 0);
        struct kept* kept = &cache.kept[before];
        size_t size = kept->size;
        for (uint32_t i = 0; i < FLIPS; ++i) {
            size_t at = i < 28 ? i : (size_t)(hair_random(&random) * (float)(size - 1));
            if (i >= 48) at = size - 1 - (i - 48);
            kept->bytes[at] ^= (unsigned char)(1u << i % 8);
            assert_int_equal(count_links(&context->gl), 1);
            assert_int_equal(count_links(&context->gl), 0);
        }
        const size_t sizes[] = {0, 1, 27, 28, 29, size / 2, size - 1};
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
            kept->size = sizes[i];
            assert_int_equal(count_links(&context->gl), 1);
            assert_int_equal(count_links(&context->gl), 0);
        }
        // The binary of another program, under the key of this one.
        kept->size = cache.kept[0].size < size ? cache.kept[0].size : size;
        memcpy(kept->bytes, cache.kept[0].bytes, kept->size);
        assert_int_equal(count_links(&context->gl), 1);
    }
    hair_context_destroy(context);
    empty(&cache);
}

static void a_cache_without_both_functions_is_refused(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    hair_cache cache = {get, NULL, NULL};
    desc.host = &test->host.host;
    desc.get_proc = hair_test_trace_proc;
    desc.cache = &cache;
    hair_test_refused(test, hair_context_create(&desc, &context), HAIR_ERROR_ARGUMENT,
                      "hair_cache.put is NULL");
    cache = (hair_cache){NULL, put, NULL};
    hair_test_refused(test, hair_context_create(&desc, &context), HAIR_ERROR_ARGUMENT,
                      "hair_cache.get is NULL");
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(programs_are_compiled_on_first_use),
        HAIR_TEST(cached_programs_are_not_recompiled_and_draw_the_same),
        HAIR_TEST(damaged_cache_entries_are_recompiled_and_replaced),
        HAIR_TEST(a_cache_without_both_functions_is_refused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
