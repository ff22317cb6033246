// rod_turns.h - a rod's whole energy by small turns of its segments, which leave the lengths alone: what is
// at rest where it is flat, stable where it curves upwards, and how it swings about there.
#ifndef HAIR_REFERENCE_ROD_TURNS_H
#define HAIR_REFERENCE_ROD_TURNS_H

#include <Eigen/Dense>

#include "lib/reference/rod_state.h"

using Eigen::Matrix3d;
using Eigen::VectorXd;

// A symmetric matrix, of which only what is at most `width` beside the diagonal is not 0.
struct hair_reference_band {
    int size, width;
    std::vector<double> values; // Row by row, the lower half: (i, i - width) … (i, i).

    hair_reference_band(int n, int w) : size(n), width(w), values(size_t(n) * size_t(w + 1), 0) {}
    double& at(int i, int j) { return values[size_t(i) * size_t(width + 1) + size_t(j - i + width)]; }
    double at(int i, int j) const { return values[size_t(i) * size_t(width + 1) + size_t(j - i + width)]; }

    void add(int i, int j, const Matrix3d& block); // At row 3 i and column 3 j <= 3 i.
    // To L D L^T in place. Returns how many of D are not positive: as many eigenvalues (Sylvester).
    int factor();
    VectorXd solve(VectorXd right) const; // After factor().
};

// Segment j turned by the vector b as it itself sees it, q_j exp(b), makes of the energy, of bending, twist,
// gravity and pull, energy + slope b + b curvature b / 2. Three numbers a segment. A straight rod knows no
// turn about its segments: their curvature is `stiffest`, and nothing else.
struct hair_reference_turns {
    double energy, stiffest;
    double size; // of the torques that the slope is the rest of: load times length, or B / l
    VectorXd slope, length;
    hair_reference_band curvature;
};

hair_reference_turns hair_reference_rod_turns(const hair_reference_rod& rod);
// The energy alone.
double hair_reference_rod_potential(const hair_reference_rod& rod);
// Turn the segments, and carry the vertices along from the root.
void hair_reference_rod_turn(hair_reference_rod& rod, const VectorXd& turns, double share);

// How far vertices beyond segment j go per turn of it: the matrix whose product with b is l q (b x y).
Matrix3d hair_reference_rod_arm(const hair_reference_rod& rod, uint32_t j);

#endif
