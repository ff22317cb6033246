// contact_try.glsl - the displacements of a guide that colliders allow.
#include "sim/contact.glsl"

// Number of steps after which contacts are only added, so that the iteration ends.
#define KEEP_FROM 4u

void meet_colliders(uint i, vec3 head_moved, bool keep)
{
    outcome made = allowed(i, own(wanted), own(reachable), keep ? own(met) : BITS(0u), head_moved, own(met));
    PUT(moved, made.d);
    own(touch) = made.freedom;
    own(slip)  = made.slip;
}

// Find the displacements that colliders allow.
void try_wanted(vec3 head_moved, bool keep)
{
    EACH(guide_count) {
        PUT(moved, own(wanted));
        if (COLLIDERS) own(touch) = own(slip) = vec4(0.0);
        if (COLLIDERS && !LISTS_REACHING && own(reachable) != BITS(0u)) meet_colliders(i, head_moved, keep);
    }
    if (COLLIDERS && LISTS_REACHING) {
        EACH_REACHING { meet_colliders(i, head_moved, keep); }
    }
}
