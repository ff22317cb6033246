// style_tied.c - guides combed to a hair tie, from which they go on as a ponytail, bun or braid.
#include "lib/groom/style_grow.h"
#include "lib/groom/style_body.h"

#define PI 3.14159265f
#define STRIDE HAIR_STYLE_PATH_STRIDE
#define TIE_RADIUS 0.011f
#define TAIL_LENGTH 0.28f
#define BUN_LENGTH 0.38f
#define BRAID_LENGTH 0.36f
#define BRAID_PITCH 0.085f // Length in which a strand of the braid returns to its place, m.
#define BRAID_TUFT 0.84f // Fraction of the braid's length behind which its end is tied.

struct hair_tie {
    hair_vec3 at, axis; // The axis is a unit vector out of the head.
};

static const struct hair_tie high_tie = {{0, 1.672f, -0.106f}, {0, 0.243f, -0.970f}};
static const struct hair_tie low_tie = {{0, 1.590f, -0.103f}, {0, -0.600f, -0.800f}};

static void comb_to_tie(const struct hair_tie* tie, hair_vec3 root, struct hair_style_path* path)
{
    hair_vec3 under = hair_skull_point(hair_skull_unit(tie->at));
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
static void gather(const struct hair_tie* tie, hair_vec3 through, hair_vec3 normal,
                   struct hair_style_path* path)
{
    hair_vec3 a = path->point[path->count - 1];
    hair_vec3 from = path->count > 1 ? hair_sub(a, path->point[path->count - 2]) : normal;
    float size = hair_distance(a, through);
    from = hair_scale(hair_normalize(from, normal), size);
    hair_vec3 to = hair_scale(tie->axis, size);
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
    hair_vec3 p = high_tie.at, d = high_tie.axis;
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

// Comb hair to a tie and through it. Return the place of the hair in the tie, relative to its
// middle. Hair from far away lies over hair from near by, so it is farther from the middle.
static hair_vec3 tie_up(const struct hair_tie* tie, hair_vec3 root, struct hair_style_path* path)
{
    path->count = 0, path->length = 0;
    comb_to_tie(tie, root, path);
    hair_vec3 side = hair_sub(path->point[path->count - 1], tie->at);
    float away = fminf(hair_distance(root, tie->at) / 0.22f, 1);
    hair_vec3 offset =
        hair_scale(hair_normalize(hair_tangential(side, tie->axis), hair_v3(0, 1, 0)), TIE_RADIUS * away);
    gather(tie, hair_add(tie->at, offset), hair_skull_normal(root), path);
    return offset;
}

void hair_style_grow_ponytail(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    hair_vec3 offset = tie_up(&high_tie, root, path);
    fall(offset, scale * TAIL_LENGTH * (1 + 0.08f * hair_noise(root, 0.02f, seed)), path);
    struct hair_curl wave = {.radius = 0.004f,
                             .pitch = 0.12f,
                             .start = path->length - 0.2f * scale,
                             .full = path->length,
                             .phase = PI * hair_noise(root, 0.1f, seed + 1),
                             .flat = 0.5f};
    hair_style_path_add_curl(path, &wave);
}

// Wind the hair into a coil around the axis of the tie. The coil is a rope that turns about its own
// middle. Each turn is wider than the last and nearer to the head, under which the end is hidden.
void hair_style_grow_bun(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    const struct hair_tie* tie = &high_tie;
    const hair_vec3 left = {1, 0, 0}, up = hair_cross(left, tie->axis);
    hair_vec3 offset = tie_up(tie, root, path);
    float from_left = hair_dot(offset, left), from_up = hair_dot(offset, up);
    float length = scale * BUN_LENGTH * (1 + 0.02f * hair_noise(root, 0.02f, seed)), angle = 0;
    for (float s = STRIDE; s < length && path->count < HAIR_STYLE_PATH_POINTS; s += STRIDE) {
        float t = s / length, begun = hair_smooth(0, 0.06f, s), wide = hair_mix(0.019f, 0.031f, t);
        float rope = hair_mix(1, 1.2f, begun) * hair_mix(1, 0.5f, hair_smooth(0.8f, 1, t));
        angle += begun * STRIDE / wide;
        hair_vec3 away = hair_add(hair_scale(left, cosf(angle)), hair_scale(up, sinf(angle)));
        hair_vec3 along = hair_sub(hair_scale(up, cosf(angle)), hair_scale(left, sinf(angle)));
        // The section of the rope is across its direction, which leaves the axis for the coil.
        hair_vec3 second = hair_normalize(hair_cross(away, hair_lerp(tie->axis, along, begun)), up);
        float turn = begun * s / 0.045f, x = rope * (cosf(turn) * from_left - sinf(turn) * from_up),
              y = rope * (sinf(turn) * from_left + cosf(turn) * from_up);
        hair_vec3 p = hair_add(tie->at, hair_scale(away, begun * wide + x));
        p = hair_add(p, hair_scale(tie->axis, hair_mix(0.024f, 0.002f, t) * hair_smooth(0, 0.06f, s)));
        hair_style_path_add(path, hair_add(p, hair_scale(second, y)));
    }
}

// Find the middle of a strand of the braid at the distance s from the tie: its distances to the
// left of the braid's middle and away from the back. The strands follow a figure of eight.
static void find_strand(uint32_t strand, float s, float length, float* left, float* off)
{
    float phase = 2 * PI * (s / BRAID_PITCH + (float)strand / 3), t = s / length;
    float width = hair_mix(1, 0.7f, t) * (1 - 0.75f * hair_smooth(BRAID_TUFT - 0.06f, BRAID_TUFT, t));
    *left = 0.0135f * width * sinf(phase), *off = 0.0065f * width * sinf(2 * phase);
}

void hair_style_grow_braid(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path)
{
    const struct hair_tie* tie = &low_tie;
    const hair_vec3 left = {1, 0, 0};
    hair_vec3 offset = tie_up(tie, root, path), up = hair_cross(left, tie->axis);
    // A third of the hair, by the side from which it comes, is one strand.
    float from_left = hair_dot(offset, left), from_up = hair_dot(offset, up);
    float angle = atan2f(from_up, from_left) + PI, third = 2 * PI / 3;
    uint32_t strand = (uint32_t)fminf(angle / third, 2);
    float middle = ((float)strand + 0.5f) * third - PI;
    float x = 1.1f * from_left - 0.6f * TIE_RADIUS * cosf(middle),
          y = 1.1f * from_up - 0.6f * TIE_RADIUS * sinf(middle);
    float length = scale * BRAID_LENGTH * (1 + 0.05f * hair_noise(root, 0.02f, seed));
    hair_vec3 p = tie->at, d = tie->axis;
    for (float s = STRIDE; s < length && path->count < HAIR_STYLE_PATH_POINTS; s += STRIDE) {
        hair_vec3 next = hair_normalize(hair_add(d, hair_v3(0, -24 * STRIDE, 0)), d);
        float height = hair_body_distance(p), t = s / length;
        if (height < 0.025f)
            next =
                hair_normalize(hair_add(next, hair_scale(hair_body_normal(p), (0.025f - height) * 4)), next);
        up = hair_rotate(hair_quat_between(d, next), up);
        d = next;
        p = hair_add(p, hair_scale(d, STRIDE));
        float to_left, to_off;
        find_strand(strand, s, length, &to_left, &to_off);
        float tied = hair_smooth(BRAID_TUFT - 0.05f, BRAID_TUFT, t), loose = hair_smooth(BRAID_TUFT, 1, t);
        float thick = hair_mix(1, 0.7f, t) * (1 - 0.6f * tied + 0.9f * loose),
              begun = hair_smooth(0, 0.03f, s);
        float across = hair_mix(from_left, to_left + thick * x, begun),
              off = hair_mix(from_up, to_off + thick * y, begun);
        hair_style_path_add(path, hair_add(p, hair_add(hair_scale(left, across), hair_scale(up, off))));
    }
}
