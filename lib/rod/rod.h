// rod.h - guides as rods, vertex by vertex, for the solvers of Kirchhoff's equations. No OpenGL.
//
// Everything is divided by the mass of a metre of hair, so that masses are lengths. The arithmetic
// is in double precision. Let q_i be the frame of the segment after vertex i, and q_-1 that of the
// scalp. The product conj(q_(i-1)) q_i has the real part w, with the sign chosen so that w is
// positive. Let u = 2 Im(conj(q_(i-1)) q_i). The energy of vertex i is
//
//   strain.w / 2 ((u - strain) . R (u - strain) + R_z (2 w - 2 w0)^2),   R = diag(ratio)
//
// where 2 w0 is the value of 2 w at rest. The scheme of straight rods omits the last term. See
// glsl/sim/mixed.glsl for the purpose of that term.
#ifndef HAIR_ROD_ROD_H
#define HAIR_ROD_ROD_H

#include <hair/hair.h>

#include "glsl/shared.h"
#include "lib/base/assert.h"
#include "lib/base/host.h"
#include "lib/groom/guide_factors.h"

#include <stdbool.h>

// A pin whose vertex has been found.
struct hair_resolved_pin {
    uint32_t guide, vertex;
    int world; // 1 if `place` is in the world, 0 if in the head's frame.
    double place[3]; // Position of the vertex, m.
    uint32_t given; // Index of the pin in the application's array.
};

// Compute R, the stiffness of bending about the frame's x axis, of twist, and of bending about its
// z axis. The stiffness is relative to the bending stiffness of a round section of the same area. A
// strand bends most easily about x, the long axis of the section.
void hair_rods_ratios(const hair_physics* physics, double ratio[3]);

// A guide vertex as part of a rod, for the solvers of Kirchhoff's equations. All quantities are
// divided by the mass of one metre of hair, which makes masses lengths. Follow-the-leader uses
// strain and factors differently, with the symbols of lib/rod/follow_segments.c. Its strain holds K
// r + a' and c, and its factor holds p, all divided by the inertia. Its factor_euler holds r and a
// damping rate. Its segment.w is the part of this rate that acts against the turn of the segment
// before, 1/s.
struct hair_rod {
    // xyz: rest strain 2 Im(conj(q_(i-1)) q_i) at vertex i, with q_i the frame of segment i. At the
    // root q_(i-1) is the frame of the scalp. w: bending stiffness divided by the length that it
    // acts over, m^3/s^2.
    hair_vec4 strain;
    // x: length of segment i, m. 0 for the tip. y: 1 / mass, 1/m. z: square of the angular
    // frequency of the pull to the rest pose, 1/s^2. w of a first vertex: method of the accurate
    // solver. 0 is explicit, 1 is BDF2, and 2 is implicit Euler, for a guide that a heavy tip pulls
    // taut. w of a second vertex: longest part of a substep when the guide whips, a power of two. 0
    // if no part is short enough. w of every vertex in the mixed scheme: 2 w0, twice the real part
    // of conj(q_(i-1)) q_i at rest. 0 for the tip.
    hair_vec4 segment;
    // Row of L D L^T of the implicit system of the solver's own method. x: 1/D. y: L(i+1,i). z:
    // L(i+2,i). w: number of the first pin beyond this vertex, counted from 1. 0 if there is none.
    hair_vec4 factor;
    // Row of L D L^T of implicit Euler, the fallback method. In the mixed scheme, xyz: stiffness
    // about the axes of the section, as multiples of strain.w. w of the tip: rate at which the
    // guide's velocities decay, 1/s.
    hair_vec4 factor_euler;
};

// Gravity preload of a guide vertex, by which the guide holds its groom.
struct hair_rod_borne {
    double stress[3]; // Derivative of the vertex's energy by its strain in the groom.
    double rest_real; // 2 w0, the value of 2 w in the pose that the guide holds.
    double stiffen; // Multiple of the stiffness, 1 to 3.
};

// Guides whose stiffness is reduced to what the solver can solve at its substep in single
// precision.
struct hair_rods_softened {
    uint32_t guides;
    uint32_t worst; // Index of the guide that is softened most.
    float factor; // Stiffness factor of its most softened vertex. 1 if no guide is softened.
};

struct hair_rods_report {
    uint32_t stiffened; // Number of guides with a stiffened vertex.
    float stiffest; // Largest multiple of the stiffness. 1 if no guide is stiffened.
    uint32_t sagging; // Number of guides that cannot hold their groom even when stiffened.
    float farthest_sag; // Largest distance of their vertices at rest from the groom, m.
    struct hair_rods_softened softened;
};

static inline struct hair_rods_report hair_rods_report_none(void)
{
    return (struct hair_rods_report){.stiffest = 1, .softened = {.factor = 1}};
}

