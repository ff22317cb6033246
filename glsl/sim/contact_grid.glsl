// contact_grid.glsl - contact with any number of colliders of any shape.
//
// A vertex leaves the sphere or capsule in which it is deepest, then the one in which it is deepest
// after that. Overlapping colliders, of which a body may be made, are thus left by the shortest way
// out of all of them. A vertex may start inside colliders. It may then stay as deep in any as it
// was in the deepest, less the distance by which it comes out in a substep.
#define ROUNDS 6u
#define AGAIN 1e-6 // Minimum depth in another collider at which the search goes on, m

uvec2 first_of(uvec2 bits)
{
    return bits.x != 0u ? uvec2(0u, bits.x & -bits.x) : uvec2(1u, bits.y & -bits.y);
}

// Loop over the bits of both words in one loop, because a software rasteriser executes even an
// empty loop once.
#define EACH_BIT(bits)                                                                                       \
    for (uvec2 left = bits, at = first_of(left); at.y != 0u; left[at.x] &= ~at.y, at = first_of(left))

#include "sim/contact_find.glsl"

// Return whether the ball around collider k is near enough to `end` that the collider can be met,
// even after a push of length `way`.
bool is_around(uint k, vec3 end, float way)
{
    vec4 ball = BALL(k);
    return length(end - ball.xyz) <= ball.w + 2.0 * way;
}

// Push a displacement out of the deepest collider, and return the number of pushes. Colliders in
// `owed` hold the vertex and have not pushed yet. They come first. `colliders` is reduced to the
// colliders nearby. `is_out` is set if no collider can push the vertex again.
uint leave_deepest(uint i, vec3 start, inout uvec2 colliders, inout uvec2 owed, float enough_depth,
                   vec3 head_moved, vec2 granted, inout outcome made, inout uvec2 met, out bool is_out)
{
    vec3  end  = start + made.d - head_moved, normal, surface;
    float max_value = -FARTHEST, was_max = -FARTHEST, depth = 0.0, way = length(made.d - head_moved), was;
    uint  whose = 0u;
    vec4  deepest = vec4(vec3(0.0), -FARTHEST), second = deepest; // xyz: normal. w: depth.
    // Maximum depth in all other colliders, and the distance by which the way misses all spheres.
    float third = -FARTHEST, clears = FARTHEST;
    uvec2 around = uvec2(0u), left = colliders, from = uvec2(0u);
    is_out = false;
    if (colliders == uvec2(0u)) return 0u;
    take_rounds(uint(bitCount(left.x) + bitCount(left.y)) + 2u);
    left &= ~look_at_cached(i, colliders, owed, end, way, max_value, was_max, depth, from, around);
    bool  cached = from != uvec2(0u), all_cached = left == uvec2(0u);
    uvec2 at = first_of(left), after;
    // Read the next member while this one is tested.
    for (uint member = member_at(local(members), at), next; at.y != 0u; at = after, member = next) {
        left[at.x] &= ~at.y;
        after       = first_of(left);
        next        = member_at(local(members), after);
        uint  k     = member & HAIR_ENTRY_NUMBER;
        bool  first = (owed[at.x] & at.y) != 0u, whole = (member & HAIR_ENTRY_LONG) != 0u;
        float deep  = 0.0;
        normal      = vec3(0.0);
        // A sphere farther away than the way of the vertex cannot be passed through.
        if (!whole) {
            vec4  then = sphere_at(k, fraction_then), now = sphere_at(k, fraction_now);
            float away = length(end - now.xyz);
            was        = then.w - length(start - then.xyz);
            float past = away - way - length(now.xyz - then.xyz);
            deep       = now.w - away;
            normal     = (end - now.xyz) / max(away, 1e-9);
            clears     = min(clears, past);
            whole      = past <= 0.0;
        }
        if (whole) deep = depth_in(k, start, made.d, head_moved, was, normal);
        if (whole) clears = 0.0;
        float rank = first ? deep + FARTHEST : deep;
        was_max   = max(was_max, was);
        around[at.x] |= first || deep > -2.0 * way ? at.y : 0u;
        bool deeper = rank > max_value;
        vec4 less   = deeper ? deepest : vec4(normal, deep);
        third       = max(third, min(second.w, less.w));
        second      = less.w > second.w ? less : second;
        if (deeper) {
            max_value    = rank;
            depth   = deep;
            deepest = vec4(normal, deep);
            whose   = k;
            from    = mask_of(at);
            cached  = false;
        }
    }
    colliders = around;
    depth -= max(was_max - granted.y, granted.x);
    bool holds = depth > enough_depth || max_value > 0.5 * FARTHEST;
    if (from == uvec2(0u) || !(holds || is_near(depth))) return 0u;
    float friction;
    if (cached) {
        touch_cached(head_moved, normal, surface, friction);
    } else {
        depth_in(whose, start, made.d, head_moved, was, normal);
        surface  = surface_of(whose, end, head_moved, normal);
        friction = BODY_POSITION(whose, 1).w;
    }
    vec3 before = made.d;
#ifdef HAIR_IMPULSES
    set_presser(member_at(local(members), first_of(from)) & HAIR_ENTRY_NUMBER);
#endif
    push_by(friction, depth, normal, surface, made);
    if (!holds) return 0u;
    met |= from;
    owed &= ~from;
    if ((owed & colliders) != uvec2(0u)) return 1u;
    if (all_cached) {
        is_out =
            is_out_of_cached(colliders, start + made.d - head_moved, length(made.d - head_moved), granted.x);
    // A push increases the distance from a ball by at least its component along the normal.
    } else if (!HAS_CACHE) {
        vec3  pushed = made.d - before;
        float far    = length(pushed);
        is_out = max(was_max - granted.y, max(second.w - dot(pushed, second.xyz), third + far) - AGAIN) <=
                     granted.x &&
                 clears > 2.0 * far;
    }
    return 1u;
}

