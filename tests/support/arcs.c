// arcs.c - two strands that bend around the x axis towards the viewer, and their highlights.
#include "tests/support/arcs.h"
#include "tests/support/grooms.h"

#include <math.h>

#define SIDE 240
#define RADIUS 0.1f // Radius of an arc, m.
#define SCALE 16 // Scale of the view, 1/m.

static hair_look look_of_arcs(bool is_lines)
{
    hair_look look = hair_look_default();
    look.strays.tip_fraction = look.strays.fraction = 0;
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    look.shading.model = is_lines ? HAIR_SHADING_LINES : HAIR_SHADING_FIBRES;
    look.strand.segments = 256, look.strand.radius = 3e-3f, look.color.spread = 0;
    look.shading.cuticle_tilt_spread = look.shading.scattering = 0;
    look.shading.roughness[0] = 0.1f;
    look.shading.specular[0] = 0, look.shading.specular[1] = 4, look.shading.gloss[1] = 200;
    for (int c = 0; c < 3; ++c) look.color.root[c] = look.color.tip[c] = is_lines ? 0.05f : 0;
    return look;
}

static GLuint make_far_depth(void)
{
    const float farthest = 1;
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_DEPTH_COMPONENT32F, SIDE, SIDE);
    glClearTexImage(texture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);
    return texture;
}

static void add_hair(struct hair_test_scene* scene, const hair_look* look,
                     const hair_strand_attribute* attribute)
{
    static const uint8_t groups[2] = {0, 1};
    struct hair_test_strands strands = hair_test_strands_make(2, 32);
    for (int g = 0; g < 2; ++g)
        for (int k = 0; k < 32; ++k) {
            float a = 1.2f - 2.4f * (float)k / 31;
            hair_store3(strands.positions + 3 * strands.vertex_count++,
                        hair_v3(0.05f * (float)g - 0.025f, RADIUS * sinf(a), RADIUS * cosf(a) - RADIUS));
        }
    for (int g = 0; g < 2; ++g) strands.vertices[strands.count++] = 32;
    strands.groups = groups;
    strands.attributes = attribute, strands.attribute_count = attribute != NULL;
    hair_groom_desc desc = hair_test_groom_desc(&scene->test->host, &strands);
    desc.guide_count = 2;
    scene->groom = hair_test_groom_of(&desc);
    hair_desc of = hair_desc_default();
    of.look = look;
    hair_test_ok(scene->test, hair_create(scene->test->context, scene->groom, &of, &scene->hair));
    hair_test_strands_free(&strands);
}

void hair_test_arcs_start(struct hair_test* test, bool is_lines, const hair_strand_attribute* attribute,
                          struct hair_test_arcs* out)
{
    const hair_look look = look_of_arcs(is_lines);
    *out = (struct hair_test_arcs){.scene = hair_test_scene_make(test, NULL),
                                   .light = hair_light_default(),
                                   .view = hair_test_view_by(HAIR_RENDER_PATH_AUTO)};
    add_hair(&out->scene, &look, attribute);
    out->light.direction[0] = out->light.direction[1] = 0, out->light.direction[2] = 1;
    for (int c = 0; c < 3; ++c) out->view.ambient[c] = 0;
    hair_test_set_orthographic(&out->view, SCALE, 3, 0);
    out->view.occluder_depth = make_far_depth();
}

// Measure the highlight in the left or in the right half of the picture.
static double measure_half(const float* pixels, int half)
{
    double row[SIDE] = {0}, max = 0, low = 0, high = 0;
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE / 2; ++x)
            row[y] = fmax(row[y], (double)pixels[4 * (y * SIDE + half * SIDE / 2 + x)]);
    for (int y = 0; y < SIDE; ++y) max = fmax(max, row[y]);
    for (int y = 1; y < SIDE; ++y) {
        double at = y - 1 + (max / 2 - row[y - 1]) / (row[y] - row[y - 1]);
        if (row[y - 1] < max / 2 && row[y] >= max / 2) low = at;
        if (row[y - 1] >= max / 2 && row[y] < max / 2) high = at;
    }
    assert_true(max > 0 && low > 2 && high > low && high < SIDE - 2);
    double middle = 0.5 * (SIDE - 1), radians = 2.0 / SCALE / SIDE / (double)RADIUS;
    return asin((high - middle) * radians) - asin((low - middle) * radians);
}

void hair_test_arcs_measure(struct hair_test_arcs* arcs, hair_render_path path, double width[2])
{
    static float pixels[4 * SIDE * SIDE];
    arcs->view.lights = &arcs->light;
    arcs->view.render_path = path;
    hair_test_draw(&arcs->scene, &arcs->view, SIDE, SIDE, 0, pixels, NULL);
    for (int half = 0; half < 2; ++half) width[half] = measure_half(pixels, half);
}

void hair_test_arcs_free(struct hair_test_arcs* arcs)
{
    glDeleteTextures(1, &arcs->view.occluder_depth);
    hair_test_scene_free(&arcs->scene);
}
