// shader_test.c - shading by the application. It receives the documented inputs, errors have its
// line numbers, and no source text breaks anything.
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/live_hair.h"
#include "tests/support/tessellated.h"

#define SIDE 96

static struct hair_test_scene start(void** state)
{
    hair_look look = hair_look_default();
    look.strand.radius = 0.004f;
    look.shading.model = HAIR_SHADING_LINES;
    return hair_test_scene_of(*state, NULL, &look);
}

static hair_result make(struct hair_test_scene* f, const char* glsl, hair_shade_at at, hair_shader** out)
{
    hair_shader_desc desc = hair_shader_desc_default();
    desc.label = "mine";
    desc.glsl = glsl;
    desc.at = at;
    return hair_shader_create(f->test->context, &desc, out);
}

static hair_view view_of(hair_pass pass, hair_shader* shader)
{
    hair_view view = hair_test_tessellated();
    view.pass = pass;
    view.shader = shader;
    hair_test_set_orthographic(&view, 2, -0.5f, -0.2f);
    return view;
}

static void draw(const struct hair_test_scene* f, const hair_view* view, float* pixels)
{
    hair_test_draw(f, view, SIDE, SIDE, 0, pixels, NULL);
}

static void user_shader_that_calls_the_built_in_changes_nothing(void** state)
{
    static float plain[4 * SIDE * SIDE], own[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state);
    hair_shader* shader;
    hair_test_ok(f.test,
                 make(&f, "vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f), 1.0); }\n",
                      HAIR_SHADE_VERTICES, &shader));
    hair_view view = view_of(HAIR_PASS_COLOR, NULL);
    draw(&f, &view, plain);
    view.shader = shader;
    draw(&f, &view, own);
    double lit = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) lit += (double)plain[4 * i];
    assert_true(lit > 10);
    for (int i = 0; i < 4 * SIDE * SIDE; ++i) hair_test_near("value", (size_t)i, own[i], plain[i], 1e-6);
    hair_shader_destroy(shader);
    hair_test_scene_free(&f);
}

// Compare with the pass of indices, which gives the strand of each pixel.
static void pixel_shader_knows_strand_position_and_side(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    static uint32_t ids[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state);
    hair_shader* shader;
    hair_test_ok(
        f.test,
        make(&f,
             "vec4 hair_shade(hair_fragment f)\n{\n    return vec4(f.t + 1.0, f.strand + 1u, f.across + 2.0, "
             "f.lock + 1u);\n}\n",
             HAIR_SHADE_PIXELS, &shader));
    hair_view view = view_of(HAIR_PASS_COLOR, shader);
    draw(&f, &view, pixels);
    hair_test_draw_ids(f.test, f.hair, &view, SIDE, ids);
    uint32_t covered = 0, strands = 0, left = 0, right = 0, last = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const float* p = pixels + 4 * i;
        const uint32_t* id = ids + 4 * i;
        assert_true((p[1] > 0) == (id[0] > 0));
        if (!id[0]) continue;
        ++covered;
        assert_true((uint32_t)p[1] == id[0] && (uint32_t)p[3] == id[1]);
        assert_true(id[0] <= f.groom->info.follower_count && id[1] <= f.groom->info.guide_count);
        assert_int_equal(f.groom->followers[id[0] - 1].guide0, id[1] - 1);
        hair_test_near("place", (size_t)i, p[0] - 1, id[2] / 65535.0, 2e-5);
        assert_true(p[2] >= 1 && p[2] <= 3);
        left += p[2]<1.7f, right += p[2]> 2.3f;
        strands += id[0] != last;
        last = id[0];
    }
    print_message("    %u pixels of at least %u strands, %u to one side, %u to the other\n", covered, strands,
                  left, right);
    assert_true(covered > 150 && left > covered / 8 && right > covered / 8);
    hair_shader_destroy(shader);
    hair_test_scene_free(&f);
}

