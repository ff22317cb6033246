// heads.c - ten small heads of hair in motion, one per subject. Hashes compare their states.
#include "tests/support/heads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <hair/hair_asset.h>

#include "lib/base/bytes.h"

#define TRY(call)                                                                                            \
    do {                                                                                                     \
        hair_result tried = (call);                                                                          \
        if (tried) return tried;                                                                             \
    } while (0)

#define FOLLOWERS 60
#define SEGMENTS 8

// Indices of kinds that have more than their haircut.
enum { WAVY = 1, COLLIDERS = 5, PINS, FLUID, HAIR_GRID, SKINNED };

static const struct {
    const char* name;
    hair_style style;
    hair_solver solver;
} table[HAIR_TEST_HEADS] = {
    {"straight", HAIR_STYLE_SHORT, HAIR_SOLVER_DIRECT},
    {"wavy", HAIR_STYLE_BOB, HAIR_SOLVER_ACCURATE},
    {"curly", HAIR_STYLE_CURLY, HAIR_SOLVER_DIRECT},
    {"afro", HAIR_STYLE_AFRO, HAIR_SOLVER_FOLLOW},
    {"long", HAIR_STYLE_LONG, HAIR_SOLVER_REDBLACK},
    {"colliders", HAIR_STYLE_BOB, HAIR_SOLVER_DIRECT},
    {"pins", HAIR_STYLE_PONYTAIL, HAIR_SOLVER_DIRECT},
    {"wind fluid", HAIR_STYLE_LONG, HAIR_SOLVER_DIRECT},
    {"hair-hair grid", HAIR_STYLE_BOB, HAIR_SOLVER_DIRECT},
    {"skinned scalp", HAIR_STYLE_SHORT, HAIR_SOLVER_FOLLOW},
};

static hair_result make_kind(const hair_host* host, uint32_t number, struct hair_test_head_kind* out)
{
    hair_asset* asset = NULL;
    hair_style_desc style = hair_style_desc_default();
    hair_groom_desc desc = hair_groom_desc_default();
    style.host = host;
    style.style = table[number].style;
    style.guide_count = 16;
    style.seed = number + 1;
    TRY(hair_asset_generate(&style, &asset));
    hair_result result = hair_asset_to_groom_desc(asset, &desc);
    desc.host = host;
    desc.guide_vertices = 10;
    desc.follower_count = FOLLOWERS;
    if (!result) result = hair_groom_create(&desc, &out->groom);
    if (!result && number == SKINNED) {
        out->scalp_vertices = desc.scalp_vertex_count;
        out->scalp = malloc(3 * sizeof(float) * desc.scalp_vertex_count);
        if (out->scalp) memcpy(out->scalp, desc.scalp_positions, 3 * sizeof(float) * desc.scalp_vertex_count);
        if (!out->scalp) result = HAIR_ERROR_MEMORY;
    }
    hair_asset_destroy(asset);
    out->name = table[number].name;
    out->solver = table[number].solver;
    return result;
}

hair_result hair_test_head_kinds_make(const hair_host* host,
                                      struct hair_test_head_kind kinds[HAIR_TEST_HEADS])
{
    memset(kinds, 0, HAIR_TEST_HEADS * sizeof *kinds);
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) TRY(make_kind(host, i, &kinds[i]));
    return HAIR_OK;
}

void hair_test_head_kinds_free(struct hair_test_head_kind kinds[HAIR_TEST_HEADS])
{
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) {
        hair_groom_destroy(kinds[i].groom);
        free(kinds[i].scalp);
    }
}

static hair_result set_wind(hair_instance* hair)
{
    hair_wind wind = hair_wind_default();
    wind.model = HAIR_WIND_FLUID;
    wind.velocity[0] = 3, wind.velocity[2] = -1;
    wind.turbulence.intensity = 0.3f;
    wind.fluid.resolution = 16;
    wind.fluid.projection_iterations = 1;
    wind.fluid.drag_strand_count = 50000;
    return hair_set_wind(hair, &wind);
}

hair_result hair_test_head_create(hair_context* context, const struct hair_test_head_kind* kinds,
                                  uint32_t number, struct hair_test_head* out)
{
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    hair_physics physics = hair_physics_default();
    if (number == WAVY) TRY(hair_look_apply_preset(&look, HAIR_LOOK_WAVY));
    look.strand.segments = SEGMENTS;
    // Hair falls asleep when the GPU answers, which is no part of the state.
    physics.sleep_threshold = 0;
    if (number == HAIR_GRID) physics.hair_hair.cohesion = 6, physics.hair_hair.pressure_stiffness = 0.2f;
    desc.label = kinds[number].name;
    desc.solver = kinds[number].solver;
    desc.look = &look;
    desc.physics = &physics;
    *out = (struct hair_test_head){.kind = &kinds[number], .number = number};
    TRY(hair_create(context, kinds[number].groom, &desc, &out->hair));
    return number == FLUID ? set_wind(out->hair) : HAIR_OK;
}

