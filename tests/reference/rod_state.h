// rod_state.h - Data and functions that the files of rod.h share.
#ifndef HAIR_TESTS_REFERENCE_ROD_STATE_H
#define HAIR_TESTS_REFERENCE_ROD_STATE_H

#include <cmath>
#include <vector>

#include "tests/reference/convert.h"
#include "tests/reference/rod.h"

struct hair_reference_rod_place {
    Vector3d position;
    Quaterniond rotation;
};

struct hair_reference_rod {
    uint32_t vertices;
    std::vector<double> lengths, masses, pull; // `pull` is the squared angular frequency
    std::vector<Vector3d> target; // in the head's frame
    double bend[2], twist;
    std::vector<double> scale;
    std::vector<Vector3d> rest_strain;
    std::vector<double> rest_real; // 2 w at rest
    bool straight, plain_clamp;
    hair_reference_rod_root root;
    Quaterniond root_frame; // in the head's frame
    // Position of the root in the head's frame.
    Vector3d arm;
    Vector3d gravity, wind;
    double damping, line_density, drag, diameter;
    hair_reference_air air;

    // Per joint, B1, C and B2 over length, times the clamp's factors.
    std::vector<Vector3d> stiffness;

    hair_reference_rod_place head;
    Vector3d root_velocity;
    std::vector<Vector3d> x, v;
    std::vector<Quaterniond> frames; // per segment
    std::vector<Vector3d> force; // elastic, per vertex
    double energy; // elastic

    uint32_t segments() const { return vertices - 1; }
    bool is_held() const { return root != HAIR_REFERENCE_ROD_FREE; }
    Quaterniond scalp() const { return head.rotation * root_frame; }
    Vector3d root_position() const { return head.position + head.rotation * arm; }
    Vector3d target_of(uint32_t i) const { return head.position + head.rotation * target[i]; }
    double inverse_mass(uint32_t i) const { return i == 0 && is_held() ? 0 : 1 / masses[i]; }
};

// Strain (w, v) of a joint and its derivatives g = dE/du and e = dE/d(2 w) of the energy E.
struct hair_reference_rod_joint {
    double w;
    Vector3d v, g;
    double e, energy;
};

// Return the stiffness of a joint by 2 w, which equals the stiffness by the strain about z.
static inline double hair_reference_rod_real_stiffness(const hair_reference_rod& rod, uint32_t joint)
{
    return rod.stiffness[joint].z();
}

static inline Vector3d along(const Quaterniond& q)
{
    return Vector3d(2 * (q.x() * q.y() - q.w() * q.z()), 1 - 2 * (q.x() * q.x() + q.z() * q.z()),
                    2 * (q.y() * q.z() + q.w() * q.x()));
}

// Return the rotation by the vector v, of |v| radians.
static inline Quaterniond rotation_by(const Vector3d& v)
{
    const double angle = v.norm(), fraction = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5;
    return Quaterniond(std::cos(angle / 2), fraction * v.x(), fraction * v.y(), fraction * v.z());
}

// Return q after the smallest rotation that makes its y the unit vector `to`.
Quaterniond hair_reference_rod_turned(const Quaterniond& q, const Vector3d& to);

// Compute the joints' stiffness, with the clamp's factors from the mass that hangs on it.
void hair_reference_rod_stiffen(hair_reference_rod& rod);

hair_reference_rod_joint hair_reference_rod_joint_at(const hair_reference_rod& rod, uint32_t i,
                                                     const Quaterniond& before, const Quaterniond& after);
// Return the first joint. A rod without clamp has no joint 0.
static inline uint32_t hair_reference_rod_first_joint(const hair_reference_rod& rod)
{
    return rod.root == HAIR_REFERENCE_ROD_CLAMPED ? 0 : 1;
}
static inline Quaterniond hair_reference_rod_before(const hair_reference_rod& rod, uint32_t joint)
{
    return joint ? rod.frames[joint - 1] : rod.scalp();
}

// Rotate the frames with x, minimize the energy of twist, and compute `force` and `energy`.
void hair_reference_rod_update(hair_reference_rod& rod);

#endif
