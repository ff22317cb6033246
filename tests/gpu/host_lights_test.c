// host_lights_test.c - lights in storage buffers of the application, which its shader reads. The
// built-in shading of such a light is that of the same light in hair_view.lights.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <string.h>

#define SIDE 48
#define VALUES (4 * SIDE * SIDE)
#define LIGHTS 12u

// One light in the storage buffer at 8. The buffer at 9 lists the lights to use.
struct host_light {
    float position[3], source_radius, color[3], unused;
};

static const char text[] =
    "struct mine_light { vec4 place, color; };\n"
    "layout(std430, binding = 8) readonly buffer mine_lights { mine_light mine_light_of[]; };\n"
    "layout(std430, binding = 9) readonly buffer mine_list { uint mine_number[]; };\n"
    "vec4 hair_shade(hair_fragment f)\n{\n"
    "    vec3 sum = vec3(0.0);\n"
    "    for (int i = 0; i < mine_number.length(); ++i) {\n"
    "        mine_light light = mine_light_of[mine_number[i]];\n"
    "        vec3 way = light.place.xyz - hair_world(f);\n"
    "        float square = dot(way, way);\n"
    "        vec3 irradiance = light.color.rgb / max(square, light.place.w * light.place.w);\n"
    "        sum += hair_reflect(f, way * inversesqrt(square), irradiance, 1.0);\n"
    "    }\n"
    "    return vec4(sum, 1.0);\n}\n";

static struct hair_test_scene start(void** state, hair_shading model)
{
    hair_look look = hair_look_default();
    look.strand.radius = 0.004f;
    look.shading.model = model;
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    hair_test_set_orthographic(&scene.view, 2, -0.5f, -0.2f);
    for (int i = 0; i < 3; ++i) scene.view.ambient[i] = 0;
    return scene;
}

static hair_shader* make_shader(struct hair_test_scene* scene, const char* glsl, hair_shade_at at)
{
    hair_shader* shader = NULL;
    hair_shader_desc desc = hair_shader_desc_default();
    desc.glsl = glsl;
    desc.at = at;
    hair_test_ok(scene->test, hair_shader_create(scene->test->context, &desc, &shader));
    return shader;
}

// Place lights around the head. The second half is not listed, and would be bright.
static void place_lights(struct host_light* own, hair_light* lights)
{
    for (uint32_t i = 0; i < LIGHTS; ++i) {
        const float at[3] = {(float)(i % 3) - 1, 0.5f * (float)(i % 2), 0.4f + 0.3f * (float)(i % 4)};
        const float color[3] = {i < LIGHTS / 2 ? 0.1f * (float)(1 + i) : 1000, 0.3f, 0.2f};
        own[i] = (struct host_light){.source_radius = 0.05f};
        lights[i] = hair_light_default();
        lights[i].kind = HAIR_LIGHT_POINT;
        memcpy(own[i].position, at, sizeof at);
        memcpy(own[i].color, color, sizeof color);
        memcpy(lights[i].position, at, sizeof at);
        memcpy(lights[i].color, color, sizeof color);
    }
}

static void lights_in_storage_buffers_shade_like_those_of_the_view(void** state)
{
    static float expected[VALUES], pixels[VALUES];
    struct host_light own[LIGHTS];
    hair_light lights[LIGHTS];
    GLuint buffers[2];
    uint32_t list[LIGHTS / 2];
    for (uint32_t i = 0; i < LIGHTS / 2; ++i) list[i] = i;
    place_lights(own, lights);
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], sizeof own, own, 0);
    glNamedBufferStorage(buffers[1], sizeof list, list, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 8, 2, buffers);
    for (int model = HAIR_SHADING_FIBRES; model <= HAIR_SHADING_LINES; ++model) {
        struct hair_test_scene scene = start(state, (hair_shading)model);
        hair_view* view = &scene.view;
        hair_shader* ours = make_shader(
            &scene, "vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f), 1.0); }\n",
            HAIR_SHADE_PIXELS);
        hair_shader* mine = make_shader(&scene, text, HAIR_SHADE_PIXELS);
        for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
            view->render_path = hair_test_paths[path];
            view->shader = ours, view->lights = lights, view->light_count = LIGHTS / 2;
            hair_test_draw(&scene, view, SIDE, SIDE, 0, expected, NULL);
            view->shader = mine, view->lights = NULL, view->light_count = 0;
            hair_test_draw(&scene, view, SIDE, SIDE, 0, pixels, NULL);
            float bright = 0;
            for (int i = 0; i < VALUES; i += 4) bright = pixels[i] > bright ? pixels[i] : bright;
            assert_true(bright > 0.05f && bright < 100);
            for (size_t i = 0; i < VALUES; ++i)
                hair_test_near("value", i, (double)pixels[i], (double)expected[i], 1e-4);
        }
        hair_shader_destroy(ours);
        hair_shader_destroy(mine);
        hair_test_scene_free(&scene);
    }
    glDeleteBuffers(2, buffers);
}

