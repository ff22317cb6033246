// rod_shape.h - one guide as a rod, in double precision. The files that implement rod.h share this
// header.
#ifndef HAIR_ROD_ROD_SHAPE_H
#define HAIR_ROD_ROD_SHAPE_H

#include "lib/rod/rod.h"

#include <math.h>

typedef struct hair_dvec3 {
    double x, y, z;
} hair_dvec3;
// Quaternion with the real part w.
typedef struct hair_dquat {
    double x, y, z, w;
} hair_dquat;

static inline hair_dvec3 hair_dload(const float* p)
{
    return (hair_dvec3){(double)p[0], (double)p[1], (double)p[2]};
}
static inline hair_dvec3 hair_dadd(hair_dvec3 a, hair_dvec3 b)
{
    return (hair_dvec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline hair_dvec3 hair_dscale(hair_dvec3 a, double s)
{
    return (hair_dvec3){a.x * s, a.y * s, a.z * s};
}
static inline double hair_ddot(hair_dvec3 a, hair_dvec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline double hair_dlength(hair_dvec3 a)
{
    return sqrt(hair_ddot(a, a));
}
static inline hair_dvec3 hair_dcross(hair_dvec3 a, hair_dvec3 b)
{
    return (hair_dvec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline hair_dquat hair_dconjugate(hair_dquat q)
{
    return (hair_dquat){-q.x, -q.y, -q.z, q.w};
}
static inline hair_dquat hair_dmultiply(hair_dquat a, hair_dquat b)
{
    return (hair_dquat){
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
static inline hair_dvec3 hair_drotate(hair_dquat q, hair_dvec3 v)
{
    hair_dvec3 u = {q.x, q.y, q.z};
    hair_dvec3 t = hair_dscale(hair_dcross(u, v), 2);
    return hair_dadd(v, hair_dadd(hair_dscale(t, q.w), hair_dcross(u, t)));
}

// Minimum length of a segment, m. The shortest segment of the shortest strand of a groom is about
// as long.
#define HAIR_ROD_SHORTEST 1e-9

// Return the squared angular frequency of the pull to the groom at a fraction of the vertices.
double hair_rod_pull_squared(const hair_physics* physics, double fraction);

struct hair_rod_shape {
    double ratio[3];
    uint32_t count; // Number of vertices.
    // Constraints of the root. `clamped` fixes its frame, and `held` fixes its position.
    int clamped, held;
    uint32_t pinned[HAIR_MAX_GUIDE_VERTICES]; // Number of the pin, from 1. 0 if not pinned.
    double gravity; // Magnitude of gravity, m/s^2.
    hair_dvec3 load; // Gravity that the rest strain is to balance, m/s^2.
    double weight; // Weight of all vertices but the root.
    double length[HAIR_MAX_GUIDE_VERTICES]; // Length of segment i, m. 0 for the tip.
    double mass[HAIR_MAX_GUIDE_VERTICES];
    // Squared angular frequency of the pull to the groom, 1/s^2.
    double pull[HAIR_MAX_GUIDE_VERTICES];
    double bend[HAIR_MAX_GUIDE_VERTICES]; // Bending stiffness at vertex i.
    hair_dquat frame[HAIR_MAX_GUIDE_VERTICES]; // Frame of segment i.
    hair_dquat turn[HAIR_MAX_GUIDE_VERTICES]; // Rotation from frame i-1 to frame i, w >= 0.
    hair_dvec3 place[HAIR_MAX_GUIDE_VERTICES]; // Position of vertex i in the groom, from the root.
    // Derivative of vertex i's energy by its strain in the groom.
    hair_dvec3 stress[HAIR_MAX_GUIDE_VERTICES];
    // 2 w at rest, where w is the real part of `turn`. See rod.h.
    double rest_real[HAIR_MAX_GUIDE_VERTICES];
};

// Compute the shape of a guide. `rest` is the guide's first vertex. The stress is 0 and rest_real
// is the groom's until hair_rod_bear() sets them.
void hair_rod_shape_of(const struct hair_guide* guide, const struct hair_rest* rest,
                       const hair_physics* physics, struct hair_rod_shape* out);

// Compute the shape of a guide that holds its groom by `borne`. `rest` and `borne` are those of all
// guides.
void hair_rod_shape_with(const struct hair_guide* guide, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, const hair_physics* physics,
                         struct hair_rod_shape* out);

#define HAIR_ROD_FRAME (1.0 / 60) // s
#define HAIR_ROD_PER_FRAME_DIRECT 4 // Minimum substeps of the solver direct in a frame.
// Maximum vertices of a straight guide for which direct needs no more substeps than that.
#define HAIR_ROD_MAX_PLAIN 32
// Return the number of substeps per frame that direct needs for a straight guide, so that it keeps
// its length when a spinning head pulls it taut.
double hair_rod_substeps_of_straight(uint32_t vertices);
// Return the maximum stiffness at vertex i that can be solved in single precision with substeps of
// length h, by the scheme of straight rods.
double hair_rod_max_stiffness(const struct hair_rod_shape* shape, uint32_t i, double h);

// Return the bending stiffness at vertex i, divided by the length of rod that bends there. Return 0
// where vertex i does not resist bending.
double hair_rod_stiffness(const struct hair_rod_shape* shape, uint32_t i);

// Return the stiffness at vertex i about the axes of its section, as multiples of
// hair_rod_stiffness().
hair_dvec3 hair_rod_ratios_at(const struct hair_rod_shape* shape, uint32_t i);

// Maximum length of hair_rod_excess().
#define HAIR_ROD_MAX_STRAIN 1.0
// Return the strain of the groom less the rest strain that balances the stress, at vertex i. The
// stiffness of the vertex is not 0.
hair_dvec3 hair_rod_excess(const struct hair_rod_shape* shape, uint32_t i, double stiffness);

// Functions of tip_inertia.c, for strands with a held root and a tip that outweighs them.

// Return an upper bound on the frequency of crosswise oscillation, 1/s. Return 0 for other strands.
double hair_rod_tautness(const struct hair_rod_shape* shape);
// Return the longest b of an implicit method that needs no tip inertia, s.
double hair_rod_longest_taut(const struct hair_rod_shape* shape);
// Add inertia to the vertices for which b is too long.
void hair_rod_add_inertia(struct hair_rod_shape* shape, double b);
// Return the weight of vertex i as a fraction of its inertia.
double hair_rod_weight_fraction(const struct hair_rod_shape* shape, uint32_t i);

// Write one hair_rod per vertex for glsl/sim/follow.comp, which interprets the factors in its own
// way. See follow_segments.c.
void hair_follow_write(const struct hair_rod_shape* shape, struct hair_rod* out);

// Maximum multiple of the bending stiffness that holds the groom.
#define HAIR_ROD_MAX_STIFFEN 3.0
// Apply the gravity preload to a new shape.
void hair_rod_bear(struct hair_rod_shape* shape, const struct hair_rod_borne* borne);

#endif
