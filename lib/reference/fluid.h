/// fluid.h - the passes of the fluid once more, in double precision: what tests hold them to. Written from the papers that
/// the shaders name, and from what glsl/shared.h and glsl/wind/fluid.glsl promise of the grid.
///
/// A grid has `cells` along each axis. Of its faces there are three arrays of (cells + 1)^3, one per axis, one after the
/// other: the face at (x, y, z) is the one below the cell of the same numbers. x runs fastest.
#ifndef HAIR_REFERENCE_FLUID_H
#define HAIR_REFERENCE_FLUID_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Where air is carried in a step.
struct hair_reference_flow {
    uint32_t cells;
    double shift[3]; ///< By which the grid has moved since `before`. Cells.
    double cells_per; ///< That air of 1 m/s goes in a step.
    double wind[3]; ///< Outside. m/s.
    double gain[3]; ///< By which that has changed.
    const double* before; ///< Of faces. m/s.
    const double* air; ///< At the middles of cells, xyz each: what air is carried by. m/s.
    double blur; ///< By which where air comes from and goes to may be off along each axis. Cells.
};

/// Share of a face that is open. `distance`: to the nearest solid, in sides of a cell, at a place in the same unit.
double hair_reference_open(uint32_t axis, const int32_t at[3],
                           double (*distance)(const double place[3], const void* user), const void* user);
/// Of the grid of half as many cells.
void hair_reference_coarsen(uint32_t cells, const double* open, double* coarse);

/// Between what and what every face is then. Both jump with where air comes from: at the border of the box, and corrected
/// air, which is kept within what is around there, from cell to cell.
void hair_reference_carry(const struct hair_reference_flow* flow, double* least, double* most);
void hair_reference_correct(const struct hair_reference_flow* flow, const double* carried, double* least,
                            double* most);

/// Strands that lie every way, in a grid of `nodes` along each axis whose cells' middles they are.
struct hair_reference_thicket {
    uint32_t nodes;
    const double* density; ///< Metres of them in a cubic metre.
    const double* flux; ///< That times their velocity, xyz each. 1/m/s.
    double per_speed; ///< Reynolds number of a strand by the speed of air. s/m.
    double viscous; ///< Their drag by a viscous force, over the step. m^2.
};

/// How open faces are and what closes them goes, after that is left of air which they hold back implicitly.
void hair_reference_hold(const struct hair_reference_flow* flow, const struct hair_reference_thicket* hair,
                         double* open, double* wall);

/// What flows into each cell.
void hair_reference_inflow(uint32_t cells, const double* open, const double* wall, const double* velocity,
                           double* right);
/// Those of one color, 0 or 1, by Gauss and Seidel; any other: of all, by Jacobi.
void hair_reference_relax(uint32_t cells, const double* open, const double* right, uint32_t color,
                          double share, double* pressure);
/// What is left of the right sides.
void hair_reference_residual(uint32_t cells, const double* open, const double* right, const double* pressure,
                             double* left);
void hair_reference_restrict(uint32_t cells, const double* left, double* coarse_right);
void hair_reference_prolong(uint32_t cells, const double* coarse, double* pressure);
void hair_reference_release(uint32_t cells, const double* open, const double* wall, const double* pressure,
                            double* velocity);
void hair_reference_air(uint32_t cells, const double* velocity, double* air);

#ifdef __cplusplus
}
#endif

#endif
