// change_lengths.comp - the state of guides that are cut, or that grow at their tips. One thread
// per guide that changes.
//
// Vertices before both tips keep their state. A new tip on the old strand has the position and the
// motion of the strand there. New vertices beyond the old tip continue the strand by its rest
// shape, and move as the old tip does.
#version 450 core
#include "sim/buffers.glsl"
#include "rotation.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_LENGTH_CHANGE) readonly buffer length_change_buffer
{
    hair_length_change change[];
};
#ifdef HAIR_ROD
layout(std430, binding = HAIR_BIND_HISTORY) buffer history_buffer { hair_history history[]; };
layout(std430, binding = HAIR_BIND_MATERIAL) buffer material_buffer { vec4 material[]; };
#ifdef HAIR_MIXED
layout(std430, binding = HAIR_BIND_BEND) buffer bend_buffer { vec4 bend[]; };
#endif
#endif

// Return the frame of segment i, whose next vertex is in place.
vec4 frame_of(uint i)
{
#if defined(HAIR_ROD) && defined(HAIR_MIXED)
    return material[i];
#else
    vec3 link = direction_or(state[i + 1u].position.xyz - state[i].position.xyz, vec3(0.0, -1.0, 0.0));
    vec4 q    = rest[i].frame;
    return normalize(quat_multiply(quat_between(rotate(q, vec3(0.0, 1.0, 0.0)), link), q));
#endif
}

// Move vertex i away from the vertex before it, to `ratio` times the distance.
void stretch_segment(uint i, float ratio)
{
    float motion = min(ratio, 1.0);
    vec3  from   = state[i - 1u].position.xyz;
    state[i].position.xyz = from + ratio * (state[i].position.xyz - from);
    state[i].displacement =
        vec4(mix(state[i - 1u].displacement.xyz, state[i].displacement.xyz, motion), 0.0);
#ifdef HAIR_ROD
    if (i < history.length()) {
        history[i].rate.xyz        = mix(history[i - 1u].rate.xyz, history[i].rate.xyz, motion);
        history[i].rate_before.xyz = mix(history[i - 1u].rate_before.xyz, history[i].rate_before.xyz, motion);
    }
#endif
}

// Add vertex i beyond the tip, with the motion of the tip. `frame` is that of its segment.
void add_vertex(uint i, vec4 frame)
{
    vec3 along = rotate(frame, vec3(0.0, 1.0, 0.0));
    state[i].position.xyz = state[i - 1u].position.xyz + rest[i - 1u].position.w * along;
    state[i].displacement = vec4(state[i - 1u].displacement.xyz, 0.0);
#ifdef HAIR_ROD
    material[i - 1u] = frame;
    if (i < history.length()) history[i] = history[i - 1u];
#endif
}

// Clear what the solvers keep of vertex i and its segment, which is the tip or beyond it.
void clear_segment(uint i)
{
#if defined(HAIR_ROD) && defined(HAIR_MIXED)
    for (uint k = 0u; k < 3u; ++k) bend[3u * i + k] = vec4(0.0);
#endif
}

void main()
{
    uint k = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (k >= change.length()) return;
    uint first = guide[change[k].guide].first, tip = first + guide[change[k].guide].count - 1u;
    uint was_tip = first + change[k].count - 1u;
    if (tip < was_tip) {
        stretch_segment(tip, rest[tip - 1u].position.w /
                                 max(distance(state[tip].position.xyz, state[tip - 1u].position.xyz), 1e-9));
    } else {
        vec4 frame = frame_of(was_tip - 1u);
        stretch_segment(was_tip, rest[was_tip - 1u].position.w / max(change[k].last, 1e-9));
        clear_segment(was_tip);
        for (uint i = was_tip + 1u; i <= tip; ++i) {
            vec4 turn = quat_multiply(quat_conjugate(rest[i - 2u].frame), rest[i - 1u].frame);
            frame     = normalize(quat_multiply(frame, turn));
            add_vertex(i, frame);
            clear_segment(i);
        }
    }
    clear_segment(tip);
    for (uint i = tip + 1u; i <= was_tip; ++i) {
        state[i].displacement = vec4(0.0);
#ifdef HAIR_ROD
        if (i < history.length()) history[i] = hair_history(vec4(0.0), vec4(0.0));
#endif
        clear_segment(i);
    }
}
