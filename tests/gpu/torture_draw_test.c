// torture_draw_test.c - drawing with memory, objects and a driver that are refused at one site
// after the other. Each failure changes nothing, leaks nothing, and the next draw is right.
#include "tests/support/torture.h"

#include <stdlib.h>
#include <string.h>

// Features of a view beside its pass and path.
enum {
    LINES = 1,
    ALPHA = 2,
    LOD = 4,
    TEXTURED = 8,
    OCCLUDED = 16,
    STRANDS = 32, // HAIR_SELF_SHADOW_STRANDS
    SHADOW_MAP = 64,
    VERTEX_SHADER = 128,
    PIXEL_SHADER = 256,
    COLLIDED = 512,
    PREPASS = 1024,
    CHEAP = 2048, // HAIR_SHADING_LINES
    MULTISAMPLED = 4096,
    CACHED_PROGRAMS = 8192,
    CLOBBERED = 16384,
    AGAIN = 32768, // One view has been drawn before.
    SLICED = 65536
};

static const struct {
    const char* name;
    hair_pass pass;
    hair_render_path path;
    int features;
} views[] = {
    {"tessellated ribbons", HAIR_PASS_COLOR, HAIR_RENDER_PATH_TESSELLATION, 0},
    {"tessellated lines", HAIR_PASS_COLOR, HAIR_RENDER_PATH_TESSELLATION, LINES | CHEAP | CLOBBERED},
    {"procedural", HAIR_PASS_COLOR, HAIR_RENDER_PATH_PROCEDURAL, CACHED_PROGRAMS},
    {"cached", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, 0},
    {"cached lines with levels", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, LINES | LOD},
    {"computed", HAIR_PASS_COLOR, HAIR_RENDER_PATH_COMPUTE, MULTISAMPLED},
    {"computed with levels", HAIR_PASS_COLOR, HAIR_RENDER_PATH_COMPUTE, LOD | CACHED_PROGRAMS},
    {"sorted", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, ALPHA},
    {"textured", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, TEXTURED},
    {"occluded", HAIR_PASS_COLOR, HAIR_RENDER_PATH_TESSELLATION, OCCLUDED},
    {"occluded and computed", HAIR_PASS_COLOR, HAIR_RENDER_PATH_COMPUTE, OCCLUDED | LOD},
    {"shadow by depth", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, SHADOW_MAP | CHEAP},
    {"shadow by strands", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, STRANDS | SHADOW_MAP | CHEAP},
    {"shadow by strands, tessellated", HAIR_PASS_COLOR, HAIR_RENDER_PATH_TESSELLATION, STRANDS | COLLIDED},
    {"own vertex shader", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, VERTEX_SHADER},
    {"own pixel shader", HAIR_PASS_COLOR, HAIR_RENDER_PATH_TESSELLATION, PIXEL_SHADER | TEXTURED},
    {"own shader, computed", HAIR_PASS_COLOR, HAIR_RENDER_PATH_COMPUTE, VERTEX_SHADER | LOD},
    {"pushed out", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, COLLIDED | CHEAP},
    {"pushed out by prepass", HAIR_PASS_COLOR, HAIR_RENDER_PATH_TESSELLATION, COLLIDED | PREPASS | CHEAP},
    {"depth", HAIR_PASS_DEPTH, HAIR_RENDER_PATH_TESSELLATION, 0},
    {"depth, computed", HAIR_PASS_DEPTH, HAIR_RENDER_PATH_COMPUTE, CLOBBERED},
    {"opacity", HAIR_PASS_OPACITY, HAIR_RENDER_PATH_CACHED, 0},
    {"indices", HAIR_PASS_ID, HAIR_RENDER_PATH_CACHED, 0},
    {"motion", HAIR_PASS_MOTION, HAIR_RENDER_PATH_CACHED, 0},
    {"motion, second frame", HAIR_PASS_MOTION, HAIR_RENDER_PATH_CACHED, AGAIN | COLLIDED},
    {"more segments", HAIR_PASS_COLOR, HAIR_RENDER_PATH_CACHED, ALPHA | AGAIN | STRANDS},
    {"more segments, computed", HAIR_PASS_COLOR, HAIR_RENDER_PATH_COMPUTE, AGAIN | LOD},
    {"guides", HAIR_PASS_GUIDES, HAIR_RENDER_PATH_TESSELLATION, 0},
    {"colliders", HAIR_PASS_COLLIDERS, HAIR_RENDER_PATH_TESSELLATION, COLLIDED | SLICED},
    {"wind", HAIR_PASS_WIND, HAIR_RENDER_PATH_TESSELLATION, 0},
};

