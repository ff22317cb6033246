/// self_shadow.h - light past hair by a grid of how much of it there is, in double precision.
#ifndef HAIR_REFERENCE_SELF_SHADOW_H
#define HAIR_REFERENCE_SELF_SHADOW_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Positions are in its own axes.
struct hair_reference_grid {
    double lower[3]; ///< Node 0. m.
    double cell; ///< m.
    uint32_t nodes[3];
    const double* density; ///< Per node: strands that light meets on the way through a cell there.
};

/// Add a segment from a to b to `density`, per node: its area over that of a side of a cell, at places in the middle of as
/// many parts as it is cells long, rounded up.
void hair_reference_fill(const struct hair_reference_grid* grid, const double a[3], const double b[3],
                         double width, double* density);

/// Strands met from there on, in steps of a cell with middles from a cell off, within the grid and for less than `reach`; 30
/// at most. met: NULL, or what nodes with hair know about it, which is taken from the second step on where there are some;
/// they are looked for in steps each 1.5 times as long as the one before.
double hair_reference_met(const struct hair_reference_grid* grid, const double from[3], const double to[3],
                          double reach, const double* met);

/// Share of the sky that is seen along the axes, in five steps each twice as long as the one before.
double hair_reference_sky(const struct hair_reference_grid* grid, const double from[3]);

/// Of values per node, what those that hold hair have around a place.
double hair_reference_around(const struct hair_reference_grid* grid, const double at[3],
                             const double* values);

/// Parallel rays along z, in the middles of equal squares of a large one.
struct hair_reference_rays {
    double lower[2]; ///< m.
    double side; ///< m.
    uint32_t count; ///< Along each side.
    unsigned char* stopped; ///< Per ray, row after row: 1: it has met a strand.
};

/// Stop those that meet the ribbon from a to b, x and y, of half so wide at both ends, which it turns to them.
void hair_reference_stop(struct hair_reference_rays* rays, const double a[2], const double b[2],
                         double radius_a, double radius_b);

/// Of the rays through a part of the square, from `x`, `y` on and `side` wide, as shares of its sides, the share that is
/// stopped.
double hair_reference_stopped(const struct hair_reference_rays* rays, double x, double y, double side);

#ifdef __cplusplus
}
#endif

#endif
