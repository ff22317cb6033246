// rod_statics.cpp - A rod at rest, with its position, stability and modes.
#include "tests/reference/rod_turns.h"

namespace
{

// Return -(H + shift l)^-1 slope with the smallest of some shifts for which it is a descent
// direction. H is the curvature and l the lengths.
VectorXd newton_step(const hair_reference_turns& t)
{
    const double unit = t.stiffest / t.length.maxCoeff();
    for (double shift = 0; shift < 1e9 * unit; shift = std::fmax(4 * shift, 1e-6 * unit)) {
        hair_reference_band h = t.curvature;
        for (int i = 0; i < h.size; ++i) h.at(i, i) += shift * t.length[i];
        if (h.factor() == 0) return h.solve(-t.slope);
    }
    return VectorXd::Zero(t.slope.size());
}

// Return the number of eigenvalues of H b = lambda l b below `lambda`.
int eigenvalues_below(const hair_reference_turns& t, double lambda)
{
    hair_reference_band h = t.curvature;
    for (int i = 0; i < h.size; ++i) h.at(i, i) -= lambda * t.length[i];
    return h.factor();
}

// Return the number of eigenvalues of H b = lambda M b below `lambda`. M is the matrix of the
// kinetic energy. Vertices beyond two segments move by the rotations of both. Twist has no inertia
// and adds no eigenvalue while it is stable.
int squares_below(const hair_reference_rod& rod, const hair_reference_turns& t, double lambda)
{
    const int n = int(rod.segments());
    hair_reference_band h(3 * n, 3 * n - 1);
    for (int i = 0; i < h.size; ++i)
        for (int j = std::max(i - t.curvature.width, 0); j <= i; ++j) h.at(i, j) = t.curvature.at(i, j);
    double beyond = 0;
    for (int j = n; j-- > 0;) {
        beyond += rod.masses[size_t(j) + 1];
        const Matrix3d own = -lambda * beyond * hair_reference_rod_arm(rod, uint32_t(j)).transpose();
        for (int i = 0; i <= j; ++i) h.add(j, i, own * hair_reference_rod_arm(rod, uint32_t(i)));
        h.at(3 * j + 1, 3 * j + 1) +=
            // A rod that is free to rotate about itself would count at random otherwise.
            1e-13 * t.stiffest;
    }
    return h.factor();
}

} // namespace

hair_reference_rod_rested hair_reference_rod_rest(hair_reference_rod* rod)
{
    hair_reference_rod_rested rested = {0, 0, INFINITY};
    if (!rod->is_held()) return rested;
    // Restore the exact lengths.
    hair_reference_rod_turn(*rod, VectorXd::Zero(3 * int(rod->segments())), 0);
    double last = INFINITY;
    for (; rested.iterations < 2000; ++rested.iterations) {
        const hair_reference_turns t = hair_reference_rod_turns(*rod);
        rested.residual = t.size > 0 ? t.slope.cwiseAbs().maxCoeff() / t.size : 0;
        // Newton's method doubles the number of correct digits until only rounding is left.
        if (rested.residual < 1e-15 || (rested.residual < 1e-11 && rested.residual >= last / 2)) break;
        last = rested.residual;
        const VectorXd step = newton_step(t);
        const double max_value = step.cwiseAbs().maxCoeff();
        double fraction = std::fmin(1, 0.7 / max_value);
        const hair_reference_rod from = *rod;
        for (;; fraction /= 2, *rod = from) {
            hair_reference_rod_turn(*rod, step, fraction);
            const double gain = t.energy - hair_reference_rod_potential(*rod);
            if (gain >= -1e-4 * fraction * t.slope.dot(step) || max_value * fraction < 1e-6) break;
        }
    }
    rested.converged = rested.residual < 1e-11;
    rod->v.assign(rod->vertices, Vector3d(0, 0, 0));
    rod->root_velocity = Vector3d(0, 0, 0);
    hair_reference_rod_update(*rod);
    return rested;
}

double hair_reference_rod_stability(const hair_reference_rod* rod)
{
    const hair_reference_turns t = hair_reference_rod_turns(*rod);
    const hair_reference_band& h = t.curvature;
    double low = INFINITY, high = INFINITY;
    for (int i = 0; i < h.size; ++i) {
        double beside = 0;
        for (int j = std::max(i - h.width, 0); j < i; ++j) beside += std::fabs(h.at(i, j));
        for (int j = i + 1; j < h.size && j <= i + h.width; ++j) beside += std::fabs(h.at(j, i));
        low = std::fmin(low, (h.at(i, i) - beside) / t.length[i]);
        high = std::fmin(high, h.at(i, i) / t.length[i]);
    }
    const double precision = 1e-14 * std::fmax(std::fabs(low), std::fabs(high));
    while (high - low > precision) {
        const double middle = (low + high) / 2;
        (eigenvalues_below(t, middle) ? high : low) = middle;
    }
    return (low + high) / 2;
}

uint32_t hair_reference_rod_modes(const hair_reference_rod* rod, uint32_t count, double* frequencies)
{
    if (!rod->is_held()) return 0;
    const hair_reference_turns t = hair_reference_rod_turns(*rod);
    double low = -1, high = 1;
    while (squares_below(*rod, t, low) > 0 && low > -1e30) low *= 4;
    count = std::min(count, 2 * rod->segments());
    for (uint32_t i = 0; i < count; ++i) {
        while (squares_below(*rod, t, high) <= int(i) && high < 1e30) high *= 4;
        for (double from = low, to = high;;) {
            const double middle = (from + to) / 2;
            if (to - from <= 1e-14 * std::fabs(middle) || middle == from || middle == to) {
                frequencies[i] = std::copysign(std::sqrt(std::fabs(middle)), middle);
                break;
            }
            (squares_below(*rod, t, middle) > int(i) ? to : from) = middle;
        }
    }
    return count;
}
