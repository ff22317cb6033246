// mixed_parts.glsl - a substep of the mixed scheme as a whole, or where that fails in quarters, and
// so on.
//
// A whip or an impact may turn a segment in a substep by more than Newton's method can follow.
// Parts keep the momentum, which follow-the-leader does not. Implicit Euler does the first part
// after a change of length, and the next substep too.
#define SMALLEST_PART (1.0 / 64.0)

// Accept the frames and forces that the substep ended with.
void accept_turns(bool led)
{
    GROUP_BARRIER;
    if (led) align_frames();
    FOR_VERTICES(guide_count) {
        local(reaction)      = led ? vec3(0.0) : local(reaction_found);
        local(turned_before) = local(turned);
        local(turned)        = led ? vec3(0.0) : 2.0 * local(turn).xyz / local(turn).w;
        local(force)         = led ? vec3(0.0) : GET(handed);
        if (!led) SHARED_READ(section) = SHARED_READ(tried);
    }
    GROUP_BARRIER;
}

// Rescale the past to motion in parts that are `ratio` times as long.
void rescale_past(float ratio)
{
    FOR_VERTICES(guide_count) {
        local(displacement) = ratio * (known < 2.0 ? local(displacement) : local(rate));
        local(turned) *= ratio;
    }
    known = 1.0;
}

// Place head and root for a part of the substep, between two fractions of it.
void place_part(float from, float to, vec3 head_moved)
{
    float fraction_from = mix(fraction_at_start, fraction_at_end, from);
    float fraction_to   = mix(fraction_at_start, fraction_at_end, to);
    vec4  head_from = normalize(mix(head_at_start, head_at_end, from));
    vec4  head_to   = normalize(mix(head_at_start, head_at_end, to));
    place_root(head_from, fraction_from);
    turn_then  = turn_now;
    root_then  = root_now;
    fraction_then = fraction_from;
    place_root(head_to, fraction_to);
    root_moved = root_now - root_then + (to - from) * head_moved;
#ifdef HAIR_PINNED
    head_then = head_from;
    head_now  = head_to;
#endif
    part_length = (to - from) * params.gravity.w;
}

// Do the substep.
void attempt_all(vec3 head_moved)
{
    float done = 0.0, part = 1.0;
    // Only follow-the-leader is left for the part.
    bool  leads = false;
    guarded       = false;
    rounds_in_all = 0u;
    part_length   = params.gravity.w;
    while (done < 1.0) {
        int  method = leads ? LEADER : known < 2.0 ? EULER : BACK;
        vec3 moves  = part * head_moved;
        bool fits = attempt(method, moves);
        bool last = part <= SMALLEST_PART || rounds_in_all >= MAX_ROUNDS_IN_ALL;
        if (!fits && !last) {
            if (part == 1.0) count_in(HAIR_SOLVER_STATS_PARTS);
            rescale_past(0.25);
            part *= 0.25;
            place_part(done, done + part, head_moved);
            continue;
        }
        if (!fits) count_in(HAIR_SOLVER_STATS_FOLLOW_FALLBACKS);
        // Wrong forces make the result of contact meaningless.
        if (!fits && (touching || group_any(bvec2(!finite, false)).x)) {
            leads = true;
            continue;
        }
        // The next substep continues with the rest of e_j.
        if (!leads) place_vertices();
        accept_turns(leads);
        accept(fits ? method : LEADER, false, moves);
        done += part;
        if (done < 1.0) {
            // Smaller parts would not help.
            if (!fits || leads) {
                rescale_past((1.0 - done) / part);
                part = 1.0 - done;
            }
            place_part(done, done + part, head_moved);
            if (COLLIDERS) next_colliders();
        }
        leads = false;
    }
    if (part < 1.0) rescale_past(1.0 / part);
#ifdef HAIR_PINNED
    if (group_any(bvec2(taut, false)).x) count_in(HAIR_SOLVER_STATS_OVEREXTENDED);
#endif
}
