// follower.cpp - where a follower is, by the formula that glsl/shared.h gives with its struct.
#include "lib/reference/convert.h"

#include <algorithm>
#include <cmath>

namespace
{

const double two_pi = 6.283185307179586;

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": pcg.
uint32_t hash(uint32_t seed)
{
    const uint32_t state = seed * 747796405u + 2891336453u;
    const uint32_t word  = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

double random(uint32_t seed)
{
    return (hash(seed) >> 8) / 16777216.0;
}

struct place {
    Vector3d    position, tangent;
    Quaterniond frame;
    double      to_root;
};

// Between samples everything is linear; beyond the tip (u > 1) the guide goes on straight.
place find(const hair_reference_sample* samples, uint32_t count, double u)
{
    const double                 at = std::min(u, 1.0) * (count - 1);
    const uint32_t               k  = std::min(uint32_t(at), count - 2);
    const double                 w  = at - k;
    const hair_reference_sample &a = samples[k], &b = samples[k + 1];
    Quaterniond                  qa = quaternion_of(a.frame), qb = quaternion_of(b.frame);
    if (qa.dot(qb) < 0) qb.coeffs() *= -1;
    place p;
    p.tangent  = direction_of((1 - w) * vector_of(a.tangent) + w * vector_of(b.tangent));
    p.frame    = Quaterniond((1 - w) * qa.coeffs() + w * qb.coeffs()).normalized();
    p.to_root  = (1 - w) * a.to_root + w * b.to_root;
    p.position = (1 - w) * vector_of(a.position) + w * vector_of(b.position);
    if (u > 1) {
        const double more = (u - 1) * b.to_root;
        p.position += more * p.tangent;
        p.to_root += more;
    }
    return p;
}

// Two slow waves across the strand, which begin at the root and of which a few strands have much.
Vector3d deviation(uint32_t seed, double frizz, double t)
{
    const double r[4]  = {random(seed), random(seed + 1), random(seed + 2), random(seed + 3)};
    const double share = frizz * std::pow(t, 1.5) * (0.3 + 2.2 * r[3] * r[3]);
    return share * Vector3d(std::sin(two_pi * (r[0] + t * (0.6 + 1.4 * r[2]))), 0,
                            std::sin(two_pi * (r[1] + t * (0.6 + 1.4 * r[3]))));
}

struct bezier {
    Vector3d point, slope;
};

// De Casteljau.
bezier evaluate(const hair_vec4 control[4], double t)
{
    Vector3d p[4];
    for (int i = 0; i < 4; ++i) p[i] = vector_of(control[i]);
    for (int level = 3; level > 1; --level)
        for (int i = 0; i < level; ++i) p[i] += t * (p[i + 1] - p[i]);
    return {p[0] + t * (p[1] - p[0]), 3 * (p[1] - p[0])};
}

double smoothstep(double from, double to, double t)
{
    const double x = std::min(std::max((t - from) / (to - from), 0.0), 1.0);
    return x * x * (3 - 2 * x);
}

} // namespace

// A cubic from 0 to 1 over the zone that ends at the hit, flat at both ends.
void hair_reference_switch(double t, double hit, hair_reference_repair* out)
{
    const double before = std::max(hit - t, 0.0) / HAIR_SWITCH_ZONE;
    *out                = {};
    out->freed          = before < 1 ? 1 - before * before * (3 - 2 * before) : 0;
    out->freed_slope    = before < 1 ? 6 * before * (1 - before) / HAIR_SWITCH_ZONE : 0;
}

// De Boor's recurrence on the four control points that reach t; the slope is that of a quadratic of their differences.
void hair_reference_spline(const double controls[HAIR_REPAIR_CONTROLS][4], double t,
                           hair_reference_repair* out)
{
    const double at = std::min(std::max(t, 0.0), 1.0) * HAIR_REPAIR_INTERVALS;
    const int    k  = std::min(int(at), HAIR_REPAIR_INTERVALS - 1);
    const double x  = at - k;
    for (int axis = 0; axis < 4; ++axis) {
        double d[4];
        for (int i = 0; i < 4; ++i) {
            const int j = k - 1 + i;
            if (j > 0)
                d[i] = controls[j][axis];
            else // At the root nothing is moved; the spline is an odd function there.
                d[i] = axis == 3 ? controls[0][3] : j < 0 ? -controls[1][axis] : 0;
        }
        double e[3];
        for (int i = 0; i < 3; ++i) e[i] = d[i + 1] - d[i];
        for (int i = 0; i < 2; ++i) e[i] += (x + 1 - i) / 2 * (e[i + 1] - e[i]);
        const double slope = t > 1 ? 0 : HAIR_REPAIR_INTERVALS * (e[0] + x * (e[1] - e[0]));
        for (int level = 3; level > 0; --level)
            for (int i = 0; i < level; ++i) d[i] += (x + level - 1 - i) / level * (d[i + 1] - d[i]);
        (axis < 3 ? out->away[axis] : out->freed)             = d[0];
        (axis < 3 ? out->away_slope[axis] : out->freed_slope) = slope;
    }
}

void hair_reference_follower(const hair_follower* f, const hair_draw_params* draw,
                             const hair_reference_sample* samples, double t,
                             const hair_reference_repair* repair, hair_reference_point* out)
{
    static const hair_reference_repair none     = {};
    const hair_reference_repair&       r        = repair ? *repair : none;
    const uint32_t                     count    = draw->smooth_vertices;
    const uint32_t                     guide[3] = {f->guide0, f->guide1, f->guide2};
    const double   weight[3] = {1 - double(f->weight1) - f->weight2, f->weight1, f->weight2};
    const double   u         = t * f->length_ratio;
    const double   v         = std::min(t, 1.0); // What is the strand's own ends with it.
    const place    own       = find(samples + size_t(guide[0]) * count, count, u);
    const double   length    = std::max(own.to_root / std::max(t, 1e-3), 1e-6);
    const bezier   offset    = evaluate(f->offset, v);
    const Vector3d waves     = length * deviation(f->seed, draw->frizz, v);

    Vector3d position = own.position + own.frame * (offset.point + waves);
    Vector3d tangent  = own.tangent + own.frame * offset.slope / length;

    const double clumped = f->multi * (1 - draw->clump * smoothstep(0.1, 1, v));
    const double multi   = clumped * (1 - r.freed);
    if (multi > 0) {
        Vector3d middle = own.frame * (Vector3d(f->offset[1].w, f->offset[2].w, f->offset[3].w) + waves);
        Vector3d along(0, 0, 0);
        for (int i = 0; i < 3; ++i) {
            const place p = find(samples + size_t(guide[i]) * count, count, u);
            middle += weight[i] * p.position;
            along += weight[i] * p.tangent;
        }
        tangent =
            (1 - multi) * tangent + multi * along - clumped * r.freed_slope / length * (middle - position);
        position = (1 - multi) * position + multi * middle;
    }
    const double taper = 1 + v * v * (double(draw->tip_radius) - 1);
    store(position + Vector3d(r.away), out->position);
    store(direction_of(tangent + Vector3d(r.away_slope) / length), out->tangent);
    out->radius = double(draw->radius) * f->offset[0].w * taper;
}
