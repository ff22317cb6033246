// guide_spline.c - a guide at rest, sampled at equal distances along the spline through its
// vertices.
//
// The spline is cubic Hermite, with the tangents of the parabola through three neighbours. These
// tangents prevent overshoot at segments of unequal length.
#include "lib/groom/guide_spline.h"

// A guide as a polyline: position and distance from the root per vertex, direction and frame per
// segment.
struct polyline {
    hair_vec3 vertex[HAIR_MAX_GUIDE_VERTICES];
    float from_root[HAIR_MAX_GUIDE_VERTICES];
    hair_vec3 direction[HAIR_MAX_GUIDE_VERTICES];
    hair_quat frame[HAIR_MAX_GUIDE_VERTICES];
    uint32_t count;
};

static void unpack(const struct hair_groom* groom, uint32_t number, struct polyline* line)
{
    const struct hair_guide* guide = &groom->guides[number];
    const struct hair_rest* rest = groom->rest + guide->first;
    hair_quat frame = {guide->root_frame.x, guide->root_frame.y, guide->root_frame.z, guide->root_frame.w};
    HAIR_ASSERT(2 <= guide->count && guide->count <= HAIR_MAX_GUIDE_VERTICES);
    line->count = guide->count;
    for (uint32_t i = 0; i < guide->count; ++i) {
        line->vertex[i] = hair_v3(rest[i].position.x, rest[i].position.y, rest[i].position.z);
        line->from_root[i] = i ? line->from_root[i - 1] + rest[i - 1].position.w : 0;
    }
    for (uint32_t i = 0; i + 1 < guide->count; ++i) {
        line->direction[i] = hair_normalize(hair_sub(line->vertex[i + 1], line->vertex[i]), hair_v3(0, 1, 0));
        if (i) {
            hair_quat turn = hair_quat_between(line->direction[i - 1], line->direction[i]);
            frame = hair_quat_normalize(hair_quat_multiply(turn, frame));
        }
        line->frame[i] = frame;
    }
}

// Return the derivative of the position by arc length at vertex j.
static hair_vec3 slope(const struct polyline* line, uint32_t j)
{
    if (j == 0) return line->direction[0];
    if (j + 1 >= line->count) return line->direction[line->count - 2];
    float before = line->from_root[j] - line->from_root[j - 1];
    float after = line->from_root[j + 1] - line->from_root[j];
    return hair_scale(
        hair_add(hair_scale(line->direction[j - 1], after), hair_scale(line->direction[j], before)),
        1 / fmaxf(before + after, 1e-12f));
}

static void evaluate(const struct polyline* line, uint32_t j, float s, struct hair_guide_spline* out,
                     uint32_t k)
{
    HAIR_ASSERT(j + 1 < line->count && k < HAIR_MAX_SMOOTH_VERTICES);
    float l = fmaxf(line->from_root[j + 1] - line->from_root[j], 1e-12f);
    float w = fminf(fmaxf((s - line->from_root[j]) / l, 0), 1);
    hair_vec3 chord = hair_sub(line->vertex[j + 1], line->vertex[j]);
    hair_vec3 bend0 = hair_sub(hair_scale(slope(line, j), l), chord);
    hair_vec3 bend1 = hair_sub(hair_scale(slope(line, j + 1), l), chord);
    // The Hermite curve is evaluated as the chord plus a deviation, so that floats keep the small
    // part.
    hair_vec3 away = hair_sub(hair_scale(bend0, 1 - w), hair_scale(bend1, w));
    out->position[k] =
        hair_add(line->vertex[j], hair_add(hair_scale(chord, w), hair_scale(away, w * (1 - w))));
    hair_vec3 tangent = hair_add(
        chord, hair_sub(hair_scale(bend0, (1 - w) * (1 - 3 * w)), hair_scale(bend1, w * (2 - 3 * w))));
    out->tangent[k] = hair_normalize(tangent, line->direction[j]);
    out->frame[k] =
        hair_quat_multiply(hair_quat_between(line->direction[j], out->tangent[k]), line->frame[j]);
}

void hair_guide_spline_fit(const struct hair_groom* groom, uint32_t guide, struct hair_guide_spline* out)
{
    struct polyline line;
    unpack(groom, guide, &line);
    out->count = 2 * (groom->max_vertices - 1) + 1;
    HAIR_ASSERT(line.count <= groom->max_vertices && out->count <= HAIR_MAX_SMOOTH_VERTICES);
    out->length = line.from_root[line.count - 1];
    uint32_t j = 0;
    for (uint32_t k = 0; k < out->count; ++k) {
        float s = out->length * (float)k / (float)(out->count - 1);
        while (j + 2 < line.count && line.from_root[j + 1] <= s) ++j;
        evaluate(&line, j, s, out, k);
    }
}

static hair_quat mix_rotations(hair_quat a, hair_quat b, float w)
{
    float sign = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -1.0f : 1.0f;
    float u = 1 - w, v = sign * w;
    return hair_quat_normalize(
        (hair_quat){u * a.x + v * b.x, u * a.y + v * b.y, u * a.z + v * b.z, u * a.w + v * b.w});
}

struct hair_guide_spline_point hair_guide_spline_at(const struct hair_guide_spline* spline, float u)
{
    HAIR_ASSERT(spline->count >= 2 && u >= 0);
    float at = fminf(u, 1) * (float)(spline->count - 1);
    uint32_t k = (uint32_t)at < spline->count - 2 ? (uint32_t)at : spline->count - 2;
    float w = at - (float)k;
    struct hair_guide_spline_point point;
    point.tangent =
        hair_normalize(hair_lerp(spline->tangent[k], spline->tangent[k + 1], w), spline->tangent[k]);
    point.position = hair_lerp(spline->position[k], spline->position[k + 1], w);
    point.position = hair_add(point.position, hair_scale(point.tangent, fmaxf(u - 1, 0) * spline->length));
    point.frame = mix_rotations(spline->frame[k], spline->frame[k + 1], w);
    return point;
}