static hair_result draw(struct hair_test_torture* t)
{
    return hair_draw(t->hair, &t->view);
}

static void make_texture(GLuint* texture, GLenum format, GLsizei size)
{
    glCreateTextures(GL_TEXTURE_2D, 1, texture);
    glTextureStorage2D(*texture, 1, format, size, size);
    glTextureParameteri(*texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
}

static void make_textures(struct hair_test_torture* t, int features)
{
    static const float middle = 0.5f, before = 0.1f, color[4] = {0.9f, 0.5f, 0.2f, 1};
    make_texture(&t->texture[0], GL_RGBA32F, 2);
    make_texture(&t->texture[1], GL_DEPTH_COMPONENT32F, 16);
    make_texture(&t->texture[2], GL_DEPTH_COMPONENT32F, 32);
    glClearTexImage(t->texture[0], 0, GL_RGBA, GL_FLOAT, color);
    glClearTexImage(t->texture[1], 0, GL_DEPTH_COMPONENT, GL_FLOAT, &middle);
    glClearTexImage(t->texture[2], 0, GL_DEPTH_COMPONENT, GL_FLOAT, NULL);
    glClearTexSubImage(t->texture[2], 0, 0, 0, 0, 16, 32, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &before);
    if (features & TEXTURED) t->view.color_texture = t->texture[0];
    if (features & OCCLUDED) t->view.occluder_depth = t->texture[2];
    t->light = hair_light_default();
    if (!(features & SHADOW_MAP)) return;
    t->light.hair_shadow_map = t->light.opaque_shadow_map = t->texture[1];
    t->view.lights = &t->light;
}

static void make_shader(struct hair_test_torture* t, int features)
{
    hair_shader_desc desc = hair_shader_desc_default();
    desc.glsl =
        "vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f) + f.color, 0.5 + f.uv.x); }";
    desc.at = features & PIXEL_SHADER ? HAIR_SHADE_PIXELS : HAIR_SHADE_VERTICES;
    hair_test_ok(t->test, hair_shader_create(t->context, &desc, &t->shader));
    t->view.shader = t->shader;
}

static void set_wind(struct hair_test_torture* t)
{
    hair_wind wind = hair_wind_default();
    wind.model = HAIR_WIND_FLUID;
    wind.velocity[0] = 2;
    wind.fluid.resolution = 16;
    hair_test_ok(t->test, hair_set_wind(t->hair, &wind));
}

static void make_view(struct hair_test_torture* t, int features)
{
    t->view = hair_test_torture_view();
    t->view.pass = views[t->variant].pass;
    t->view.render_path = views[t->variant].path;
    t->view.primitive = features & LINES ? HAIR_PRIMITIVE_LINES : HAIR_PRIMITIVE_RIBBONS;
    t->view.coverage = features & ALPHA ? HAIR_COVERAGE_ALPHA : HAIR_COVERAGE_MSAA;
    t->view.slice = features & SLICED ? HAIR_SLICE_Y : HAIR_SLICE_NONE;
    t->lod = hair_lod_default();
    t->lod.strand_fraction = 0.6f;
    if (features & LOD) t->view.lod = &t->lod;
    if (features & (VERTEX_SHADER | PIXEL_SHADER)) make_shader(t, features);
    make_textures(t, features);
}

static void start(struct hair_test_torture* t)
{
    int features = views[t->variant].features;
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    look.strand.segments = 6, look.strand.radius = 0.003f;
    if (features & STRANDS) look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    if (features & CHEAP) look.shading.model = HAIR_SHADING_LINES;
    if (features & PREPASS) desc.hit_method = HAIR_HIT_METHOD_PREPASS;
    desc.look = &look;
    hair_test_torture_add(t, &desc);
    make_view(t, features);
    if (t->view.pass == HAIR_PASS_WIND) set_wind(t);
    if (features & COLLIDED) hair_test_torture_collide(t);
    hair_test_ok(t->test, hair_step(t->hair, 1.0f / 60));
    if (!(features & AGAIN)) return;
    t->view.frame_index = 1;
    hair_test_ok(t->test, draw(t));
    if (t->view.pass != HAIR_PASS_MOTION) look.strand.segments = 9;
    hair_test_ok(t->test, hair_set_look(t->hair, &look));
    hair_test_ok(t->test, hair_step(t->hair, 1.0f / 60));
    t->view.frame_index = 2;
    memcpy(t->view.prev_view, t->view.view, sizeof t->view.view);
    memcpy(t->view.prev_projection, t->view.projection, sizeof t->view.projection);
}

static void finish(struct hair_test_torture* t)
{
    glDeleteTextures(3, t->texture);
}

static void refused_draws_change_and_leak_nothing(void** state)
{
    const char* only = getenv("HAIR_TEST_ONLY");
    for (int i = 0; i < (int)(sizeof views / sizeof *views); ++i) {
        int features = views[i].features;
        struct hair_test_torture t = {.test = *state,
                                      .name = views[i].name,
                                      .variant = i,
                                      .is_cached = (features & CACHED_PROGRAMS) != 0,
                                      .has_clobbered_state = (features & CLOBBERED) != 0,
                                      .tolerance = features & ALPHA ? 0.05f : 0,
                                      .samples = features & MULTISAMPLED ? 4 : 0,
                                      .start = start,
                                      .call = draw,
                                      .finish = finish};
        if (views[i].pass == HAIR_PASS_ID) t.format = GL_RGBA32UI;
        if (only && strcmp(only, t.name) != 0) continue;
        hair_test_torture_run(&t);
    }
    hair_test_torture_tell(only ? 0 : 300);
}

static const struct {
    const char* name;
    hair_read_source source;
    uint32_t attributes;
    int features;
} buffers[] = {
    {"buffers of followers", HAIR_READ_FOLLOWERS, 127, 0},
    {"buffers of followers that collide", HAIR_READ_FOLLOWERS, 127, COLLIDED},
    {"buffers of more segments", HAIR_READ_FOLLOWERS, 127, AGAIN},
    {"buffers of guides", HAIR_READ_SMOOTH,
     HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_TANGENT | HAIR_ATTRIBUTE_STRAND | HAIR_ATTRIBUTE_PREV_POSITION,
     0},
};

static hair_result get_buffers(struct hair_test_torture* t)
{
    hair_buffers out = hair_buffers_default();
    out.attributes = buffers[t->variant].attributes;
    HAIR_TRY(hair_get_buffers(t->hair, buffers[t->variant].source, &out));
    assert_true(out.position.buffer && out.tangent.buffer && out.strand.buffer && out.prev_position.buffer);
    assert_int_equal(out.position.count, out.strand_count * out.strand_vertices);
    return draw(t);
}

static void start_buffers(struct hair_test_torture* t)
{
    int features = buffers[t->variant].features;
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    look.strand.segments = 6, look.strand.radius = 0.003f;
    look.shading.model = HAIR_SHADING_LINES;
    desc.look = &look;
    hair_test_torture_add(t, &desc);
    t->view = hair_test_torture_view();
    t->view.render_path = HAIR_RENDER_PATH_CACHED;
    if (features & COLLIDED) hair_test_torture_collide(t);
    hair_test_ok(t->test, hair_step(t->hair, 1.0f / 60));
    if (!(features & AGAIN)) return;
    hair_test_ok(t->test, get_buffers(t));
    look.strand.segments = 9;
    hair_test_ok(t->test, hair_set_look(t->hair, &look));
    hair_test_ok(t->test, hair_step(t->hair, 1.0f / 60));
}

static void refused_buffers_change_and_leak_nothing(void** state)
{
    if (getenv("HAIR_TEST_ONLY")) return;
    for (int i = 0; i < (int)(sizeof buffers / sizeof *buffers); ++i) {
        struct hair_test_torture t = {.test = *state,
                                      .name = buffers[i].name,
                                      .variant = i,
                                      .start = start_buffers,
                                      .call = get_buffers};
        hair_test_torture_run(&t);
    }
    hair_test_torture_tell(40);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(refused_buffers_change_and_leak_nothing),
                                       HAIR_TEST(refused_draws_change_and_leak_nothing)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