// Move three colliders through the hair. One of them comes and goes.
static hair_result set_colliders(hair_instance* hair, uint32_t i, float time)
{
    hair_collider colliders[3];
    for (int k = 0; k < 3; ++k) {
        colliders[k] = hair_collider_default();
        colliders[k].shape = (hair_shape)k; // sphere, capsule, box
        colliders[k].size[0] = 0.06f, colliders[k].size[1] = 0.05f, colliders[k].size[2] = 0.03f;
        colliders[k].position[0] = 0.12f * cosf(2 * time + 2 * (float)k);
        colliders[k].position[1] = 1.55f;
        colliders[k].position[2] = 0.12f * sinf(2 * time + 2 * (float)k);
        colliders[k].key = (uint64_t)k + 1;
    }
    return hair_set_colliders(hair, colliders, i / 50 % 2 ? 3 : 2, sizeof *colliders);
}

// Hold a tip in the world, and a second one to the head for every other second.
static hair_result set_pins(hair_instance* hair, uint32_t i, float time)
{
    hair_pin pins[2] = {hair_pin_default(), hair_pin_default()};
    pins[0].to = HAIR_PIN_WORLD;
    pins[0].position[0] = 0.05f * sinf(3 * time), pins[0].position[1] = 1.5f, pins[0].position[2] = -0.15f;
    pins[1].guide = 3, pins[1].vertex = 5;
    pins[1].position[0] = 0.1f, pins[1].position[1] = 1.6f, pins[1].position[2] = -0.05f;
    return hair_set_pins(hair, pins, i / 60 % 2 ? 2 : 1, sizeof *pins);
}

static hair_result set_scalp(const struct hair_test_head* head, float time)
{
    uint32_t count = head->kind->scalp_vertices;
    float* positions = malloc(3 * sizeof(float) * count);
    if (!positions) return HAIR_ERROR_MEMORY;
    for (uint32_t i = 0; i < 3 * count; ++i)
        positions[i] = head->kind->scalp[i] * (1 + 0.01f * sinf(7 * time + (float)(i / 3 % 5)));
    hair_result result = hair_set_scalp(head->hair, positions, count, 12, NULL);
    free(positions);
    return result;
}

hair_result hair_test_head_step(struct hair_test_head* head)
{
    uint32_t i = head->steps++;
    float time = (float)i / 60, angle = 0.5f * sinf(4 * time), c = cosf(angle), s = sinf(angle);
    const float matrix[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.05f * sinf(2 * time), 0, 0.1f * time, 1};
    TRY(hair_set_transform(head->hair, matrix));
    if (head->number == COLLIDERS) TRY(set_colliders(head->hair, i, time));
    if (head->number == PINS) TRY(set_pins(head->hair, i, time));
    if (head->number == SKINNED) TRY(set_scalp(head, time));
    return hair_step(head->hair, 1.0f / 60);
}

hair_result hair_test_head_steps(struct hair_test_head* head, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) TRY(hair_test_head_step(head));
    return HAIR_OK;
}

// Save the state into new memory, to be freed.
static hair_result save(hair_instance* hair, unsigned char** bytes, size_t* size)
{
    TRY(hair_save(hair, NULL, 0, size));
    *bytes = malloc(*size);
    if (!*bytes) return HAIR_ERROR_MEMORY;
    return hair_save(hair, *bytes, *size, size);
}

hair_result hair_test_head_hash(const struct hair_test_head* head, uint64_t* hash)
{
    static const uint32_t max = FOLLOWERS * (SEGMENTS + 1);
    float positions[3 * FOLLOWERS * (SEGMENTS + 1)];
    unsigned char* bytes = NULL;
    size_t size;
    uint32_t count = 0;
    hair_result result = save(head->hair, &bytes, &size);
    if (!result) result = hair_read_positions(head->hair, HAIR_READ_FOLLOWERS, positions, max, &count);
    if (!result) *hash = hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size);
    if (!result) *hash = hair_hash_bytes(*hash, positions, 3 * sizeof *positions * count);
    free(bytes);
    return result;
}

hair_result hair_test_head_renew(struct hair_test_head* head, hair_context* context,
                                 const struct hair_test_head_kind* kinds)
{
    struct hair_test_head old = *head;
    unsigned char* bytes = NULL;
    size_t size;
    hair_result result = save(old.hair, &bytes, &size);
    if (!result) result = hair_test_head_create(context, kinds, old.number, head);
    if (!result) result = hair_load(head->hair, bytes, size);
    if (head->hair != old.hair) hair_destroy(old.hair);
    head->steps = old.steps;
    free(bytes);
    return result;
}