void get_out(uint i, vec3 start, uvec2 colliders, uvec2 kept, vec3 head_moved, inout outcome made,
             inout uvec2 met)
{
    vec2  granted = granted_to(i);
    uvec2 owed = kept, tried;
    uint  pushed = 1u;
    bool  is_out;
    // A loop keeps a compiler from generating this code twice.
    for (uint n = 0u; n < ROUNDS && pushed > 0u && (n == 0u || has_rounds()); ++n) {
        vec3 end = start + made.d - head_moved;
        tried    = enough(i, start, end);
        if (n == 0u) colliders = tried | kept;
        uvec2 around = colliders;
#ifdef HAIR_BODIES
        around &= ~local(walked);
        uvec2 bodies = n < 2u ? colliders & local(walked) : uvec2(0u);
#endif
        pushed = leave_deepest(i, start, around, owed, n > 0u ? AGAIN : 0.0, head_moved, granted, made, met,
                               is_out);
#ifdef HAIR_BODIES
        EACH_BIT(bodies) {
            take_rounds(BODY_STEPS + 2u);
            uint  k = member_at(local(members), at) & HAIR_ENTRY_NUMBER;
            vec3  way = made.d - head_moved, normal, surface;
            if ((kept[at.x] & at.y) != 0u || is_around(k, start + way, length(way))) {
                float depth = depth_in_body(k, start, start + way, head_moved, granted, normal, surface);
                bool  holds = depth > 0.0 || (kept[at.x] & at.y) != 0u;
                if (holds || is_near(depth)) {
                    set_presser(k);
                    push_by(BODY_POSITION(k, 1).w, depth, normal, surface, made);
                    met[at.x] |= holds ? at.y : 0u;
                    is_out = is_out && !holds;
                    pushed += uint(holds);
                }
                around[at.x] |= at.y;
            }
        }
#endif
        // The pushes led to other colliders.
        bool led = tried != enough(i, start, start + made.d - head_moved);
        colliders   = led ? local(reachable) : around;
        if (!led && (is_out || bitCount(colliders.x) + bitCount(colliders.y) < 2)) break;
    }
}
