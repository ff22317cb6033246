// rod_turns.h - Energy of a rod as a function of small rotations of its segments, which preserve
// lengths. The slope is 0 at rest, the curvature is positive at a stable rest, and the curvature
// determines the modes.
#ifndef HAIR_TESTS_REFERENCE_ROD_TURNS_H
#define HAIR_TESTS_REFERENCE_ROD_TURNS_H

#include <Eigen/Dense>

#include "tests/reference/rod_state.h"

using Eigen::Matrix3d;
using Eigen::VectorXd;

// A symmetric band matrix. Elements farther than `width` from the diagonal are 0.
struct hair_reference_band {
    int size, width;
    std::vector<double> values; // lower half row by row, (i, i - width) … (i, i)

    hair_reference_band(int n, int w) : size(n), width(w), values(size_t(n) * size_t(w + 1), 0) {}
    double& at(int i, int j) { return values[size_t(i) * size_t(width + 1) + size_t(j - i + width)]; }
    double at(int i, int j) const { return values[size_t(i) * size_t(width + 1) + size_t(j - i + width)]; }

    // Add a block at row 3 i and column 3 j <= 3 i.
    void add(int i, int j, const Matrix3d& block);
    // Factor into L D L^T in place. Return the number of elements of D that are not positive, which
    // equals the number of such eigenvalues (Sylvester).
    int factor();
    // Solve a linear system after factor().
    VectorXd solve(VectorXd right) const;
};

// Second-order expansion of the energy of bending, twist, gravity and pull. If segment j rotates by
// the vector b in its own frame, to q_j exp(b), the energy becomes energy + slope b + b curvature b
// / 2. There are three numbers per segment. A straight rod ignores rotations about its segments.
// Their curvature is `stiffest`, and all other terms are 0.
struct hair_reference_turns {
    double energy, stiffest;
    double size; // magnitude of the torques that sum to the slope, load times length or B / l
    VectorXd slope, length;
    hair_reference_band curvature;
};

// Compute the expansion.
hair_reference_turns hair_reference_rod_turns(const hair_reference_rod& rod);
// Compute only the energy.
double hair_reference_rod_potential(const hair_reference_rod& rod);
// Rotate the segments by `fraction` of `turns`, and move the vertices from the root
// outwards.
void hair_reference_rod_turn(hair_reference_rod& rod, const VectorXd& turns, double fraction);

// Return the derivative of the positions of vertices beyond segment j by its rotation. The product
// of this matrix with b is l q (b x y).
Matrix3d hair_reference_rod_arm(const hair_reference_rod& rod, uint32_t j);

#endif
