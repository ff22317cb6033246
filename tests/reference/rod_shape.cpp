// rod_shape.cpp - Rest strain of a shape without load, and rest strain that preserves a shape under
// load.
#include "tests/reference/rod_state.h"

namespace
{

Vector3d strain_of(const Quaterniond& before, const Quaterniond& after)
{
    const Quaterniond r = before.conjugate() * after;
    return r.w() < 0 ? Vector3d(-2 * r.vec()) : Vector3d(2 * r.vec());
}

double real_of(const Quaterniond& before, const Quaterniond& after)
{
    return std::fabs(2 * (before.conjugate() * after).w());
}

// Return the stress g that gives the torque `wanted`. If 2 w has its rest value, the torque of a
// joint on the next segment is -(w g + v x g) in the previous segment's frame.
Vector3d stress_for(const Quaterniond& before, const Quaterniond& after, const Vector3d& wanted)
{
    const Vector3d u = strain_of(before, after), v = u / 2;
    const double w = std::sqrt(std::fmax(1 - v.squaredNorm(), 1e-12));
    const Vector3d torque = before.conjugate() * -wanted;
    return w * torque - v.cross(torque) + v * (v.dot(torque) / w);
}

} // namespace

void hair_reference_rod_strain(uint32_t vertices, const double* positions, const double root_frame[4],
                               double* strain)
{
    Quaterniond before = quaternion_of(root_frame).normalized();
    for (uint32_t j = 0; j + 1 < vertices; ++j) {
        const Vector3d link = vector_of(positions + 3 * j + 3) - vector_of(positions + 3 * j);
        const Quaterniond after = hair_reference_rod_turned(before, direction_of(link));
        store(strain_of(before, after), strain + 3 * j);
        before = after;
    }
}

// Consider the part of the rod beyond joint i. It is in balance if the joint's torque is minus the
// torque of its load about vertex i. The torque is accumulated from the tip. The torque at a
// segment's start is that at its end plus the couple l t x F. F is the load beyond, l the segment's
// length and t its tangent.
int hair_reference_rod_hold(const hair_reference_rod_desc* desc, double* strain, double* real)
{
    hair_reference_rod* rod = hair_reference_rod_create(desc);
    const bool fit = rod && !rod->straight && rod->root == HAIR_REFERENCE_ROD_CLAMPED;
    if (fit) {
        for (uint32_t j = 0; j < rod->segments(); ++j) {
            const Vector3d link = rod->x[j + 1] - rod->x[j];
            rod->frames[j] =
                hair_reference_rod_turned(hair_reference_rod_before(*rod, j), direction_of(link));
        }
        Vector3d load(0, 0, 0), torque(0, 0, 0);
        for (uint32_t j = rod->segments(); j-- > 0;) {
            const Vector3d pulled = rod->pull[j + 1] * (rod->target_of(j + 1) - rod->x[j + 1]);
            load += rod->masses[j + 1] * (rod->gravity + pulled);
            torque -= (rod->x[j + 1] - rod->x[j]).cross(load);
            const Quaterniond before = hair_reference_rod_before(*rod, j), after = rod->frames[j];
            const Vector3d stress = stress_for(before, after, torque);
            Vector3d excess(0, 0, 0);
            for (int k = 0; k < 3; ++k)
                if (rod->stiffness[j][k] > 0) excess[k] = stress[k] / rod->stiffness[j][k];
            store(Vector3d(strain_of(before, after) - excess), strain + 3 * j);
            real[j] = real_of(before, after);
        }
    }
    hair_reference_rod_destroy(rod);
    return fit;
}
