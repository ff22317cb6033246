// contact_try.glsl - the displacements of a guide that colliders allow.
#include "sim/contact.glsl"

// Number of steps after which contacts are only added, so that the iteration ends.
#define KEEP_FROM 4u

void resolve_contact(uint i, vec3 head_moved, bool keep)
{
    outcome made =
        allowed(i, local(wanted), local(reachable), keep ? local(met) : BITS(0u), head_moved, local(met));
    PUT(moved, made.d);
    local(touch) = made.freedom;
    local(slip)  = made.slip;
    keep_pushes(i);
}

// Find the displacements that colliders allow.
void try_wanted(vec3 head_moved, bool keep)
{
    FOR_VERTICES(guide_count) {
        PUT(moved, local(wanted));
        if (COLLIDERS) local(touch) = local(slip) = vec4(0.0);
        clear_pushes(i);
        if (COLLIDERS && !LISTS_REACHING && local(reachable) != BITS(0u))
            resolve_contact(i, head_moved, keep);
    }
    if (COLLIDERS && LISTS_REACHING) {
        EACH_REACHING { resolve_contact(i, head_moved, keep); }
    }
}
