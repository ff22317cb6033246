// extent.c - Extents of a studio's picture and shadow map, from the projections of camera and
// light.
#include "tools/bench/extent.h"

#include <math.h>

#define TEXELS 4 // minimum texels of a shadow map per pixel
#define MIN_MAP 256 // texels per side

// Return the pixels per metre of a projection at a distance.
static float scale_of(const struct hair_matrices* matrices, float distance, uint32_t pixels)
{
    const float* p = matrices->projection;
    return 0.5f * (float)pixels * p[5] / (p[15] > 0 ? 1 : distance);
}

static float distance_of(const struct bench_studio* studio, float away)
{
    const struct hair_scene* scene = &studio->scene;
    float square = 0;
    for (int i = 0; i < 3; ++i) square += powf(away * (scene->eye[i] - scene->target[i]), 2);
    return sqrtf(square);
}

void bench_extent_shift(struct hair_matrices* matrices, const float by[2], uint32_t size)
{
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 2; ++i)
            matrices->projection[4 * column + i] +=
                2 * by[i] / (float)size * matrices->projection[4 * column + 3];
}

void bench_extent_aim(const struct bench_studio* studio, struct hair_matrices* out)
{
    struct hair_scene scene = studio->scene;
    for (int i = 0; i < 3; ++i)
        scene.eye[i] = scene.target[i] + studio->shot.away * (scene.eye[i] - scene.target[i]);
    hair_camera_matrices(&scene, studio->transform, studio->reach, out);
    bench_extent_shift(out, studio->shot.jitter, studio->size);
}

float bench_extent_scale(const struct bench_studio* studio, float away)
{
    struct hair_matrices camera;
    hair_camera_matrices(&studio->scene, studio->transform, studio->reach, &camera);
    return scale_of(&camera, distance_of(studio, away), studio->size);
}

float bench_extent_texel(const struct bench_studio* studio, const struct hair_matrices* camera,
                         const struct hair_matrices* light, uint32_t size)
{
    uint32_t pixels = studio->size * studio->shot.supersample;
    float distance = distance_of(studio, studio->shot.away);
    return scale_of(camera, distance, pixels) / scale_of(light, 1, size);
}

bool bench_extent_fits(const struct bench_studio* studio, const struct hair_matrices* light, uint32_t size)
{
    const struct bench_shot* shot = &studio->shot;
    float wide = 2 * shot->look.strand.radius;
    if (shot->has_lod && !shot->lod.per_patch) wide /= fmaxf(shot->lod.strand_fraction, 1e-3f);
    return shot->map_fits && wide * scale_of(light, 1, size) >= 1;
}

uint32_t bench_extent_map(const struct bench_studio* studio, const struct hair_matrices* camera,
                          const struct hair_matrices* light)
{
    uint32_t size = HAIR_SHADOW_SIZE;
    while (size > MIN_MAP && bench_extent_fits(studio, light, size / 2)) size /= 2;
    if (!studio->shot.has_lod || !studio->shot.lod.per_patch || studio->shot.map_whole) return size;
    while (size > MIN_MAP && TEXELS * bench_extent_texel(studio, camera, light, size / 2) <= 1) size /= 2;
    return size;
}

// Return the bounds of the hair's sphere in the picture. The sphere contains all hair for any
// rotation of the head. The perspective bounds of its box are used.
struct bench_rectangle bench_extent_hair(const struct bench_studio* studio,
                                         const struct hair_matrices* camera, uint32_t pixels)
{
    const float *v = camera->view, *p = camera->projection;
    struct bench_rectangle all = {{0, 0}, {(int)pixels, (int)pixels}}, part = all;
    float world[3], seen[3], half = 0.5f * (float)pixels, reach = studio->reach;
    hair_camera_pivot(&studio->scene, studio->transform, world);
    for (int i = 0; i < 3; ++i)
        seen[i] = v[i] * world[0] + v[4 + i] * world[1] + v[8 + i] * world[2] + v[12 + i];
    if (-seen[2] <= 2 * reach) return all;
    for (int i = 0; i < 2; ++i) {
        float nearest = -seen[2] - reach, farthest = -seen[2] + reach, low = seen[i] - reach,
              high = seen[i] + reach;
        float from = p[5 * i] * low / (low < 0 ? nearest : farthest) - p[8 + i];
        float to = p[5 * i] * high / (high < 0 ? farthest : nearest) - p[8 + i];
        part.lower[i] = (int)fminf(fmaxf(floorf(half * (1 + from)) - 1, 0), (float)pixels);
        part.upper[i] = (int)fminf(fmaxf(ceilf(half * (1 + to)) + 1, 0), (float)pixels);
    }
    return part;
}
