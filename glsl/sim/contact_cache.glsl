// contact_cache.glsl - the spheres that are close to a vertex, at hand: it looks at them several times in a substep, and
// would wait for memory each time, with no other guide to go on with. Spheres that overlap hide each other, so that few are close.
#include "sim/contact_lists.glsl"

#ifndef HAIR_FEW_GUIDES // Of many, more are under way at once without: registers are few.
#define HAS_CACHE false

void  cache_close(uint i) {}
bool  is_out_of_cached(uvec2 solids, vec3 end, float way, float granted) { return false; }
void  touch_cached(vec3 head_moved, out vec3 normal, out vec3 surface, out float friction) {}
uvec2 look_at_cached(uint i, uvec2 solids, uvec2 owed, vec3 end, float way, inout float most, inout float was_most,
                     inout float depth, inout uvec2 from, inout uvec2 around)
{
    return uvec2(0u);
}

#else

#define HAS_CACHE true
#define CACHED 4u
uvec2 cached_bit[CACHED]; // of the list; of none none

// Where they are when the step starts and ends, how they spin and their share of friction: of a subgroup read once, when a
// list is made.
#ifdef HAIR_SUBGROUP
PARKED(vec4, cached_start[CACHED]);
PARKED(vec4, cached_end[CACHED]);
PARKED(vec4, cached_turn[CACHED]);
#define CACHED_START(a) cached_start[a][lane]
#define CACHED_END(a) cached_end[a][lane]
#define CACHED_TURN(a) cached_turn[a][lane]
#else
uint cached_solid[CACHED];
#define CACHED_START(a) SOLID_START(cached_solid[a], 0)
#define CACHED_END(a) SOLID_END(cached_solid[a], 0)
#define CACHED_TURN(a) vec4(SOLID_SPIN(cached_solid[a]).xyz, BODY_POSITION(cached_solid[a], 1).w)
#endif

void cache(uint a, uint k)
{
#ifdef HAIR_SUBGROUP
    CACHED_START(a) = SOLID_START(k, 0);
    CACHED_END(a)   = SOLID_END(k, 0);
    CACHED_TURN(a)  = vec4(SOLID_SPIN(k).xyz, BODY_POSITION(k, 1).w);
#else
    cached_solid[a] = k;
#endif
}

// The first of them, in the order of the list, up to one that is no sphere.
void cache_close(uint i)
{
    uvec2 left = own(close);
    bool  spheres = true;
    uint  member[CACHED];
#ifdef HAIR_BODIES
    left &= ~own(walked);
#endif
    for (uint a = 0u; a < CACHED; ++a) {
        uvec2 at      = first_of(left);
        cached_bit[a] = mask_of(at);
        member[a]     = member_at(own(members), at);
        left &= ~cached_bit[a];
    }
    for (uint a = 0u; a < CACHED; ++a) {
        spheres       = spheres && (member[a] & HAIR_MEMBER_LONG) == 0u;
        cached_bit[a] = spheres ? cached_bit[a] : uvec2(0u);
        cache(a, member[a] & HAIR_MEMBER_NUMBER);
    }
}

// In a substep: where they are, with the margin; how they have moved, and how far; how they spin, and their share of friction;
// and how deep the vertex was in them.
vec4  cached_now[CACHED], cached_way[CACHED], cached_spin[CACHED];
float cached_was[CACHED];

void advance_cached(vec3 start)
{
    vec4 margin = vec4(0.0, 0.0, 0.0, params.margin);
    for (uint a = 0u; a < CACHED; ++a) {
        vec4 begins = CACHED_START(a), ends = CACHED_END(a), turns = CACHED_TURN(a), then = mix(begins, ends, share_then) + margin;
        cached_now[a]  = mix(begins, ends, share_now) + margin;
        cached_way[a]  = vec4(cached_now[a].xyz - then.xyz, length(cached_now[a].xyz - then.xyz));
        cached_spin[a] = vec4(turns.xyz * (share_now - share_then), turns.w);
        cached_was[a]  = then.w - length(start - then.xyz);
    }
}

// The deepest of those looked at: from its middle to the vertex, and how far; how it moved, and its radius; how it spins.
vec4 deepest_out, deepest_way, deepest_spin;

// As leave_deepest() looks at others; returns which it has looked at. None if the vertex may go right through one.
uvec2 look_at_cached(uint i, uvec2 solids, uvec2 owed, vec3 end, float way, inout float most, inout float was_most,
                     inout float depth, inout uvec2 from, inout uvec2 around)
{
    if ((solids & ~own(close)) != uvec2(0u)) return uvec2(0u);
    bool  whole = false;
    uvec2 all   = uvec2(0u);
    float away[CACHED];
    for (uint a = 0u; a < CACHED; ++a) {
        away[a] = length(end - cached_now[a].xyz);
        whole   = whole || ((solids & cached_bit[a]) != uvec2(0u) && away[a] <= way + cached_way[a].w);
    }
    if (whole) return uvec2(0u);
    for (uint a = 0u; a < CACHED; ++a) {
        bool  looked = (solids & cached_bit[a]) != uvec2(0u), first = (owed & cached_bit[a]) != uvec2(0u);
        float deep   = cached_now[a].w - away[a], rank = !looked ? -FARTHEST : first ? deep + FARTHEST : deep;
        was_most     = looked ? max(was_most, cached_was[a]) : was_most;
        all |= cached_bit[a];
        around |= looked && (first || deep > -2.0 * way) ? cached_bit[a] : uvec2(0u);
        if (rank > most) {
            most         = rank;
            depth        = deep;
            from         = cached_bit[a];
            deepest_out  = vec4(end - cached_now[a].xyz, away[a]);
            deepest_way  = vec4(cached_way[a].xyz, cached_now[a].w);
            deepest_spin = cached_spin[a];
        }
    }
    return all;
}

void touch_cached(vec3 head_moved, out vec3 normal, out vec3 surface, out float friction)
{
    normal   = deepest_out.w > 1e-9 ? deepest_out.xyz / deepest_out.w : vec3(0.0, 1.0, 0.0);
    surface  = head_moved + deepest_way.xyz + cross(deepest_spin.xyz, normal * deepest_way.w);
    friction = deepest_spin.w;
}

// Whether those looked at leave nothing to get out of: to look at them again would find none that is deep enough.
bool is_out_of_cached(uvec2 solids, vec3 end, float way, float granted)
{
    bool is_out = true;
    for (uint a = 0u; a < CACHED; ++a) {
        float away   = length(end - cached_now[a].xyz);
        bool  out_of = cached_now[a].w - away - granted <= AGAIN && away > way + cached_way[a].w;
        is_out       = is_out && (out_of || (solids & cached_bit[a]) == uvec2(0u));
    }
    return is_out;
}

#endif