static void user_shader_has_lights_and_further_outputs(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state);
    hair_shader* shader;
    hair_test_ok(
        f.test,
        make(&f,
             "layout(location = 1) out vec4 mine_second;\n"
             "vec4 hair_shade(hair_fragment f)\n{\n"
             "    vec3 to, sum = vec3(0.0);\n"
             "    for (uint i = 0u; i < hair_lights(); ++i) sum += hair_light(f, i, to) * "
             "hair_light_through(f, i);\n"
             "    mine_second = vec4(to + 2.0, distance(hair_world(f), f.position) + hair_sky(f).x + 1.0);\n"
             "    return vec4(sum, 0.5);\n}\n",
             HAIR_SHADE_PIXELS, &shader));
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    GLuint second;
    static const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    static const float none[4] = {0};
    glCreateRenderbuffers(1, &second);
    glNamedRenderbufferStorage(second, GL_RGBA32F, SIDE, SIDE);
    glNamedFramebufferRenderbuffer(frame.framebuffer, GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, second);
    glNamedFramebufferDrawBuffers(frame.framebuffer, 2, both);
    glClearNamedFramebufferfv(frame.framebuffer, GL_COLOR, 1, none);
    hair_view view = view_of(HAIR_PASS_COLOR, shader);
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    uint32_t covered = 0;
    for (int target = 0; target < 2; ++target) {
        glNamedFramebufferReadBuffer(frame.framebuffer, both[target]);
        glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_FLOAT, pixels);
        for (int i = 0; i < SIDE * SIDE; ++i) {
            const float* p = pixels + 4 * i;
            if (p[3] == 0) continue;
            ++covered;
            if (target == 0) { // The default lights, without shadow.
                for (int k = 0; k < 3; ++k) hair_test_near("light", (size_t)k, p[k], 3, 1e-5);
                hair_test_near("alpha", 0, p[3], 0.5, 0);
            } else {
                double length = sqrt(0.4 * 0.4 + 0.8 * 0.8 + 0.45 * 0.45);
                hair_test_near("x", 0, p[0] - 2, 0.4 / length, 1e-5);
                hair_test_near("y", 0, p[1] - 2, 0.8 / length, 1e-5);
            }
        }
    }
    assert_true(covered > 300);
    hair_test_frame_free(&frame);
    glDeleteRenderbuffers(1, &second);
    hair_shader_destroy(shader);
    hair_test_scene_free(&f);
}

static void nonfinite_user_colors_are_drawn_black(void** state)
{
    static const char* const texts[] = {
        "vec4 hair_shade(hair_fragment f) { return vec4(-1.0, sqrt(f.t - 2.0), log(-1.0 - f.t), 1.0); }",
        "vec4 hair_shade(hair_fragment f) { return vec4(0.0 / (f.t - f.t), -1e30, -1.0 / (f.t - f.t), 1.0); "
        "}"};
    static float pixels[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state);
    for (int i = 0; i < 4; ++i) {
        hair_shader* shader;
        hair_test_ok(f.test,
                     make(&f, texts[i / 2], i % 2 ? HAIR_SHADE_PIXELS : HAIR_SHADE_VERTICES, &shader));
        hair_view view = view_of(HAIR_PASS_COLOR, shader);
        draw(&f, &view, pixels);
        for (int k = 0; k < SIDE * SIDE; ++k)
            for (int c = 0; c < 3; ++c) assert_true(pixels[4 * k + c] == 0);
        hair_shader_destroy(shader);
    }
    hair_test_scene_free(&f);
}

static void shader_errors_have_lines_of_the_users_text(void** state)
{
    struct hair_test_scene f = start(state);
    hair_shader* shader = NULL;
    hair_shader_desc desc = hair_shader_desc_default();
    hair_test_refused(f.test, hair_shader_create(f.test->context, &desc, &shader), HAIR_ERROR_ARGUMENT,
                      "hair_shader_desc.glsl is NULL");
    for (int at = 0; at < 2; ++at) {
        hair_result result =
            make(&f, "// A comment.\n\nvec4 hair_shade(hair_fragment f)\n{\n    return nonsense;\n}\n",
                 (hair_shade_at)at, &shader);
        print_message("    %s\n", f.test->host.sentence);
        hair_test_refused(f.test, result, HAIR_ERROR_OPENGL, "mine:5: ");
        result = make(&f, "float mine_only;\n", (hair_shade_at)at, &shader);
        print_message("    %s\n", f.test->host.sentence);
        hair_test_refused(f.test, result, HAIR_ERROR_OPENGL, "mine: ");
    }
    assert_null(shader);
    hair_test_scene_free(&f);
}

