// contact_few.glsl - solids that are in the step's parameters, HAIR_FEW_SOLIDS at most: which a guide can touch, and out
// of them, one after the other.

// `bit` of those of some solids, and the number of its one, k.
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

// The solids that the guide can touch in this substep, of them those that a vertex can: others are not looked at
// again. A vertex is taken to be moved by the fitting of lengths no more than 2 cm farther than it would go freely.
void find_solids(vec3 head_moved)
{
    if (!SOLIDS) return;
    uint  near    = 0u;
    float longest = guide_length + length(root_moved - head_moved) + 0.02;
    if (root_is_free || TIED) longest = 2.0 * FARTHEST; // What the scalp does not hold, or not alone, may be anywhere.
    sunk = 0.0;
    for (uint k = lane; k < params.solids; k += lanes) {
        capsule now = solid_at(k, share_now);
        float   off = length(from_axis(root_now, now)) - now.radius;
        share_solid(k, now);
        if (off < longest + moves_of(k)) near |= 1u << k;
        if ((1u << k & bodies()) == 0u) sunk = max(sunk, -off);
    }
    SOLIDS_MEET;
    near = bits_of_lanes(near);
    if (any_of(bvec2(sunk > 0.0, false)).x) sunk = most_of(sunk);
#ifdef HAIR_BODIES
    EACH_BIT(near & bodies()) sunk = max(sunk, root_depth_in(k, true));
#endif
    if (root_is_free) sunk = 0.0;
    EACH(guide_count) {
        own(reachable) = own(met) = 0u;
        if (own(slack) > 0.0) {
            vec3  position = root_now + GET(place) + own(wanted) - root_moved;
            float reach    = 0.02 + length(own(wanted) - head_moved);
            EACH_BIT(near) {
                capsule solid = solid_now(k);
                vec3    off   = from_axis(position, solid);
                float   far   = solid.radius + reach + moves_of(k);
                if (dot(off, off) < far * far) own(reachable) |= bit;
            }
        }
    }
}

// Out of one solid after the other, capsules first. Out of a second one may lead into the first: then once more.
void get_out(uint i, vec3 start, uint solids, uint kept, vec3 head_moved, inout outcome made, inout uint met)
{
    vec2 granted  = granted_to(i);
    uint contacts = 2u;
    for (uint n = 0u; n < 2u && contacts > 1u; ++n) { // In a loop, so that a compiler need not make so much of it twice.
        vec3 normal, surface;
        contacts = 0u;
        EACH_BIT(solids & ~bodies()) {
            float was, depth = depth_in(k, start, made.d, head_moved, was, normal) - max(was - granted.y, granted.x);
            if (depth > 0.0 || (kept & bit) != 0u) { // What its surface does matters only then.
                surface = surface_of(k, start + made.d - head_moved, head_moved, normal);
                push_by(BODY_POSITION(k, 1).w, depth, normal, surface, made);
                met |= bit;
                ++contacts;
            }
        }
#ifdef HAIR_BODIES
        EACH_BIT(solids & bodies()) {
            float depth = depth_in_body(k, start, start + made.d - head_moved, head_moved, granted, normal, surface);
            if (depth > 0.0 || (kept & bit) != 0u) {
                push_by(BODY_POSITION(k, 1).w, depth, normal, surface, made);
                met |= bit;
                ++contacts;
            }
        }
#endif
    }
}
