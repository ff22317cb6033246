// Turn a head of hair for a second and draw it into hello.ppm, without a window.
#include <epoxy/gl.h>
#include <hair/hair.h>
#include <hair/hair_asset.h>
#include <hair/hair_egl.h>
#include <math.h>
#include <stdio.h>

enum { SIZE = 480 };
static unsigned char pixels[SIZE][SIZE][3];

int main(void)
{
    hair_egl* egl;
    hair_context* context;
    hair_asset* asset;
    hair_groom* groom;
    hair_instance* hair;

    if (hair_egl_create(NULL, -1, &egl)) return 1; // A game has its own OpenGL context and loader.
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.get_proc = hair_egl_get_proc;
    if (hair_context_create(&context_desc, &context)) return 1;

    hair_style_desc style = hair_style_desc_default(); // hair_asset_read() reads a file instead.
    hair_groom_desc groom_desc = hair_groom_desc_default();
    if (hair_asset_generate(&style, &asset)) return 1;
    if (hair_asset_to_groom_desc(asset, &groom_desc) || hair_groom_create(&groom_desc, &groom)) return 1;

    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.look = &look;
    if (hair_create(context, groom, &desc, &hair)) return 1;

    // The skull, the shoulders.
    hair_collider body[] = {hair_collider_default(), hair_collider_default()};
    body[0].shape = body[1].shape = HAIR_SHAPE_CAPSULE;
    body[0].position[1] = 1.63f, body[0].size[0] = 0.08f, body[0].size[1] = 0.015f;
    body[1].position[1] = 1.36f, body[1].size[0] = 0.07f, body[1].size[1] = 0.11f;
    body[1].rotation[2] = body[1].rotation[3] = 0.70710678f;
    if (hair_set_colliders(hair, body, 2, sizeof *body)) return 1;

    for (int frame = 1; frame <= 60; ++frame) { // The head turns about the y axis and back.
        float a = 0.8f * sinf(0.105f * (float)frame), c = cosf(a), s = sinf(a);
        float transform[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
        if (hair_set_transform(hair, transform) || hair_step(hair, 1.0f / 60)) return 1;
    }

    GLuint framebuffer, targets[2]; // Colours are linear, so the picture is sRGB.
    const GLfloat background[] = {0.6f, 0.6f, 0.6f, 1}, farthest = 1;
    glCreateFramebuffers(1, &framebuffer), glCreateRenderbuffers(2, targets);
    glNamedRenderbufferStorage(targets[0], GL_SRGB8_ALPHA8, SIZE, SIZE);
    glNamedRenderbufferStorage(targets[1], GL_DEPTH_COMPONENT32F, SIZE, SIZE);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, targets[0]);
    glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, targets[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, SIZE, SIZE);
    glEnable(GL_DEPTH_TEST), glEnable(GL_FRAMEBUFFER_SRGB);
    glClearBufferfv(GL_COLOR, 0, background);
    glClearBufferfv(GL_DEPTH, 0, &farthest);

    hair_view view = hair_view_default();
    view.view[13] = -1.52f, view.view[14] = -1.1f; // The camera is 1.52 m up and 1.1 m in front.
    view.projection[0] = view.projection[5] = 4; // It sees 28 degrees, from 0.2 m to 2.2 m.
    view.projection[10] = -1.2f, view.projection[14] = -0.44f;
    view.projection[11] = -1, view.projection[15] = 0;
    view.pass = HAIR_PASS_COLLIDERS; // A game draws its own body here.
    if (hair_draw(hair, &view)) return 1;
    view.pass = HAIR_PASS_COLOR;
    view.coverage = HAIR_COVERAGE_ALPHA; // Smooth edges without multisampling.
    if (hair_draw(hair, &view)) return 1;

    FILE* file = fopen("hello.ppm", "wb");
    if (!file) return 1;
    glReadPixels(0, 0, SIZE, SIZE, GL_RGB, GL_UNSIGNED_BYTE, pixels);
    fprintf(file, "P6\n%d %d\n255\n", SIZE, SIZE);
    for (int y = SIZE; y--;) fwrite(pixels[y], 1, sizeof pixels[y], file); // OpenGL begins below.
    printf("wrote hello.ppm\n");
    hair_destroy(hair), hair_groom_destroy(groom), hair_asset_destroy(asset);
    hair_context_destroy(context), hair_egl_destroy(egl);
    return fclose(file) ? 1 : 0;
}
