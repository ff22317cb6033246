// hair_grid_gather.comp - the acceleration of a guide vertex i by the hair around it. Cohesion
// pulls its velocity v towards the rigid motion of this hair. Hair denser than its space holds
// presses like a gas of constant temperature:
//
//   a = cohesion sum_n w_in g_n (u_n(x_i) - v_i)
//       + 6 volume / cell^2 sum_n w_in max(1 - limit_n / V_n, 0) (x_i - c_n)
//
// The sums are over the nodes n around, of weights w. u_n is the rigid motion of all hair at the
// node, c_n its centre of mass, and V_n its volume. hair_grid_motion.comp computes them. With the
// masses and weights of a node, u_n has the momentum and the angular momentum of the velocities in
// it. A force away from the centre has neither. All hair together therefore keeps its momentum and
// angular momentum.
//
// g_n is 0 where a strand is alone, and 1 from two strands on. In hair of density d that changes
// little over a cell, the pressure term is -volume grad(d - limit) / d. This holds because the mean
// of w_in (x_n - x_i)^2 is a sixth of the squared cell size. One thread per guide vertex.
#version 450 core
#include "sim/hair_grid.glsl"
#include "sim/hair_grid_rigid.glsl"

layout(std430, binding = HAIR_BIND_NODE_MOTION) readonly buffer node_motion_buffer
{
    hair_grid_node node_motion[];
};
layout(std430, binding = HAIR_BIND_ACCELERATION) writeonly buffer acceleration_buffer
{
    vec4 acceleration[];
};

// Return the acceleration of the velocity v. Nodes without hair add nothing.
vec3 pushed(vec3 v)
{
    vec3 drawn = vec3(0.0), pressed = vec3(0.0);
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = fractions_of(corner), from_node = part - vec3(corner);
        float weight = s.x * s.y * s.z;
        hair_grid_node n = node_motion[node_of(corner)];
        vec3 u = speed_at(motion(n.centre.xyz, n.speed.xyz, n.turn.xyz), from_node);
        drawn   += weight * n.centre.w * (u - v);
        pressed += weight * n.speed.w * (from_node - n.centre.xyz);
    }
    return params.cohesion * HAIR_GRID_SPEED * drawn +
           6.0 * params.pressure_stiffness / params.lower.w * pressed;
}

void main()
{
    uint i = thread();
    if (i >= params.vertices) return;
    acceleration[i] = vec4(0.0);
    if (!counts(i)) return;
    vec3 v = speed_of(i), at = grid_position(i, v);
    if (!is_inside(at)) return;
    find_stencil(at);
    acceleration[i] = vec4(rotate(params.rotation, pushed(v)), 0.0);
}
