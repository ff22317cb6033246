// linkage.cpp - Pendulums that hang from each other in a plane, by Lagrange's equations in their
// angles.
#include "tests/reference/continuum.h"

#include <Eigen/Dense>

#include "tests/reference/gragg.h"

using Eigen::VectorXd;

namespace
{

struct linkage {
    VectorXd length, hanging; // `hanging` is the mass below the upper end of each link
    double gravity;
};

linkage linkage_of(uint32_t links, const double* lengths, const double* masses, double gravity)
{
    linkage l{VectorXd(links), VectorXd(links), gravity};
    double sum = 0;
    for (int i = int(links); i-- > 0;) {
        l.length[i] = lengths[i];
        l.hanging[i] = sum += masses[i];
    }
    return l;
}

// Return the derivative of the state, the angles a and the rates r. Lagrange's equations are
//
// sum_j H_ij l_i l_j (cos(a_i - a_j) r_j' + sin(a_i - a_j) r_j^2) + H_i g l_i sin a_i = 0.
//
// H_i is the mass below the upper end of link i. H_ij is the mass that both links move, H of the
// lower one. l_i is the length of link i, g gravity.
VectorXd slope(const linkage& l, const VectorXd& state)
{
    const int n = int(l.length.size());
    Eigen::MatrixXd inertia(n, n);
    VectorXd torque(n), result(2 * n);
    for (int i = 0; i < n; ++i) {
        torque[i] = -l.hanging[i] * l.gravity * l.length[i] * std::sin(state[i]);
        for (int j = 0; j < n; ++j) {
            const double shared = l.hanging[std::max(i, j)] * l.length[i] * l.length[j];
            const double rate = state[n + j];
            inertia(i, j) = shared * std::cos(state[i] - state[j]);
            torque[i] -= shared * std::sin(state[i] - state[j]) * rate * rate;
        }
    }
    result.head(n) = state.tail(n);
    result.tail(n) = inertia.llt().solve(torque);
    return result;
}

} // namespace

void hair_reference_linkage_advance(uint32_t links, const double* lengths, const double* masses,
                                    double gravity, double dt, uint32_t steps, double* angles, double* rates)
{
    const linkage l = linkage_of(links, lengths, masses, gravity);
    VectorXd state(2 * links);
    for (int i = 0; i < int(links); ++i) state[i] = angles[i], state[int(links) + i] = rates[i];
    const auto f = [&](double, const VectorXd& y) { return slope(l, y); };
    for (uint32_t k = 0; k < steps; ++k) state = gragg_step(f, 0, state, dt / steps);
    for (int i = 0; i < int(links); ++i) angles[i] = state[i], rates[i] = state[int(links) + i];
}

double hair_reference_linkage_energy(uint32_t links, const double* lengths, const double* masses,
                                     double gravity, const double* angles, const double* rates)
{
    double energy = 0, y = 0, vx = 0, vy = 0;
    for (uint32_t i = 0; i < links; ++i) {
        y -= lengths[i] * std::cos(angles[i]);
        vx += lengths[i] * std::cos(angles[i]) * rates[i];
        vy += lengths[i] * std::sin(angles[i]) * rates[i];
        energy += masses[i] * ((vx * vx + vy * vy) / 2 + gravity * y);
    }
    return energy;
}
