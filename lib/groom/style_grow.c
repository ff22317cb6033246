// style_grow.c - guides of the built-in haircuts, traced from root to tip.
#include "lib/groom/style_grow.h"
#include "lib/groom/style_body.h"
#include "lib/groom/style_walk.h"

#define PI 3.14159265f
// Distance from a parting within which hair runs along it at first, m.
#define BESIDE 0.025f
#define WHORL 0.045f // Radius of the whorl at the crown, m.
#define SWIRL 1.1f // Motion around the whorl per motion away from it.
// Height by which hair from the crown is cut shorter than hair from the hairline, m.
#define LAYERS 0.045f
#define CURLY_TURNS 8.5f // Mean number of turns of the longest curls.

// Parted hair -------------------------------------------------------------------------------------

struct hair_parting hair_style_parting(hair_style style)
{
    switch (style) {
    case HAIR_STYLE_LONG: return (struct hair_parting){1, 0.004f, 0.002f, -0.040f};
    case HAIR_STYLE_CURLY: return (struct hair_parting){1, -0.012f, -0.006f, -0.035f};
    case HAIR_STYLE_BOB: return (struct hair_parting){1, 0.026f, 0.014f, -0.040f};
    case HAIR_STYLE_SHORT:
    case HAIR_STYLE_FADE: return (struct hair_parting){1, 0.034f, 0.024f, -0.030f};
    default: return (struct hair_parting){0};
    }
}

hair_vec3 hair_style_whorl(struct hair_parting parting)
{
    return hair_skull_point(
        hair_skull_unit(hair_v3(parting.crown + 0.004f, 1.71f, parting.crown_z - 0.014f)));
}

// Turn the comb into a spiral around the whorl.
static hair_vec3 add_whorl(struct hair_parting parting, hair_vec3 p, hair_vec3 normal, float along,
                           hair_vec3 comb)
{
    hair_vec3 away = hair_tangential(hair_sub(p, hair_style_whorl(parting)), normal);
    float distance = hair_length(away);
    float weight = hair_smooth(WHORL, 0.3f * WHORL, distance) * hair_smooth(0.9f, 1.1f, along);
    if (!(weight > 0 && distance > 1e-5f)) return comb;
    hair_vec3 outwards = hair_scale(away, 1 / distance);
    hair_vec3 spiral = hair_add(outwards, hair_scale(hair_cross(normal, outwards), SWIRL));
    return hair_lerp(hair_normalize(hair_tangential(comb, normal), outwards),
                     hair_normalize(spiral, outwards), weight);
}

// Return the direction of a comb drawn from the parting. It runs sideways at the forehead and
// increasingly backwards towards the crown. Behind the crown it spreads evenly around the back of
// the head.
static hair_vec3 comb_from_parting(struct hair_parting parting, hair_vec3 p, float back_front,
                                   float back_crown)
{
    hair_vec3 normal = hair_skull_normal(p);
    float along = (HAIR_PARTING_FRONT_Z - p.z) / (HAIR_PARTING_FRONT_Z - parting.crown_z);
    // Width over which the side changes, m.
    float width = hair_mix(0.0005f, 0.045f, hair_smooth(0.9f, 1.5f, along));
    float away = p.x - hair_parting_x(parting, p.z), side = fminf(fmaxf(away / width, -1), 1);
    float back = hair_mix(back_front, back_crown, hair_smooth(0, 1, along));
    // Beside the parting, hair first runs along the parting and covers the skin there.
    float beside = hair_smooth(BESIDE, 0, fabsf(away)) * hair_smooth(1.2f, 0.9f, along);
    side *= 1 - 0.5f * beside, back += 0.4f * beside;
    // On the underside of the skull, back would point up.
    float above = hair_smooth(1.57f, 1.67f, p.y);
    hair_vec3 v = {side * above, -0.7f, -back * above};
    v = add_whorl(parting, p, normal, along, v);
    return hair_normalize(hair_tangential(v, normal), hair_tangential(hair_v3(0, -1, 0), normal));
}

// Return the layer of a root: 0 at the hairline of nape and sides, 1 at the crown.
static float layer(hair_vec3 root)
{
    return hair_smooth(1.55f, 1.72f, root.y);
}

