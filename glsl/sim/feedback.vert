// feedback.vert - the solver of redblack.comp without compute shaders, as in Tariq 2010 for
// Direct3D 10. Every phase draws all vertices as points. Transform feedback captures them into
// another buffer, which the next phase reads. The shader is compiled once per HAIR_PHASE:
//
//   0 integration, 1 angular forces, 2 and 3 red and black distance constraints,
//   4 and 5 angular constraints, 6 collisions, 7 end of the substep
//
// The substep is the first one in the parameters. During the constraints, the value kept beside a
// vertex's position is its position before the substep.
#version 450 core
#include "shared.h"
layout(std140, binding = HAIR_BIND_STEP) uniform step_buffer { hair_step_params params; };
#include "rotation.glsl"
#include "sim/capsules.glsl"
#include "sim/angular.glsl"

layout(binding = HAIR_UNIT_STATE) uniform samplerBuffer state_texture; // hair_state
layout(binding = HAIR_UNIT_REST) uniform samplerBuffer rest_texture;   // hair_rest
layout(binding = HAIR_UNIT_GUIDE) uniform usamplerBuffer guide_texture; // hair_guide
// Index of the guide of each vertex.
layout(binding = HAIR_UNIT_OWNER) uniform usamplerBuffer owner_texture;

out vec4 moved[2]; // hair_state

uint first, count; // first vertex of the guide, and number of its vertices

vec3 vertex(uint i) { return texelFetch(state_texture, 2 * int(first + i)).xyz; }
vec3 beside(uint i) { return texelFetch(state_texture, 2 * int(first + i) + 1).xyz; }
vec4 rest_position(uint i) { return texelFetch(rest_texture, 2 * int(first + i)); }

vec3 pull(vec3 position, vec3 target, float frequency_squared, float dt)
{
    float k = frequency_squared * dt * dt;
    return position + (target - position) * (k / (1.0 + k));
}

// Return vertex i, an end of the link (a, b), after relax_link() of sim/constraints.glsl.
vec3 relaxed(uint i, uint a, uint b, float rest_length, float stiffness)
{
    vec3  link = vertex(b) - vertex(a);
    float l    = length(link);
    if (b >= count || l < 1e-12 || b < 2u) return vertex(i);
    vec3 correction = link * (stiffness * (l - rest_length) / l);
    if (i == b) return vertex(b) - (a < 2u ? 1.0 : 0.5) * correction;
    return a >= 2u ? vertex(a) + 0.5 * correction : vertex(a);
}

vec3 relax_distance(uint i, uint phase)
{
    if (i < phase) return vertex(i);
    uint a = i - (i - phase) % 2u;
    return relaxed(i, a, a + 1u, rest_position(a).w, 1.0);
}

vec3 relax_bend(uint i, uint phase)
{
    if (i < 2u * phase) return vertex(i);
    uint a = i - ((i - 2u * phase) % 4u & 2u);
    // relaxed() takes no vertex beyond the tip.
    vec3 from = rest_position(a).xyz, to = rest_position(min(a + 2u, count - 1u)).xyz;
    return relaxed(i, a, a + 2u, distance(from, to), params.bend);
}

angular_moves angular_of(uint i, vec4 head)
{
    vec3  middle = rest_position(i - 1u).xyz, link = middle - rest_position(i - 2u).xyz;
    float dt     = params.gravity.w;
    return angular_force(head, vertex(i - 2u), vertex(i - 1u), vertex(i), link, rest_position(i).xyz - middle,
                         params.angular * dt * dt);
}

vec3 bend_to_rest(uint i, vec4 head)
{
    if (i < 2u) return vertex(i);
    vec3 moved = angular_of(i, head).end;
    if (i + 1u < count) {
        angular_moves next = angular_of(i + 1u, head);
        moved -= next.end + next.couple;
    }
    if (i + 2u < count) moved += angular_of(i + 2u, head).couple;
    return vertex(i) + moved;
}

// Push vertex i out of all colliders. A collider that is too far away does nothing.
vec3 collide(uint i, float fraction)
{
    vec3 position = vertex(i);
    for (uint k = 0u; k < params.colliders && i >= 2u; ++k)
        position = push_out(position, collider_at(params.collider[k], fraction, params.collision_margin));
    return position;
}

// Return whether v is finite. The test is by bits, because compilers may remove comparisons with
// NaN.
bool is_finite(vec3 v) { return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u))); }

bool is_broken(vec3 head)
{
    for (uint i = 0u; i < count; ++i) {
        vec3 x = vertex(i), d = x - beside(i) + head;
        if (!is_finite(x) || !is_finite(d) || dot(x, x) > 1e8 || dot(d, d) > 1e8) return true;
    }
    return false;
}

void main()
{
    uvec4 record   = texelFetch(guide_texture, 2 * int(texelFetch(owner_texture, gl_VertexID).x) + 1);
    vec4  rotation = params.substep[0].rotation;
    vec3  head     = params.substep[0].displacement.xyz;
    first = record.x, count = record.y;
    uint i = uint(gl_VertexID) - first;
    vec3 x = vertex(i), kept = beside(i), target = rotate(rotation, rest_position(i).xyz);
#if HAIR_PHASE == 0
    float dt = params.gravity.w, frequency = mix(params.shape_frequency_root, params.shape_frequency_tip,
                                                 float(i) / float(count - 1u));
    vec3 p = pull(x - head + params.keep * kept + params.gravity.xyz * (dt * dt), target,
                  frequency * frequency, dt);
    kept = x;
    x    = i < 2u ? target : p;
#elif HAIR_PHASE == 1
    x = bend_to_rest(i, rotation);
#elif HAIR_PHASE == 2 || HAIR_PHASE == 3
    x = relax_distance(i, HAIR_PHASE - 2u);
#elif HAIR_PHASE == 4 || HAIR_PHASE == 5
    x = relax_bend(i, HAIR_PHASE - 4u);
#elif HAIR_PHASE == 6
    x = collide(i, params.substep[0].displacement.w);
#else
    // The whole strand returns to its rest pose.
    bool broken = is_broken(head);
    kept        = broken ? (dot(head, head) < 1e8 ? head : vec3(0.0)) : x - kept + head;
    x           = broken ? target : x;
#endif
    moved[0] = vec4(x, 0.0);
    moved[1] = vec4(kept, 0.0);
}
