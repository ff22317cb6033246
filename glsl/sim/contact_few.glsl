// contact_few.glsl - solids that are in the step's parameters, HAIR_FEW_SOLIDS at most: which a guide can touch, and out
// of them, one after the other.
uint  number_of(uvec2 at) { return 32u * at.x + uint(findLSB(at.y)); }
uvec2 bodies()
{
#ifdef HAIR_BODIES
    return uvec2(params.bodies0, params.bodies1);
#else
    return uvec2(0u);
#endif
}

// The solids that the guide can touch in this substep, of them those that a vertex can: others are not looked at
// again. A vertex is taken to be moved by the fitting of lengths no more than 2 cm farther than it would go freely.
void find_solids(vec3 head_moved)
{
    if (!SOLIDS) return;
    uvec2 near    = uvec2(0u);
    float longest = guide_length + length(root_moved - head_moved) + 0.02;
    if (root_is_free || TIED) longest = 2.0 * FARTHEST; // What the scalp does not hold, or not alone, may be anywhere.
    for (uint k = lane; k < params.solids; k += lanes) {
        capsule solid = solid_at(k, share_now);
        if (length(from_axis(root_now, solid)) < solid.radius + longest + swept_by(k, solid))
            near[k / 32u] |= 1u << (k % 32u);
    }
    near = all_bits(near);
    sunk = 0.0;
    if (!root_is_free)
        EACH_BIT(near) sunk = max(sunk, root_depth_in(number_of(at), (at.y & bodies()[at.x]) != 0u));
    EACH(guide_count) {
        own(reachable) = own(met) = uvec2(0u);
        if (own(slack) > 0.0) {
            vec3  position = root_now + GET(place) + own(wanted) - root_moved;
            float reach    = 0.02 + length(own(wanted) - head_moved);
            EACH_BIT(near) {
                uint    k     = number_of(at);
                capsule solid = solid_at(k, share_now);
                if (length(from_axis(position, solid)) < solid.radius + reach + swept_by(k, solid))
                    own(reachable)[at.x] |= at.y;
            }
        }
    }
}

// Out of one solid after the other, capsules first. Out of a second one may lead into the first: then once more.
void get_out(uint i, vec3 start, uvec2 solids, uvec2 kept, vec3 head_moved, inout outcome made, inout uvec2 met)
{
    vec2 granted  = granted_to(i);
    uint contacts = 2u;
    for (uint n = 0u; n < 2u && contacts > 1u; ++n) { // In a loop, so that a compiler need not make so much of it twice.
        vec3 normal, surface;
        contacts = 0u;
        EACH_BIT(solids & ~bodies()) {
            uint  k = number_of(at);
            float was, depth = depth_in(k, start, made.d, head_moved, was, normal) - max(was - granted.y, granted.x);
            if (depth > 0.0 || (kept[at.x] & at.y) != 0u) { // What its surface does matters only then.
                surface = surface_of(k, start + made.d - head_moved, head_moved, normal);
                push_by(BODY_POSITION(k, 1).w, depth, normal, surface, made);
                met[at.x] |= at.y;
                ++contacts;
            }
        }
#ifdef HAIR_BODIES
        EACH_BIT(solids & bodies()) {
            uint  k     = number_of(at);
            float depth = depth_in_body(k, start, start + made.d - head_moved, head_moved, granted, normal, surface);
            contacts += push_from(at, BODY_POSITION(k, 1).w, depth, normal, surface, kept, made, met);
        }
#endif
    }
}
