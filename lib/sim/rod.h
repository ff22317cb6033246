// rod.h - guides as rods: what the solvers of Kirchhoff's equations need to know of each vertex. No OpenGL.
//
// Everything is divided by the mass of a metre of hair, so that masses are lengths; arithmetic is in double. With
// u_i = 2 Im(conj(q_(i-1)) q_i), q_i the frame of the segment after vertex i (of the scalp at i = -1), real part
// positive, the energy of vertex i is
//
//   strain.w / 2 ((u - strain) . R (u - strain) + R_z (2 w - 2 w0)^2),   R = diag(ratio)
//
// w is the real part and 2 w0 its double at rest. The scheme of straight rods leaves the last term out: see
// glsl/sim/mixed.glsl for what it is good for.
#ifndef HAIR_SIM_ROD_H
#define HAIR_SIM_ROD_H

#include <hair/hair.h>

#include "glsl/shared.h"

struct hair_knot;

// R: bending about the frame's x, twist, bending about its z, all relative to bending of a round section of like
// area. The section's long axis is x: about it it bends easily.
void hair_rods_ratios(const hair_physics* physics, double ratio[3]);

// What holds a guide's groom against gravity, for each vertex.
struct hair_rod_borne {
    double stress[3]; // derivative of the vertex's energy by its strain in the groom
    double rest_real; // 2 w0: 2 w in the pose that the guide holds
    double stiffen; // multiple of the stiffness, 1 to 3
};

// Guides whose stiffness is reduced to what the solver can solve at its substep in single precision.
struct hair_rods_softened {
    uint32_t guides;
    uint32_t worst; // number of the guide that is softened most
    float factor; // of its stiffness, at the vertex that is softened most; 1 when none is
};

struct hair_rods_report {
    uint32_t stiffened; // guides that any vertex of is stiffer
    float stiffest; // greatest multiple; 1 when there are none
    uint32_t sagging; // guides that cannot hold their groom even so
    float farthest_sag; // greatest distance of their vertices from the groom when they rest, m
    struct hair_rods_softened softened;
};

static inline struct hair_rods_report hair_rods_report_none(void)
{
    return (struct hair_rods_report){.stiffest = 1, .softened = {.factor = 1}};
}

// Find out how guides are to hold their groom: hold.c. It depends on no solver and no substep.
//
// From a clamped root the rest strain bears `hold` of gravity: with 1 the groom is in equilibrium.
// Too soft a strand would buckle out of it even so, or need a rest strain further than 1 from the
// groom's own. Such a guide is made up to 3 times as stiff, by as little as keeps it stable. One
// that needs more than that sags to a pose that it can keep.
void hair_rods_hold(const struct hair_guide* guides, const struct hair_rest* rest, uint32_t count,
                    const hair_physics* physics, struct hair_rod_borne* out, struct hair_rods_report* report);

// Write one hair_rod per guide vertex, for substeps of that length. `borne` is of hair_rods_hold().
// A rest strain that is further than 1 from the groom's own is cut to that. Return how guides are softened.
struct hair_rods_softened hair_rods_write(const struct hair_guide* guides, const struct hair_rest* rest,
                                          const struct hair_rod_borne* borne, uint32_t count,
                                          const hair_physics* physics, hair_solver solver, int mixed,
                                          double substep, struct hair_rod* out);

// Write again those guides that ties hold, whose knots are in the order of guides and their vertices.
void hair_rods_tie(const struct hair_guide* guides, const struct hair_rest* rest,
                   const struct hair_rod_borne* borne, const struct hair_knot* knot, uint32_t count,
                   const hair_physics* physics, hair_solver solver, int mixed, double substep,
                   struct hair_rod* out);

// Return whether the mixed scheme is to solve the guides under direct and accurate. It does when
// some are curved at rest, or have segments too short or a tip too heavy for the scheme of straight
// rods; under direct also when some have more than 32 vertices. A substep of 0 is the one that direct wants.
int hair_rods_are_mixed(const struct hair_guide* guides, const struct hair_rest* rest,
                        const struct hair_rod_borne* borne, uint32_t count, const hair_physics* physics,
                        hair_solver solver, double substep);

// The substep that a solver wants. s. Of direct: 1/240, with heavy tips down to 1/960. Of accurate: 1/1080, or as much
// shorter as bending needs to be stable without being implicit, down to 1/6000; guides that need still shorter ones
// take BDF2.
double hair_rods_substep(const struct hair_guide* guides, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, uint32_t count, const hair_physics* physics,
                         hair_solver solver, int mixed);

// The own method's systems for work groups: one vec4 per vertex and round, round after round; zeros where a guide has
// no such system. A guide of n vertices has hair_rods_rounds(n) rounds at most, and out and last, which is room to work in,
// are for as many. Returns after how many the last comes.
uint32_t hair_rods_rounds(uint32_t most_vertices);
uint32_t hair_rods_reduce(const struct hair_guide* guides, uint32_t count, const struct hair_rod* rod,
                          uint32_t vertices, double substep, hair_vec4* out, hair_vec4* last);

// Whether rods for `a` are others than for `b`.
int hair_rods_differ(const hair_physics* a, const hair_physics* b);

#endif
