// porous.comp - hair as a porous obstacle for the wind. A face is closed as far as strands slow the
// air between them over the step, and what closes it moves with the strands. Strands are taken to
// be isotropic, with l metres of them in a cubic metre. Air of velocity u relative to them slows by
//
//   du/dt = -r u,  r = l nu (2/3 D_n + 1/3 D_t)
//
// D_n and D_t are the drag across and along a strand of cylinder.glsl, at the velocity before the
// step. nu is the kinematic viscosity. Implicitly, 1 / (1 + r dt) of u remains, and of every change
// of u by pressure. This is the open fraction of the face. Air therefore flows around hair that is
// too dense to pass within a step. One thread per slot.
#version 450 core
#include "wind/backtrace.glsl"
#include "wind/cylinder.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_THICKET) uniform isamplerBuffer thicket_texture; // Mass and momentum.
layout(binding = HAIR_UNIT_BARE_FACE_FRACTION) uniform usamplerBuffer bare_face_fraction_texture;
layout(binding = HAIR_UNIT_BARE_WALL_VELOCITY) uniform samplerBuffer bare_wall_velocity_texture;
layout(std430, binding = HAIR_BIND_WALL_VELOCITY) writeonly buffer wall_velocity_buffer
{
    float wall_velocity[];
};
layout(std430, binding = HAIR_BIND_FACE_FRACTION) writeonly buffer face_fraction_buffer { uint slots[]; };

// Return mass and momentum of hair at a position, linear between nodes. Nodes are the centres of
// cells of their own size.
vec4 hair_at(vec3 place)
{
    int   n    = int(fluid.nodes);
    vec3  at   = clamp(place * (float(n) / float(fluid.cells)) - 0.5, vec3(0.0), vec3(n - 1));
    ivec3 low  = min(ivec3(at), n - 2);
    vec3  part = at - vec3(low);
    vec4  sum  = vec4(0.0);
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        vec3  fraction  = mix(1.0 - part, part, vec3(corner));
        sum += fraction.x * fraction.y * fraction.z *
               vec4(texelFetch(thicket_texture, index_of(low + corner, fluid.nodes)));
    }
    return sum;
}

// Return the velocity of the air before the step, or of the wind if the box was not there.
vec3 air_before(vec3 place)
{
    vec3 then = place + fluid.shift.xyz;
    return is_in_box(then) ? textureLod(air_texture, then / float(fluid.cells), 0.0).xyz : fluid.wind.xyz;
}

// Return the fraction of the relative velocity that remains for hair of the given density and
// velocity.
float left_of(vec3 place, float density, vec3 velocity)
{
    vec2 drag = drag_of(length(air_before(place) - velocity) * fluid.per_speed);
    return 1.0 / (1.0 + density * fluid.viscous * (2.0 * drag.x + drag.y) / 3.0);
}

void main()
{
    uint side = fluid.cells + 1u, i = thread();
    if (i >= side * side * side) return;
    ivec3 at   = place_of(i, side);
    uint  bare = texelFetch(bare_face_fraction_texture, int(i)).x, slot = 0u;
    for (int axis = 0; axis < 3; ++axis) {
        int   face = face_of(axis, at);
        uint  open = bare >> (10 * axis) & 1023u;
        vec4  hair = hair_at(face_place(axis, at));
        float speed = texelFetch(bare_wall_velocity_texture, face).x;
        if (open > 0u && hair.x > 0.0) {
            vec3  velocity = HAIR_GRID_SPEED * hair.yzw / hair.x;
            float left     = left_of(face_place(axis, at), hair.x * fluid.thick, velocity);
            uint  still    = clamp(uint(float(open) * left + 0.5), 1u, open);
            float held     = float(open - still), closed = float(1023u - open);
            if (held > 0.0) speed = (held * velocity[axis] + closed * speed) / (held + closed);
            open = still;
        }
        slot |= open << (10 * axis);
        wall_velocity[face] = speed;
    }
    slots[i] = slot;
}
