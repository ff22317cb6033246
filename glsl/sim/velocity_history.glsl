// velocity_history.glsl - the past of a guide's motion beside its last displacement, and the effect
// of an impact on it.
//
// A two-step method continues a jump of positions as if it were motion. A strand that strikes a
// collider would rebound with up to 5/4 of the velocity that it lost. The time of the impact within
// the substep does not matter. An impact at any vertex therefore ends the past of the whole strand,
// and the next substep is a leap. A leap continues the motion as SHAKE does, with the forces of the
// start. Bending goes through the system of BDF2 (Newmark's method, beta = 4/9). The leap also
// completes the impact.

// Change of velocity by a contact from which it is an impact, m/s.
#define STRUCK 0.1
#define LEAPS_NEXT 1.5 // Value of `known` after an impact
// Factor of the displacement by colliders that pressed() returns.
#define PRESSED 2.5
#define MAX_PRESSED 0.02 // Maximum displacement that pressed() returns, m

#ifdef KEEPS_RATES
bool is_struck(uint i, vec3 d)
{
    vec3 lost = local(displacement) - d;
    return COLLIDERS && i < guide_count && local(touch).w != FREE &&
           length(lost - pass_on(local(touch), lost)) > STRUCK * SUBSTEP;
}

// Update the rates after a substep by `method` with the displacement d. `kept` is the part of d
// that the velocity keeps.
void keep_rates(uint i, int method, vec3 d, vec3 kept)
{
    // These values may be not finite.
    vec3 last = local(displacement), before = local(rate);
    bool leapt = LEAPS(method);
    local(rate)        = IS_BACK(method) ? 1.5 * d - 0.5 * last : kept;
    spilled(rate_before) = IS_LEADER(method) ? kept : leapt ? 0.5 * (d + last) : before;
    if (!COLLIDERS) return;
    // A vertex that begins to touch loses its past across the surface. A vertex that sticks loses
    // all of its past. A vertex that continues to slide keeps it. Only then does a curved surface
    // turn the motion by as much as other forces do, and not by 9/4 of that.
    bool touches = local(touch).w != FREE, comes = touches && (leapt || local(touched) == 0.0),
         sticks = local(touch).w == STICKS;
    vec3 rate_on = d + pass_on(local(touch), local(rate) - d),
         before_on = d + pass_on(local(touch), spilled(rate_before) - d);
    local(rate)        = sticks ? d : comes ? rate_on : local(rate);
    spilled(rate_before) = sticks ? d : comes ? before_on : spilled(rate_before);
    local(touched)     = touches ? 1.0 : 0.0;
}
#endif

// Return the part of the displacement by colliders that goes through A^-1 in the first step. It is
// not 0 where the vertex strikes a collider. With M^-1 alone the strand would be kinked there. Its
// neighbours would feel the impact by bending only a substep later.
//
// Bending resists the push, so that contact must push more in the end than it does at first. The
// factor of a single contact is 1 / (m A^-1_ii), for which PRESSED stands. M^-1 times the same push
// is taken from the wanted displacement, which then lies deeper by as much as contact pushes it out
// again. Among many small colliders this would lead into others, and the result is 0.
vec3 pressed(uint i, int method)
{
#if defined(HAIR_COLLIDERS) && defined(KEEPS_RATES) && !defined(HAIR_COLLIDER_GRID)
    vec3 taken = GET(moved) - local(wanted);
    if (LEAPS(method) || local(touched) == 0.0)
        return min(PRESSED, MAX_PRESSED / max(length(taken), 1e-9)) * taken;
#endif
    return vec3(0.0);
}