// Compute the gravity preload of guides, as gravity_preload.c describes. The preload depends on no
// solver and no substep.
//
// The rest strain of a guide with a clamped root balances the fraction
// hair_physics.shape.gravity_preload of gravity. With 1 the groom is in equilibrium. A strand that
// is too soft would still buckle out of the groom, or need a rest strain further than 1 from the
// groom's own. Such a guide is made up to 3 times as stiff, by as little as keeps it stable. A
// guide that needs more stiffness sags to a pose that it can keep.
//
// The other guides, and their order, change no result. Return HAIR_ERROR_MEMORY if the host refuses
// memory.
struct hair_rods_preload {
    const hair_host* host; // NULL selects the C library's allocator.
    const struct hair_guide* guides;
    const struct hair_rest* rest;
    const uint32_t* list; // Guides that are computed, `count` of them. NULL selects the first ones.
    uint32_t count;
    // Return the physics of a guide, which may be in `own`. All have the same fibres, but for
    // Young's modulus, the same root and the same gravity.
    const hair_physics* (*find_physics)(const void* user, uint32_t guide, hair_physics* own);
    const void* user;
    struct hair_rod_borne* out; // Receives the vertices of the guides.
    float* sags; // Receives the distance of each guide from its groom, m. -1 if the guide holds it.
};
hair_result hair_rods_preload_list(const struct hair_rods_preload* desc);
// Compute the gravity preload of guides with the same physics. NULL `host` selects the C library's
// allocator. Return HAIR_ERROR_MEMORY if the host refuses memory.
hair_result hair_rods_preload_gravity(const hair_host* host, const struct hair_guide* guides,
                                      const struct hair_rest* rest, uint32_t count,
                                      const hair_physics* physics, struct hair_rod_borne* out,
                                      struct hair_rods_report* report);

// Write one hair_rod per vertex of a guide for substeps of the given length. `borne` comes from
// hair_rods_preload_list(). `out` has the vertices of the guide only. Limit the distance of the
// rest strain from the groom's own to 1. Return the smallest stiffness factor of a vertex, which is
// 1 unless the guide is softened.
double hair_rods_write(const struct hair_guide* guide, const struct hair_rest* rest,
                       const struct hair_rod_borne* borne, const hair_physics* physics, hair_solver solver,
                       int mixed, double substep, struct hair_rod* out);

// Write a pinned guide again. Its pins are those from `first` up to, not including, `end`.
void hair_rods_pin(const struct hair_guide* guide, const struct hair_rest* rest,
                   const struct hair_rod_borne* borne, const struct hair_resolved_pin* resolved_pin,
                   uint32_t first, uint32_t end, const hair_physics* physics, hair_solver solver, int mixed,
                   double substep, struct hair_rod* out);

// Return whether the mixed scheme is to solve the guides under direct and accurate. The mixed
// scheme is needed when some guides are curved at rest. It is also needed when segments are too
// short or a tip is too heavy for the scheme of straight rods. Under direct it is also needed for
// more than 32 vertices where colliders or pins hold hair, or where the substep is longer than
// direct's own. `is_held` tells of colliders and pins. A substep of 0 stands for direct's own.
bool hair_rods_are_mixed(const struct hair_guide* guides, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, uint32_t count, const hair_physics* physics,
                         hair_solver solver, bool is_held, double substep);

// Return whether colliders and pins may decide the scheme under direct.
bool hair_rods_are_long(const struct hair_guide* guides, uint32_t count);

// Return a solver's own substep length, s. Direct takes 1/240, down to 1/960 for heavy tips, and
// 1/240 times 32 / N for straight guides of N > 32 vertices. Accurate takes 1/1080, or less where
// explicit bending is only stable with less, down to 1/6000. Guides that need even shorter substeps
// are solved by BDF2. The mixed scheme takes 1/240 under direct and 1/1440 under accurate.
double hair_rods_substep(const struct hair_guide* guides, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, uint32_t count, const hair_physics* physics,
                         hair_solver solver, int mixed);

// Return the maximum number of rounds of cyclic reduction for a guide of `max_vertices` vertices.
uint32_t hair_rods_rounds(uint32_t max_vertices);

// Return whether the solver's own method has an implicit system for a guide, whose vertices are
// `rod`.
bool hair_rods_have_system(const struct hair_rod* rod);
// Reduce the system of the solver's own method for work groups. `rod` has the vertices of the guide
// only. Write one vec4 per vertex and round to `out`, round after round, and the final solve to
// `last`, one vec4 per vertex. A guide without such a system leaves zeros. `out` holds
// hair_rods_rounds() - 1 rounds of zeros on entry, and `last` holds zeros. Return the number of
// rounds before the final solve.
uint32_t hair_rods_write_reduction(const struct hair_guide* guide, const struct hair_rod* rod,
                                   uint32_t vertices, double substep, hair_vec4* out, hair_vec4* last);

// Add the final solve to the rounds in `out`, after `rounds` rounds.
void hair_rods_add_final_solve(const struct hair_guide* guides, uint32_t count, uint32_t vertices,
                               uint32_t rounds, const hair_vec4* last, hair_vec4* out);

// Return whether physics `a` and `b` need different rods.
bool hair_rods_differ(const hair_physics* a, const hair_physics* b);

// Functions of factors.c.

bool hair_factors_are_equal(const struct hair_guide_factors* a, const struct hair_guide_factors* b);
// Return physics that are multiplied by the factors of a guide, within the ranges of hair_physics.
hair_physics hair_physics_multiply(const hair_physics* physics, const struct hair_guide_factors* factors);

#endif