static void append(hair_log_level level, const char* sentence, void* user)
{
    static const char* const levels[] = {"error", "warning", "info"};
    size_t used = strlen(user);
    snprintf((char*)user + used, 8192 - used, "%s: %s\n", levels[level], sentence);
}

static void every_error_of_a_shader_has_a_line_in_the_log(void** state)
{
    static char log[8192];
    struct hair_test_scene f = start(state);
    hair_host host = {.log = append, .user = log};
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    hair_shader_desc wrong = hair_shader_desc_default();
    hair_shader* shader = NULL;
    desc.host = &host;
    desc.get_proc = hair_egl_get_proc;
    hair_test_ok(f.test, hair_context_create(&desc, &context));
    wrong.label = "mine";
    wrong.glsl = "vec4 hair_shade(hair_fragment f)\n{\n    float a = nonsense;\n    float b = rubbish;\n"
                 "    return vec4(a, b, 0.0, 1.0);\n}\n";
    assert_int_equal(hair_shader_create(context, &wrong, &shader), HAIR_ERROR_OPENGL);
    hair_context_destroy(context);
    print_message("%s", log);
    assert_non_null(strstr(log, "error: mine:3: "));
    assert_non_null(strstr(log, "info: mine:4: "));
    assert_non_null(strstr(log, "rubbish"));
    hair_test_scene_free(&f);
}

static void any_shader_text_is_refused_or_harmless(void** state)
{
    static const char* const texts[] = {
        "",
        "#endif\n#endif\n",
        "/* without an end",
        "#version 330\nvec4 hair_shade(hair_fragment f) { return vec4(1); }",
        "#include \"../../etc/passwd\"\n",
        "#include \"light/user_shader.glsl\"\n",
        "#include \"a_name_that_is_much_too_long_for_any_file_of_the_library.glsl\"\n",
        "}}}}\n{{{{",
        "#error no\n",
        "#line 1 4000000000\nnonsense",
        "#if 1\nvec4 hair_shade(hair_fragment f) { return vec4(1.0); }\n",
        "void main() {}\nvec4 hair_shade(hair_fragment f) { return vec4(1.0); }",
        "\xff\xfe\x01%s%n%d \\\n\\",
        "struct hair_fragment { int x; };"};
    static float before[4 * SIDE * SIDE], after[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state);
    hair_view view = view_of(HAIR_PASS_COLOR, NULL);
    draw(&f, &view, before);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        hair_shader* shader = NULL;
        hair_result result = make(&f, texts[i], i % 2 ? HAIR_SHADE_PIXELS : HAIR_SHADE_VERTICES, &shader);
        assert_true(result == HAIR_ERROR_OPENGL || (!result && shader));
        assert_true(result == HAIR_OK || !shader);
        hair_shader_destroy(shader);
        hair_test_forgive(f.test);
    }
    draw(&f, &view, after);
    assert_memory_equal(before, after, sizeof before);
    hair_test_scene_free(&f);
}

