// displace.cpp - Displacements of guides, and followers with a shape of their own.
#include "tests/reference/strand.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

// Extend a curve beyond both ends by its point reflections at them.
std::vector<Vector3d> extend(const std::vector<Vector3d>& curve, int by)
{
    const int last = int(curve.size()) - 1;
    std::vector<Vector3d> out;
    for (int k = -by; k <= last + by; ++k) {
        const int mirrored = std::min(std::max(k < 0 ? -k : k > last ? 2 * last - k : k, 0), last);
        const Vector3d& p = curve[size_t(mirrored)];
        out.push_back(k < 0 ? 2 * curve.front() - p : k > last ? 2 * curve.back() - p : p);
    }
    return out;
}

// Evaluate a polyline and its slope at t in [0, 1].
void at_polyline(const double* points, uint32_t count, double t, Vector3d& at, Vector3d& slope)
{
    const uint32_t k = std::min(uint32_t(t * (count - 1)), count - 2);
    const Vector3d a = vector_of(points + 3 * k), b = vector_of(points + 3 * k + 3);
    slope = (count - 1) * (b - a);
    at = a + (t * (count - 1) - k) * (b - a);
}

// Evaluate a Catmull-Rom spline as a polynomial. The curve has a vertex beyond each end.
void at_spline(const double* vertices, uint32_t count, double t, Vector3d& at, Vector3d& slope)
{
    const uint32_t k = std::min(uint32_t(t * (count - 1)), count - 2);
    const double x = t * (count - 1) - k;
    Vector3d p[4];
    for (uint32_t i = 0; i < 4; ++i) p[i] = vector_of(vertices + 3 * (k + i));
    const Vector3d c1 = (p[2] - p[0]) / 2, c2 = p[0] - 2.5 * p[1] + 2 * p[2] - p[3] / 2;
    const Vector3d c3 = (p[3] - p[0]) / 2 + 1.5 * (p[1] - p[2]);
    at = p[1] + x * (c1 + x * (c2 + x * c3));
    slope = (count - 1) * (c1 + x * (2 * c2 + x * 3 * c3));
}

} // namespace

void hair_reference_displacements(const hair_reference_sample* samples, const hair_vec4* shape,
                                  uint32_t count, double* out)
{
    std::vector<Vector3d> raw;
    const Quaterniond frame = quaternion_of(samples[0].frame).normalized();
    for (uint32_t k = 0; k < count; ++k)
        raw.push_back(vector_of(samples[k].position) - vector_of(samples[0].position) -
                      frame * vector_of(shape[k]));
    const double deviation = (count - 1) / 16.0;
    const int reach = int(2.5 * deviation);
    const std::vector<Vector3d> extended = extend(raw, reach);
    for (uint32_t k = 0; k < count; ++k) {
        Vector3d sum(0, 0, 0);
        double over = 0;
        for (int i = -reach; i <= reach; ++i) {
            const double weight = std::exp(-i * i / (2 * deviation * deviation));
            sum += weight * extended[size_t(int(k) + reach + i)];
            over += weight;
        }
        store(sum / over, out + 3 * k);
    }
}

void hair_reference_shaped(const hair_follower* follower, const hair_look* look,
                           const hair_reference_shapes* shapes, double t, double freed,
                           hair_reference_point* out)
{
    const uint32_t count = shapes->count, guide[3] = {follower->guide0, follower->guide1, follower->guide2};
    const double drawn = hair_reference_fraction(*look, follower->seed);
    const hair_reference_sample* first = shapes->samples + size_t(guide[0]) * count;
    const Quaterniond frame = quaternion_of(first->frame).normalized();
    const double w1 = follower->weight1, w2 = follower->weight2;
    const double weight[3] = {follower->offset[1].w + freed * (w1 + w2), (1 - freed) * w1, (1 - freed) * w2};
    Vector3d at, slope;
    at_spline(shapes->vertices, shapes->shape_vertices, t * drawn, at, slope);
    Vector3d position = vector_of(first->position) + frame * (vector_of(follower->offset[0]) + at);
    Vector3d tangent = frame * slope;
    for (int i = 0; i < 3; ++i) {
        at_polyline(shapes->displacements + 3 * size_t(guide[i]) * count, count, t * drawn, at, slope);
        position += weight[i] * at;
        tangent += weight[i] * slope;
    }
    tangent *= drawn;

    // The look acts about guide 0 as on a single-strand follower, which hair_reference_follower()
    // gives without an offset.
    hair_follower single = *follower;
    for (int i = 0; i < 4; ++i) single.offset[i].x = single.offset[i].y = single.offset[i].z = 0;
    single.multi = 0;
    hair_look plain = *look;
    plain.strays.fraction = plain.strays.tip_fraction = plain.curl.radius = 0;
    plain.strays.frizz = hair_curve();
    hair_reference_point guided, astray;
    hair_reference_follower(&single, &plain, count, shapes->samples, t, nullptr, &guided);
    hair_reference_follower(&single, look, count, shapes->samples, t, nullptr, &astray);
    const along width = hair_reference_curve(look->clump.width, t);
    const double length = drawn * follower->length_ratio * first[count - 1].to_root;
    tangent = width.value * tangent + (1 - width.value) * length * vector_of(guided.tangent) +
              width.slope * (position - vector_of(guided.position));
    position = vector_of(guided.position) + width.value * (position - vector_of(guided.position));
    store(position + vector_of(astray.position) - vector_of(guided.position), out->position);
    store(direction_of(tangent), out->tangent);
    out->radius = astray.radius;
}
