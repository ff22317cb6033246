// rod_energy.cpp - Bending and twist of a rod, with energy, forces, and the twist of minimum
// energy.
#include "tests/reference/rod_state.h"

#include <cmath>

Quaterniond hair_reference_rod_turned(const Quaterniond& q, const Vector3d& to)
{
    const Vector3d from = along(q);
    const double w = 1 + from.dot(to);
    Quaterniond turn(0, 0, 0, 0);
    if (w < 1e-12)
        turn.vec() = from.unitOrthogonal();
    else
        turn = Quaterniond(w, 0, 0, 0), turn.vec() = from.cross(to);
    return (turn.normalized() * q).normalized();
}

// A chain leaves the clamp at an angle under the tension T. Far from the clamp it straightens by
// the factor 1/r per segment, with r + 1/r = 2 + p^2 and p = l sqrt(T / B). l is the segment
// length, B the bending stiffness. The continuous rod's moment at the clamp is sqrt(B T) times the
// angle. Equating the chain's moment to it gives the factor 1 / (1/p - 1/(1/r - 1)), which is this
// expression.
double hair_reference_rod_clamp_factor(double length, double weight, double bend)
{
    if (!(bend > 0)) return 0;
    const double p = length * std::sqrt(weight / bend);
    return 1 + p / 2 + std::sqrt(1 + p * p / 4);
}

void hair_reference_rod_stiffen(hair_reference_rod& rod)
{
    double hanging = 0;
    for (uint32_t i = 1; i < rod.vertices; ++i) hanging += rod.masses[i];
    const double weight = hanging * rod.gravity.norm();
    rod.stiffness.assign(rod.segments(), Vector3d(0, 0, 0));
    for (uint32_t i = 0; i < rod.segments(); ++i) {
        const double length = i ? (rod.lengths[i - 1] + rod.lengths[i]) / 2 : rod.lengths[0];
        const Vector3d k = rod.scale[i] * Vector3d(rod.bend[0], rod.twist, rod.bend[1]);
        Vector3d factor(1, 1, 1);
        if (i == 0) {
            factor = Vector3d(2, 2, 2);
            if (!rod.plain_clamp)
                factor.x() = hair_reference_rod_clamp_factor(length, weight, k.x()),
                factor.z() = hair_reference_rod_clamp_factor(length, weight, k.z());
        }
        rod.stiffness[i] = factor.cwiseProduct(k) / length;
    }
}

hair_reference_rod_joint hair_reference_rod_joint_at(const hair_reference_rod& rod, uint32_t i,
                                                     const Quaterniond& before, const Quaterniond& after)
{
    const Quaterniond r = before.conjugate() * after;
    const double sign = r.w() < 0 ? -1 : 1;
    hair_reference_rod_joint joint;
    joint.w = sign * r.w();
    joint.v = sign * r.vec();
    const Vector3d excess = 2 * joint.v - rod.rest_strain[i];
    joint.g = rod.stiffness[i].cwiseProduct(excess);
    const double off = 2 * joint.w - rod.rest_real[i];
    joint.e = hair_reference_rod_real_stiffness(rod, i) * off;
    joint.energy = (joint.g.dot(excess) + joint.e * off) / 2;
    return joint;
}

