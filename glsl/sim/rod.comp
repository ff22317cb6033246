// rod.comp - the solvers of an inextensible rod: all substeps of a step for every guide.
//
// HAIR_SOLVER names the method that is tried first; of guides whose bending SHAKE cannot bear at that substep BDF2, in
// the programs that have HAIR_STIFF. A substep that it leaves stretched or not finite is done again by implicit Euler,
// and that failing by follow-the-leader, which cannot; a guide that is not finite even so goes back to its rest pose.
// Each such substep is counted in health[]. SHAKE takes a substep in parts where a whip turns segments: see parts.glsl.
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
#include "sim/lengths.glsl"
#include "sim/ride.glsl"
#include "sim/stored.glsl"
#include "sim/accept.glsl"

#ifdef SPLITS
void place_part(float size, float end, vec3 head_moved);
bool may_split(float smaller);
bool turns_far(int method);
#endif

// The substep by `method`. False: it failed.
bool attempt(int method, vec3 head_moved)
{
    predict(method);
    find_solids(head_moved);
    list_reaching();
    bool fits = fit_lengths(method, HAIR_SOLVER == SHAKE ? 3e-4 : 9e-4, head_moved);
#ifdef SPLITS
    fits = !turns_far(method) && fits;
#endif
    return fits;
}

// The substep, or a part of it, by one method after the other, until one can.
void attempt_all(vec3 head_moved)
{
    bool waits = own_method == SHAKE && known > 1.0;
    int method = waits || (own_method == BACK && known < LEAPS_NEXT) ? EULER : own_method;
    for (;; ++method) { // As a condition the attempt takes a tenth longer by one compiler.
        vec3 moves = head_moved;
#ifdef SPLITS
        moves *= min(leap_part, 1.0 - done);
#endif
        if (attempt(method, moves)) break;
#ifdef SPLITS
        if (IS_SHAKE(method) && may_split(0.5 * leap_part)) {
            place_part(0.5 * leap_part, done + 0.5 * leap_part, head_moved);
            --method;
            continue;
        }
        place_part(1.0, 1.0, head_moved); // All that is left, by a method that does not leap.
#endif
#ifdef KEEPS_RATES
        EACH(guide_count) { own(tension) = 0.0; } // This one was led to nothing.
#endif
        if (IS_SHAKE(method)) ++method; // To Euler: BDF2 needs a past that SHAKE does not keep.
        count_in(method >= EULER ? HAIR_HEALTH_FOLLOW : HAIR_HEALTH_EULER);
    }
#ifdef HAIR_TIED
    if (any_of(bvec2(taut, false)).x) count_in(HAIR_HEALTH_TAUT);
#endif
    accept(method, waits, head_moved);
}

#include "sim/substeps.glsl"
#include "sim/guide_list.glsl"

// Many guides go through two programs: one that knows no method but the solver's own, and for those that it leaves one that
// knows all. So the first takes fewer registers, and instructions that a GPU has at hand.
void main()
{
    uint first = hair_guide_number(), guides_at_once = gl_NumWorkGroups.x * gl_NumWorkGroups.y * GUIDES_IN_GROUP;
#if defined(HAIR_FIRST)
    if (first == 0u && lane == 0u) clear_list(1u - params.list);
    for (guide_number = first; guide_number < params.guides; guide_number += guides_at_once) {
        bool done = solve();
        if (!done && lane == 0u) add_to_list(guide_number);
        MEET;
    }
#elif defined(HAIR_LISTED)
    uint count = health[length_of_list(params.list)];
    for (uint n = first; n < count; n += guides_at_once) {
        guide_number = health[HAIR_HEALTH_LISTS + n];
        solve();
        MEET;
    }
#else
    guide_number = first;
    if (guide_number < params.guides) solve();
#endif
}
