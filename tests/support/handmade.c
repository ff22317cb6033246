// handmade.c - synthetic grooms: guides that wander at random from a ball, and followers around
// them.
#include "tests/support/handmade.h"

#include <stdlib.h>

#include "lib/base/math.h"

#define Y_AXIS hair_v3(0, 1, 0)

struct hair_test_handmade hair_test_handmade_default(void)
{
    return (struct hair_test_handmade){.guides = 7,
                                       .fewest = 16,
                                       .max = 16,
                                       .segment = 0.01f,
                                       .turn = 0.3f,
                                       .followers = 64,
                                       .each = 16,
                                       .density = 1,
                                       .seed = 1};
}

// Allocate or abort. Tests of refused memory make their grooms before they refuse any.
static void* take(const hair_host* host, size_t count, size_t size)
{
    void* memory = hair_alloc(host, count, size);
    if (!memory) abort();
    return memory;
}

static float between(uint32_t* random, float min, float max)
{
    return min + (max - min) * hair_random(random);
}

// Return the i-th root, evenly over the upper half of the ball (Fibonacci's lattice).
static hair_vec3 find_root(uint32_t i, uint32_t count)
{
    float y = 0.1f + 0.9f * ((float)i + 0.5f) / (float)count;
    float r = sqrtf(1 - y * y);
    float angle = 2.399963f * (float)i;
    return hair_v3(0.1f * r * cosf(angle), 0.1f * y, 0.1f * r * sinf(angle));
}

static hair_vec3 turn_a_little(hair_vec3 direction, float max, uint32_t* random)
{
    hair_vec3 side = hair_perpendicular(direction);
    hair_vec3 other = hair_cross(direction, side);
    float about = between(random, 0, 6.2831853f), angle = between(random, 0, max);
    hair_vec3 to = hair_add(hair_scale(side, cosf(about)), hair_scale(other, sinf(about)));
    return hair_add(hair_scale(direction, cosf(angle)), hair_scale(to, sinf(angle)));
}

static void place_guide(struct hair_guide* guide, struct hair_rest* rest, hair_vec3 root,
                        const struct hair_test_handmade* wanted, uint32_t* random)
{
    hair_vec3 at = root, direction = hair_normalize(root, Y_AXIS);
    hair_quat frame = hair_quat_between(Y_AXIS, direction);
    guide->root_frame = (hair_vec4){frame.x, frame.y, frame.z, frame.w};
    for (uint32_t i = 0; i < guide->count; ++i) {
        int tip = i + 1 == guide->count;
        float length = tip ? 0 : wanted->segment * between(random, 0.7f, 1.3f);
        if (i > 0 && !tip) {
            hair_vec3 to = hair_normalize(turn_a_little(direction, wanted->turn, random), direction);
            frame = hair_quat_normalize(hair_quat_multiply(hair_quat_between(direction, to), frame));
            direction = to;
        }
        rest[i].position = (hair_vec4){at.x, at.y, at.z, length};
        rest[i].frame = (hair_vec4){frame.x, frame.y, frame.z, frame.w};
        at = hair_add(at, hair_scale(direction, length));
        guide->arc_length += length;
    }
}

static void place_follower(struct hair_follower* follower, uint32_t number, uint32_t guides, uint32_t* random)
{
    float a = hair_random(random), b = hair_random(random);
    follower->guide0 = number % guides;
    follower->guide1 = (number + 1) % guides;
    follower->guide2 = (number + 2) % guides;
    follower->seed = hair_hash(number);
    follower->weight1 = a + b < 1 ? a : 1 - a;
    follower->weight2 = a + b < 1 ? b : 1 - b;
    follower->length_ratio = between(random, 0.5f, 1.1f);
    follower->multi = number % 3 == 0 ? 0 : number % 3 == 1 ? 1 : hair_random(random);
    for (int i = 0; i < 4; ++i)
        follower->offset[i] = (hair_vec4){between(random, -0.01f, 0.01f), between(random, -0.002f, 0.002f),
                                          between(random, -0.01f, 0.01f), between(random, -0.002f, 0.002f)};
    follower->offset[0].w = 1 + (float)number / 65536;
}

