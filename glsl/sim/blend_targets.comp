// blend_targets.comp - targets and weights after a substep, and the state of the guides that are at
// their targets. One thread per guide, root to tip.
//
// A target moves evenly from where it is to where the application wants it at the end of the step.
// The target of a vertex with the weight 0 starts at the vertex. A vertex with the weight 1 takes
// the position and the velocity of its target. The vertices beyond it are drawn along at their
// lengths (follow-the-leader), and their velocities gain what this moves them. Other vertices keep
// their simulated state.
#version 450 core
#include "sim/buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;
#ifdef HAIR_ROD
#include "sim/rod_buffers.glsl"
#endif
#include "sim/targets.glsl"

layout(std430, binding = HAIR_BIND_TARGET_WEIGHT) readonly buffer target_weight_buffer
{
    float target_weight[];
};

bool resets;         // There is no history.
vec4 head_then;      // Rotation of the head at the start of the substep.
vec4 head_now;       // Rotation of the head at its end.
vec3 head_moved;     // Displacement of the head's origin over the substep, m.
float fraction;      // Fraction of the remaining step that the substep takes.
vec3 target_before;  // Target of the vertex before, before the substep.

void begin()
{
    resets     = (blend.flags & HAIR_TARGETS_RESET) != 0u;
    head_then  = resets ? params.rotation_now : params.rotation_start;
    head_now   = resets ? params.rotation_now : params.substep[0].rotation;
    head_moved = resets ? vec3(0.0) : params.substep[0].displacement.xyz;
    float left = 1.0 - params.fraction_start;
    float part = params.substep[0].displacement.w - params.fraction_start;
    fraction   = resets || left < 1e-6 ? 1.0 : clamp(part / left, 0.0, 1.0);
}

// Return the factor of the weight at a fraction of the vertices from root to tip.
float weight_along(float at)
{
    float t = at * float(HAIR_CURVE_INTERVALS);
    uint  k = min(uint(t), HAIR_CURVE_INTERVALS - 1u);
    vec4  c = blend.along[k];
    t -= float(k);
    return clamp(c.x + t * (c.y + t * (c.z + t * c.w)), 0.0, 1.0);
}

// Move the target of vertex i and its weight by a substep. Return the displacement of the target
// over the substep in the world, and set `target_now` to its position. `at_cut` is true for the tip
// of a guide that has been cut.
vec3 move_target(uint i, bool at_cut, float weight, out vec3 target_now)
{
    vec4 was   = target[i];
    vec3 to    = target_in_head(i);
    bool is_ok = is_near(to);
    if (was.w <= 0.0) was.xyz = rotate(quat_conjugate(head_then), state[i].position.xyz -
                                                                  state[i].displacement.xyz + head_moved);
    else if (at_cut) was.xyz = cut_point(i, target_before, was.xyz);
    if (at_cut && is_ok) to = cut_point(i, target_in_head(i - 1u), to);
    is_ok         = is_near(to);
    target_before = was.xyz;
    float change = resets ? 1.0 : blend.max_change;
    vec3  now    = is_ok ? mix(was.xyz, to, fraction) : was.xyz;
    if (!is_ok) weight = 0.0;
    target[i]    = vec4(now, was.w + clamp(weight - was.w, -change, change));
    target_now   = rotate(head_now, now);
    return resets ? vec3(0.0) : target_now - rotate(head_then, was.xyz) + head_moved;
}

// Place vertex i, with its displacement over the substep.
void place(uint i, vec3 position, vec3 displacement)
{
#ifdef HAIR_ROD
    // A solver without history has no buffer.
    if (i < history.length())
        history[i].rate.xyz = target[i].w >= 1.0
                                  ? displacement
                                  : history[i].rate.xyz + displacement - state[i].displacement.xyz;
#endif
    state[i].position.xyz     = position;
    state[i].displacement.xyz = displacement;
}

// Turn the frame of segment i along the segment.
void align_frame(uint i, vec3 link)
{
#if defined(HAIR_ROD) && defined(HAIR_MIXED)
    vec4 q      = material[i];
    material[i] = normalize(quat_multiply(quat_between(rotate(q, vec3(0.0, 1.0, 0.0)), link), q));
#endif
}

void main()
{
    uint g = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (g >= params.guides) return;
    begin();
    uint first = guide[g].first, end = first + guide[g].count;
    bool hangs = false; // A vertex before this one is at its target.
    vec3 simulated = vec3(0.0), placed = vec3(0.0); // Position of the vertex before.
    for (uint i = first; i < end; ++i) {
        vec3 goal, here = state[i].position.xyz, to = here;
        float weight = blend.strength * target_weight[g] *
                       weight_along(float(i - first) / float(end - first - 1u));
        vec3 moved = move_target(i, i + 1u == end && is_cut(i), weight, goal);
        bool is_held = target[i].w >= 1.0;
        if (is_held) {
            to = goal;
        } else if (hangs) {
            vec3 link = direction_or(here - placed, direction_or(here - simulated, vec3(0.0, -1.0, 0.0)));
            to        = placed + distance(here, simulated) * link;
            moved     = resets ? vec3(0.0) : state[i].displacement.xyz + (to - here);
        }
        hangs = hangs || is_held;
        if (hangs) {
            place(i, to, moved);
            if (i > first) align_frame(i - 1u, direction_or(to - placed, vec3(0.0, -1.0, 0.0)));
        }
        simulated = here;
        placed    = to;
    }
    // Vertices that grow again begin with the weight 0.
    uint next = g + 1u < params.guides ? guide[g + 1u].first : uint(target.length());
    for (uint i = end; i < next; ++i) target[i].w = 0.0;
}