// Check a square scalp of 0.4 m whose texture coordinates are x and z. Roots have the coordinates
// of their positions.
static void roots_have_the_uvs_and_texture_of_the_scalp(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    struct hair_test_scene f = {.test = *state};
    struct hair_test_scalp scalp = hair_test_scalp_make(4, 0.4f);
    struct hair_test_strands guides = hair_test_strands_make(9, 4);
    for (int i = 0; i < 9; ++i) // The guides are slanted, so that strands are not seen end on.
        hair_test_add_straight(&guides, 4, hair_v3(0.1f * (float)(i % 3 + 1), 0, 0.1f * (float)(i / 3 + 1)),
                               hair_v3(0.3f, 1, 0), 0.1f);
    hair_groom_desc groom = hair_test_groom_desc(&f.test->host, &guides);
    float* uvs = malloc(2 * sizeof *uvs * scalp.vertex_count);
    for (uint32_t i = 0; i < scalp.vertex_count; ++i)
        for (size_t k = 0; k < 2; ++k) uvs[2 * i + k] = scalp.positions[3 * i + 2 * k] / 0.4f;
    hair_test_set_scalp(&groom, &scalp);
    groom.strand_set = HAIR_STRAND_SET_GUIDES;
    groom.follower_count = 200;
    groom.scalp_uvs = uvs;
    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    look.strand.radius = 0.004f, look.strays.tip_fraction = look.strays.fraction = 0, look.color.spread = 0;
    look.clump.interpolation = HAIR_INTERPOLATION_MULTI;
    desc.look = &look;
    hair_test_ok(f.test, hair_groom_create(&groom, &f.groom));
    hair_test_ok(f.test, hair_create(f.test->context, f.groom, &desc, &f.hair));
    hair_shader* shader;
    hair_test_ok(f.test,
                 make(&f, "vec4 hair_shade(hair_fragment f) { return vec4(f.uv + 1.0, 0.0, f.t + 1.0); }",
                      HAIR_SHADE_PIXELS, &shader));
    hair_view view = view_of(HAIR_PASS_COLOR, shader);
    memset(view.view, 0, sizeof view.view); // View from above, with x to the right and z down.
    view.view[0] = view.view[6] = view.view[15] = 1, view.view[9] = -1, view.view[14] = -0.5f;
    view.projection[13] = 0;
    draw(&f, &view, pixels);
    uint32_t covered = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const float* p = pixels + 4 * i;
        if (p[3] == 0 || p[3] > 1.2f) continue; // Only pixels near roots count.
        ++covered;
        double x = ((i % SIDE + 0.5) / SIDE - 0.5), z = -((i / SIDE + 0.5) / SIDE - 0.5);
        hair_test_near("u", (size_t)i, p[0] - 1, x / 0.4, 0.06);
        hair_test_near("v", (size_t)i, p[1] - 1, z / 0.4, 0.06);
    }
    print_message("    %u pixels near roots\n", covered);
    assert_true(covered > 50);

    // Half of the scalp has blue hair, and the hair of the other half reflects no light.
    static const unsigned char halves[] = {0, 0, 255, 255, 0, 0, 0, 255};
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, 2, 1);
    glTextureSubImage2D(texture, 0, 0, 0, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, halves);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    view.color_texture = texture;
    hair_shader_destroy(shader);
    hair_test_ok(f.test, make(&f, "vec4 hair_shade(hair_fragment f) { return vec4(f.color, f.uv.x + 1.0); }",
                              HAIR_SHADE_PIXELS, &shader));
    view.shader = shader;
    draw(&f, &view, pixels);
    uint32_t blue = 0, black = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const float* p = pixels + 4 * i;
        if (p[3] == 0 || fabsf(p[3] - 1.5f) < 0.01f) continue;
        assert_true(p[0] == 0 && p[1] == 0 && (p[2] > 0) == (p[3] < 1.5f));
        ++*(p[2] > 0 ? &blue : &black);
    }
    print_message("    %u blue pixels, %u black\n", blue, black);
    assert_true(blue > 30 && black > 30);
    view.shader = NULL;
    blue = 0;
    draw(&f, &view, pixels);
    for (int i = 0; i < SIDE * SIDE; ++i) blue += pixels[4 * i + 2] > 2 * pixels[4 * i];
    assert_true(blue > 30);
    view.color_texture = 4711;
    hair_test_refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT,
                      "hair_view.color_texture is 4711");
    glDeleteTextures(1, &texture);
    hair_shader_destroy(shader);
    hair_test_scene_free(&f);
    free(uvs);
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&guides);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(user_shader_that_calls_the_built_in_changes_nothing),
        HAIR_TEST(pixel_shader_knows_strand_position_and_side),
        HAIR_TEST(user_shader_has_lights_and_further_outputs),
        HAIR_TEST(roots_have_the_uvs_and_texture_of_the_scalp),
        HAIR_TEST(nonfinite_user_colors_are_drawn_black),
        HAIR_TEST(shader_errors_have_lines_of_the_users_text),
        HAIR_TEST(every_error_of_a_shader_has_a_line_in_the_log),
        HAIR_TEST(any_shader_text_is_refused_or_harmless),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
