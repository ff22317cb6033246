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
// Values of params.keep and params.kick for the part.
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
#define part_keep params.keep
#define part_kick params.kick
float leap_span() { return known == 0.0 ? 0.5 : 1.0; } // The first leap is half a step.
#endif

// Cosine of the angle by which a segment may turn in a substep, 0.3 rad.
#define MIN_COSINE 0.955

#ifdef WATCHES_TURNS
// Leapfrog keeps the energy of a segment that turns evenly. A whip gains or loses energy where the
// turn changes within a substep. A whip keeps its parts until a whole substep turns no segment
// farther than a part may.
// Cosine of the angle by which a segment may turn in a part, 0.1 rad.
#define MIN_PART_COSINE 0.995
#define MAX_TURN_CHANGE 0.05 // Maximum change of the turn from one leap to the next, rad

#if defined(HAIR_THREAD_PER_GUIDE) || (defined(HAIR_SUBGROUP) && HAIR_GUIDE_THREADS == 32)
#define PUT_SPREAD
#define KEEP_SPREAD
#define SPREAD_BEFORE (leap_part * (AFTER_VEC3(displacement) - local(displacement)))
// Threads of a work group do not see a neighbour's displacement. find_edges() has a barrier between
// the two macros.
#else
// Difference of the displacements of a segment's ends in the last leap.
LOCAL(vec3, spread_before);
#define PUT_SPREAD PUT(handed, leap_part * local(displacement))
#define KEEP_SPREAD                                                                                          \
    FOR_VERTICES(guide_count - 1u)                                                                           \
    {                                                                                                        \
        local(spread_before) = AFTER_VEC3(handed) - GET(handed);                                             \
    }
#define SPREAD_BEFORE local(spread_before)
#endif

// Return whether a segment turns too far for leapfrog, or not as in the leap before.
bool turns_at(uint i, float min_cosine)
{
    // Sum of the segment's directions before and after.
    vec3  middle = GET(edge) + GET(lever);
    vec3  change = AFTER_VEC3(moved) - GET(moved) - SPREAD_BEFORE;
    float along  = dot(change, middle) / max(dot(middle, middle), 1e-9);
    float across = length(change - along * middle);
    bool  turned = dot(GET(edge), GET(lever)) < min_cosine || across > MAX_TURN_CHANGE * local(rest_length);
    return i + 1u < guide_count && turned;
}
#else
#define PUT_SPREAD
#define KEEP_SPREAD
#endif

#if defined(LEAVES_WHIPS) || defined(SPLITS)
// Maximum of 1 - cos of the angle by which a segment may turn in a substep of BDF2, 0.07 rad. BDF2
// damps the waves of faster turns.
#define MAX_TURN_OF_BACK 0.0025

// Return whether segments may turn too far in a whole substep. Lengths of quiet guides take one
// step.
bool may_turn_far() { return length_steps > 1u; }

// Return whether a segment turns too far in a whole substep.
bool turns_in_whole(uint i, int method)
{
    float along = dot(GET(edge), AFTER_VEC3(moved) - GET(moved)),
          max_turn = IS_BACK(method) ? MAX_TURN_OF_BACK : 1.0 - MIN_COSINE;
    return i + 1u < guide_count && method < EULER && along > max_turn * local(rest_length);
}
#endif
