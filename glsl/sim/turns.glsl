// turns.glsl - tests of how far segments turn, which tell a whip from other motion. See parts.glsl.

// Cosine of the angle by which a segment may turn in a substep, 0.3 rad.
#define MIN_COSINE 0.955

#ifdef WATCHES_TURNS
// Leapfrog keeps the energy of a segment that turns evenly. A whip gains or loses energy where the
// turn changes within a substep. A whip keeps its parts until a whole substep turns no segment
// farther than a part may.
// Cosine of the angle by which a segment may turn in a part, 0.1 rad.
#define MIN_PART_COSINE 0.995
#define MAX_TURN_CHANGE 0.05 // Maximum change of the turn from one leap to the next, rad

#ifdef HAIR_PASS1
// The first program does whole substeps, whose turns it keeps.
#define PUT_SPREAD
#define KEEP_SPREAD
// Change of the direction of segment i in the last substep.
LOCAL(vec3, turn_before);

// Find the last changes of direction by the last displacements.
void begin_turns()
{
    FOR_VERTICES(guide_count) { PUT(handed, local(displacement)); }
    GROUP_BARRIER;
    FOR_VERTICES(guide_count) {
        vec3 way = AFTER_VEC3(place) - GET(place), spread = AFTER_VEC3(handed) - GET(handed);
        local(turn_before) = normalize(way) - normalize(way - spread);
    }
    GROUP_BARRIER;
}

// Return whether a segment turns too far for leapfrog, or not as in the leap before. Keep the turn
// for the next leap.
bool turns_at(uint i)
{
    vec3 turn = GET(edge) - GET(lever), change = turn - local(turn_before);
    bool turned = dot(turn, turn) > 2.0 - 2.0 * MIN_COSINE ||
                  dot(change, change) > MAX_TURN_CHANGE * MAX_TURN_CHANGE;
    local(turn_before) = turn;
    return i + 1u < guide_count && turned;
}
#else
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
#endif
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