namespace
{

// Second-order expansion of the energy by rotations of the frames about their segments. The second
// derivatives form a tridiagonal matrix.
struct expansion {
    double energy = 0;
    // Off-diagonal second derivatives, beside[j] by segments j and j + 1.
    std::vector<double> slope, diagonal, beside;
};

// Expand the energy. If segments i-1 and i rotate by a and b about their y, r = (w, v) becomes
// exp(-y a/2) r exp(y b/2). This changes 2 w by v.y (a - b) - w (a - b)^2 / 4.
expansion expand(const hair_reference_rod& rod)
{
    const uint32_t n = rod.segments();
    expansion e;
    e.slope.assign(n, 0), e.diagonal.assign(n, 0), e.beside.assign(n, 0);
    for (uint32_t i = hair_reference_rod_first_joint(rod); i < n; ++i) {
        const hair_reference_rod_joint j =
            hair_reference_rod_joint_at(rod, i, hair_reference_rod_before(rod, i), rod.frames[i]);
        const Vector3d by_a(-j.v.z(), -j.w, j.v.x()); // -(w y + y x v)
        const Vector3d by_b(-j.v.z(), j.w, j.v.x()); //   w y + v x y
        const Vector3d k = rod.stiffness[i];
        const double of_real = hair_reference_rod_real_stiffness(rod, i) * j.v.y() * j.v.y();
        const double c = of_real - 0.5 * (j.g.dot(j.v) + j.e * j.w);
        e.energy += j.energy;
        e.slope[i] += j.g.dot(by_b) - j.e * j.v.y();
        e.diagonal[i] += by_b.dot(k.cwiseProduct(by_b)) + c;
        if (i == 0) continue; // The scalp does not rotate.
        e.slope[i - 1] += j.g.dot(by_a) + j.e * j.v.y();
        e.diagonal[i - 1] += by_a.dot(k.cwiseProduct(by_a)) + c;
        e.beside[i - 1] += by_a.dot(k.cwiseProduct(by_b)) - of_real -
                           0.5 * (j.g.x() * j.v.x() - j.g.y() * j.v.y() + j.g.z() * j.v.z() - j.e * j.w);
    }
    return e;
}

// Compute angles = -(H + shift)^-1 slope. H is the matrix of second derivatives. Return false if H
// + shift is not positive definite.
bool solve(const expansion& e, double shift, std::vector<double>& angles)
{
    const size_t n = e.slope.size();
    std::vector<double> pivot(n);
    for (size_t j = 0; j < n; ++j) {
        pivot[j] = e.diagonal[j] + shift;
        angles[j] = -e.slope[j];
        if (j > 0) {
            const double f = e.beside[j - 1] / pivot[j - 1];
            pivot[j] -= f * e.beside[j - 1];
            angles[j] -= f * angles[j - 1];
        }
        if (!(pivot[j] > 0)) return false;
    }
    for (size_t j = n; j-- > 0;) {
        if (j + 1 < n) angles[j] -= e.beside[j] * angles[j + 1];
        angles[j] /= pivot[j];
    }
    return true;
}

double largest(const std::vector<double>& values)
{
    double max_value = 0;
    for (double v : values) max_value = std::fmax(max_value, std::fabs(v));
    return max_value;
}

void turn_about_segments(std::vector<Quaterniond>& frames, const std::vector<double>& angles, double fraction)
{
    for (size_t j = 0; j < frames.size(); ++j) {
        const double half = fraction * angles[j] / 2;
        frames[j] = (frames[j] * Quaterniond(std::cos(half), 0, std::sin(half), 0)).normalized();
    }
}

// Minimize the energy by Newton's method. If the energy is not convex or the step is too long,
// descend along the slope.
void settle_twist(hair_reference_rod& rod)
{
    expansion e = expand(rod);
    const double scale = largest(e.diagonal);
    std::vector<double> angles(rod.segments());
    if (scale == 0) return;
    for (int iteration = 0; iteration < 100; ++iteration) {
        // A rod without a clamp can rotate about itself without resistance.
        double shift = rod.root == HAIR_REFERENCE_ROD_CLAMPED ? 0 : 1e-9 * scale;
        while (!solve(e, shift, angles)) {
            shift = std::fmax(4 * shift, 1e-3 * scale);
            if (!(shift < 1e9 * scale)) return; // Nothing is finite.
        }
        const double step = largest(angles);
        double fraction = std::fmin(1, 0.5 / step);
        for (const auto from = rod.frames;;) {
            turn_about_segments(rod.frames, angles, fraction);
            if (step < 1e-9) return; // The squared step is negligible.
            expansion after = expand(rod);
            if (after.energy <= e.energy * (1 + 1e-13) || step * fraction < 1e-6) {
                e = std::move(after);
                break;
            }
            rod.frames = from;
            fraction /= 2;
        }
    }
}

// Add the force of a torque on a segment to its end, and the opposite force to its start.
void couple(hair_reference_rod& rod, uint32_t segment, const Vector3d& torque)
{
    const Vector3d link = rod.x[segment + 1] - rod.x[segment];
    const Vector3d f = torque.cross(link) / link.squaredNorm();
    rod.force[segment + 1] += f;
    rod.force[segment] -= f;
}

// Compute the energy and forces of a straight rod with u = t_i - t_{i-1}. t_i is the unit tangent
// of segment i.
void update_straight(hair_reference_rod& rod)
{
    for (uint32_t i = hair_reference_rod_first_joint(rod); i < rod.segments(); ++i) {
        const Vector3d before = along(hair_reference_rod_before(rod, i)), after = along(rod.frames[i]);
        const double k = rod.stiffness[i].x();
        const Vector3d torque = k * after.cross(before); // -dE / (rotation of segment i)
        rod.energy += k * (after - before).squaredNorm() / 2;
        couple(rod, i, torque);
        if (i > 0) couple(rod, i - 1, -torque);
    }
}

} // namespace

void hair_reference_rod_update(hair_reference_rod& rod)
{
    for (uint32_t j = 0; j < rod.segments(); ++j)
        rod.frames[j] = hair_reference_rod_turned(rod.frames[j], direction_of(rod.x[j + 1] - rod.x[j]));
    rod.force.assign(rod.vertices, Vector3d(0, 0, 0));
    rod.energy = 0;
    if (rod.straight) return update_straight(rod);
    settle_twist(rod);
    // Rotating segment i by d changes u by w d' + d' x v and 2 w by -v.d'. d' is d in the frame of
    // segment i-1. There is no torque about the segments, therefore the rotation of frames about
    // moving segments does not matter.
    for (uint32_t i = hair_reference_rod_first_joint(rod); i < rod.segments(); ++i) {
        const Quaterniond before = hair_reference_rod_before(rod, i);
        const hair_reference_rod_joint j = hair_reference_rod_joint_at(rod, i, before, rod.frames[i]);
        const Vector3d torque = -(before * (j.w * j.g + j.v.cross(j.g) - j.e * j.v));
        rod.energy += j.energy;
        couple(rod, i, torque);
        if (i > 0) couple(rod, i - 1, -torque);
    }
}
