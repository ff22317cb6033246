// accepted_test.c - haircut files that are accepted become hair that moves, collides, is drawn and
// saved with finite values, or are refused with a sentence that names a member.
//
// The environment variable HAIR_TEST_SEED selects other changes of the files.
#define _GNU_SOURCE
#include <hair/hair_asset.h>

#include "lib/base/bytes.h"
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"
#include "tests/support/seal.h"
#include "tests/support/ways.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_FILE 65536 // Maximum size of a file, bytes.
#define SIDE 16 // Width and height of pictures.
#define STEPS 4
#define MAX_RADIUS 0.01f // Maximum of hair_look.strand.radius, m.
#define KEPT 65536 // Number of haircuts whose hashes are kept.

struct run {
    struct hair_test* test;
    struct hair_test_frame frame;
    uint32_t random;
    uint64_t seen[KEPT]; // Hashes of haircuts that are done.
    uint32_t inputs, accepted, refused, haircuts, visible;
    char name[512]; // Name of the present input.
};

static uint32_t any(struct run* run, uint32_t count)
{
    run->random = run->random * 1664525u + 1013904223u;
    return (run->random >> 8) % count;
}

// Check that a call succeeded, or failed with a sentence that names a member. Return whether it
// succeeded.
static bool is_done(struct run* run, hair_result result)
{
    char sentence[sizeof run->test->host.sentence];
    memcpy(sentence, run->test->host.sentence, sizeof sentence);
    uint32_t logged = hair_test_forgive(run->test);
    if (result == HAIR_OK) {
        if (logged) fail_msg("%s: accepted, but: %s", run->name, sentence);
        return true;
    }
    bool is_named = result == HAIR_ERROR_ARGUMENT && (strstr(sentence, "desc.") || strstr(sentence, "hair_"));
    if (!is_named || logged != 1)
        fail_msg("%s: error %d, %u sentences: %s", run->name, result, logged, sentence);
    ++run->refused;
    return false;
}

static void check_finite(struct run* run, const char* what, const float* values, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (!isfinite(values[i]))
            fail_msg("%s: value %zu of %s is %g", run->name, i, what, (double)values[i]);
}

// Read positions, check them, and return them to be freed.
static float* read_positions(struct run* run, hair_instance* hair, hair_read_source source, const char* what)
{
    uint32_t count = 0;
    hair_test_ok(run->test, hair_read_positions(hair, source, NULL, 0, &count));
    float* at = malloc(12 * (size_t)count + 1);
    assert_non_null(at);
    hair_test_ok(run->test, hair_read_positions(hair, source, at, count, &count));
    check_finite(run, what, at, 3 * (size_t)count);
    return at;
}

// Return a radius of strands that shows them beside their length.
static float find_radius(const hair_groom* groom)
{
    return fminf(fmaxf(groom->info.length[1] / 30, 1e-6f), MAX_RADIUS);
}

// Draw the hair around the tip of its first guide, and check the pixels.
static void draw(struct run* run, hair_instance* hair, const hair_groom* groom, hair_render_path path)
{
    float pixels[4 * SIDE * SIDE], *at = read_positions(run, hair, HAIR_READ_GUIDES, "guides");
    hair_view view = hair_test_view_by(path);
    uint32_t tip = groom->guides[0].first + groom->guides[0].count - 1;
    float radius = 4 * find_radius(groom);
    hair_test_set_orthographic(&view, 1 / radius, 1e-3f / radius, 0);
    for (int i = 0; i < 3; ++i) view.view[12 + i] = -at[3 * tip + i];
    free(at);
    hair_test_draw_in(&run->frame, run->test, hair, &view, pixels);
    check_finite(run, "the picture", pixels, 4 * SIDE * SIDE);
    run->visible += hair_test_mean_alpha(pixels, 4 * SIDE * SIDE) > 0;
}

static void collide(struct run* run, hair_instance* hair)
{
    hair_collider collider = hair_collider_default();
    float lower[3], upper[3], radius = 0;
    hair_test_ok(run->test, hair_get_bounds(hair, lower, upper));
    for (int i = 0; i < 3; ++i) {
        collider.position[i] = lower[i] / 2 + upper[i] / 2 + 0.2f * (upper[i] - lower[i]);
        radius = fmaxf(radius, upper[i] / 2 - lower[i] / 2);
    }
    collider.size[0] = fminf(fmaxf(radius / 2, 1e-4f), 1e6f);
    hair_test_ok(run->test, hair_set_colliders(hair, &collider, 1, sizeof collider));
}

