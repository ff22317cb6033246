// frames.cpp - Parallel transport of frames along a guide, segment by segment.
#include "tests/reference/convert.h"

// Return the smallest rotation from a to b, computed from the vector half-way between them.
// Opposite vectors have no unique plane of rotation, therefore any is used.
static Quaterniond min_rotation(const Vector3d& a, const Vector3d& b)
{
    Quaterniond turn;
    if (1 + a.dot(b) < 1e-6) {
        turn.w() = 0;
        turn.vec() = a.unitOrthogonal();
        return turn;
    }
    const Vector3d half = (a + b).normalized();
    turn.w() = a.dot(half);
    turn.vec() = a.cross(half);
    return turn.normalized();
}

void hair_reference_frames(uint32_t segments, const double* directions, const double root[4], double* frames)
{
    Quaterniond frame = quaternion_of(root);
    for (uint32_t i = 0; i < segments; ++i) {
        const Vector3d along = frame * Vector3d(0, 1, 0);
        frame = (min_rotation(along, vector_of(directions + 3 * i)) * frame).normalized();
        store(frame, frames + 4 * i);
    }
}
