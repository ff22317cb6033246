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

void hair_reference_follower(const hair_follower* f, const hair_draw_params* draw,
                             const hair_reference_sample* samples, double t, hair_reference_point* out)
{
    const uint32_t count     = draw->smooth_vertices;
    const uint32_t guide[3]  = {f->guide0, f->guide1, f->guide2};
    const double   weight[3] = {1 - double(f->weight1) - f->weight2, f->weight1, f->weight2};
    const double   u         = t * f->length_ratio;
    const place    own       = find(samples + size_t(guide[0]) * count, count, u);
    const double   length    = std::max(own.to_root / std::max(t, 1e-3), 1e-6);
    const bezier   offset    = evaluate(f->offset, t);
    const Vector3d waves     = length * deviation(f->seed, draw->frizz, t);

    Vector3d position = own.position + own.frame * (offset.point + waves);
    Vector3d tangent  = own.tangent + own.frame * offset.slope / length;

    const double multi = f->multi * (1 - draw->clump * smoothstep(0.1, 1, t));
    if (multi > 0) {
        Vector3d middle = own.frame * (Vector3d(f->offset[1].w, f->offset[2].w, f->offset[3].w) + waves);
        Vector3d along(0, 0, 0);
        for (int i = 0; i < 3; ++i) {
            const place p = find(samples + size_t(guide[i]) * count, count, u);
            middle += weight[i] * p.position;
            along += weight[i] * p.tangent;
        }
        position = (1 - multi) * position + multi * middle;
        tangent  = (1 - multi) * tangent + multi * along;
    }
    const double taper = 1 + t * t * (double(draw->tip_radius) - 1);
    store(position, out->position);
    store(direction_of(tangent), out->tangent);
    out->radius = double(draw->radius) * f->offset[0].w * taper;
}
