// rod.comp - the solvers of an inextensible rod. A dispatch does all substeps of a step for every
// guide.
//
// HAIR_SOLVER names the method that is tried first. Programs with HAIR_STIFF try BDF2 for guides
// whose bending makes SHAKE unstable at this substep. A substep that the method leaves stretched or
// not finite is done again by implicit Euler, and then by follow-the-leader, which cannot fail. A
// guide that is not finite even then returns to its rest pose. Each such substep is counted in
// solver_stats[]. A whip is solved by SHAKE in parts of a substep, as parts.glsl explains.
#version 450 core
#ifdef HAIR_SUBGROUP
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#endif
#include "sim/rod.glsl"
layout(local_size_x = GROUP_THREADS) in;
#include "sim/bending.glsl"
#include "sim/predict.glsl"
#include "sim/length_constraints.glsl"
#include "sim/root_transforms.glsl"
#include "sim/load_store.glsl"
#include "sim/finish_substep.glsl"

#ifdef SPLITS
void place_part(float size, float end, vec3 head_moved);
bool may_split(float smaller);
bool turns_far(int method);
bool splits(inout int method, float known_before, vec3 head_moved);
#endif

// Do the substep by `method`. Return false if it failed.
bool attempt(int method, vec3 head_moved)
{
    predict(method);
    find_colliders(head_moved);
    list_reaching();
    bool fits = fit_lengths(method, HAIR_SOLVER == SHAKE ? 3e-4 : 9e-4, head_moved);
#ifdef SPLITS
    fits = !turns_far(method) && fits;
#endif
    return fits;
}

// Do the substep, or a part of it, by one method after the other, until one succeeds.
void attempt_all(vec3 head_moved)
{
    bool waits = own_method == SHAKE && known > 1.0;
    int method = waits || (own_method == BACK && known < LEAPS_NEXT) ? EULER : own_method;
#ifdef SPLITS
    float known_before = known;
    // BDF2 has no past after parts, and begins with a leap.
    if (leap_part < 1.0) method = SHAKE;
    else if (own_method == BACK && known > 0.0 && known < 1.0) {
        method = BACK;
        known  = LEAPS_NEXT;
    }
#endif
    // One compiler makes slower code if the attempt is the loop's condition.
    for (;; ++method) {
        vec3 moves = head_moved;
#ifdef SPLITS
        moves *= min(leap_part, 1.0 - done);
#endif
        if (attempt(method, moves)) break;
#ifdef SPLITS
        if (splits(method, known_before, head_moved)) continue;
        // A method that does not leap does the whole rest.
        place_part(1.0, 1.0, head_moved);
#endif
#ifdef LEAVES_WHIPS
        is_left = may_whip(method);
        if (is_left) return;
#endif
#ifdef KEEPS_RATES
        // The failed attempt led to wrong tensions.
        FOR_VERTICES(guide_count) { local(tension) = 0.0; }
#endif
        // Skip BDF2, which needs a past that SHAKE does not keep.
        if (IS_SHAKE(method)) ++method;
        count_in(method >= EULER ? HAIR_SOLVER_STATS_FOLLOW_FALLBACKS : HAIR_SOLVER_STATS_EULER_FALLBACKS);
    }
#ifdef HAIR_PINNED
    if (group_any(bvec2(taut, false)).x) count_in(HAIR_SOLVER_STATS_OVEREXTENDED);
#endif
#ifdef LEAVES_WHIPS
    is_left = !accept(method, waits, head_moved);
#else
    accept(method, waits, head_moved);
#endif
}

#include "sim/substeps.glsl"
#include "sim/guide_list.glsl"
#include "sim/guide_level.glsl"

// Many guides go through two programs. The first knows only the solver's own method. The second
// knows all methods, and does the guides that the first leaves. The first thus takes fewer
// registers, and its instructions fit into a GPU's cache. With HAIR_STIFF the first knows all
// methods too, but not parts of a substep.
void main()
{
    uint first = hair_guide_number(),
         guides_at_once = hair_group_count() * GUIDES_IN_GROUP;
#if defined(HAIR_PASS1)
    if (first == 0u && lane == 0u) clear_list(1u - params.list);
    for (uint k = first; k < params.simulated; k += guides_at_once) {
        guide_number = simulated_guide(k);
        bool done = solve();
        if (!done && lane == 0u) add_to_list(guide_number);
        GROUP_BARRIER;
    }
#elif defined(HAIR_PASS2)
    uint count = solver_stats[length_of_list(params.list)];
    for (uint n = first; n < count; n += guides_at_once) {
        guide_number = solver_stats[HAIR_SOLVER_STATS_LISTS + n];
        solve();
        GROUP_BARRIER;
    }
#else
    if (first < params.simulated) {
        guide_number = simulated_guide(first);
        solve();
    }
#endif
}
