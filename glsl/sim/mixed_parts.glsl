// mixed_parts.glsl - a substep of the mixed scheme in parts: as a whole, or where that fails in quarters,
// and so on.
//
// A whip or an impact may turn a segment by more in a substep than Newton's method can follow. Parts keep
// the momentum, which follow-the-leader does not. The first part after a change of length is one of implicit
// Euler, as is the next substep.
#define SMALLEST_PART (1.0 / 64.0)

// Take over the frames and forces that the substep ended with.
void accept_turns(bool led)
{
    MEET;
    if (led) align_frames();
    EACH(guide_count) {
        own(reaction)      = led ? vec3(0.0) : own(reaction_found);
        own(turned_before) = own(turned);
        own(turned)        = led ? vec3(0.0) : 2.0 * own(turn).xyz / own(turn).w;
        own(force)         = led ? vec3(0.0) : GET(handed);
        if (!led) seen(section) = seen(tried);
    }
    MEET;
}

// Rescale the past to motion in parts that are so many times as long.
void rescale_past(float ratio)
{
    EACH(guide_count) {
        own(displacement) = ratio * (known < 2.0 ? own(displacement) : own(rate));
        own(turned) *= ratio;
    }
    known = 1.0;
}

// Place head and root where the part of the substep from one fraction of it to another begins and ends.
void place_part(float from, float to, vec3 head_moved)
{
    float fraction_from = mix(fraction_at_start, fraction_at_end, from);
    float fraction_to   = mix(fraction_at_start, fraction_at_end, to);
    vec4  head_from = normalize(mix(head_at_start, head_at_end, from));
    vec4  head_to   = normalize(mix(head_at_start, head_at_end, to));
    place_root(head_from, fraction_from);
    turn_then  = turn_now;
    root_then  = root_now;
    share_then = fraction_from;
    place_root(head_to, fraction_to);
    root_moved = root_now - root_then + (to - from) * head_moved;
#ifdef HAIR_TIED
    head_then = head_from;
    head_now  = head_to;
#endif
    part_length = (to - from) * params.gravity.w;
}

// Do the substep.
void attempt_all(vec3 head_moved)
{
    float done = 0.0, part = 1.0;
    bool  leads = false; // Nothing else is left for the part.
    guarded       = false;
    rounds_in_all = 0u;
    part_length   = params.gravity.w;
    while (done < 1.0) {
        int  method = leads ? LEADER : known < 2.0 ? EULER : BACK;
        vec3 moves  = part * head_moved;
        bool fits = attempt(method, moves);
        bool last = part <= SMALLEST_PART || rounds_in_all >= MAX_ROUNDS_IN_ALL;
        if (!fits && !last) {
            if (part == 1.0) count_in(HAIR_HEALTH_PARTS);
            rescale_past(0.25);
            part *= 0.25;
            place_part(done, done + part, head_moved);
            continue;
        }
        if (!fits) count_in(HAIR_HEALTH_FOLLOW);
        // Contact may make anything of wrong forces.
        if (!fits && (touching || any_of(bvec2(!finite, false)).x)) {
            leads = true;
            continue;
        }
        if (!leads) place_vertices(); // The next substep goes on with what is left of e_j.
        accept_turns(leads);
        accept(fits ? method : LEADER, false, moves);
        done += part;
        if (done < 1.0) {
            if (!fits || leads) { // There is no more to be had of parts.
                rescale_past((1.0 - done) / part);
                part = 1.0 - done;
            }
            place_part(done, done + part, head_moved);
            if (SOLIDS) next_solids();
        }
        leads = false;
    }
    if (part < 1.0) rescale_past(1.0 / part);
#ifdef HAIR_TIED
    if (any_of(bvec2(taut, false)).x) count_in(HAIR_HEALTH_TAUT);
#endif
}
