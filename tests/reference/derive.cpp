// derive.cpp - Guides that are not simulated, which turn as their parents do.
#include "tests/reference/convert.h"

#include <algorithm>
#include <cmath>

namespace
{

// Return the least rotation from a unit vector to another that is not opposite to the first.
Quaterniond least_rotation(const Vector3d& from, const Vector3d& to)
{
    const Vector3d axis = from.cross(to);
    return Quaterniond(Eigen::AngleAxisd(std::atan2(axis.norm(), from.dot(to)), direction_of(axis)));
}

// Return the rotation from rest of segment k of the parent.
Quaterniond turn_of(const hair_reference_derived& in, uint32_t k)
{
    const uint32_t v = in.parent->first + k;
    const Quaterniond at_rest = quaternion_of(in.rest[v].frame);
    if (in.material) return quaternion_of(in.material[v]) * at_rest.conjugate();
    const Vector3d now = vector_of(in.state[v + 1].position) - vector_of(in.state[v].position);
    const Quaterniond head = quaternion_of(in.head);
    const Vector3d carried = head * (at_rest * Vector3d(0, 1, 0));
    return least_rotation(carried, direction_of(now)) * head;
}

// Return the least rotation that undoes the motion of segment k of the parent in the last substep.
Quaterniond back_of(const hair_reference_derived& in, uint32_t k)
{
    const hair_state *a = in.state + in.parent->first + k, *b = a + 1;
    const Vector3d now = vector_of(b->position) - vector_of(a->position);
    const Vector3d before = now - (vector_of(b->displacement) - vector_of(a->displacement));
    return least_rotation(direction_of(now), direction_of(before));
}

} // namespace

void hair_reference_derive(const hair_reference_derived* in, double* positions, double* displacements)
{
    const hair_guide *own = in->own, *parent = in->parent;
    const double ratio =
        (double(own->arc_length) / (own->count - 1)) / (double(parent->arc_length) / (parent->count - 1));
    const Vector3d root = vector_of(in->rest[own->first].position);
    Vector3d at = quaternion_of(in->head) * root;
    Vector3d moved = vector_of(in->head_moved) + at - quaternion_of(in->head_before) * root;
    for (uint32_t i = 0; i < own->count; ++i) {
        store(at, positions + 3 * i);
        store(moved, displacements + 3 * i);
        if (i + 1 == own->count) break;
        const uint32_t k = std::min(uint32_t((i + 0.5) * ratio), parent->count - 2);
        const hair_rest* rest = in->rest + own->first + i;
        const Vector3d edge = turn_of(*in, k) * (vector_of(rest[1].position) - vector_of(rest[0].position));
        at += edge;
        moved += edge - back_of(*in, k) * edge;
    }
}
