// painted_hair.c - Attributes that are painted on the scalp: hair is short and thin on one side of
// the head, and long and curly on the other.
//
//     painted_hair [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_asset.h>
#include <hair/hair_egl.h>

// An attribute, and its values on the left and on the right of the picture.
static const struct {
    hair_strand_attribute_kind kind;
    float left, right;
} painted[] = {{HAIR_STRAND_ATTRIBUTE_LENGTH, 0.2f, 1},
               {HAIR_STRAND_ATTRIBUTE_DENSITY, 0.5f, 1},
               {HAIR_STRAND_ATTRIBUTE_CURL_RADIUS, 0, 1.5f}};

enum { PAINTED = sizeof painted / sizeof *painted };

// Return a value for each vertex of the scalp. It changes within 3 cm at the parting.
static float* paint(const hair_groom_desc* desc, float left, float right)
{
    float* values = (float*)malloc(desc->scalp_vertex_count * sizeof *values);
    if (!values) fail("There is no memory for a map.");
    for (uint32_t i = 0; i < desc->scalp_vertex_count; ++i) {
        float t = desc->scalp_positions[3 * i] / 0.03f - 0.2f;
        values[i] = left + (right - left) * fminf(fmaxf(t, 0), 1);
    }
    return values;
}

static hair_groom* make_painted_groom(void)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_strand_attribute attributes[PAINTED];
    float* maps[PAINTED];
    hair_style_desc style = hair_style_desc_default();
    style.style = HAIR_STYLE_BOB;
    check(hair_asset_generate(&style, &asset));
    hair_groom_desc desc = hair_groom_desc_default();
    check(hair_asset_to_groom_desc(asset, &desc));
    desc.follower_count = 8000;
    for (int i = 0; i < PAINTED; ++i) {
        maps[i] = paint(&desc, painted[i].left, painted[i].right);
        attributes[i] = hair_strand_attribute_default();
        attributes[i].kind = painted[i].kind;
        attributes[i].map.source = HAIR_MAP_SOURCE_VERTICES;
        attributes[i].map.values = maps[i];
    }
    desc.strand_attributes = attributes;
    desc.strand_attribute_count = PAINTED;
    check(hair_groom_create(&desc, &groom));
    for (int i = 0; i < PAINTED; ++i) free(maps[i]); // The groom has copied the values.
    hair_asset_destroy(asset);
    return groom;
}

int main(int argc, char** argv)
{
    hair_egl* egl;
    hair_context* context;
    hair_instance* hair;
    hair_host host = {NULL, NULL, print_sentence, NULL};
    check(hair_egl_create(&host, -1, &egl));
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = hair_egl_get_proc;
    check(hair_context_create(&context_desc, &context));

    // Attributes multiply the curls of the look.
    hair_groom* groom = make_painted_groom();
    hair_look look = hair_look_default();
    check(hair_look_apply_preset(&look, HAIR_LOOK_3A));
    look.strand.radius = 2.5e-4f;
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    hair_collider colliders[BUST_COLLIDERS];
    bust_colliders(identity, colliders);
    check(hair_set_colliders(hair, colliders, BUST_COLLIDERS, sizeof *colliders));
    for (int frame = 0; frame < 30; ++frame) check(hair_step(hair, 1.0f / 60));

    const float eye[3] = {-0.25f, 1.68f, 0.98f}, target[3] = {0, 1.57f, 0};
    struct camera camera = camera_perspective(eye, target, 0.34f, 4.0f / 3);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    struct bust bust = bust_create();
    bust_draw(&bust, bust.program, identity, camera.clip);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    check(hair_draw(hair, &view));
    picture_end(&picture, argc > 1 ? argv[1] : "painted_hair.ppm");

    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
