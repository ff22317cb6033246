// sword_cut.c - A stroke of a blade cuts hair while it moves. The locks that it cuts off fall to
// the ground as hair of their own.
//
//     sword_cut [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_asset.h>
#include <hair/hair_egl.h>

enum { STROKE = 20, FRAMES = 36 }; // Frame of the stroke, and the last frame.

static hair_instance* make_hair(hair_context* context)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_instance* hair;
    hair_style_desc style = hair_style_desc_default();
    check(hair_asset_generate(&style, &asset));
    hair_groom_desc groom_desc = hair_groom_desc_default();
    hair_asset_to_groom_desc(asset, &groom_desc);
    groom_desc.follower_count = 6000;
    check(hair_groom_create(&groom_desc, &groom));
    hair_asset_destroy(asset);
    hair_look look = hair_look_default();
    look.strand.radius = 2.5e-4f;
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

// Swing the blade from the front to the back through the hair on one side. It rises outwards.
static hair_instance* swing_blade(hair_instance* hair)
{
    hair_instance* locks;
    hair_cut_info info = hair_cut_info_default();
    hair_cut_desc stroke = hair_cut_desc_default();
    const float hilt[3] = {0.02f, 1.50f, 0}, point[3] = {0.5f, 1.68f, 0};
    stroke.shape = HAIR_CUT_SHAPE_BLADE;
    memcpy(stroke.start, hilt, sizeof hilt);
    memcpy(stroke.end, point, sizeof point);
    memcpy(stroke.last_start, hilt, sizeof hilt);
    memcpy(stroke.last_end, point, sizeof point);
    stroke.last_start[2] = stroke.last_end[2] = 0.3f;
    stroke.start[2] = stroke.end[2] = -0.3f;
    check(hair_cut(hair, &stroke, &info, &locks));
    printf("%u strands have lost %.1f m.\n", info.strands, info.length);
    return locks;
}

static void draw_hair(hair_instance* hair, const struct camera* camera)
{
    hair_view view = hair_view_default();
    memcpy(view.view, camera->view, sizeof view.view);
    memcpy(view.projection, camera->projection, sizeof view.projection);
    check(hair_draw(hair, &view));
}

int main(int argc, char** argv)
{
    hair_egl* egl;
    hair_context* context;
    hair_instance* locks = NULL;
    hair_host host = {NULL, NULL, print_sentence, NULL};
    check(hair_egl_create(&host, -1, &egl));
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = hair_egl_get_proc;
    check(hair_context_create(&context_desc, &context));
    hair_instance* hair = make_hair(context);
    hair_collider colliders[BUST_COLLIDERS];
    bust_colliders(identity, colliders);
    check(hair_set_colliders(hair, colliders, BUST_COLLIDERS, sizeof *colliders));
    float head[16];
    memcpy(head, identity, sizeof head);
    for (int frame = 0; frame < FRAMES; ++frame) {
        if (frame == STROKE) locks = swing_blade(hair);
        head[12] = 0.03f * sinf(0.2f * (float)frame);
        check(hair_set_transform(hair, head));
        bust_colliders(head, colliders);
        check(hair_set_colliders(hair, colliders, BUST_COLLIDERS, sizeof *colliders));
        check(hair_step(hair, 1.0f / 60));
        if (!locks) continue;
        check(hair_set_colliders(locks, colliders, BUST_COLLIDERS, sizeof *colliders));
        check(hair_step(locks, 1.0f / 60));
    }

    const float eye[3] = {0.55f, 1.52f, 1.05f}, target[3] = {0.03f, 1.48f, 0};
    struct camera camera = camera_perspective(eye, target, 0.48f, 4.0f / 3);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    struct bust bust = bust_create();
    bust_draw(&bust, bust.program, head, camera.clip);
    draw_hair(hair, &camera);
    if (locks) draw_hair(locks, &camera);
    picture_end(&picture, argc > 1 ? argv[1] : "sword_cut.ppm");

    bust_destroy(&bust);
    hair_destroy(locks);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
