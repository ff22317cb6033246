// style_ponytail.c - guides combed back to a hair tie behind the crown, from which they fall as a
// tail.
#include "lib/groom/style_grow.h"
#include "lib/groom/style_body.h"

#define PI 3.14159265f
#define STRIDE HAIR_STYLE_PATH_STRIDE
#define TIE_RADIUS 0.011f
#define TAIL_LENGTH 0.28f

static const hair_vec3 tie = {0, 1.672f, -0.106f};
static const hair_vec3 tie_axis = {0, 0.243f, -0.970f}; // unit vector out of the head

static void comb_to_tie(hair_vec3 root, struct hair_style_path* path)
{
    hair_vec3 under = hair_skull_point(hair_skull_unit(tie));
    hair_vec3 p = root, normal = hair_skull_normal(root);
    float above = hair_body_distance(root);
    hair_vec3 d =
        hair_normalize(hair_lerp(hair_tangential(hair_sub(under, root), normal), normal, 0.02f), normal);
    hair_style_path_add(path, p);
    while (hair_distance(p, under) > 0.034f && path->length < 0.5f) {
        hair_vec3 last = p;
        normal = hair_skull_normal(p);
        hair_vec3 to = hair_normalize(hair_tangential(hair_sub(under, p), normal), d);
        d = hair_normalize(hair_lerp(d, to, 0.15f), to);
        p = hair_add(p, hair_scale(d, STRIDE));
        float height = hair_body_distance(p);
        float wanted = above + (0.003f + 0.03f * path->length) * (1 - expf(-path->length / 0.015f));
        p = hair_add(p, hair_scale(hair_body_normal(p), fmaxf(fminf(wanted - height, STRIDE), -STRIDE)));
        d = hair_normalize(hair_sub(p, last), d);
        hair_style_path_add(path, p);
    }
}

// Append a cubic Hermite curve from the end of the path through the hair tie.
static void gather(hair_vec3 through, hair_vec3 normal, struct hair_style_path* path)
{
    hair_vec3 a = path->point[path->count - 1];
    hair_vec3 from = path->count > 1 ? hair_sub(a, path->point[path->count - 2]) : normal;
    float size = hair_distance(a, through);
    from = hair_scale(hair_normalize(from, normal), size);
    hair_vec3 to = hair_scale(tie_axis, size);
    for (int i = 1; i <= 40; ++i) {
        float t = (float)i / 40, u = 1 - t;
        hair_vec3 p = hair_add(hair_scale(a, u * u * (1 + 2 * t)), hair_scale(through, t * t * (3 - 2 * t)));
        p = hair_add(p, hair_add(hair_scale(from, t * u * u), hair_scale(to, -t * t * u)));
        hair_style_path_add(path, p);
    }
}

// Append the tail. All hairs follow its centre line and keep their place around it. The tail
// swells, then tapers.
static void fall(hair_vec3 offset, float length, struct hair_style_path* path)
{
    hair_vec3 p = tie, d = tie_axis;
    for (float s = 0; s < length && path->count < HAIR_STYLE_PATH_POINTS; s += STRIDE) {
        hair_vec3 next = hair_normalize(hair_add(d, hair_v3(0, -24 * STRIDE, 0)), d);
        float height = hair_body_distance(p);
        if (height < 0.03f)
            next =
                hair_normalize(hair_add(next, hair_scale(hair_body_normal(p), (0.03f - height) * 4)), next);
        offset = hair_rotate(hair_quat_between(d, next), offset);
        d = next;
        p = hair_add(p, hair_scale(d, STRIDE));
        float t = s / length;
        float swell = 1 + 1.5f * hair_smooth(0, 0.30f, t) - 1.7f * hair_smooth(0.35f, 1.0f, t);
        hair_style_path_add(path, hair_add(p, hair_scale(offset, swell)));
    }
}

void hair_style_grow_ponytail(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    hair_vec3 normal = hair_skull_normal(root);
    path->count = 0, path->length = 0;
    comb_to_tie(root, path);
    // Hair from far away lies over hair from near by, so it is farther from the centre of the hair
    // tie.
    hair_vec3 side = hair_sub(path->point[path->count - 1], tie);
    float away = fminf(hair_distance(root, tie) / 0.22f, 1);
    hair_vec3 offset =
        hair_scale(hair_normalize(hair_tangential(side, tie_axis), hair_v3(0, 1, 0)), TIE_RADIUS * away);
    gather(hair_add(tie, offset), normal, path);
    fall(offset, scale * TAIL_LENGTH * (1 + 0.08f * hair_noise(root, 0.02f, seed)), path);
    struct hair_curl wave = {.radius = 0.004f,
                             .pitch = 0.12f,
                             .start = path->length - 0.2f * scale,
                             .full = path->length,
                             .phase = PI * hair_noise(root, 0.1f, seed + 1),
                             .flat = 0.5f};
    hair_style_path_add_curl(path, &wave);
}
