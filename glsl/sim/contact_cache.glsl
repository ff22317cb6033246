// contact_cache.glsl - a cache of the spheres that are close to a vertex. A vertex tests these
// spheres several times in a substep. With few guides, no other guide runs while it waits for
// memory. Overlapping spheres cover each other, so that few remain close.
#include "sim/contact_grid_lists.glsl"

// Many guides hide the latency of memory better without the cache, because the cache takes
// registers.
#ifndef HAIR_FEW_GUIDES
#define HAS_CACHE false

void  cache_close(uint i) {}
bool  is_out_of_cached(uvec2 colliders, vec3 end, float way, float granted) { return false; }
void  touch_cached(vec3 head_moved, out vec3 normal, out vec3 surface, out float friction) {}
uvec2 look_at_cached(uint i, uvec2 colliders, uvec2 owed, vec3 end, float way, inout float max_value,
                     inout float was_max, inout float depth, inout uvec2 from, inout uvec2 around)
{
    return uvec2(0u);
}

#else

#define HAS_CACHE true
#define CACHED 4u
uvec2 cached_bit[CACHED]; // Bit of each cached sphere in the list, or no bit

// Places of the spheres at the start and end of the step, their spins, and their factors of
// friction. A subgroup reads them once, when a list is made.
#ifdef HAIR_SUBGROUP
SPILLED(vec4, cached_start[CACHED]);
SPILLED(vec4, cached_end[CACHED]);
SPILLED(vec4, cached_turn[CACHED]);
#define CACHED_START(a) cached_start[a][lane]
#define CACHED_END(a) cached_end[a][lane]
#define CACHED_TURN(a) cached_turn[a][lane]
#else
uint cached_collider[CACHED];
#define CACHED_START(a) COLLIDER_START(cached_collider[a], 0)
#define CACHED_END(a) COLLIDER_END(cached_collider[a], 0)
#define CACHED_TURN(a) vec4(COLLIDER_SPIN(cached_collider[a]).xyz, BODY_POSITION(cached_collider[a], 1).w)
#endif

void cache(uint a, uint k)
{
#ifdef HAIR_SUBGROUP
    CACHED_START(a) = COLLIDER_START(k, 0);
    CACHED_END(a)   = COLLIDER_END(k, 0);
    CACHED_TURN(a)  = vec4(COLLIDER_SPIN(k).xyz, BODY_POSITION(k, 1).w);
#else
    cached_collider[a] = k;
#endif
}

// Cache the first close spheres in the order of the list. Stop at the first collider that is no
// sphere.
void cache_close(uint i)
{
    uvec2 left = local(close);
    bool  spheres = true;
    uint  member[CACHED];
#ifdef HAIR_BODIES
    left &= ~local(walked);
#endif
    for (uint a = 0u; a < CACHED; ++a) {
        uvec2 at      = first_of(left);
        cached_bit[a] = mask_of(at);
        member[a]     = member_at(local(members), at);
        left &= ~cached_bit[a];
    }
    for (uint a = 0u; a < CACHED; ++a) {
        spheres       = spheres && (member[a] & HAIR_ENTRY_LONG) == 0u;
        cached_bit[a] = spheres ? cached_bit[a] : uvec2(0u);
        cache(a, member[a] & HAIR_ENTRY_NUMBER);
    }
}

// The cached spheres in this substep. `cached_now` is the sphere at the end, with the margin.
// `cached_way` is its displacement, and w the length of that. `cached_spin` is its rotation, and w
// its factor of friction.
vec4  cached_now[CACHED], cached_way[CACHED], cached_spin[CACHED];
// Depth of the vertex in each cached sphere at the start of the substep.
float cached_was[CACHED];

void advance_cached(vec3 start)
{
    vec4 margin = vec4(0.0, 0.0, 0.0, params.collision_margin);
    for (uint a = 0u; a < CACHED; ++a) {
        vec4 begins = CACHED_START(a), ends = CACHED_END(a), turns = CACHED_TURN(a),
             then = mix(begins, ends, fraction_then) + margin;
        cached_now[a]  = mix(begins, ends, fraction_now) + margin;
        cached_way[a]  = vec4(cached_now[a].xyz - then.xyz, length(cached_now[a].xyz - then.xyz));
        cached_spin[a] = vec4(turns.xyz * (fraction_now - fraction_then), turns.w);
        cached_was[a]  = then.w - length(start - then.xyz);
    }
}

// The deepest sphere tested. `deepest_out` is the vector from its centre to the vertex, and w its
// length. `deepest_way` is the displacement of the sphere, and w its radius. `deepest_spin` is as
// in `cached_spin`.
vec4 deepest_out, deepest_way, deepest_spin;

// Cached variant of the search in leave_deepest(). Return a bit mask of the members tested. Return
// no bits if the vertex may pass through a sphere.
uvec2 look_at_cached(uint i, uvec2 colliders, uvec2 owed, vec3 end, float way, inout float max_value,
                     inout float was_max, inout float depth, inout uvec2 from, inout uvec2 around)
{
    if ((colliders & ~local(close)) != uvec2(0u)) return uvec2(0u);
    bool  whole = false;
    uvec2 all   = uvec2(0u);
    float away[CACHED];
    for (uint a = 0u; a < CACHED; ++a) {
        away[a] = length(end - cached_now[a].xyz);
        whole   = whole || ((colliders & cached_bit[a]) != uvec2(0u) && away[a] <= way + cached_way[a].w);
    }
    if (whole) return uvec2(0u);
    for (uint a = 0u; a < CACHED; ++a) {
        bool  looked = (colliders & cached_bit[a]) != uvec2(0u), first = (owed & cached_bit[a]) != uvec2(0u);
        float deep   = cached_now[a].w - away[a], rank = !looked ? -FARTHEST : first ? deep + FARTHEST : deep;
        was_max     = looked ? max(was_max, cached_was[a]) : was_max;
        all |= cached_bit[a];
        around |= looked && (first || deep > -2.0 * way) ? cached_bit[a] : uvec2(0u);
        if (rank > max_value) {
            max_value         = rank;
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

// Return whether no cached sphere would push the vertex at `end` any more.
bool is_out_of_cached(uvec2 colliders, vec3 end, float way, float granted)
{
    bool is_out = true;
    for (uint a = 0u; a < CACHED; ++a) {
        float away   = length(end - cached_now[a].xyz);
        bool  out_of = cached_now[a].w - away - granted <= AGAIN && away > way + cached_way[a].w;
        is_out       = is_out && (out_of || (colliders & cached_bit[a]) == uvec2(0u));
    }
    return is_out;
}

#endif
