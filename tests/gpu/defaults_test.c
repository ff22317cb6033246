// defaults_test.c - the library's own defaults give no reason to log anything.
#include "tests/support/support.h"

#include <hair/hair_asset.h>
#include <stdio.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"

// A host that keeps its log.
struct log {
    uint32_t sentences;
    char last[512];
};

static void keep(hair_log_level level, const char* sentence, void* user)
{
    struct log* log = user;
    (void)level;
    ++log->sentences;
    snprintf(log->last, sizeof log->last, "%s", sentence);
}

static void use_style(struct hair_test* test, hair_context* context, const hair_host* host, hair_style style)
{
    hair_style_desc of = hair_style_desc_default();
    hair_groom_desc groom_desc = hair_groom_desc_default();
    hair_desc desc = hair_desc_default();
    hair_view view = hair_view_default();
    hair_asset* asset = NULL;
    hair_groom* groom = NULL;
    hair_instance* hair = NULL;
    of.style = style;
    of.host = groom_desc.host = host;
    hair_test_ok(test, hair_asset_generate(&of, &asset));
    hair_test_ok(test, hair_asset_to_groom_desc(asset, &groom_desc));
    hair_test_ok(test, hair_groom_create(&groom_desc, &groom));
    hair_test_ok(test, hair_create(context, groom, &desc, &hair));
    for (int i = 0; i < 3; ++i) hair_test_ok(test, hair_step(hair, 1.0f / 60));
    hair_test_ok(test, hair_draw(hair, &view));
    hair_destroy(hair);
    hair_groom_destroy(groom);
    hair_asset_destroy(asset);
}

static void default_haircuts_log_nothing(void** state)
{
    struct hair_test* test = *state;
    struct log log = {0};
    hair_host host = {NULL, NULL, keep, &log};
    hair_context_desc desc = hair_context_desc_default();
    hair_context* context = NULL;
    struct hair_test_frame frame;
    desc.host = &host;
    desc.get_proc = hair_egl_get_proc;
    hair_test_ok(test, hair_context_create(&desc, &context));
    hair_test_frame_make(&frame, 16, 16, GL_RGBA8, 0);
    log.sentences = 0; // The driver may have had a sentence.
    for (int style = 0; style < HAIR_STYLE_COUNT; ++style) {
        use_style(test, context, &host, (hair_style)style);
        if (log.sentences) fail_msg("%s: %s", hair_style_name((hair_style)style), log.last);
    }
    hair_test_frame_free(&frame);
    hair_context_destroy(context);
}

// The log is kept: settings that need it do have a sentence.
static void long_frames_are_logged(void** state)
{
    struct hair_test* test = *state;
    struct log log = {0};
    hair_host host = {NULL, NULL, keep, &log};
    hair_context_desc desc = hair_context_desc_default();
    hair_context* context = NULL;
    hair_groom_desc groom_desc = hair_groom_desc_default();
    hair_desc usual = hair_desc_default();
    hair_groom* groom = NULL;
    hair_instance* hair = NULL;
    static const float strand[] = {0, 1.7f, 0, 0, 1.6f, 0.02f, 0, 1.5f, 0.02f};
    static const uint32_t sizes[] = {3};
    desc.host = groom_desc.host = &host;
    desc.get_proc = hair_egl_get_proc;
    groom_desc.positions = strand;
    groom_desc.strand_vertices = sizes;
    groom_desc.strand_count = 1;
    hair_test_ok(test, hair_context_create(&desc, &context));
    hair_test_ok(test, hair_groom_create(&groom_desc, &groom));
    hair_test_ok(test, hair_create(context, groom, &usual, &hair));
    hair_test_ok(test, hair_step(hair, 0.5f));
    assert_non_null(strstr(log.last, "beyond max_dt"));
    hair_destroy(hair);
    hair_groom_destroy(groom);
    hair_context_destroy(context);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(default_haircuts_log_nothing),
        HAIR_TEST(long_frames_are_logged),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