// Return 1 in front of the ears and 0 behind them.
static float frontness(hair_vec3 root)
{
    return hair_smooth(-0.012f, 0.030f, root.z);
}

// Return an uneven height of a root's hair, up to `height` metres up or down. Locks of hair lie on
// one another, so the outline of a head is no smooth dome.
static float uneven(hair_vec3 root, float height, uint32_t seed)
{
    return height * (0.6f * hair_noise(root, 0.03f, seed) + 0.4f * hair_noise(root, 0.011f, seed + 7));
}

// Styles ------------------------------------------------------------------------------------------

// Bend hair into flat waves. Their phase changes over `apart` m of the scalp.
static void add_wave(uint32_t guide, hair_vec3 root, uint32_t seed, float apart, struct hair_curl* wave,
                     struct hair_style_path* path)
{
    wave->phase = 1.5f * PI * hair_noise(root, apart, seed + 2);
    wave->flat = 0.5f;
    wave->seed = hair_hash(guide ^ seed);
    hair_style_path_add_curl(path, wave);
}

static void grow_long(uint32_t guide, hair_vec3 root, float scale, uint32_t seed,
                      struct hair_style_path* path)
{
    float front = frontness(root), high = layer(root);
    struct hair_style_walk walk = {
        .comb = comb_from_parting(hair_style_parting(HAIR_STYLE_LONG), root, 0.30f, 1.1f),
        .rise = 0.17f,
        .clearance = hair_mix(0.004f, 0.014f, high) + uneven(root, 0.003f, seed),
        .lift = 0.075f,
        .gravity = 45,
        .hold = 0.04f,
        .split = 25,
        // Hair from behind the ears falls down the back.
        .ridge = hair_mix(-0.004f, -0.034f, hair_smooth(-0.012f, 0.012f, root.z)),
        .floor = hair_mix(1.285f, 1.325f, front) + LAYERS * high + 0.03f * hair_noise(root, 0.012f, seed + 1),
        .face = 0.010f,
        .inward_below = 0,
    };
    hair_style_trace_cut(&walk, root, scale, 0.03f, path);
    struct hair_curl wave = {
        .radius = 0.011f, .pitch = 0.105f, .start = 0.05f * scale, .full = 0.28f * scale, .variation = 0.3f};
    add_wave(guide, root, seed, 0.06f, &wave, path);
}

// Bend hair that is cut at the chin. Without a slight wave it is a curtain beside the temple.
static void add_slight_wave(uint32_t guide, hair_vec3 root, float scale, uint32_t seed, float size,
                            struct hair_style_path* path)
{
    struct hair_curl wave = {.radius = 0.006f * size,
                             .pitch = 0.085f,
                             .start = 0.025f * scale,
                             .full = 0.14f * scale,
                             .variation = 0.4f};
    add_wave(guide, root, seed, 0.04f, &wave, path);
}

static void grow_bob(uint32_t guide, hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    float high = layer(root);
    float cut = hair_mix(1.528f, 1.500f, hair_smooth(-0.07f, 0.04f, root.z));
    struct hair_style_walk walk = {
        .comb = comb_from_parting(hair_style_parting(HAIR_STYLE_BOB), root, 0.40f, 1.0f),
        .rise = 0.16f,
        .clearance = hair_mix(0.005f, 0.017f, high) + uneven(root, 0.004f, seed),
        .lift = 0.06f,
        .gravity = 40,
        .hold = 0.04f,
        .inward = 22,
        .inward_below = cut + 0.045f,
        .floor = cut + 0.010f * hair_noise(root, 0.012f, seed + 1),
        .face = 0.008f,
    };
    hair_style_trace_cut(&walk, root, scale, 0.03f, path);
    add_slight_wave(guide, root, scale, seed, 1, path);
}

