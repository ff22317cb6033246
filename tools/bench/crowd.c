// crowd.c - A haircut in motion, with every strand simulated or with strands between guides.
#include "tools/bench/crowd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/groom/groom.h"
#include "tools/bench/capsules.h"
#include "tools/bench/scene.h"

#define CROWD_KEYS 31
#define MIN_GUIDES 16 // of a built-in haircut
#define SHAKE 34.377f // degrees, which are 0.6 rad

const char* const crowd_motion_names[CROWD_MOTIONS] = {"shake", "contact", "wind"};

// Return copies of an array in a row, to be freed, or NULL without memory.
static void* repeat(const void* array, size_t size, uint32_t copies)
{
    char* all = malloc(size * copies);
    for (uint32_t i = 0; i < copies && all; ++i) memcpy(all + size * i, array, size);
    return all;
}

// Create a groom of `copies` of each strand.
static hair_result create_groom(hair_groom_desc* desc, uint32_t copies, hair_groom** out)
{
    size_t vertices = 0;
    for (uint32_t i = 0; i < desc->strand_count; ++i) vertices += desc->strand_vertices[i];
    float* positions = repeat(desc->positions, 3 * vertices * sizeof *positions, copies);
    uint32_t* counts = repeat(desc->strand_vertices, desc->strand_count * sizeof *counts, copies);
    desc->positions = positions;
    desc->strand_vertices = counts;
    desc->strand_count *= copies;
    hair_result result = positions && counts ? hair_groom_create(desc, out) : HAIR_ERROR_MEMORY;
    free(positions);
    free(counts);
    return result;
}

static hair_result make_groom(struct crowd* crowd)
{
    const struct crowd_desc* wanted = &crowd->desc;
    uint32_t copies = wanted->copies ? wanted->copies : 1;
    hair_style_desc style = hair_style_desc_default();
    hair_groom_desc desc = hair_groom_desc_default();
    hair_asset* asset = NULL;
    style.host = desc.host = &crowd->bench->host;
    style.style = wanted->style->style;
    style.guide_count = wanted->strands;
    if (wanted->grown) style.guide_count = wanted->guides > MIN_GUIDES ? wanted->guides : MIN_GUIDES;
    style.strand_vertices = wanted->style->segments + 1;
    hair_result result = hair_asset_generate(&style, &asset);
    if (!result) result = hair_asset_to_groom_desc(asset, &desc);
    desc.strand_set = wanted->grown ? HAIR_STRAND_SET_GUIDES : HAIR_STRAND_SET_FULL;
    desc.guide_count = wanted->guides;
    desc.guide_vertices = style.strand_vertices;
    desc.follower_count = wanted->strands * copies;
    if (!result) result = create_groom(&desc, wanted->grown ? 1 : copies, &crowd->groom);
    hair_asset_destroy(asset);
    return result;
}

// Return a look that leaves strands as they are interpolated.
static hair_look make_look(const struct crowd_style* style)
{
    hair_look look = hair_look_default();
    look.clump.interpolation = HAIR_INTERPOLATION_MULTI;
    look.strays.fraction = look.strays.tip_fraction = 0;
    look.strand.segments = style->segments;
    return look;
}

static hair_wind make_wind(void)
{
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = 3;
    wind.velocity[2] = -2;
    wind.turbulence.intensity = 0.4f;
    wind.turbulence.length = 0.3f;
    return wind;
}

// Set the keys of the head's motion. A shake is that of the suite `accuracy`, a yaw there and back.
// For contact the head turns to and fro faster and nods, so that hair swings onto the shoulders.
static void make_motion(enum crowd_motion motion, struct hair_motion* out)
{
    const float turn = 2 * (float)BENCH_PI;
    out->count = motion == CROWD_WIND ? 1 : CROWD_KEYS;
    for (uint32_t k = 0; k < out->count; ++k) {
        float time = (float)(k * CROWD_FRAMES * CROWD_FRAME / (CROWD_KEYS - 1));
        float *rotation = out->key[k].rotation, begun = fminf(4 * time, 1);
        out->key[k].time = time;
        if (motion == CROWD_SHAKE) rotation[0] = SHAKE * powf(sinf(0.5f * turn * time), 2);
        if (motion == CROWD_CONTACT) rotation[0] = 45 * begun * sinf(1.5f * turn * time);
        if (motion == CROWD_CONTACT) rotation[1] = 30 * begun * sinf(turn * time);
    }
}

static bool place(struct crowd* crowd)
{
    float time = (float)crowd->frame * (float)CROWD_FRAME, *transform = crowd->transform;
    hair_motion_at(&crowd->scene.motion, time, transform);
    if (crowd->desc.motion != CROWD_SHAKE)
        crowd->collider_count =
            hair_head_rig_colliders(&crowd->scene, NULL, time, transform, crowd->colliders);
    return !crowd->hair || (!hair_set_transform(crowd->hair, transform) &&
                            !hair_set_colliders(crowd->hair, crowd->colliders, crowd->collider_count,
                                                sizeof *crowd->colliders));
}

