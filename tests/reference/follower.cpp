// follower.cpp - Position of a follower, by the formula at its struct in glsl/shared.h.
#include "tests/reference/strand.h"

#include <algorithm>
#include <cmath>

namespace
{

struct place {
    Vector3d position, tangent, bend; // `bend` is the derivative of the tangent by u
    Quaterniond frame;
    double length; // length of the guide
};

// Evaluate a guide at u. Values are linear between samples. Beyond the tip (u > 1) the guide
// continues straight.
place find(const hair_reference_sample* samples, uint32_t count, double u)
{
    const double at = std::min(u, 1.0) * (count - 1);
    const uint32_t k = std::min(uint32_t(at), count - 2);
    const double w = at - k;
    const hair_reference_sample &a = samples[k], &b = samples[k + 1];
    Quaterniond qa = quaternion_of(a.frame), qb = quaternion_of(b.frame);
    if (qa.dot(qb) < 0) qb.coeffs() *= -1;
    place p;
    p.tangent = direction_of((1 - w) * vector_of(a.tangent) + w * vector_of(b.tangent));
    p.bend = (count - 1) * (vector_of(b.tangent) - vector_of(a.tangent)) * (u < 1 ? 1 : 0);
    p.frame = Quaterniond((1 - w) * qa.coeffs() + w * qb.coeffs()).normalized();
    p.length = samples[count - 1].to_root;
    p.position = (1 - w) * vector_of(a.position) + w * vector_of(b.position);
    if (u > 1) p.position += (u - 1) * p.length * p.tangent;
    return p;
}

struct bezier {
    Vector3d point, slope;
};

// Evaluate a curve by de Casteljau's algorithm.
bezier evaluate(const hair_vec4 control[4], double t)
{
    Vector3d p[4];
    for (int i = 0; i < 4; ++i) p[i] = vector_of(control[i]);
    for (int level = 3; level > 1; --level)
        for (int i = 0; i < level; ++i) p[i] += t * (p[i + 1] - p[i]);
    return {p[0] + t * (p[1] - p[0]), 3 * (p[1] - p[0])};
}

// Shorten a curve to `fraction` of its length. The new control points are intermediate points of de
// Casteljau's algorithm.
void cut(hair_follower& f, double fraction)
{
    Vector3d p[4];
    for (int i = 0; i < 4; ++i) p[i] = vector_of(f.offset[i]);
    for (int level = 1; level < 4; ++level) {
        for (int i = 3; i >= level; --i) p[i] = (1 - fraction) * p[i - 1] + fraction * p[i];
    }
    for (int i = 0; i < 4; ++i)
        f.offset[i].x = float(p[i].x()), f.offset[i].y = float(p[i].y()), f.offset[i].z = float(p[i].z());
    f.length_ratio = float(f.length_ratio * fraction);
}

} // namespace

// Blend by a cubic from 0 to 1 over the zone that ends at the hit, with slope 0 at both ends.
void hair_reference_switch(double t, double hit, hair_reference_repair* out)
{
    const double before = std::max(hit - t, 0.0) / HAIR_SWITCH_ZONE;
    *out = {};
    out->freed = before < 1 ? 1 - before * before * (3 - 2 * before) : 0;
    out->freed_slope = before < 1 ? 6 * before * (1 - before) / HAIR_SWITCH_ZONE : 0;
}

// Evaluate the spline by de Boor's recurrence on the four control points around t. The slope is a
// quadratic spline of their differences.
void hair_reference_spline(const double controls[HAIR_REPAIR_CONTROLS][4], double t,
                           hair_reference_repair* out)
{
    const double at = std::min(std::max(t, 0.0), 1.0) * HAIR_REPAIR_INTERVALS;
    const int k = std::min(int(at), HAIR_REPAIR_INTERVALS - 1);
    const double x = at - k;
    for (int axis = 0; axis < 4; ++axis) {
        double d[4];
        for (int i = 0; i < 4; ++i) {
            const int j = k - 1 + i;
            if (j > 0)
                d[i] = controls[j][axis];
            else // The spline is an odd function at the root, where nothing moves.
                d[i] = axis == 3 ? controls[0][3] : j < 0 ? -controls[1][axis] : 0;
        }
        double e[3];
        for (int i = 0; i < 3; ++i) e[i] = d[i + 1] - d[i];
        for (int i = 0; i < 2; ++i) e[i] += (x + 1 - i) / 2 * (e[i + 1] - e[i]);
        const double slope = t > 1 ? 0 : HAIR_REPAIR_INTERVALS * (e[0] + x * (e[1] - e[0]));
        for (int level = 3; level > 0; --level)
            for (int i = 0; i < level; ++i) d[i] += (x + level - 1 - i) / level * (d[i + 1] - d[i]);
        (axis < 3 ? out->away[axis] : out->freed) = d[0];
        (axis < 3 ? out->away_slope[axis] : out->freed_slope) = slope;
    }
}

void hair_reference_follower(const hair_follower* follower, const hair_look* look, uint32_t count,
                             const hair_reference_sample* samples, double t,
                             const hair_reference_repair* repair, hair_reference_point* out)
{
    static const hair_reference_repair none = {};
    const hair_reference_repair& r = repair ? *repair : none;
    hair_follower own = *follower;
    cut(own, hair_reference_fraction(*look, own.seed));
    const uint32_t guide[3] = {own.guide0, own.guide1, own.guide2};
    const double weight[3] = {1 - double(own.weight1) - own.weight2, own.weight1, own.weight2};
    const double ratio = own.length_ratio, u = t * ratio, v = std::min(t, 1.0);
    const place first = find(samples + size_t(guide[0]) * count, count, u);
    const double length = ratio * first.length;
    const bezier offset = evaluate(own.offset, v);
    const along width = hair_reference_curve(look->clump.width, v);
    const along single = hair_reference_singleness(*look, v);

    // One guide contributes its offset. Three guides contribute their mean, with a fixed offset
    // from it at the strand's root.
    const Vector3d aside_one = width.value * offset.point;
    const Vector3d slope_one = width.value * offset.slope + width.slope * offset.point;
    const Vector3d aside_many = Vector3d(own.offset[1].w, own.offset[2].w, own.offset[3].w);
    Vector3d mean(0, 0, 0), mean_slope(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
        const place p = find(samples + size_t(guide[i]) * count, count, u);
        mean += weight[i] * p.position;
        mean_slope += weight[i] * ratio * p.length * p.tangent;
    }
    const double many = own.multi * (1 - single.value) * (1 - r.freed);
    const double many_slope =
        -own.multi * (single.slope * (1 - r.freed) + (1 - single.value) * r.freed_slope);
    const astray stray = hair_reference_astray(*look, own.guide0, own.seed, v, length, ratio);
    const Vector3d local = (1 - many) * aside_one + many * aside_many + stray.at;
    const Vector3d local_slope = (1 - many) * slope_one + many_slope * (aside_many - aside_one) + stray.slope;
    const Vector3d turned = first.frame * local;

    const Vector3d position = (1 - many) * first.position + many * mean + turned;
    const Vector3d slope = (1 - many) * length * first.tangent + many * mean_slope +
                           many_slope * (mean - first.position) + first.frame * local_slope -
                           ratio * first.bend.dot(turned) * first.tangent;
    store(position + Vector3d(r.away), out->position);
    store(direction_of(slope + Vector3d(r.away_slope)), out->tangent);
    out->radius =
        double(look->strand.radius) * own.offset[0].w * hair_reference_curve(look->strand.taper, v).value;
}
