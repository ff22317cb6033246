// style_path.h - a guide as it grows: its points, random variation and curls.
#ifndef HAIR_GROOM_STYLE_PATH_H
#define HAIR_GROOM_STYLE_PATH_H

#include "lib/base/math.h"

#define HAIR_STYLE_PATH_POINTS 2048 // Maximum number of points of a path.
// Distance between points, m. A tenth of the sharpest bend radius of the built-in haircuts.
#define HAIR_STYLE_PATH_STRIDE 0.002f

// Points of a guide, root first. There are more points than the guide will have.
struct hair_style_path {
    hair_vec3 point[HAIR_STYLE_PATH_POINTS];
    uint32_t count;
    float length; // m
};

static inline float hair_smooth(float from, float to, float x)
{
    float t = fminf(fmaxf((x - from) / (to - from), 0), 1);
    return t * t * (3 - 2 * t);
}

static inline float hair_mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

static inline hair_vec3 hair_tangential(hair_vec3 v, hair_vec3 normal)
{
    return hair_sub(v, hair_scale(normal, hair_dot(v, normal)));
}

// Return value noise in [-1, 1] that varies over `scale` metres. Neighbouring roots get similar
// values.
float hair_noise(hair_vec3 p, float scale, uint32_t seed);

// Append a point. Skip a point within a micrometre of the last one, and any point beyond the
// maximum.
void hair_style_path_add(struct hair_style_path* path, hair_vec3 p);

// Shorten the path to `max` metres. At most one stride is removed.
void hair_style_path_trim(struct hair_style_path* path, float max);

// Smooth the path by rounds of a binomial filter. The ends stay.
void hair_style_path_smooth(struct hair_style_path* path, uint32_t rounds);

struct hair_curl {
    float radius, pitch; // m
    // Distances from the root at which the curl starts and at which its radius is reached, m.
    float start, full;
    float phase; // radians
    float flat; // 1 gives a helix to the right, -1 one to the left, 0 a plane wave.
    float variation; // relative variation of the radius and of the pitch along the curl, [0, 0.9]
    float swell; // further relative variation of the radius, [0, 0.5]
    float drift; // distance by which the axis leaves the path, m
    uint32_t seed; // of this variation
};

// Wind the path into a helix, in a frame transported along it without twist, outside the bust.
void hair_style_path_add_curl(struct hair_style_path* path, const struct hair_curl* curl);

#endif
