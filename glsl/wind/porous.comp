// porous.comp - hair in the way of air: a face is as far closed as strands hold back over the step what is between them, and
// what closes it goes with them. As if they lay every way, with l metres of them in a cubic metre, air of velocity u against
// them slows by
//
//   du/dt = -r u,  r = l nu (2/3 D_n + 1/3 D_t)
//
// D: of cylinder.glsl, at what u was. Implicitly 1 / (1 + r dt) is left of u, and as much of what pressure adds to it: so that
// is how open the face is, and air goes around hair that is too dense for it within a step. One thread per slot.
#version 450 core
#include "wind/trace.glsl"
#include "wind/cylinder.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_THICKET) uniform isamplerBuffer thicket_texture; // mass and momentum
layout(binding = HAIR_UNIT_BARE_OPEN) uniform usamplerBuffer bare_open_texture;
layout(binding = HAIR_UNIT_BARE_WALL) uniform samplerBuffer bare_wall_texture;
layout(std430, binding = HAIR_BIND_WALL) writeonly buffer wall_buffer { float wall[]; };
layout(std430, binding = HAIR_BIND_OPEN) writeonly buffer open_buffer { uint slots[]; };

// Linear between nodes, which are the middles of cells of their own size.
vec4 hair_at(vec3 place)
{
    int   n    = int(fluid.nodes);
    vec3  at   = clamp(place * (float(n) / float(fluid.cells)) - 0.5, vec3(0.0), vec3(n - 1));
    ivec3 low  = min(ivec3(at), n - 2);
    vec3  part = at - vec3(low);
    vec4  sum  = vec4(0.0);
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        vec3  share  = mix(1.0 - part, part, vec3(corner));
        sum += share.x * share.y * share.z * vec4(texelFetch(thicket_texture, index_of(low + corner, fluid.nodes)));
    }
    return sum;
}

// Before the step, or the wind where the box was not.
vec3 air_before(vec3 place)
{
    vec3 then = place + fluid.shift.xyz;
    return is_in_box(then) ? textureLod(air_texture, then / float(fluid.cells), 0.0).xyz : fluid.wind.xyz;
}

// What is left of air against hair of such a density and velocity.
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
    uint  bare = texelFetch(bare_open_texture, int(i)).x, slot = 0u;
    for (int axis = 0; axis < 3; ++axis) {
        int   face = face_of(axis, at);
        uint  open = bare >> (10 * axis) & 1023u;
        vec4  hair = hair_at(face_place(axis, at));
        float speed = texelFetch(bare_wall_texture, face).x;
        if (open > 0u && hair.x > 0.0) {
            vec3  velocity = HAIR_CROWD_SPEED * hair.yzw / hair.x;
            float left     = left_of(face_place(axis, at), hair.x * fluid.thick, velocity);
            uint  still    = clamp(uint(float(open) * left + 0.5), 1u, open);
            float held     = float(open - still), closed = float(1023u - open);
            if (held > 0.0) speed = (held * velocity[axis] + closed * speed) / (held + closed);
            open = still;
        }
        slot |= open << (10 * axis);
        wall[face] = speed;
    }
    slots[i] = slot;
}
