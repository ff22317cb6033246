/// self_shadow.h - Light through hair by a density grid, in double precision.
#ifndef HAIR_TESTS_REFERENCE_SELF_SHADOW_H
#define HAIR_TESTS_REFERENCE_SELF_SHADOW_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A density grid. Positions are in its own axes.
struct hair_reference_grid {
    double lower[3]; ///< Position of node 0, m.
    double cell; ///< m.
    uint32_t nodes[3];
    /// Number of strands that light meets on its way through a cell, per node.
    const double* density;
};

/// Add a segment from a to b to `density`, per node. The amount is the segment's area over the area
/// of a cell's side. The segment is divided into as many parts as it is cells long, rounded up, and
/// the middle of each part adds its amount.
void hair_reference_fill(const struct hair_reference_grid* grid, const double a[3], const double b[3],
                         double width, double* density);

/// Return the number of strands met from `from` along `to`, at most 30. Steps are a cell long, with
/// middles from one cell onwards, within the grid and for less than `reach`. `met` is NULL, or the
/// known number at nodes with hair. With `met`, the number at the nearest known nodes is added from
/// the second step on. The search for such nodes lengthens its steps by a factor of 1.5.
double hair_reference_met(const struct hair_reference_grid* grid, const double from[3], const double to[3],
                          double reach, const double* met);

/// Return the visible fraction of the sky along the axes, in five steps of doubling length.
double hair_reference_sky(const struct hair_reference_grid* grid, const double from[3]);

/// Interpolate values per node at a place, using only nodes that contain hair.
double hair_reference_around(const struct hair_reference_grid* grid, const double at[3],
                             const double* values);

/// Parallel rays along z, through the middles of equal squares of a large square.
struct hair_reference_rays {
    double lower[2]; ///< Lower corner, m.
    double side; ///< m.
    uint32_t count; ///< Rays along each side.
    unsigned char* stopped; ///< 1 for each ray that has met a strand, row by row.
};

/// Stop the rays that meet the ribbon from a to b in x and y. The radii are half its width at its
/// ends. The ribbon faces the rays.
void hair_reference_stop(struct hair_reference_rays* rays, const double a[2], const double b[2],
                         double radius_a, double radius_b);

/// Return the fraction of stopped rays in a part of the square from (x, y) on, `side` wide. All
/// three are fractions of the square's side.
double hair_reference_stopped(const struct hair_reference_rays* rays, double x, double y, double side);

#ifdef __cplusplus
}
#endif

#endif
