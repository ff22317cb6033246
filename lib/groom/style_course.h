// style_course.h - a guide as it grows: its points, where they may wander, how they curl.
#ifndef HAIR_GROOM_STYLE_COURSE_H
#define HAIR_GROOM_STYLE_COURSE_H

#include "lib/base/math.h"

#define HAIR_COURSE_POINTS 2048 // Most points of a course.
#define HAIR_COURSE_STRIDE 0.002f // Between them, m: a tenth of the sharpest bend of the built-in haircuts.

// More points than the guide will have, root first.
struct hair_course {
    hair_vec3 point[HAIR_COURSE_POINTS];
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

// Value noise in [-1, 1] that changes over `scale` metres: neighbouring roots get near values.
float hair_noise(hair_vec3 p, float scale, uint32_t seed);

// A point nearer to the last than a micrometre, or one too many, is left out.
void hair_course_add(struct hair_course* course, hair_vec3 p);

// Take off what is longer than `most` metres, a stride or less.
void hair_course_trim(struct hair_course* course, float most);

struct hair_curl {
    float radius, pitch; // m
    float start, full; // distance from the root where it begins, and where the radius is reached, m
    float phase; // radians
    float flat; // 1: a helix; 0: a wave in one plane
};

// Lay a helix round a course, in a frame carried along it without twist, clear of the bust.
void hair_course_wind(struct hair_course* course, const struct hair_curl* curl);

#endif
