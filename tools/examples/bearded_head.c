// bearded_head.c - Hair, a beard and brows as three groups of strands in one instance. Each group
// has guides, physics, a radius and colours of its own.
//
//     bearded_head [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_asset.h>
#include <hair/hair_egl.h>

enum { HAIR, BEARD, BROWS };
enum { HAIR_STRANDS = 4000, BEARD_STRANDS = 5000, BROW_STRANDS = 700, VERTICES = 6 };

struct strands {
    float* positions;
    uint32_t* vertices;
    uint8_t* groups;
    uint32_t count, vertex_count;
};

static float random_number(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) / 16777216.0f;
}

// Find a point of the mannequin between two rows. The angle is 0 in front and grows to its left.
static void find_root(float row, float angle, float out[3])
{
    float a[4], b[4], t = row - floorf(row);
    bust_row((int)row, a);
    bust_row((int)row + 1, b);
    for (int i = 0; i < 4; ++i) a[i] += t * (b[i] - a[i]);
    out[0] = a[1] * sinf(angle), out[1] = a[0], out[2] = a[2] * cosf(angle) + a[3];
}

// Add a strand that leaves the skin and bends into the direction `way`.
static void add_strand(struct strands* strands, uint8_t group, const float root[3], float angle,
                       const float way[3], float length)
{
    const float out[3] = {sinf(angle), 0, cosf(angle)};
    float* at = strands->positions + 3 * strands->vertex_count;
    for (int k = 0; k < VERTICES; ++k) {
        float t = (float)k / (VERTICES - 1);
        for (int i = 0; i < 3; ++i)
            *at++ = root[i] + length * t * (0.7f * (1 - 0.8f * t) * out[i] + (0.5f + 0.4f * t) * way[i]);
    }
    strands->vertex_count += VERTICES;
    strands->vertices[strands->count] = VERTICES;
    strands->groups[strands->count++] = group;
}

static void add_beard(struct strands* strands)
{
    for (int i = 0; i < BEARD_STRANDS; ++i) {
        float angle = 2.9f * random_number() - 1.45f, row = 23.5f + 9 * random_number(), root[3];
        // The mouth and the cheeks are bare.
        if (row < 25.5f + 2 * cosf(1.3f * angle) - 9 * fmaxf(fabsf(angle) - 1.1f, 0)) row += 5;
        const float way[3] = {0.3f * sinf(angle), -1, 0.25f * cosf(angle)};
        find_root(row, angle, root);
        add_strand(strands, BEARD, root, angle, way, 0.03f + 0.02f * random_number() * cosf(angle));
    }
}

static void add_brows(struct strands* strands)
{
    for (int i = 0; i < BROW_STRANDS; ++i) {
        float side = i % 2 ? 1.0f : -1.0f, along = random_number(), root[3];
        float angle = side * (0.16f + 0.5f * along);
        float row = 16.6f - 1.2f * sinf(2.6f * along) + 0.9f * (1 - 0.6f * along) * random_number();
        const float way[3] = {side * cosf(angle), 0.25f - 0.5f * along, -side * sinf(angle)};
        find_root(row, angle, root);
        add_strand(strands, BROWS, root, angle, way, 0.008f + 0.004f * random_number());
    }
}

// Make a groom of a built-in haircut, a beard and brows.
static hair_groom* make_bearded_groom(void)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_asset_info info = hair_asset_info_default();
    hair_style_desc style = hair_style_desc_default();
    style.style = HAIR_STYLE_SHORT;
    style.guide_count = HAIR_STRANDS;
    check(hair_asset_generate(&style, &asset));
    check(hair_asset_describe(asset, &info));
    uint32_t more = BEARD_STRANDS + BROW_STRANDS, count = info.strand_count + more;
    struct strands strands = {malloc(3 * sizeof(float) * (info.vertex_count + VERTICES * more)),
                              malloc(count * sizeof(uint32_t)), calloc(count, 1), info.strand_count,
                              info.vertex_count};
    if (!strands.positions || !strands.vertices || !strands.groups) fail("There is no memory.");
    memcpy(strands.positions, info.positions, 3 * sizeof(float) * info.vertex_count);
    memcpy(strands.vertices, info.strand_vertices, info.strand_count * sizeof(uint32_t));
    hair_asset_destroy(asset);
    add_beard(&strands);
    add_brows(&strands);

    hair_groom_desc desc = hair_groom_desc_default();
    desc.positions = strands.positions;
    desc.strand_vertices = strands.vertices;
    desc.strand_groups = strands.groups;
    desc.strand_count = strands.count;
    desc.guide_count = 500;
    desc.guide_vertices = 12;
    check(hair_groom_create(&desc, &groom));
    free(strands.positions);
    free(strands.vertices);
    free(strands.groups);
    return groom;
}

// A beard is stiffer and thicker than hair. Brows are finer, and hardly move.
static void set_groups(hair_instance* hair)
{
    hair_physics physics = hair_physics_default();
    hair_group_look look = hair_group_look_default();
    physics.shape.stiffness_root = physics.shape.stiffness_tip = 4;
    check(hair_set_group_physics(hair, BEARD, &physics));
    physics.shape.frequency_root = physics.shape.frequency_tip = 20;
    check(hair_set_group_physics(hair, BROWS, &physics));
    const float beard[2][3] = {{0.10f, 0.03f, 0.012f}, {0.30f, 0.10f, 0.03f}};
    look.radius = 1.2f;
    look.color.enabled = true;
    memcpy(look.color.root, beard[0], sizeof beard[0]);
    memcpy(look.color.tip, beard[1], sizeof beard[1]);
    check(hair_set_group_look(hair, BEARD, &look));
    look.radius = 0.6f;
    memcpy(look.color.tip, beard[0], sizeof beard[0]);
    check(hair_set_group_look(hair, BROWS, &look));
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
    hair_groom* groom = make_bearded_groom();
    hair_look look = hair_look_default();
    look.strand.radius = 2.5e-4f;
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    set_groups(hair);
    hair_collider colliders[BUST_COLLIDERS];
    bust_colliders(identity, colliders);
    check(hair_set_colliders(hair, colliders, BUST_COLLIDERS, sizeof *colliders));
    for (int frame = 0; frame < 10; ++frame) check(hair_step(hair, 1.0f / 60));

    const float eye[3] = {0.35f, 1.60f, 0.95f}, target[3] = {0, 1.60f, 0};
    struct camera camera = camera_perspective(eye, target, 0.33f, 4.0f / 3);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    struct bust bust = bust_create();
    bust_draw(&bust, bust.program, identity, camera.clip);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    check(hair_draw(hair, &view));
    picture_end(&picture, argc > 1 ? argv[1] : "bearded_head.ppm");

    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
