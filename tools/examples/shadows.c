// shadows.c - Shadow maps in both directions. The head shades hair. Hair shades head and hair.
//
//     shadows [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_egl.h>

static const float to_light[3] = {0.80f, 0.55f, 0.24f}; // unit

// The skin needs two maps of hair, because hair shades only what lies behind it.
static const char skin_text[] =
    "#version 450 core\n"
    "layout(location = 2) uniform mat4 shadow_matrix;\n"
    "layout(location = 3) uniform vec3 to_light;\n"
    "layout(binding = 0) uniform sampler2D opaque_map;\n"
    "layout(binding = 1) uniform sampler2D hair_map;\n"
    "layout(binding = 2) uniform sampler2D opacity_map;\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 0) out vec3 color;\n"
    "void main()\n"
    "{\n"
    "    vec3 n = normalize(normal);\n"
    "    vec3 at = 0.5 + 0.5 * (shadow_matrix * vec4(position + 0.004 * n, 1.0)).xyz;\n"
    "    float lit = 0.0;\n"
    "    for (int i = 0; i < 49; ++i) {\n"
    "        vec2 tap = at.xy + vec2(i % 7 - 3, i / 7 - 3) / vec2(textureSize(hair_map, 0));\n"
    "        float hair = texture(hair_map, tap).r < at.z ? texture(opacity_map, tap).r : 0.0;\n"
    "        lit += texture(opaque_map, tap).r < at.z ? 0.0 : (1.0 - hair) / 49.0;\n"
    "    }\n"
    "    color = vec3(0.50, 0.38, 0.31) / 3.14159 * (3.0 * lit * max(dot(n, to_light), 0.0) + 0.35);\n"
    "}\n";

// Maps of the light: depth of the head, depth of hair, and the fraction that hair covers.
enum { OPAQUE, HAIR, OPACITY, MAPS, SIZE = 512 };

struct light {
    GLuint textures[MAPS], framebuffers[MAPS];
    struct camera camera;
};

// Create the maps and an orthographic camera that covers the bust.
static struct light make_light(void)
{
    struct light light;
    const float target[3] = {0, 1.52f, 0}, eye[3] = {to_light[0], 1.52f + to_light[1], to_light[2]};
    light.camera = camera_orthographic(eye, target, 0.3f);
    glCreateTextures(GL_TEXTURE_2D, MAPS, light.textures);
    glCreateFramebuffers(MAPS, light.framebuffers);
    for (int i = 0; i < MAPS; ++i) {
        GLenum format = i == OPACITY ? GL_R16F : GL_DEPTH_COMPONENT32F;
        GLenum attachment = i == OPACITY ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_ATTACHMENT;
        glTextureStorage2D(light.textures[i], 1, format, SIZE, SIZE);
        glTextureParameteri(light.textures[i], GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glNamedFramebufferTexture(light.framebuffers[i], attachment, light.textures[i], 0);
    }
    // With the head's depth, the opacity counts only hair between the light and the head.
    glNamedFramebufferTexture(light.framebuffers[OPACITY], GL_DEPTH_ATTACHMENT, light.textures[OPAQUE], 0);
    return light;
}

static void draw_shadow_maps(const struct light* light, const struct bust* bust, hair_instance* hair)
{
    static const float farthest = 1, none[4] = {0, 0, 0, 0};
    hair_view view = hair_view_default();
    memcpy(view.view, light->camera.view, sizeof view.view);
    memcpy(view.projection, light->camera.projection, sizeof view.projection);
    glViewport(0, 0, SIZE, SIZE);
    glEnable(GL_DEPTH_TEST);

    glBindFramebuffer(GL_FRAMEBUFFER, light->framebuffers[OPAQUE]);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    bust_draw(bust, bust->program, identity, light->camera.clip);

    glBindFramebuffer(GL_FRAMEBUFFER, light->framebuffers[HAIR]);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    view.pass = HAIR_PASS_DEPTH;
    check(hair_draw(hair, &view));

    glBindFramebuffer(GL_FRAMEBUFFER, light->framebuffers[OPACITY]);
    glClearBufferfv(GL_COLOR, 0, none);
    view.pass = HAIR_PASS_OPACITY;
    check(hair_draw(hair, &view));
}

static void draw_picture(const struct light* light, const struct bust* bust, GLuint skin, hair_instance* hair)
{
    const float eye[3] = {0.50f, 1.60f, 0.985f}, target[3] = {0, 1.55f, 0};
    struct camera camera = camera_perspective(eye, target, 0.36f, 4.0f / 3);
    glProgramUniformMatrix4fv(skin, 2, 1, GL_FALSE, light->camera.clip);
    glProgramUniform3fv(skin, 3, 1, to_light);
    glBindTextures(0, MAPS, light->textures);
    bust_draw(bust, skin, identity, camera.clip);

    hair_light sun = hair_light_default();
    memcpy(sun.direction, to_light, sizeof to_light);
    memcpy(sun.shadow_matrix, light->camera.clip, sizeof sun.shadow_matrix);
    sun.hair_shadow_map = light->textures[HAIR];
    sun.opaque_shadow_map = light->textures[OPAQUE];
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.lights = &sun;
    check(hair_draw(hair, &view));
}

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
    struct light light = make_light();
    GLuint skin = make_program(bust_vertex_text, skin_text);
    check(hair_step(hair, 1.0f / 60));
    draw_shadow_maps(&light, &bust, hair);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    draw_picture(&light, &bust, skin, hair);
    picture_end(&picture, argc > 1 ? argv[1] : "shadows.ppm");

    glDeleteProgram(skin);
    glDeleteTextures(MAPS, light.textures);
    glDeleteFramebuffers(MAPS, light.framebuffers);
    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
