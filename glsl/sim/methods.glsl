// methods.glsl - the methods of a substep, and their state of a guide's past.
// Leapfrog, or Verlet: second order, with exact damping. Lengths are corrected along the edges of
// the start.
#define SHAKE 0
#define BACK 1   // BDF2: second order, stable at any stiffness
#define EULER 2  // Implicit Euler: first order, more stable still
#define LEADER 3 // Implicit Euler, then follow-the-leader

// Tests for a method. They are constants where a program never has the method, because software
// rasterisers execute both sides of a branch.
#define IS_SHAKE(method) (HAIR_SOLVER == SHAKE && (method) == SHAKE)
#define IS_BACK(method) (HAS_BACK && (method) == BACK)
#define IS_LEADER(method) ((method) == LEADER)
#ifdef HAIR_MIXED
#define LEAPS(method) false
#else
#define LEAPS(method) (IS_BACK(method) && known < 2.0) // See velocity_history.glsl.
#endif

#if HAIR_SOLVER != SHAKE || defined(HAIR_STIFF)
#define KEEPS_RATES
#define HAS_BACK true
// h v at the end of the last substep, or the displacement while known < 2.
LOCAL(vec3, rate);
// h v at the end of the substep before.
SPILLED(vec3, rate_before);
LOCAL(float, touched);    // 1 if the vertex touched a collider at the end of the last substep
#ifndef HAIR_MIXED
// Tension of segment i that keeps its length, divided by the line density, m^2/s^2.
LOCAL(float, tension);

#define GUESSED 0.5      // Minimum fraction of the last tension that guessed_part() returns
#define SLOW 0.6         // w h up to which the whole tension is guessed
#define FAST 2.0         // w h from which on the fraction GUESSED is guessed
#define STILL 0.05       // Speed relative to the root at which a vertex counts as still, m/s
#define MOVING 0.2       // Speed from which on the vertex counts as moving, m/s
// Maximum displacement of a chain by the guessed tension, as a fraction of the distance to a
// neighbour.
#define MAX_GUESSED 0.5
#define FIND_TENSION(part) local(tension) -= (part) * local(solution) / of_force
#define KEEPS_TENSION
#endif
#else
#define HAS_BACK false
#define FIND_TENSION(part)
#endif
#ifdef HAIR_STIFF
int own_method; // Method of the guide
#else
const int own_method = HAIR_SOLVER;
#endif
// Displacement times mass by a force in the substep, divided by the force, s^2.
float of_force;
#include "sim/parts.glsl"
