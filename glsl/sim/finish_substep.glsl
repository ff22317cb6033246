// finish_substep.glsl - the end of a substep. Accept its result, or return the guide to its rest
// pose.

// Decrease of `known` per substep of implicit Euler after SHAKE has failed. A strand where SHAKE
// fails is kinked, and oscillates from vertex to vertex. No explicit method can follow these
// oscillations. It would fail again and again, or flail without failing. Implicit Euler damps them
// for 16 substeps.
#define WAIT (1.0 / 16.0)

// Fraction of the speed kept after follow-the-leader. Follow-the-leader adds speed. A strand that
// keeps all of it flails, and the method of its solver then fails again, without end.
#define LEADER_KEEPS 0.5

// Return how much of the past is known after a substep without an impact.
float known_after(int method)
{
#ifdef HAIR_MIXED
    if (method == BACK && !guarded) return min(known + CALM, MAX_CALM);
#endif
    return 2.0;
}

#ifdef LEAVES_WHIPS
// Return whether an attempt may have failed because the guide whips. The second program then tries
// again. A guide that touches a collider takes whole substeps.
bool may_whip(int method)
{
    bool touches = false;
    if (method != own_method || method == EULER) return false;
    FOR_VERTICES(guide_count) { touches = touches || (COLLIDERS && local(met) != BITS(0u)); }
    return !COLLIDERS || !group_any(bvec2(touches, false)).x;
}
#endif

#ifdef HAIR_IMPULSES
#include "sim/accept_impulses.glsl"
#endif

// Accept `moved` as the result of a substep by `method`. Update place, displacement and rates. A
// strand that is not finite, or is farther away than any hair, returns to its rest pose and moves
// with the head. Return false if another program must do the substep instead.
bool accept(int method, bool waits, vec3 head_moved)
{
    bool lost = false, struck = false, turns = false, touches = false;
#ifdef LEAVES_WHIPS
    if (may_turn_far()) {
        FOR_VERTICES(guide_count) {
            turns   = turns || turns_in_whole(i, method);
            touches = touches || (COLLIDERS && local(met) != BITS(0u));
        }
    }
#endif
    FOR_VERTICES(guide_count) {
        vec3 d = GET(moved), kept = d;
#if defined(HAIR_PASS1) && defined(WATCHES_TURNS)
        // The second program splits the substep, unless a vertex touched a collider.
        turns  = turns || turns_at(i);
        struck = struck || (COLLIDERS && local(met) != BITS(0u));
        lost   = lost || (!COLLIDERS && turns);
#endif
        // Limit the speed that follow-the-leader added.
        if (IS_LEADER(method)) {
            float fastest =
                length(root_moved) + 4.0 * SUBSTEP * sqrt(2.0 * length(params.gravity.xyz) * guide_length);
            vec3  root_d   = GET_AT(moved, 0u), relative = d - root_d;
            float speed    = length(relative);
            float keeps =
                (heavy && i + 1u == guide_count) || (PINNED && local(slack) == 0.0) ? 1.0 : LEADER_KEEPS;
            kept           = root_d + keeps * relative * (speed > fastest ? fastest / speed : 1.0);
        }
        // Round as store() and load() do, so that the number of substeps per dispatch does not
        // matter.
        vec3 from_head = rounded(root_now + (GET(place) + (d - root_moved)));
        PUT(place, from_head - root_now);
#ifdef HAIR_IMPULSES
        begin_lapse(i, method, d);
#endif
#ifdef KEEPS_RATES
        struck = struck || is_struck(i, d);
        keep_rates(i, method, d, kept);
#endif
#ifdef KEEPS_TENSION
        bool slacks  = IS_LEADER(method) || i + 1u >= guide_count || bits_of(local(tension)) >= 0x7f800000u;
        local(tension) = slacks ? 0.0 : local(tension);
#endif
        local(displacement) = kept / leap_part;
        if (i < guide_count)
            lost = lost || max(bits_of(dot(from_head, from_head)), bits_of(dot(d, d))) >
                               floatBitsToUint(FARTHEST * FARTHEST);
    }
#ifdef LEAVES_WHIPS
    uint  flags = uint(lost) | uint(struck) << 1u | uint(turns) << 2u | uint(touches) << 3u;
    uint  all   = all_bits(uvec2(flags, 0u)).x;
    bvec2 found = bvec2((all & 1u) != 0u, (all & 2u) != 0u);
#else
    bvec2 found = group_any(bvec2(lost, struck));
#endif
    if (IS_SHAKE(method)) known = leap_part;
    else if (own_method == SHAKE)
        known = waits && method == EULER ? max(known - WAIT, 1.0) : 2.0 - WAIT;
    else known = method == BACK || method == EULER ? found.y ? LEAPS_NEXT : known_after(method) : 1.0;
#ifdef HAIR_IMPULSES
    if (!found.x) accept_impulses(method);
#endif
#ifdef LEAVES_WHIPS
    bool whips = (all & 12u) == 4u && rod_segment(guide_first + 1u).w > 0.0;
    return !(found.x || whips);
#elif defined(HAIR_PASS1)
    if (HAIR_SOLVER == SHAKE && COLLIDERS && !found.y) return !group_any(bvec2(turns || found.x, false)).x;
    return !found.x;
#else
    if (!found.x) return true;

    vec3 still = dot(head_moved, head_moved) < FARTHEST * FARTHEST ? head_moved : vec3(0.0);
    FOR_VERTICES(guide_count) {
        PUT(place, rotate(turn_now, rest_from_root(i)));
        local(displacement) = still;
#ifdef HAIR_MIXED
        SHARED_READ(section) =
            quat_multiply(turn_now, rest[min(guide_first + i, params.vertices - 1u)].frame);
        local(force) = local(turned) = local(turned_before) = vec3(0.0);
        local(reaction) = vec3(0.0);
#endif
#ifdef KEEPS_RATES
        local(rate) = spilled(rate_before) = still;
#endif
#ifdef KEEPS_TENSION
        local(tension) = 0.0;
#endif
    }
    known       = 1.0;
    count_in(HAIR_SOLVER_STATS_RESET);
    return true;
#endif
}