// Per vertex, sum up the lights of the view by hair_reflect, behind hair that each lets through.
static void reflected_lights_are_those_of_the_built_in_shading(void** state)
{
    static float expected[VALUES], pixels[VALUES];
    static const char sum[] = "vec4 hair_shade(hair_fragment f)\n{\n"
                              "    vec3 to, sum = vec3(0.0);\n"
                              "    for (uint i = 0u; i < hair_lights(); ++i) {\n"
                              "        vec3 irradiance = hair_light(f, i, to);\n"
                              "        sum += hair_reflect(f, to, irradiance, hair_light_through(f, i));\n"
                              "    }\n"
                              "    return vec4(sum, 1.0);\n}\n";
    for (int model = HAIR_SHADING_FIBRES; model <= HAIR_SHADING_LINES; ++model) {
        struct hair_test_scene scene = start(state, (hair_shading)model);
        hair_view* view = &scene.view;
        view->render_path = HAIR_RENDER_PATH_CACHED;
        hair_test_draw(&scene, view, SIDE, SIDE, 0, expected, NULL);
        view->shader = make_shader(&scene, sum, HAIR_SHADE_VERTICES);
        hair_test_draw(&scene, view, SIDE, SIDE, 0, pixels, NULL);
        uint32_t lit = 0;
        for (size_t i = 0; i < VALUES; ++i) {
            lit += i % 4 < 3 && pixels[i] > 0.02f;
            hair_test_near("value", i, (double)pixels[i], (double)expected[i], 1e-3);
        }
        print_message("    %u lit values\n", lit);
        assert_true(lit > 40);
        hair_shader_destroy(view->shader);
        hair_test_scene_free(&scene);
    }
}

// A light behind hair is darker, and the sky is as open as hair_sky_through() tells.
static void hidden_lights_and_skies_are_darker(void** state)
{
    static float pixels[VALUES];
    struct hair_test_scene scene = start(state, HAIR_SHADING_LINES);
    hair_look look = scene.hair->geometry.look;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    hair_test_ok(scene.test, hair_set_look(scene.hair, &look));
    scene.view.shader = make_shader(
        &scene,
        "vec4 hair_shade(hair_fragment f)\n{\n"
        "    vec3 to = normalize(vec3(0.2, 1.0, 0.3)), one = vec3(1.0);\n"
        "    float full = hair_reflect(f, to, one, 1.0).x, half_ = hair_reflect(f, to, one, 0.5).x;\n"
        "    return vec4(half_ / max(full, 1e-6), hair_sky_through(f), 1.0, 1.0);\n}\n",
        HAIR_SHADE_VERTICES);
    hair_test_draw(&scene, &scene.view, SIDE, SIDE, 0, pixels, NULL);
    float least = 1, most = 0;
    for (int i = 0; i < VALUES; i += 4) {
        if (pixels[i + 2] < 0.999f) continue;
        hair_test_near("half of a light", (size_t)i, (double)pixels[i], 0.5, 2e-3);
        least = pixels[i + 1] < least ? pixels[i + 1] : least;
        most = pixels[i + 1] > most ? pixels[i + 1] : most;
    }
    print_message("    %.3f to %.3f of the sky\n", (double)least, (double)most);
    assert_true(least > 0 && least < 0.9f * most && most <= 1.001f);
    hair_shader_destroy(scene.view.shader);
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(lights_in_storage_buffers_shade_like_those_of_the_view),
        HAIR_TEST(reflected_lights_are_those_of_the_built_in_shading),
        HAIR_TEST(hidden_lights_and_skies_are_darker),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
