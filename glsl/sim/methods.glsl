// methods.glsl - the methods of a substep, and what they keep of a guide's past.
#define SHAKE 0  // leapfrog: Verlet's second order, damping exact; lengths corrected along the edges of the start
#define BACK 1   // BDF2: second order, stable at any stiffness
#define EULER 2  // implicit Euler: first order, more stable still
#define LEADER 3 // the same, then follow the leader

// These tests are constants where a program never has the method: software rasterisers run both sides of a branch.
#define IS_SHAKE(method) (HAIR_SOLVER == SHAKE && (method) == SHAKE)
#define IS_BACK(method) (HAS_BACK && (method) == BACK)
#define IS_LEADER(method) ((method) == LEADER)
#ifdef HAIR_MIXED
#define LEAPS(method) false
#else
#define LEAPS(method) (IS_BACK(method) && known < 2.0) // See past.glsl.
#endif

#if HAIR_SOLVER != SHAKE || defined(HAIR_STIFF)
#define KEEPS_RATES
#define HAS_BACK true
OWN(vec3, rate);        // h v at the end of the last substep; the displacement while known < 2
PARKED(vec3, rate_before); // and of the one before
OWN(float, touched);    // 1: something, at the end of the last substep
#ifndef HAIR_MIXED
OWN(float, tension);    // of segment i, the force that keeps its length, over line density: m^2/s^2

#define GUESSED 0.5      // of the tension that was, at least: see guessed_part
#define SLOW 0.3         // w h up to which all of it is,
#define FAST 1.0         // and from which on no more
#define STILL 0.05       // m/s from the root: what moves no faster is,
#define MOVING 0.2       // and what is no longer
#define MOST_GUESSED 0.5 // of the distance to a neighbour, which that may move a vertex
#define FIND_TENSION(part) own(tension) -= (part) * own(solution) / of_force
#define KEEPS_TENSION
#endif
#else
#define HAS_BACK false
#define FIND_TENSION(part)
#endif
#ifdef HAIR_STIFF
int own_method; // of the guide
#else
const int own_method = HAIR_SOLVER;
#endif
float of_force; // what a force does in the substep, displacement times mass: s^2
#include "sim/parts.glsl"
