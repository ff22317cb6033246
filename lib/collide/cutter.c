// cutter.c - the first place of a segment in a half space, in a capsule, or on a swept blade.
#include "lib/collide/cutter.h"

#define SEARCHES 40 // Steps of a search that keeps two thirds. They reach the last bit of a float.
#define BISECTIONS 24
#define SLACK 1e-5f // Rounding of a distance relative to the positions.

static hair_vec3 from_origin(const float position[3], const double origin[3])
{
    return hair_v3((float)((double)position[0] - origin[0]), (float)((double)position[1] - origin[1]),
                   (float)((double)position[2] - origin[2]));
}

struct hair_cutter hair_cutter_from(const hair_cut_desc* desc, const double origin[3])
{
    return (struct hair_cutter){.shape = desc->shape,
                                .start = from_origin(desc->start, origin),
                                .end = from_origin(desc->end, origin),
                                .last_start = from_origin(desc->last_start, origin),
                                .last_end = from_origin(desc->last_end, origin),
                                .normal = hair_normalize(hair_load3(desc->normal), hair_v3(0, -1, 0)),
                                .radius = desc->radius};
}

static bool meets_plane(const struct hair_cutter* cutter, hair_vec3 a, hair_vec3 b, float* t)
{
    float at_a = hair_dot(hair_sub(a, cutter->start), cutter->normal);
    float at_b = hair_dot(hair_sub(b, cutter->start), cutter->normal);
    if (at_a < 0 && at_b < 0) return false;
    *t = at_a < 0 ? at_a / (at_a - at_b) : 0;
    return true;
}

// Return the distance from the axis of a capsule.
static float distance_from_axis(const struct hair_cutter* cutter, hair_vec3 p)
{
    hair_vec3 axis = hair_sub(cutter->end, cutter->start), arm = hair_sub(p, cutter->start);
    float squared = hair_dot(axis, axis);
    float along = squared > 0 ? fminf(fmaxf(hair_dot(arm, axis) / squared, 0), 1) : 0;
    return hair_distance(arm, hair_scale(axis, along));
}

// Return the place where the segment is nearest to the axis. Their distance is a convex function of
// the place.
static float nearest_place(const struct hair_cutter* cutter, hair_vec3 a, hair_vec3 b)
{
    float low = 0, high = 1;
    for (int i = 0; i < SEARCHES; ++i) {
        float third = (high - low) / 3;
        float at_low = distance_from_axis(cutter, hair_lerp(a, b, low + third));
        if (at_low < distance_from_axis(cutter, hair_lerp(a, b, high - third)))
            high -= third;
        else
            low += third;
    }
    return (low + high) / 2;
}

static bool meets_capsule(const struct hair_cutter* cutter, hair_vec3 a, hair_vec3 b, float* t)
{
    float away = distance_from_axis(cutter, a) - cutter->radius;
    if (away > hair_distance(a, b)) return false;
    float low = 0, high = away <= 0 ? 0 : nearest_place(cutter, a, b);
    if (distance_from_axis(cutter, hair_lerp(a, b, high)) > cutter->radius) return false;
    for (int i = 0; i < BISECTIONS; ++i) {
        float middle = (low + high) / 2;
        if (distance_from_axis(cutter, hair_lerp(a, b, middle)) <= cutter->radius)
            high = middle;
        else
            low = middle;
    }
    *t = high;
    return true;
}

// Based on: Moeller and Trumbore 1997, "Fast, minimum storage ray/triangle intersection".
static bool meets_triangle(const hair_vec3 corner[3], hair_vec3 a, hair_vec3 b, float* t)
{
    hair_vec3 way = hair_sub(b, a), arm = hair_sub(a, corner[0]);
    hair_vec3 side1 = hair_sub(corner[1], corner[0]), side2 = hair_sub(corner[2], corner[0]);
    hair_vec3 h = hair_cross(way, side2), q = hair_cross(arm, side1);
    float scale = hair_dot(side1, h);
    if (scale == 0) return false;
    float u = hair_dot(arm, h) / scale, v = hair_dot(way, q) / scale, at = hair_dot(side2, q) / scale;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 1)) return false;
    *t = at;
    return true;
}

static bool meets_blade(const struct hair_cutter* cutter, hair_vec3 a, hair_vec3 b, float* t)
{
    const hair_vec3 first[3] = {cutter->last_start, cutter->last_end, cutter->end};
    const hair_vec3 second[3] = {cutter->last_start, cutter->end, cutter->start};
    float other;
    bool meets = meets_triangle(first, a, b, t);
    if (!meets_triangle(second, a, b, &other)) return meets;
    *t = meets ? fminf(*t, other) : other;
    return true;
}

bool hair_cutter_meets(const struct hair_cutter* cutter, hair_vec3 a, hair_vec3 b, float* t)
{
    switch (cutter->shape) {
    case HAIR_CUT_SHAPE_PLANE: return meets_plane(cutter, a, b, t);
    case HAIR_CUT_SHAPE_CAPSULE: return meets_capsule(cutter, a, b, t);
    case HAIR_CUT_SHAPE_BLADE: break;
    }
    return meets_blade(cutter, a, b, t);
}

// Return whether a plane has a point of a box on its side.
static bool plane_reaches(const struct hair_cutter* cutter, hair_vec3 lower, hair_vec3 upper)
{
    hair_vec3 n = cutter->normal;
    hair_vec3 corner = {n.x > 0 ? upper.x : lower.x, n.y > 0 ? upper.y : lower.y,
                        n.z > 0 ? upper.z : lower.z};
    hair_vec3 arm = hair_sub(corner, cutter->start);
    return !(hair_dot(arm, n) < -SLACK * hair_length(arm));
}

// Return the distance between the box around the positions of a shape and another box. `size`
// receives the greatest coordinate of the positions.
static float distance_from_box(const struct hair_cutter* cutter, hair_vec3 lower, hair_vec3 upper,
                               float* size)
{
    const hair_vec3* const own[4] = {&cutter->start, &cutter->end, &cutter->last_start, &cutter->last_end};
    float squared = 0;
    *size = 0;
    for (int k = 0; k < 3; ++k) {
        float low = INFINITY, high = -INFINITY, gap;
        for (int i = 0; i < (cutter->shape == HAIR_CUT_SHAPE_BLADE ? 4 : 2); ++i) {
            low = fminf(low, (&own[i]->x)[k]);
            high = fmaxf(high, (&own[i]->x)[k]);
        }
        gap = fmaxf(fmaxf((&lower.x)[k] - high, low - (&upper.x)[k]), 0);
        squared += gap * gap;
        *size = fmaxf(*size, fmaxf(fabsf(low), fabsf(high)));
    }
    return sqrtf(squared);
}

bool hair_cutter_reaches(const struct hair_cutter* cutter, hair_vec3 lower, hair_vec3 upper)
{
    float size, radius = cutter->shape == HAIR_CUT_SHAPE_CAPSULE ? cutter->radius : 0;
    if (cutter->shape == HAIR_CUT_SHAPE_PLANE) return plane_reaches(cutter, lower, upper);
    return !(distance_from_box(cutter, lower, upper, &size) > radius + SLACK * (size + radius));
}
