// smooth.cpp - Smoothing of a guide by Hermite cubics through its vertices, sampled at equal
// distances along the chords.
#include "tests/reference/convert.h"

#include <cmath>
#include <vector>

void hair_reference_slope(const double before[3], const double at[3], const double after[3],
                          double length_before, double length_after, double slope[3])
{
    // Newton's divided differences give f[0,1] + (x1 - x0) f[0,1,2].
    const Vector3d first = (vector_of(at) - vector_of(before)) / length_before;
    const Vector3d second = (vector_of(after) - vector_of(at)) / length_after;
    store(first + length_before * (second - first) / (length_before + length_after), slope);
}

void hair_reference_hermite(const double a[3], const double slope_a[3], const double b[3],
                            const double slope_b[3], double length, double w, double position[3],
                            double tangent[3])
{
    const Vector3d p0 = vector_of(a), p1 = vector_of(b);
    const Vector3d m0 = length * vector_of(slope_a), m1 = length * vector_of(slope_b);
    // The cubic is c0 + c1 w + c2 w^2 + c3 w^3.
    const Vector3d c2 = 3 * (p1 - p0) - 2 * m0 - m1, c3 = 2 * (p0 - p1) + m0 + m1;
    store(p0 + w * (m0 + w * (c2 + w * c3)), position);
    store(m0 + w * (2 * c2 + 3 * w * c3), tangent);
}

namespace
{

// Data of the chords that the smoothed curve interpolates.
struct chords {
    std::vector<double> positions, directions, slopes, frames, from_root;
};

// Compute the positions at the fraction alpha of the last substep. Both ends are interpolated in
// the head's frame and placed under the current pose of the head.
void place(const hair_reference_guide& g, const hair_reference_vertex* state, chords& c)
{
    const Quaterniond before = quaternion_of(g.params->rotation_before);
    const Quaterniond after = quaternion_of(g.params->rotation_after);
    const Quaterniond now = quaternion_of(g.params->rotation_now);
    const Vector3d head = vector_of(g.params->last_displacement);
    const double alpha = g.params->alpha;
    for (uint32_t i = 0; i < g.guide->count; ++i) {
        const Vector3d at_end = vector_of(state[i].position);
        const Vector3d at_start =
            // The start is relative to the position that the head had then.
            at_end - vector_of(state[i].displacement) + head;
        const Vector3d own = (1 - alpha) * (before.inverse() * at_start) + alpha * (after.inverse() * at_end);
        store(now * own, &c.positions[3 * i]);
    }
}

chords measure(const hair_reference_guide& g, const hair_reference_vertex* state)
{
    const uint32_t count = g.guide->count, segments = count - 1;
    chords c{std::vector<double>(3 * count), std::vector<double>(3 * segments),
             std::vector<double>(3 * count), std::vector<double>(4 * segments), std::vector<double>(count)};
    place(g, state, c);
    const double* p = c.positions.data();
    for (uint32_t i = 0; i < segments; ++i) {
        const Vector3d link = vector_of(p + 3 * i + 3) - vector_of(p + 3 * i);
        store(direction_of(link), &c.directions[3 * i]);
        c.from_root[i + 1] = c.from_root[i] + link.norm();
    }
    // End vertices have a neighbour on one side only, therefore the curve leaves them along their
    // segment.
    store(vector_of(&c.directions[0]), &c.slopes[0]);
    store(vector_of(&c.directions[3 * segments - 3]), &c.slopes[3 * segments]);
    for (uint32_t i = 1; i < segments; ++i)
        hair_reference_slope(p + 3 * i - 3, p + 3 * i, p + 3 * i + 3, c.from_root[i] - c.from_root[i - 1],
                             c.from_root[i + 1] - c.from_root[i], &c.slopes[3 * i]);
    double root[4];
    store(quaternion_of(g.params->rotation_now) * quaternion_of(g.guide->root_frame), root);
    hair_reference_frames(segments, c.directions.data(), root, c.frames.data());
    return c;
}

// Give the root the frame of the scalp, which does not turn with the first segment.
void hang_on_scalp(const hair_reference_guide& g, hair_reference_sample& root)
{
    const Quaterniond scalp = quaternion_of(g.params->rotation_now) * quaternion_of(g.guide->root_frame);
    store(scalp, root.frame);
    store(scalp * Vector3d(0, 1, 0), root.tangent);
}

} // namespace

void hair_reference_smooth(hair_reference_guide g, const hair_reference_vertex* state,
                           hair_reference_sample* samples)
{
    const chords c = measure(g, state);
    const uint32_t segments = g.guide->count - 1;
    uint32_t j = 0;
    for (uint32_t k = 0; k < g.params->smooth_vertices; ++k) {
        hair_reference_sample& sample = samples[k];
        const double s = c.from_root[segments] * k / (g.params->smooth_vertices - 1);
        while (j + 1 < segments && c.from_root[j + 1] <= s) ++j;
        const double length = c.from_root[j + 1] - c.from_root[j];
        const double w = std::fmin((s - c.from_root[j]) / length, 1);
        hair_reference_hermite(&c.positions[3 * j], &c.slopes[3 * j], &c.positions[3 * j + 3],
                               &c.slopes[3 * j + 3], length, w, sample.position, sample.tangent);
        store(direction_of(vector_of(sample.tangent)), sample.tangent);
        sample.to_root = s;
        sample.stretch = length / g.rest[j].position.w - 1;
        // Rotate the segment's frame onto the tangent by the smallest rotation.
        hair_reference_frames(1, sample.tangent, &c.frames[4 * j], sample.frame);
        if (k == 0) hang_on_scalp(g, sample);
    }
}
