// own_shader.c - Shading of hair by GLSL of the application. A band of light crosses the strands.
// The tips have a colour of their own.
//
//     own_shader [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_egl.h>

// The uniform block. Bindings from 8 on belong to the application.
struct glow {
    float tip_color[4]; // reflectance
    float radiance[3];
    float place; // on the strand, from 0 at the root to 1 at the tip
};

static const char shader_text[] =
    "layout(std140, binding = 8) uniform example_block {\n"
    "    vec4 example_tip_color;\n"
    "    vec4 example_glow;\n"
    "};\n"
    "vec4 hair_shade(hair_fragment f)\n"
    "{\n"
    "    f.color = mix(f.color, example_tip_color.rgb, smoothstep(0.3, 0.9, f.t + 0.2 * f.random));\n"
    "    float away = abs(f.t - example_glow.w - 0.06 * f.random);\n"
    "    return vec4(hair_shade_ours(f) + smoothstep(0.10, 0.0, away) * example_glow.rgb, 1.0);\n"
    "}\n";

static hair_instance* make_hair(hair_context* context)
{
    hair_instance* hair;
    hair_groom* groom = make_groom(HAIR_STYLE_LONG, 6000);
    hair_look look = hair_look_default();
    look.strand.radius = 3e-4f; // 6000 strands stand for 100000.
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

int main(int argc, char** argv)
{
    hair_egl* egl;
    hair_context* context;
    hair_host host = {NULL, NULL, print_sentence, NULL};
    check(hair_egl_create(&host, -1, &egl));
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = hair_egl_get_proc;
    check(hair_context_create(&context_desc, &context));
    hair_instance* hair = make_hair(context);
    struct bust bust = bust_create();
    check(hair_step(hair, 1.0f / 60));

    // A text that does not compile is an error here. The log names the line.
    hair_shader* shader;
    hair_shader_desc shader_desc = hair_shader_desc_default();
    shader_desc.label = "glow";
    shader_desc.glsl = shader_text;
    check(hair_shader_create(context, &shader_desc, &shader));

    // An animation would write `place` each frame.
    const struct glow glow = {{0.02f, 0.25f, 0.45f, 1}, {0.1f, 0.5f, 0.7f}, 0.55f};
    GLuint block;
    glCreateBuffers(1, &block);
    glNamedBufferStorage(block, sizeof glow, &glow, 0);
    glBindBufferBase(GL_UNIFORM_BUFFER, 8, block);

    const float eye[3] = {0.62f, 1.62f, -0.92f}, target[3] = {0, 1.53f, 0};
    struct camera camera = camera_perspective(eye, target, 0.42f, 4.0f / 3);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    bust_draw(&bust, bust.program, identity, camera.clip);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.shader = shader;
    check(hair_draw(hair, &view));
    picture_end(&picture, argc > 1 ? argv[1] : "own_shader.ppm");

    glDeleteBuffers(1, &block);
    bust_destroy(&bust);
    hair_destroy(hair);
    hair_shader_destroy(shader);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