static bool make_instance(struct crowd* crowd)
{
    hair_look look = make_look(crowd->desc.style);
    hair_physics physics = hair_physics_default();
    hair_wind wind = make_wind();
    hair_desc desc = hair_desc_default();
    physics.sleep_threshold = 0;
    desc.solver = crowd->desc.solver;
    desc.thread_mapping = crowd->bench->options.mapping;
    desc.physics = &physics;
    desc.look = &look;
    if (!place(crowd)) return false;
    memcpy(desc.transform, crowd->transform, sizeof desc.transform);
    return !hair_create(crowd->bench->context, crowd->groom, &desc, &crowd->hair) &&
           (crowd->desc.motion != CROWD_WIND || !hair_set_wind(crowd->hair, &wind)) && place(crowd);
}

struct seed {
    uint32_t seed, follower;
};

static int compare(const void* a, const void* b)
{
    uint32_t x = ((const struct seed*)a)->seed, y = ((const struct seed*)b)->seed;
    return (x > y) - (x < y);
}

// Find the order of strands. The seed of a follower depends only on its strand, so the order of
// seeds is the same for every choice of guides.
static bool find_places(struct crowd* crowd)
{
    struct seed* seeds = malloc(crowd->strands * sizeof *seeds);
    for (uint32_t i = 0; i < crowd->strands && seeds; ++i)
        seeds[i] = (struct seed){crowd->groom->followers[i].seed, i};
    if (seeds) qsort(seeds, crowd->strands, sizeof *seeds, compare);
    for (uint32_t i = 0; i < crowd->strands && seeds; ++i) crowd->place[i] = seeds[i].follower;
    free(seeds);
    return seeds != NULL;
}

static bool make_all(struct crowd* crowd)
{
    hair_groom_info info = hair_groom_info_default();
    hair_scene_default(&crowd->scene);
    make_motion(crowd->desc.motion, &crowd->scene.motion);
    if (make_groom(crowd) || hair_groom_describe(crowd->groom, &info)) return false;
    crowd->strands = info.follower_count;
    crowd->guides = info.guide_count;
    crowd->vertices = crowd->desc.style->segments + 1;
    crowd->place = malloc(crowd->strands * sizeof *crowd->place);
    crowd->read = malloc(3 * sizeof *crowd->read * crowd->strands * crowd->vertices);
    return crowd->place && crowd->read && find_places(crowd) && make_instance(crowd);
}

bool bench_crowd_make(struct bench* bench, const struct crowd_desc* desc, struct crowd* out)
{
    memset(out, 0, sizeof *out);
    out->bench = bench;
    out->desc = *desc;
    snprintf(bench->sentence, sizeof bench->sentence, "the scene could not be made");
    if (make_all(out)) return true;
    bench_crowd_free(out);
    return false;
}

void bench_crowd_free(struct crowd* crowd)
{
    hair_destroy(crowd->hair);
    hair_groom_destroy(crowd->groom);
    hair_scene_free(&crowd->scene);
    free(crowd->place);
    free(crowd->read);
    memset(crowd, 0, sizeof *crowd);
}

bool bench_crowd_restart(struct crowd* crowd)
{
    crowd->frame = 0;
    return place(crowd) && !hair_reset(crowd->hair);
}

bool bench_crowd_step(struct crowd* crowd)
{
    ++crowd->frame;
    return place(crowd) && !hair_step(crowd->hair, (float)CROWD_FRAME);
}

bool bench_crowd_expand(struct crowd* crowd)
{
    hair_buffers buffers = hair_buffers_default();
    buffers.attributes = HAIR_ATTRIBUTE_POSITION;
    return !hair_get_buffers(crowd->hair, HAIR_READ_FOLLOWERS, &buffers);
}

bool bench_crowd_read(struct crowd* crowd, float* strands)
{
    uint32_t count = crowd->strands * crowd->vertices, there;
    size_t each = 3 * (size_t)crowd->vertices;
    if (hair_read_positions(crowd->hair, HAIR_READ_FOLLOWERS, crowd->read, count, &there) || there != count)
        return false;
    for (uint32_t i = 0; i < crowd->strands; ++i)
        memcpy(strands + each * i, crowd->read + each * crowd->place[i], each * sizeof *strands);
    return true;
}

uint32_t bench_crowd_count_inside(const struct crowd* crowd, const float* strands, double depth)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < crowd->strands && crowd->collider_count; ++i) {
        const float* strand = strands + 3 * (size_t)crowd->vertices * i;
        bool inside = false;
        for (uint32_t k = 1; k < crowd->vertices && !inside; ++k)
            inside = bench_capsule_distance(crowd->colliders, crowd->collider_count, strand + 3 * k) < -depth;
        count += inside;
    }
    return count;
}
