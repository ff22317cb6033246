// offscreen.c - Simulate a head of hair without a window and write a picture of it.
//
//     offscreen [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_asset.h>
#include <hair/hair_egl.h>

// Generate a built-in haircut. hair_asset_read() would read a haircut of a file instead.
static hair_groom* make_bob(void)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_style_desc style = hair_style_desc_default();
    style.style = HAIR_STYLE_BOB;
    check(hair_asset_generate(&style, &asset));

    hair_groom_desc desc = hair_groom_desc_default();
    check(hair_asset_to_groom_desc(asset, &desc));
    desc.follower_count = 6000;
    check(hair_groom_create(&desc, &groom));
    hair_asset_destroy(asset); // The groom has copied the strands.
    return groom;
}

int main(int argc, char** argv)
{
    const char* path = argc > 1 ? argv[1] : "offscreen.ppm";
    int width = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800;
    hair_host host = {NULL, NULL, print_sentence, NULL};
    hair_egl* egl;
    hair_context* context;
    hair_instance* hair;

    // The context takes the first EGL device that has OpenGL 4.5.
    check(hair_egl_create(&host, -1, &egl));
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = hair_egl_get_proc;
    check(hair_context_create(&context_desc, &context));

    // 6000 strands stand for the 100000 of a real head, therefore they are thicker.
    hair_groom* groom = make_bob();
    hair_look look = hair_look_default();
    look.strand.radius = 3e-4f;
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);

    hair_collider colliders[BUST_COLLIDERS];
    bust_colliders(identity, colliders);
    check(hair_set_colliders(hair, colliders, BUST_COLLIDERS, sizeof *colliders));
    for (int frame = 0; frame < 30; ++frame) check(hair_step(hair, 1.0f / 60));

    const float eye[3] = {0.50f, 1.62f, 0.985f}, target[3] = {0, 1.58f, 0};
    struct camera camera = camera_perspective(eye, target, 0.33f, 4.0f / 3);
    struct picture picture = picture_begin(width);
    struct bust bust = bust_create();
    bust_draw(&bust, bust.program, identity, camera.clip);

    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    check(hair_draw(hair, &view));
    picture_end(&picture, path);

    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
