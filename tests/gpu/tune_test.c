// tune_test.c - hair_context_tune() measures paths, and hair_context_set_tuning() takes no other
// text.
#include <stdio.h>
#include <string.h>

#include "tests/support/scene.h"

#define SIDE 32

static hair_render_path auto_path(const struct hair_test_scene* scene, hair_primitive primitive)
{
    hair_view view = hair_view_default();
    view.primitive = primitive;
    return hair_test_path_of(&scene->hair->renderer, &view);
}

// Replace a word of a text.
static void replace(char* text, const char* word, const char* by)
{
    char rest[HAIR_TUNING_SIZE];
    char* at = strstr(text, word);
    assert_non_null(at);
    snprintf(rest, sizeof rest, "%s", at + strlen(word));
    snprintf(at, HAIR_TUNING_SIZE - (size_t)(at - text), "%s%s", by, rest);
}

// Set the text with a word replaced.
static void set_with(const struct hair_test_scene* scene, const char* tuning, const char* word,
                     const char* by)
{
    char text[HAIR_TUNING_SIZE];
    snprintf(text, sizeof text, "%s", tuning);
    replace(text, word, by);
    hair_test_ok(scene->test, hair_context_set_tuning(scene->test->context, text));
}

static void refuse(const struct hair_test_scene* scene, const char* text, const char* words)
{
    hair_test_refused(scene->test, hair_context_set_tuning(scene->test->context, text), HAIR_ERROR_ARGUMENT,
                      words);
}

static void refuse_with(const struct hair_test_scene* scene, const char* tuning, const char* word,
                        const char* by, const char* words)
{
    char text[HAIR_TUNING_SIZE];
    snprintf(text, sizeof text, "%s", tuning);
    replace(text, word, by);
    refuse(scene, text, words);
}

// Return the path that a tuning has for a use, as text.
static const char* path_of(const char* tuning, const char* use)
{
    const char* at = strstr(tuning, use);
    assert_non_null(at);
    return at + strlen(use);
}

static void check_texts(const struct hair_test_scene* scene, const char* tuning)
{
    char text[HAIR_TUNING_SIZE + 1]; // with a space
    size_t size = strlen(tuning);
    for (size_t i = 0; i < size; ++i) {
        memcpy(text, tuning, i);
        text[i] = 0;
        refuse(scene, text, "the tuning is");
        snprintf(text, sizeof text, "%s", tuning);
        text[i] = (char)(text[i] == '\x80' ? 'x' : '\x80');
        refuse(scene, text, "the tuning is");
    }
    snprintf(text, sizeof text, "%s ", tuning);
    refuse(scene, text, "should be the end");
    // Another driver has another key.
    snprintf(text, sizeof text, "%s", tuning);
    text[strlen("hair-paths 1 ")] = (char)(text[strlen("hair-paths 1 ")] == '0' ? '1' : '0');
    refuse(scene, text, "another driver");
    refuse_with(scene, tuning, "hair-paths 1", "hair-paths 2", "character 0");
    const char* lines = path_of(tuning, " lines=");
    char word[64], by[64];
    snprintf(word, sizeof word, " lines=%.*s", (int)strcspn(lines, " "), lines);
    snprintf(by, sizeof by, " lines=%s", "compute");
    refuse_with(scene, tuning, word, by, "a path for this use");
    refuse_with(scene, tuning, word, " lines=procedural", "a path for this use");
    refuse_with(scene, tuning, word, " lines=auto", "a path for this use");
}

// Set each path that ribbons may have, and draw by it.
static void check_paths(const struct hair_test_scene* scene, const char* tuning)
{
    static const char* const names[] = {"tessellation", "cached", "compute"};
    const char* ribbons = path_of(tuning, " ribbons=");
    char word[64], by[64];
    snprintf(word, sizeof word, " ribbons=%.*s", (int)strcspn(ribbons, " "), ribbons);
    for (int i = 0; i < 3; ++i) {
        snprintf(by, sizeof by, " ribbons=%s", names[i]);
        set_with(scene, tuning, word, by);
        assert_int_equal(auto_path(scene, HAIR_PRIMITIVE_RIBBONS), i);
    }
}

static void tuning_is_kept_as_text_and_no_other_text_is_taken(void** state)
{
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
    hair_context* context = scene.test->context;
    char tuning[HAIR_TUNING_SIZE], again[HAIR_TUNING_SIZE];
    GLint bound = 0, viewport[4], box[4];
    hair_test_frame_make(&scene.frame, SIDE, SIDE, GL_RGBA8, 0);
    hair_render_path usual = auto_path(&scene, HAIR_PRIMITIVE_RIBBONS);
    glEnable(GL_SCISSOR_TEST);
    glScissor(1, 2, 3, 4);
    glDepthMask(GL_FALSE);
    glDisable(GL_DEPTH_TEST);
    uint32_t objects = hair_test_count_objects();
    hair_test_ok(scene.test, hair_context_tune(context, tuning, sizeof tuning));
    print_message("    %s\n", tuning);
    // Programs of the paths stay in the context.
    assert_true(hair_test_count_objects() >= objects);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    glGetIntegerv(GL_VIEWPORT, viewport);
    glGetIntegerv(GL_SCISSOR_BOX, box);
    assert_int_equal(bound, scene.frame.framebuffer);
    assert_true(viewport[2] == SIDE && viewport[3] == SIDE && box[0] == 1 && box[3] == 4);
    assert_true(glIsEnabled(GL_SCISSOR_TEST) && !glIsEnabled(GL_DEPTH_TEST));
    glGetIntegerv(GL_DEPTH_WRITEMASK, &bound);
    assert_false(bound);
    glDepthMask(GL_TRUE), glEnable(GL_DEPTH_TEST), glDisable(GL_SCISSOR_TEST);

    check_texts(&scene, tuning);
    check_paths(&scene, tuning);
    hair_test_ok(scene.test, hair_context_set_tuning(context, NULL));
    assert_int_equal(auto_path(&scene, HAIR_PRIMITIVE_RIBBONS), usual);
    hair_test_refused(scene.test, hair_context_tune(context, again, HAIR_TUNING_SIZE - 1),
                      HAIR_ERROR_ARGUMENT, "capacity is 255");
    hair_test_refused(scene.test, hair_context_tune(context, NULL, sizeof again), HAIR_ERROR_ARGUMENT, "out");
    hair_memory memory = hair_memory_default();
    hair_test_ok(scene.test, hair_get_memory(context, &memory));
    hair_test_ok(scene.test, hair_set_memory_limit(context, memory.bytes + 4096));
    hair_test_refused(scene.test, hair_context_tune(context, again, sizeof again), HAIR_ERROR_MEMORY,
                      "beyond the limit");
    hair_test_ok(scene.test, hair_set_memory_limit(context, 0));
    assert_int_equal(auto_path(&scene, HAIR_PRIMITIVE_RIBBONS), usual);
    hair_test_scene_free(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(tuning_is_kept_as_text_and_no_other_text_is_taken)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