static void place_patch(struct hair_patch* patch, uint32_t first, const struct hair_test_handmade* wanted)
{
    uint32_t left = wanted->followers - first;
    patch->first = first;
    patch->count = left < wanted->each ? left : wanted->each;
    patch->density = wanted->density;
    patch->map_density = patch->map_thickness = (hair_vec4){1, 1, 1, 1};
}

static uint32_t count_vertices(const struct hair_test_handmade* wanted, uint32_t guide)
{
    if (wanted->vertices) return wanted->vertices[guide];
    return wanted->fewest + guide % (wanted->max - wanted->fewest + 1);
}

// Write the lengths and the bounds of the guides.
static void measure_guides(hair_groom* groom)
{
    hair_groom_info* info = &groom->info;
    float sum = 0;
    info->length[0] = INFINITY;
    for (int k = 0; k < 3; ++k) info->lower[k] = INFINITY, info->upper[k] = -INFINITY;
    for (uint32_t i = 0; i < info->guide_count; ++i) {
        info->length[0] = fminf(info->length[0], groom->guides[i].arc_length);
        info->length[2] = fmaxf(info->length[2], groom->guides[i].arc_length);
        sum += groom->guides[i].arc_length;
    }
    info->length[1] = sum / (float)info->guide_count;
    for (uint32_t i = 0; i < info->guide_vertex_count; ++i) {
        hair_vec4 p = groom->rest[i].position;
        const float at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; ++k) {
            info->lower[k] = fminf(info->lower[k], at[k]);
            info->upper[k] = fmaxf(info->upper[k], at[k]);
        }
    }
}

hair_groom* hair_test_groom(const hair_host* host, struct hair_test_handmade wanted)
{
    uint32_t random = wanted.seed, vertices = 0;
    for (uint32_t i = 0; i < wanted.guides; ++i) vertices += count_vertices(&wanted, i);
    uint32_t patches = (wanted.followers + wanted.each - 1) / wanted.each;
    hair_groom* groom = take(host, 1, sizeof *groom);
    groom->host = *host;
    atomic_init(&groom->holders, 1);
    groom->guides = take(host, wanted.guides, sizeof *groom->guides);
    groom->rest = take(host, vertices, sizeof *groom->rest);
    groom->info.follower_count = wanted.followers;
    groom->followers = take(host, hair_groom_follower_bytes(groom) / 16, 16);
    groom->patches = take(host, patches, sizeof *groom->patches);

    uint32_t first = 0;
    for (uint32_t i = 0; i < wanted.guides; ++i) {
        struct hair_guide* guide = &groom->guides[i];
        guide->first = first;
        guide->count = count_vertices(&wanted, i);
        place_guide(guide, groom->rest + first, find_root(i, wanted.guides), &wanted, &random);
        first += guide->count;
        if (guide->count > groom->max_vertices) groom->max_vertices = guide->count;
    }
    for (uint32_t i = 0; i < wanted.followers; ++i)
        place_follower(&groom->followers[i], i, wanted.guides, &random);
    for (uint32_t i = 0; i < patches; ++i) place_patch(&groom->patches[i], i * wanted.each, &wanted);
    groom->info.guide_count = wanted.guides;
    groom->info.guide_vertex_count = vertices;
    groom->info.patch_count = patches;
    measure_guides(groom);
    if (hair_measure_rest(groom) || hair_order_guides(groom)) abort();
    hair_measure_patches(groom);
    groom->head_sphere = hair_find_head_sphere(groom);
    return groom;
}

static hair_vec4 anywhere(uint32_t* random, hair_vec4 around, float reach)
{
    float x = between(random, -reach, reach), y = between(random, -reach, reach),
          z = between(random, -reach, reach);
    return (hair_vec4){around.x + x, around.y + y, around.z + z, 0};
}

void hair_test_scatter(const hair_groom* groom, float away, float moved, uint32_t* random,
                       struct hair_state* state)
{
    for (uint32_t i = 0; i < groom->info.guide_vertex_count; ++i) {
        state[i].position = anywhere(random, groom->rest[i].position, away);
        state[i].displacement = anywhere(random, (hair_vec4){0}, moved);
    }
}