static void grow_short(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    float top = hair_smooth(1.625f, 1.705f, root.y);
    struct hair_style_walk walk = {
        .comb = comb_from_parting(hair_style_parting(HAIR_STYLE_SHORT), root, 0.70f, 1.3f),
        .rise = hair_mix(0.25f, 0.32f, top),
        .clearance = hair_mix(0.005f, 0.013f, top) + 0.003f * hair_noise(root, 0.025f, seed),
        .lift = 0.02f,
        .gravity = 8,
        .hold = 0.04f,
        .press = 0.03f,
    };
    float length = hair_mix(0.026f, 0.068f, top) * (1 + 0.12f * hair_noise(root, 0.02f, seed + 1));
    hair_style_trace_to(&walk, root, scale * length, path);
}

// Give the lock of a guide a phase, a direction and a size of its own. Neighbouring locks of one
// phase would look like waves across the whole head. `spread` is the relative variation of the
// size.
static void make_lock(uint32_t guide, uint32_t seed, float spread, struct hair_curl* curl)
{
    uint32_t random = hair_hash(guide ^ hair_hash(seed));
    float size = 1 + spread * (2 * hair_random(&random) - 1);
    curl->radius *= size * (1 + 0.4f * spread * (2 * hair_random(&random) - 1));
    curl->pitch *= size;
    curl->phase = 2 * PI * hair_random(&random);
    curl->flat = hair_random(&random) < 0.5f ? -1 : 1;
    curl->seed = hair_hash(random);
}

static void grow_curly(uint32_t guide, hair_vec3 root, float scale, uint32_t seed,
                       struct hair_style_path* path)
{
    float high = layer(root), brow = hair_smooth(0.030f, 0.065f, root.z);
    struct hair_style_walk walk = {
        .comb = comb_from_parting(hair_style_parting(HAIR_STYLE_CURLY), root, 0.2f, 1.0f),
        // Volume at the root, but not before the forehead.
        .rise = hair_mix(0.45f, 0.18f, brow),
        .clearance = hair_mix(0.014f, 0.030f, high) + uneven(root, 0.007f, seed),
        .lift = hair_mix(0.03f, 0.07f, brow),
        .gravity = 40,
        .hold = 0.04f,
        .split = 15,
        .ridge = -0.034f,
        .floor = 1.385f + LAYERS * high + 0.025f * hair_noise(root, 0.012f, seed + 1),
        .face = 0.024f,
    };
    hair_style_trace_cut(&walk, root, scale, 0.04f, path);
    // A kink on a shoulder would be a jump of the curl.
    hair_style_path_smooth(path, 16);
    // Long hair pulls its own curls out. Tighter turns would be zigzags with 64 vertices.
    struct hair_curl curl = {.radius = 0.0095f,
                             .pitch = fmaxf(0.028f, path->length / (CURLY_TURNS * scale)),
                             .start = 0.002f,
                             .full = 0.05f,
                             .variation = 0.2f,
                             .swell = 0.25f,
                             .drift = 0.010f};
    make_lock(guide, seed + 2, 0.2f, &curl);
    hair_style_path_add_curl(path, &curl);
}

// Grow a tight helix from the root outwards to a sphere.
static void grow_afro(uint32_t guide, hair_vec3 root, float scale, uint32_t seed,
                      struct hair_style_path* path)
{
    const hair_vec3 center = {0, 1.648f, -0.014f};
    const float radius = 0.163f;
    hair_vec3 normal = hair_skull_normal(root);
    hair_vec3 out = hair_normalize(hair_sub(root, center), normal);
    hair_vec3 tip = hair_add(center, hair_scale(out, radius * (1 + 0.03f * hair_noise(root, 0.02f, seed))));
    // Scale the tip about the root. The path starts along the normal.
    tip = hair_lerp(root, tip, scale);
    hair_vec3 control = hair_add(root, hair_scale(normal, 0.4f * hair_distance(root, tip)));
    uint32_t count = 600;
    path->count = 0, path->length = 0;
    for (uint32_t i = 0; i <= count; ++i) {
        float t = (float)i / (float)count;
        hair_style_path_add(path, hair_lerp(hair_lerp(root, control, t), hair_lerp(control, tip, t), t));
    }
    struct hair_curl curl = {
        .radius = 0.0042f, .pitch = 0.012f, .start = 0.001f, .full = 0.012f, .variation = 0.25f};
    make_lock(guide, seed + 1, 0.2f, &curl);
    hair_style_path_add_curl(path, &curl);
}

