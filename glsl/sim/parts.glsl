// parts.glsl - leaps of SHAKE over a substep, or over parts of one.
//
// If lengths fail or a segment turns too far, a part of half the time is tried, and so on. A leap
// of length h after one of length g advances the velocity by (g + h) / 2, which keeps leapfrog's
// second order. Displacements are stored as over a whole substep.
//
// BDF2 damps a whip's waves. A guide of BDF2 that whips is therefore solved by SHAKE, in parts in
// which explicit bending is stable. BDF2 continues after quiet substeps.

// Extent to which the past is known. At 0 nothing is known, and the strand is at rest. At 1 its
// displacement is known. At 2 its rates are known too. Above 1 SHAKE waits, and below 2 BDF2 leaps.
// Below 1 the displacement is that of a leap over a part of the substep, as known_part() explains.
float known;

// Number of Newton steps on the lengths in the last attempt.
uint  length_steps;

// Contact and pins may leave lengths broken in parts of any size. Guides that touch a collider,
// have pins, or look up colliders in lists therefore take whole substeps.
#if HAIR_SOLVER == SHAKE && !defined(HAIR_COLLIDER_GRID) && !defined(HAIR_PINNED)
#if defined(HAIR_PASS1) && defined(HAIR_STIFF)
#define LEAVES_WHIPS
bool is_left; // The second program must do the guide.
#elif defined(HAIR_PASS1) || defined(HAIR_PASS2)
#define WATCHES_TURNS
#endif
#ifdef HAIR_PASS2
#define SPLITS
#endif
#endif

#ifdef SPLITS
float whip_part;    // Longest part of a guide that whips. 0 if the guide cannot be split.
float leap_part;    // Fraction of the substep, a power of two
// Values of guide_keep and guide_kick for the part.
float part_keep;
float part_kick;
float done;         // Fraction of the substep that is done
uint  rounds_spent; // Loops over the strand in the substep

// Return the last part of a substep. `known` is this part, plus up to as much again that counts the
// quiet substeps since.
float known_part() { return known < 1.0 ? uintBitsToFloat(floatBitsToUint(known) & 0x7f800000u) : 1.0; }

// Return the time for which forces act, in leaps. The first leap is half a step.
float leap_span() { return known == 0.0 ? 0.5 : 0.5 + 0.5 * known_part() / leap_part; }
#else
#define leap_part 1.0
#define part_keep guide_keep
#define part_kick guide_kick
float leap_span() { return known == 0.0 ? 0.5 : 1.0; } // The first leap is half a step.
#endif

#include "sim/turns.glsl"
