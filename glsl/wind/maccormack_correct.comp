// maccormack_correct.comp - MacCormack correction of advection by Selle et al. 2008, "An
// Unconditionally Stable MacCormack Method". It restores half of the error of advection forward and
// back, clamped to the range of the faces from which the fluid comes. Then the change of the
// ambient wind is added everywhere. One thread per slot.
#version 450 core
#include "wind/backtrace.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_ADVECTED) uniform samplerBuffer advected_texture;
layout(std430, binding = HAIR_BIND_VELOCITY) writeonly buffer velocity_buffer { float velocity[]; };

float min_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float max_of(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

float corrected(int axis, ivec3 at, float advected, vec3 place, vec3 from)
{
    vec4       near, far, near_to, far_to;
    vec3       to    = backtrace(place, 1.0) - fluid.shift.xyz; // In the current box.
    face_stencil own   = stencil_at(axis, place), source = stencil_at(axis, from);
    fetch_faces(velocity_texture, axis, own, near, far);
    float      was   = between(near, far, own.part);
    fetch_faces(velocity_texture, axis, source, near, far);
    if (!is_in_box(to) || !is_in_box(place)) return advected;
    face_stencil target = stencil_at(axis, to);
    fetch_faces(advected_texture, axis, target, near_to, far_to);
    float      better = advected + 0.5 * (was - between(near_to, far_to, target.part));
    return clamp(better, min_of(min(near, far)), max_of(max(near, far)));
}

void main()
{
    uint side = fluid.cells + 1u, i = thread();
    if (i >= side * side * side) return;
    ivec3 at = place_of(i, side);
    for (int axis = 0; axis < 3; ++axis) {
        vec3  place  = face_place(axis, at) + fluid.shift.xyz, from = backtrace(place, -1.0);
        int   face   = face_of(axis, at);
        float result = texelFetch(advected_texture, face).x;
        if (is_in_box(from)) result = corrected(axis, at, result, place, from) + fluid.gain[axis];
        velocity[face] = is_sound(result) ? result : fluid.wind[axis];
    }
}
