// substeps.glsl - the substeps of a step, one after the other, for one guide.

// Place the root where the scalp has it after a fraction of the step, and set its rotation.
void place_root(vec4 head, float fraction)
{
    turn_now  = head;
    root_now  = rotate(head, root_at_rest);
    fraction_now = fraction;
#ifdef HAIR_SKINNED
    root_transform r   = root_transform_at(guide_number, fraction);
    root_now = rotate(head, root_at_rest + r.shift);
    turn_now = quat_multiply(head, r.turn);
#endif
}

#if defined(HAIR_MIXED) || defined(SPLITS)
// Rotation of the head when a substep starts and ends.
vec4  head_at_start, head_at_end;
// Fraction of the step that is done when a substep starts and ends.
float fraction_at_start, fraction_at_end;
#endif

// Do a substep by the method of the program.
void attempt_all(vec3 head_moved);

#ifdef SPLITS
#include "sim/leap_parts.glsl"
#endif

// Do all substeps. Return false if the solver's own method fails. Nothing is stored then.
bool solve()
{
    guide_first  = guide[guide_number].first;
    guide_count  = guide[guide_number].count;
    guide_length = guide[guide_number].arc_length;
    load_damping();
    root_at_rest = rest[guide_first].position.xyz;
    clamp_at_rest = rotate(guide[guide_number].root_frame, vec3(0.0, 1.0, 0.0));
    uint begin = params.substep_first;
    vec4 head  = params.rotation_start;
    float fraction = params.fraction_start;
    if (begin > 0u) {
        head  = params.substep[begin - 1u].rotation;
        fraction = params.substep[begin - 1u].displacement.w;
    }
    place_root(head, fraction);
    root_then = root_now;
#ifdef HAIR_PINNED
    head_now  = head;
#endif
    load();
    if (COLLIDERS) begin_colliders();
#ifdef LEAVES_WHIPS
    if (known > 0.0 && known < 1.0) return false;
#elif defined(HAIR_PASS1)
    if (HAIR_SOLVER == SHAKE ? known != 0.0 && known != 1.0 : known < LEAPS_NEXT) return false;
#endif

#if defined(HAIR_PASS1) && defined(WATCHES_TURNS)
    begin_turns();
#endif
    for (uint s = begin; s < params.substeps; ++s) {
        vec3 head_moved = params.substep[s].displacement.xyz;
#ifdef HAIR_WIND
        substep_number  = s;
#endif
        turn_then       = turn_now;
        root_then       = root_now;
        fraction_then      = fraction_now;
#ifdef HAIR_PINNED
        head_then       = head_now;
        head_now        = params.substep[s].rotation;
#endif
        place_root(params.substep[s].rotation, params.substep[s].displacement.w);
        root_moved = root_now - root_then + head_moved;
#if defined(HAIR_MIXED) || defined(SPLITS)
        head_at_start  = s == 0u ? params.rotation_start : params.substep[s - 1u].rotation;
        head_at_end    = params.substep[s].rotation;
        fraction_at_start = fraction_then;
        fraction_at_end   = fraction_now;
#endif

        grant_rounds();
        if (COLLIDERS) next_colliders();
#ifdef LEAVES_WHIPS
        attempt_all(head_moved);
        if (is_left) return false;
#elif defined(HAIR_PASS1)
        if (!attempt(HAIR_SOLVER, head_moved) || !accept(HAIR_SOLVER, false, head_moved)) return false;
#elif defined(SPLITS)
        do_substep(head_moved);
#else
        attempt_all(head_moved);
#endif
    }
    store();
    return true;
}
