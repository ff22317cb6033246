// past.glsl - what is kept of how a guide moved, beside its last displacement, and what an impact makes of that.
//
// A method of two steps goes on with a jump that it finds in places as no jump of velocities does: a strand that strikes
// something would be thrown back with up to 5/4 of what it lost, wherever in the substep it struck. So an impact at any
// vertex ends the past of the whole strand, and the next substep is a leap: on as it moved, as SHAKE does, with the forces
// of the start, but what bending does by the system of BDF2 (Newmark's method, beta = 4/9). It also does what is left of
// the impact.

#define STRUCK 0.1 // m/s: a contact that takes more than this away is an impact
#define LEAPS_NEXT 1.5 // what is known after one
#define PRESSED 2.5
#define MOST_PRESSED 0.02 // m

#ifdef KEEPS_RATES
bool is_struck(uint i, vec3 d)
{
    vec3 lost = own(displacement) - d;
    return SOLIDS && i < guide_count && own(touch).w != FREE &&
           length(lost - pass_on(own(touch), lost)) > STRUCK * SUBSTEP;
}

// Rates after a substep by `method`, with the displacement d of which so much is kept.
void keep_rates(uint i, int method, vec3 d, vec3 kept)
{
    vec3 last = own(displacement), before = own(rate); // Which may be what was not finite.
    bool leapt = LEAPS(method);
    own(rate)        = IS_BACK(method) ? 1.5 * d - 0.5 * last : kept;
    parked(rate_before) = IS_LEADER(method) ? kept : leapt ? 0.5 * (d + last) : before;
    if (!SOLIDS) return;
    // What comes to touch has no past across the surface, and what sticks none at all. What slides on has all of it: only
    // so a curved surface turns it by as much as other forces do, and not by 9/4 of that.
    bool touches = own(touch).w != FREE, comes = touches && (leapt || own(touched) == 0.0), sticks = own(touch).w == STICKS;
    vec3 rate_on = d + pass_on(own(touch), own(rate) - d), before_on = d + pass_on(own(touch), parked(rate_before) - d);
    own(rate)        = sticks ? d : comes ? rate_on : own(rate);
    parked(rate_before) = sticks ? d : comes ? before_on : parked(rate_before);
    own(touched)     = touches ? 1.0 : 0.0;
}
#endif

// What of the displacement by solids goes by A^-1 in the first step: of what strikes. By M^-1 alone a strand would be kinked there, its
// neighbours would feel it by bending only a substep later. Bending resists, so that contact does more in the end than it does
// now, alone 1 / (m A^-1_ii) times as much: 2.4 inside the benchmark's strand at 1/300 s. What is wanted goes deeper by as much
// as contact does by M^-1 to come out again; so not among many small solids, where that leads into others.
vec3 pressed(uint i, int method)
{
#if defined(HAIR_SOLIDS) && defined(KEEPS_RATES) && !defined(HAIR_ANY)
    vec3 taken = GET(moved) - own(wanted);
    if (LEAPS(method) || own(touched) == 0.0) return min(PRESSED, MOST_PRESSED / max(length(taken), 1e-9)) * taken;
#endif
    return vec3(0.0);
}
