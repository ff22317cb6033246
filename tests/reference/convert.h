// convert.h - Conversion between the structs of shared.h, arrays of doubles, and Eigen.
#ifndef HAIR_TESTS_REFERENCE_CONVERT_H
#define HAIR_TESTS_REFERENCE_CONVERT_H

#include <Eigen/Geometry>

#include "tests/reference/reference.h"

using Eigen::Quaterniond;
using Eigen::Vector3d;

static inline Vector3d vector_of(const hair_vec4& v)
{
    return Vector3d(v.x, v.y, v.z);
}
static inline Vector3d vector_of(const double* v)
{
    return Vector3d(v[0], v[1], v[2]);
}
static inline void store(const Vector3d& v, double* out)
{
    out[0] = v.x(), out[1] = v.y(), out[2] = v.z();
}
static inline Quaterniond quaternion_of(const hair_vec4& q)
{
    return Quaterniond(q.w, q.x, q.y, q.z).normalized();
}
static inline Quaterniond quaternion_of(const double* q)
{
    return Quaterniond(q[3], q[0], q[1], q[2]);
}
static inline void store(const Quaterniond& q, double* out)
{
    out[0] = q.x(), out[1] = q.y(), out[2] = q.z(), out[3] = q.w();
}

// Return the normalized vector, or +y for a vector of length 0.
static inline Vector3d direction_of(const Vector3d& v)
{
    return v.norm() > 0 ? Vector3d(v.normalized()) : Vector3d(0, 1, 0);
}

#endif