// Create, move, read, draw and save hair.
static void live(struct run* run, const hair_groom* groom)
{
    hair_desc desc = hair_test_way((int)(run->haircuts % HAIR_TEST_WAYS));
    hair_look look = hair_look_default();
    hair_instance* hair = NULL;
    look.strand.radius = find_radius(groom);
    look.strand.segments = 6;
    desc.look = &look;
    desc.field_voxel = fminf(fmaxf(groom->info.length[1] / 20, 0.0005f), 1);
    if (!is_done(run, hair_create(run->test->context, groom, &desc, &hair))) return;
    collide(run, hair);
    for (int i = 0; i < STEPS; ++i) hair_test_ok(run->test, hair_step(hair, 1.0f / 60));
    free(read_positions(run, hair, HAIR_READ_FOLLOWERS, "followers"));
    draw(run, hair, groom, hair_test_paths[run->haircuts % HAIR_TEST_PATHS]);
    size_t size = 0;
    hair_test_ok(run->test, hair_save(hair, NULL, 0, &size));
    void* bytes = malloc(size);
    assert_non_null(bytes);
    hair_test_ok(run->test, hair_save(hair, bytes, size, &size));
    hair_test_ok(run->test, hair_load(hair, bytes, size));
    free(bytes);
    hair_destroy(hair);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

// Return whether a haircut of these strands is done already. Remember it otherwise.
static bool is_known(struct run* run, const hair_asset* asset)
{
    hair_asset_info info = hair_asset_info_default();
    assert_int_equal(hair_asset_describe(asset, &info), HAIR_OK);
    uint64_t hash = hair_hash_bytes(HAIR_HASH_BEGIN, info.positions, 12 * (size_t)info.vertex_count);
    hash = hair_hash_bytes(hash, info.strand_vertices, 4 * (size_t)info.strand_count);
    for (uint32_t i = 0; i < run->haircuts; ++i)
        if (run->seen[i] == hash) return true;
    assert_true(run->haircuts < KEPT);
    run->seen[run->haircuts++] = hash;
    return false;
}

static void use(struct run* run, const hair_import* import, const unsigned char* bytes, size_t size)
{
    hair_asset_desc read = hair_asset_desc_default();
    hair_asset* asset = NULL;
    read.host = &run->test->host.host;
    read.import = import;
    ++run->inputs;
    if (hair_asset_read(&read, bytes, size, &asset)) {
        hair_test_forgive(run->test);
        return;
    }
    ++run->accepted;
    if (!is_known(run, asset)) {
        hair_groom_desc desc = hair_groom_desc_default();
        hair_groom* groom = NULL;
        desc.host = read.host;
        desc.guide_count = 8;
        desc.follower_count = 64;
        hair_test_ok(run->test, hair_asset_to_groom_desc(asset, &desc));
        if (is_done(run, hair_groom_create(&desc, &groom))) live(run, groom);
        hair_groom_destroy(groom);
    }
    hair_asset_destroy(asset);
}

// Use a file with the usual import, and with one that changes more.
static void use_both(struct run* run, const unsigned char* bytes, size_t size)
{
    static const float scales[] = {1, 0.01f, 1e6f, 1e-6f};
    static const uint32_t vertices[] = {0, 2, 4, 16, 256};
    hair_import other = hair_import_default();
    other.scale = scales[any(run, 4)];
    other.up = (hair_up)any(run, 3);
    other.tip_first = any(run, 2);
    other.strand_vertices = vertices[any(run, 5)];
    use(run, NULL, bytes, size);
    use(run, &other, bytes, size);
}

// Change a few numbers at any place of a file.
static void change(struct run* run, unsigned char* bytes, size_t size)
{
    static const float values[] = {0,      -0.0f, 1e-40f, 1e-20f, 1e-6f,   1e3f,
                                   999999, -1e6f, 1e20f,  NAN,    INFINITY};
    for (uint32_t i = 1 + any(run, 4); i > 0 && size >= 4; --i) {
        uint32_t at = any(run, (uint32_t)size - 3);
        float value = values[any(run, sizeof values / sizeof *values)];
        if (any(run, 2))
            memcpy(bytes + at / 4 * 4, &value, 4);
        else
            bytes[at] ^= (unsigned char)(1 << any(run, 8));
    }
}

static void use_files(struct run* run, const char* parser, uint32_t changes)
{
    static unsigned char bytes[MAX_FILE], changed[MAX_FILE];
    char pattern[128];
    glob_t files;
    snprintf(pattern, sizeof pattern, "tests/fuzz/corpus/%s/*", parser);
    assert_int_equal(glob(pattern, 0, NULL, &files), 0);
    for (size_t i = 0; i < files.gl_pathc; ++i) {
        FILE* file = fopen(files.gl_pathv[i], "rb");
        assert_non_null(file);
        size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        for (uint32_t k = 0; k <= changes; ++k) {
            snprintf(run->name, sizeof run->name, "%s, change %u", files.gl_pathv[i], k);
            memcpy(changed, bytes, size);
            if (k) change(run, changed, size), hair_test_seal(changed, size);
            use_both(run, changed, size);
        }
    }
    globfree(&files);
}

static void live_by(struct hair_test* test, const char* parser, uint32_t changes)
{
    static struct run run;
    const char* seed = getenv("HAIR_TEST_SEED");
    memset(&run, 0, sizeof run);
    run.test = test;
    run.random = seed ? (uint32_t)atoi(seed) : 1;
    hair_test_frame_make(&run.frame, SIDE, SIDE, GL_RGBA32F, 0);
    use_files(&run, parser, getenv("HAIR_TEST_FULL") ? 40 * changes : changes);
    hair_test_frame_free(&run.frame);
    print_message("    %u inputs, %u accepted, %u haircuts, %u refused, %u seen\n", run.inputs, run.accepted,
                  run.haircuts, run.refused, run.visible);
    assert_true(2 * run.visible > run.haircuts);
}

static void accepted_hair_files_live(void** state)
{
    live_by(*state, "hairfile", 1);
}

static void accepted_groom_files_live(void** state)
{
    live_by(*state, "groomfile", 1);
}

static void accepted_tfx_files_live(void** state)
{
    live_by(*state, "tfx", 1);
}

static void accepted_tfx_texts_live(void** state)
{
    live_by(*state, "tfx_text", 1);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(accepted_hair_files_live),
        HAIR_TEST(accepted_groom_files_live),
        HAIR_TEST(accepted_tfx_files_live),
        HAIR_TEST(accepted_tfx_texts_live),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