// Return the direction away from the whorl, which hair without a parting has.
static hair_vec3 comb_from_whorl(hair_vec3 p)
{
    hair_vec3 normal = hair_skull_normal(p), whorl = hair_style_whorl((struct hair_parting){0});
    hair_vec3 away = hair_normalize(hair_tangential(hair_sub(p, whorl), normal), hair_v3(0, 0, 1));
    return hair_normalize(hair_tangential(hair_add(away, hair_v3(0, -0.3f, 0)), normal), away);
}

// A bob without a parting. Hair of the forehead is cut above the brows.
static void grow_fringe(uint32_t guide, hair_vec3 root, float scale, uint32_t seed,
                        struct hair_style_path* path)
{
    float high = layer(root), front = hair_smooth(0.005f, 0.030f, root.z);
    float cut = hair_mix(1.528f, 1.500f, hair_smooth(-0.07f, 0.04f, root.z));
    struct hair_style_walk walk = {
        .comb = comb_from_whorl(root),
        .rise = 0.16f,
        .clearance = hair_mix(0.005f, hair_mix(0.017f, 0.012f, front), high) + uneven(root, 0.002f, seed),
        .lift = 0.06f,
        .gravity = 40,
        .hold = 0.04f,
        .inward = 22,
        .inward_below = cut + 0.045f,
        .floor = cut + 0.006f * hair_noise(root, 0.012f, seed + 1),
        .face = hair_mix(0.004f, -0.06f, front),
        .fringe = 1.628f + 0.005f * hair_noise(root, 0.012f, seed + 1),
    };
    hair_style_trace_cut(&walk, root, scale, 0.03f, path);
    add_slight_wave(guide, root, scale, seed, 0.7f * (1 - front), path);
}

// Short hair whose sides and back fade to stubble towards the hairline.
static void grow_fade(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    float top = hair_smooth(1.615f, 1.705f, root.y + 0.15f * fmaxf(root.z, 0));
    struct hair_style_walk walk = {
        .comb = comb_from_parting(hair_style_parting(HAIR_STYLE_FADE), root, 0.70f, 1.3f),
        .rise = hair_mix(0.35f, 0.40f, top),
        .clearance = hair_mix(0.002f, 0.012f, top) + top * 0.003f * hair_noise(root, 0.025f, seed),
        .lift = 0.02f,
        .gravity = 8,
        .hold = 0.04f,
        .press = 0.03f,
    };
    float length = 0.004f * powf(14, top) * (1 + 0.12f * hair_noise(root, 0.02f, seed + 1));
    hair_style_trace_to(&walk, root, fmaxf(scale * length, 0.002f), path);
}

// -------------------------------------------------------------------------------------------------

uint32_t hair_style_vertices(hair_style style)
{
    switch (style) {
    case HAIR_STYLE_CURLY:
    case HAIR_STYLE_AFRO:
    case HAIR_STYLE_BUN:
    case HAIR_STYLE_BRAID: return 64;
    default: return 32;
    }
}

void hair_style_grow(hair_style style, uint32_t guide, hair_vec3 root, float scale, uint32_t seed,
                     struct hair_style_path* path)
{
    seed = hair_hash(seed + 101u);
    switch (style) {
    case HAIR_STYLE_LONG: grow_long(guide, root, scale, seed, path); break;
    case HAIR_STYLE_BOB: grow_bob(guide, root, scale, seed, path); break;
    case HAIR_STYLE_SHORT: grow_short(root, scale, seed, path); break;
    case HAIR_STYLE_PONYTAIL: hair_style_grow_ponytail(root, scale, seed, path); break;
    case HAIR_STYLE_CURLY: grow_curly(guide, root, scale, seed, path); break;
    case HAIR_STYLE_FRINGE: grow_fringe(guide, root, scale, seed, path); break;
    case HAIR_STYLE_FADE: grow_fade(root, scale, seed, path); break;
    case HAIR_STYLE_BUN: hair_style_grow_bun(root, scale, seed, path); break;
    case HAIR_STYLE_BRAID: hair_style_grow_braid(root, scale, seed, path); break;
    default: grow_afro(guide, root, scale, seed, path); break;
    }
}
