// derive_guides.comp - move the guides that are not simulated like their parents, which are. One
// work group per guide that is not simulated, and one thread per segment.
//
// A segment has the rotation from rest that the parent has at the same distance from the root.
// Lengths are exact, because segments are only turned. When the level changes, a guide keeps its
// shape: the difference from the parent's rotations is found before a step, and decays. With
// HAIR_BEGIN the program finds the differences, and moves nothing.
#version 450 core
#include "sim/buffers.glsl"
#include "sim/rod_buffers.glsl"
#include "sim/guide_level.glsl"
#include "rotation.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

vec3 direction_of(vec3 v) { return direction_or(v, vec3(0.0, -1.0, 0.0)); }

// Frame of a segment of the parent, and its direction a substep ago.
struct turned_segment {
    vec4 frame;
    vec3 now, before;
};

// Return segment k of the parent. `head` is the rotation of the head.
turned_segment segment_at(uint k, vec4 head)
{
    hair_state a = state[k], b = state[k + 1u];
    vec3 now = b.position.xyz - a.position.xyz;
    turned_segment s;
    s.now    = direction_of(now);
    s.before = direction_of(now - (b.displacement.xyz - a.displacement.xyz));
#ifdef HAIR_MIXED
    s.frame  = material[k];
#else
    // The least rotation from rest, because no frames are kept.
    vec4 at_rest = quat_multiply(head, rest[k].frame);
    s.frame      = quat_multiply(quat_between(along_of(at_rest), s.now), at_rest);
#endif
    return s;
}

// Return the difference of segment i from a frame, which is xyz of a unit quaternion with w >= 0.
vec3 difference_of(uint i, vec4 frame)
{
#ifdef HAIR_MIXED
    vec4 q = quat_multiply(material[i], quat_conjugate(frame));
    return q.w < 0.0 ? -q.xyz : q.xyz;
#else
    vec3 own = direction_of(state[i + 1u].position.xyz - state[i].position.xyz);
    return quat_between(along_of(frame), own).xyz;
#endif
}

#ifndef HAIR_BEGIN
// Sums of the segments up to that of a thread, and of their motion in the last substep.
shared vec3 place_of[HAIR_GROUP_SIZE], moved_of[HAIR_GROUP_SIZE];

// Replace the values of all threads by the sums of those up to each (Hillis and Steele 1986).
void add_up(uint t, vec3 edge, vec3 motion)
{
    place_of[t] = edge;
    moved_of[t] = motion;
    for (uint reach = 1u; reach < HAIR_GROUP_SIZE; reach *= 2u) {
        synchronise();
        vec3 place = t >= reach ? place_of[t - reach] : vec3(0.0);
        vec3 moved = t >= reach ? moved_of[t - reach] : vec3(0.0);
        synchronise();
        place_of[t] += place;
        moved_of[t] += moved;
    }
    synchronise();
}

// Keep a part of the difference of segment v from a frame. Return the frame of the segment.
vec4 approach(uint v, vec4 frame)
{
    vec3 away = params.guide_keep * history[v].rate.xyz;
    history[v].rate.xyz = away;
    return normalize(quat_multiply(vec4(away, sqrt(max(1.0 - dot(away, away), 0.0))), frame));
}
#endif

void main()
{
    uint k  = hair_group(), t = gl_LocalInvocationID.x;
    uint at = k + k / (params.guide_stride - 1u) + 1u; // The places of parents are left out.
    if (at >= params.guides) return;
    hair_guide own = guide[guide_in_order(at)], parent = guide[guide_in_order(at - at % params.guide_stride)];
    float own_segment    = own.arc_length / float(own.count - 1u);
    float parent_segment = parent.arc_length / float(parent.count - 1u);
    float ratio = own_segment / max(parent_segment, 1e-9);
#ifdef HAIR_BEGIN
    vec4 head = params.rotation_start;
#else
    vec4 head = params.rotation_after;
    vec3 root = rest[own.first].position.xyz, place = rotate(head, root);
    vec3 moved = params.last_displacement.xyz + place - rotate(params.rotation_before, root);
    if (t == 0u) state[own.first] = hair_state(vec4(place, 1.0), vec4(moved, 0.0));
#endif
    for (uint first = 0u; first + 1u < own.count; first += HAIR_GROUP_SIZE) {
        uint i = min(first + t, own.count - 2u), v = own.first + i;
        uint j = min(uint(min((float(i) + 0.5) * ratio, 1e4)), parent.count - 2u);
        turned_segment s = segment_at(parent.first + j, head);
        // The parent's rotation from rest.
        vec4 turn  = quat_multiply(s.frame, quat_conjugate(rest[parent.first + j].frame));
        vec4 frame = quat_multiply(turn, rest[v].frame);
        bool is_own = first + t == i;
#ifdef HAIR_BEGIN
        if (is_own) history[v].rate = vec4(difference_of(v, frame), 0.0);
#else
        if (is_own) frame = approach(v, frame);
        vec3 edge = distance(rest[v].position.xyz, rest[v + 1u].position.xyz) * along_of(frame);
        add_up(t, edge, edge - rotate(quat_between(s.now, s.before), edge));
        if (is_own)
            state[v + 1u] = hair_state(vec4(place + place_of[t], 1.0), vec4(moved + moved_of[t], 0.0));
#ifdef HAIR_MIXED
        if (is_own) material[v] = frame;
#endif
        place += place_of[HAIR_GROUP_SIZE - 1];
        moved += moved_of[HAIR_GROUP_SIZE - 1];
        synchronise();
#endif
    }
}
