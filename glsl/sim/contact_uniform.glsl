// contact_uniform.glsl - contact with at most HAIR_FEW_COLLIDERS colliders, which the step's
// parameters hold. Find the colliders that a guide can touch, and push vertices out of them one
// after the other.

// Loop over the set bits of a mask. `bit` is the current bit, and k its index.
#define EACH_BIT(bits)                                                                                       \
    for (uint left = bits, bit = left & -left, k = uint(findLSB(bit)); bit != 0u;                            \
         left &= ~bit, bit = left & -left, k = uint(findLSB(bit)))

uint bodies()
{
#ifdef HAIR_BODIES
    return params.bodies;
#else
    return 0u;
#endif
}

// Find the colliders that the guide can touch in this substep, and for each vertex those that it
// can touch. Later tests use only these.
void find_colliders(vec3 head_moved)
{
    if (!COLLIDERS) return;
    uint  near    = 0u;
    float longest = guide_length + length(root_moved - head_moved) + HAIR_CONTACT_FIT;
    // A guide with a free root or with pins may be anywhere.
    if (root_is_free || PINNED) longest = 2.0 * FARTHEST;
    sunk = 0.0;
    for (uint k = lane; k < params.colliders; k += lanes) {
        capsule now = collider_at(k, fraction_now);
        float   off = length(from_axis(root_now, now)) - now.radius;
        store_collider(k, now);
        if (off < longest + moves_of(k)) near |= 1u << k;
        if ((1u << k & bodies()) == 0u) sunk = max(sunk, -off);
    }
    COLLIDERS_BARRIER;
    near = bits_of_lanes(near);
    if (group_any(bvec2(sunk > 0.0, false)).x) sunk = group_max(sunk);
#ifdef HAIR_BODIES
    EACH_BIT(near & bodies()) sunk = max(sunk, root_depth_in(k, true));
#endif
    if (root_is_free) sunk = 0.0;
    FOR_VERTICES(guide_count) {
        local(reachable) = local(met) = 0u;
        if (local(slack) > 0.0) {
            vec3  position = root_now + GET(place) + local(wanted) - root_moved;
            float reach    = HAIR_CONTACT_FIT + length(local(wanted) - head_moved);
            EACH_BIT(near) {
                capsule collider = collider_now(k);
                vec3    off   = from_axis(position, collider);
                float   far   = collider.radius + reach + moves_of(k);
                if (dot(off, off) < far * far) local(reachable) |= bit;
            }
        }
    }
}

// Push a vertex out of one collider after the other, capsules first. A push out of a second
// collider may lead into the first. Then all are tested once more.
void get_out(uint i, vec3 start, uint colliders, uint kept, vec3 head_moved, inout outcome made,
             inout uint met)
{
    vec2 granted  = granted_to(i);
    uint contacts = 2u;
    // A loop keeps a compiler from generating this code twice.
    for (uint n = 0u; n < 2u && contacts > 1u; ++n) {
        vec3 normal, surface;
        contacts = 0u;
        EACH_BIT(colliders & ~bodies()) {
            float was,
                depth = depth_in(k, start, made.d, head_moved, was, normal) - max(was - granted.y, granted.x);
            // The displacement of the surface matters only in contact.
            bool holds = depth > 0.0 || (kept & bit) != 0u;
            if (holds || is_near(depth)) {
                surface = surface_of(k, start + made.d - head_moved, head_moved, normal);
                set_presser(k);
                push_by(BODY_POSITION(k, 1).w, depth, normal, surface, made);
                met |= holds ? bit : 0u;
                contacts += uint(holds);
            }
        }
#ifdef HAIR_BODIES
        EACH_BIT(colliders & bodies()) {
            float depth =
                depth_in_body(k, start, start + made.d - head_moved, head_moved, granted, normal, surface);
            bool holds = depth > 0.0 || (kept & bit) != 0u;
            if (holds || is_near(depth)) {
                set_presser(k);
                push_by(BODY_POSITION(k, 1).w, depth, normal, surface, made);
                met |= holds ? bit : 0u;
                contacts += uint(holds);
            }
        }
#endif
    }
}
