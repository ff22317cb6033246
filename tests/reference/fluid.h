/// fluid.h - Passes of the fluid in double precision, which tests compare the shaders with. The
/// code is written from the papers that the shaders name, and from the definition of the grid in
/// glsl/shared.h and glsl/wind/fluid.glsl.
///
/// A grid has `cells` cells along each axis. Its faces are three successive arrays of (cells +
/// 1)^3, one per axis. The face at (x, y, z) is the lower face of the cell at (x, y, z). x runs
/// fastest.
#ifndef HAIR_TESTS_REFERENCE_FLUID_H
#define HAIR_TESTS_REFERENCE_FLUID_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Parameters of the advection of air in a step.
struct hair_reference_flow {
    uint32_t cells;
    double shift[3]; ///< Movement of the grid since `before`, in cells.
    double cells_per; ///< Cells that air of 1 m/s moves in a step.
    double wind[3]; ///< Wind outside the box, m/s.
    double gain[3]; ///< Change of the wind in the step, m/s.
    const double* before; ///< Face velocities before the step, m/s.
    const double* air; ///< Velocities at cell centres that advect the air, xyz each, m/s.
    double blur; ///< Tolerance of traced positions along each axis, in cells.
};

/// Return the open fraction of a face. `distance` returns the distance to the nearest collider.
/// Distances and places are in cell sizes.
double hair_reference_open(uint32_t axis, const int32_t at[3],
                           double (*distance)(const double place[3], const void* user), const void* user);
/// Compute the open fractions of the grid with half as many cells.
void hair_reference_coarsen(uint32_t cells, const double* open, double* coarse);

/// Compute bounds of each face velocity after advection. Exact values are undefined, because the
/// result is discontinuous in the traced position at the border of the box.
void hair_reference_carry(const struct hair_reference_flow* flow, double* min, double* max);
/// Compute bounds of each face velocity after correction. The correction is limited to the range of
/// the surrounding values, which jumps from cell to cell.
void hair_reference_correct(const struct hair_reference_flow* flow, const double* carried, double* min,
                            double* max);

/// Strands of all directions, on nodes at the middles of a grid of `nodes` cells along each axis.
struct hair_reference_thicket {
    uint32_t nodes;
    const double* density; ///< Length of strands per volume, m/m^3.
    const double* flux; ///< Density times velocity, xyz each, 1/(m s).
    double per_speed; ///< Reynolds number of a strand over the speed of air, s/m.
    double viscous; ///< Drag of strands over a viscous force, over the step, m^2.
};

/// Update the open fraction and the wall velocity of faces by the drag of hair, which is integrated
/// implicitly.
void hair_reference_hold(const struct hair_reference_flow* flow, const struct hair_reference_thicket* hair,
                         double* open, double* wall);

/// Compute the net inflow of each cell.
void hair_reference_inflow(uint32_t cells, const double* open, const double* wall, const double* velocity,
                           double* right);
/// Relax the pressure of cells of one color, 0 or 1, by Gauss-Seidel. Any other color relaxes all
/// cells by Jacobi.
void hair_reference_relax(uint32_t cells, const double* open, const double* right, uint32_t color,
                          double fraction, double* pressure);
/// Compute the residual of the pressure equation.
void hair_reference_residual(uint32_t cells, const double* open, const double* right, const double* pressure,
                             double* left);
/// Restrict the residual to the right-hand side of the coarse grid.
void hair_reference_restrict(uint32_t cells, const double* left, double* coarse_right);
/// Add the coarse pressure to the fine pressure.
void hair_reference_prolong(uint32_t cells, const double* coarse, double* pressure);
/// Subtract the pressure gradient from the face velocities.
void hair_reference_release(uint32_t cells, const double* open, const double* wall, const double* pressure,
                            double* velocity);
/// Average face velocities to cell centres.
void hair_reference_air(uint32_t cells, const double* velocity, double* air);

#ifdef __cplusplus
}
#endif

#endif
