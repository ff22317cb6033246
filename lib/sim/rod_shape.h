// rod_shape.h - one guide as a rod, in double precision: what the files of rod.h share.
#ifndef HAIR_SIM_ROD_SHAPE_H
#define HAIR_SIM_ROD_SHAPE_H

#include "lib/sim/rod.h"

#include <math.h>

// Components x, y, z; of quaternions w after them.
typedef struct hair_dvec3 {
    double x, y, z;
} hair_dvec3;
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

struct hair_rod_shape {
    double ratio[3];
    uint32_t count; // of vertices
    int clamped, held; // at the root
    uint32_t tied[HAIR_MAX_GUIDE_VERTICES]; // by the tie of this number, from 1; 0: not
    double gravity; // m/s^2
    hair_dvec3 load; // the gravity that the rest strain is to bear, m/s^2
    double weight; // of all but the root vertex
    double length[HAIR_MAX_GUIDE_VERTICES]; // of segment i, 0 for the tip
    double mass[HAIR_MAX_GUIDE_VERTICES];
    double pull[HAIR_MAX_GUIDE_VERTICES]; // squared angular frequency of the pull to the groom, 1/s^2
    double bend[HAIR_MAX_GUIDE_VERTICES]; // bending stiffness at vertex i
    hair_dquat frame[HAIR_MAX_GUIDE_VERTICES]; // of segment i
    hair_dquat turn[HAIR_MAX_GUIDE_VERTICES]; // from the frame of segment i-1 to that of i, w >= 0
    hair_dvec3 place[HAIR_MAX_GUIDE_VERTICES]; // of vertex i in the groom, from the root
    hair_dvec3 stress[HAIR_MAX_GUIDE_VERTICES]; // derivative of vertex i's energy by its strain in the groom
    double rest_real[HAIR_MAX_GUIDE_VERTICES]; // 2 w at rest, w the real part of `turn`: see rod.h
};

// `rest` is that of the guide. The stress is 0 and rest_real is the groom's: hair_rod_hold() or
// hair_rod_bear() set them.
void hair_rod_shape_of(const struct hair_guide* guide, const struct hair_rest* rest,
                       const hair_physics* physics, struct hair_rod_shape* out);

// Bending stiffness over the length it is for. 0 where vertex i resists nothing.
double hair_rod_stiffness(const struct hair_rod_shape* shape, uint32_t i);

// From the rest strain that bears the stress to the strain of the groom, at a vertex of that stiffness, not 0.
#define HAIR_ROD_MOST_STRAIN 1.0
hair_dvec3 hair_rod_excess(const struct hair_rod_shape* shape, uint32_t i, double stiffness);

// taut.c: of strands that hang from a held root and whose tip outweighs them. Others have tautness 0.
double hair_rod_tautness(const struct hair_rod_shape* shape); // the highest frequency that gives, 1/s
double hair_rod_longest_taut(const struct hair_rod_shape* shape); // b that implicit methods can have, s
void hair_rod_add_inertia(struct hair_rod_shape* shape, double b); // where that is exceeded
double hair_rod_weight_share(const struct hair_rod_shape* shape, uint32_t i); // of its inertia

// follow.c: write one hair_rod per vertex as glsl/sim/follow.comp reads it. Its factors have another
// meaning there.
void hair_follow_write(const struct hair_rod_shape* shape, struct hair_rod* out);

// hold.c. Set stress and rest_real of a new shape so that it holds its groom, and multiply its
// bending stiffness for that by 1 to 3, vertex by vertex. With more than that the groom would still be
// unstable, or a rest strain further than 1 from the groom's own: then the guide is three times as
// stiff and sags as little as leads to a stable pose.
#define HAIR_ROD_MOST_STIFFEN 3.0
struct hair_rod_held {
    double stiffest; // greatest multiple of the stiffness; 1 when there is none
    double sag; // farthest that a vertex comes to rest from the groom, m; 0 when it holds
    int sags;
};
struct hair_rod_held hair_rod_hold(struct hair_rod_shape* shape);

// Use what hair_rod_hold() found before for a shape like this.
void hair_rod_bear(struct hair_rod_shape* shape, const struct hair_rod_borne* borne);

#endif
