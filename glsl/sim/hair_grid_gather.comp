// hair_grid_gather.comp - the acceleration of a guide vertex i by the hair around it. Cohesion
// pulls its velocity v towards the rigid motion of this hair. Hair denser than its space holds
// presses like a gas of constant temperature:
//
//   a = cohesion sum_n w_in g_n (u_n(x_i) - v_i)
//       + 6 volume / cell^2 sum_n w_in max(1 - limit_n / V_n, 0) (x_i - c_n)
//
// The sums are over the nodes n around, of weights w. u_n is the rigid motion of all hair at the
// node, c_n its centre of mass, and V_n its volume. hair_grid_rigid.glsl computes u_n. With the
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

vec3 numbers_at(uint at) { return vec3(hair_grid[at], hair_grid[at + 1u], hair_grid[at + 2u]); }

sums sums_at(uint at)
{
    return sums(float(hair_grid[at]), numbers_at(at + HAIR_GRID_MOMENTUM), numbers_at(at + HAIR_GRID_MOMENT),
                numbers_at(at + HAIR_GRID_ANGULAR), numbers_at(at + HAIR_GRID_SQUARES),
                numbers_at(at + HAIR_GRID_PRODUCTS));
}

// Return g of a node. With the masses m_s of strands at the node and their sum m, Q = sum_s m_s^2 /
// m^2 is 1/N for N equal strands.
float company_at(uint node)
{
    float mass = float(hair_grid[node]),
          alike = float(hair_grid[node + HAIR_GRID_ALIKE]) / (params.per_strand * mass * mass);
    return clamp(2.0 * (1.0 - alike), 0.0, 1.0);
}

// Return the pull of cohesion on the velocity v. A loop of no rounds replaces a branch, because a
// software rasteriser executes both sides of a branch.
vec3 drawn_at(vec3 v)
{
    vec3 drawn = vec3(0.0);
    for (uint k = 0u, end = params.cohesion > 0.0 ? 8u : 0u; k < end; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = fractions_of(corner);
        uint  node   = node_of(corner);
        if (hair_grid[node] <= 0) continue;
        vec3 u = speed_at(rigid_motion(sums_at(node)), part - vec3(corner));
        drawn += s.x * s.y * s.z * company_at(node) * (u - v);
    }
    return drawn;
}

vec3 pressed()
{
    vec3 sum = vec3(0.0);
    for (uint k = 0u, end = params.pressure_stiffness > 0.0 ? 8u : 0u; k < end; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = fractions_of(corner);
        uint  node   = node_of(corner);
        if (hair_grid[node] <= 0) continue;
        // Rounding may leave a negative volume.
        float volume = float(hair_grid[node + HAIR_GRID_VOLUME]);
        float over   = 1.0 - min(rest_density[node / NODE_NUMBERS] / max(volume, 1.0), 1.0);
        vec3  centre = numbers_at(node + HAIR_GRID_MOMENT) / float(hair_grid[node]);
        sum += s.x * s.y * s.z * over * (part - vec3(corner) - centre);
    }
    return sum;
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
    vec3 a = params.cohesion * HAIR_GRID_SPEED * drawn_at(v) +
             6.0 * params.pressure_stiffness / params.lower.w * pressed();
    acceleration[i] = vec4(rotate(params.rotation, a), 0.0);
}
