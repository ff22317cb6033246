// crowd_gather.comp - what the crowd does to a guide vertex i: it draws its velocity v towards the rigid motion of the
// hair around, and where there is more hair than its space holds, that presses like a gas of constant temperature:
//
//   a = cohesion sum_n w_in g_n (u_n(x_i) - v_i) + 6 volume / cell^2 sum_n w_in max(1 - limit_n / V_n, 0) (x_i - c_n)
//
// over the nodes n around, of weights w, with u_n the rigid motion of all hair at the node and c_n its centre of mass: see
// crowd_rigid.glsl. With the masses and the weights of a node u_n has the momentum and the angular momentum of the
// velocities it is of, and what leads straight away from the centre has neither: so no term takes any from all hair
// together. g_n is 0 where a strand is by itself, and 1 from two on. In hair of density d that changes little over a cell
// pressure is -volume grad(d - limit) / d, for the mean of w_in (x_n - x_i)^2 is a sixth of the cell's square.
// One thread per guide vertex.
#version 450 core
#include "sim/crowd.glsl"
#include "sim/crowd_rigid.glsl"

vec3 numbers_at(uint at) { return vec3(crowd[at], crowd[at + 1u], crowd[at + 2u]); }

sums sums_at(uint at)
{
    return sums(float(crowd[at]), numbers_at(at + HAIR_CROWD_MOMENTUM), numbers_at(at + HAIR_CROWD_MOMENT),
                numbers_at(at + HAIR_CROWD_ANGULAR), numbers_at(at + HAIR_CROWD_SQUARES),
                numbers_at(at + HAIR_CROWD_PRODUCTS));
}

// By the mass of strands at the node, which is their number if they are alike: Q = sum_s m_s^2 / m^2 is one by it.
float company_at(uint node)
{
    float mass = float(crowd[node]), alike = float(crowd[node + HAIR_CROWD_ALIKE]) / (params.per_strand * mass * mass);
    return clamp(2.0 * (1.0 - alike), 0.0, 1.0);
}

// A software rasteriser runs both sides of a branch, but no loop without rounds.
vec3 drawn_at(vec3 v)
{
    vec3 drawn = vec3(0.0);
    for (uint k = 0u, end = params.cohesion > 0.0 ? 8u : 0u; k < end; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = shares_of(corner);
        uint  node   = node_of(corner);
        if (crowd[node] <= 0) continue;
        vec3 u = speed_at(rigid_motion(sums_at(node)), part - vec3(corner));
        drawn += s.x * s.y * s.z * company_at(node) * (u - v);
    }
    return drawn;
}

vec3 pressed()
{
    vec3 sum = vec3(0.0);
    for (uint k = 0u, end = params.volume > 0.0 ? 8u : 0u; k < end; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = shares_of(corner);
        uint  node   = node_of(corner);
        if (crowd[node] <= 0) continue;
        float volume = float(crowd[node + HAIR_CROWD_VOLUME]); // Rounding may leave less than 0.
        float over   = 1.0 - min(limit[node / NODE_NUMBERS] / max(volume, 1.0), 1.0);
        vec3  centre = numbers_at(node + HAIR_CROWD_MOMENT) / float(crowd[node]);
        sum += s.x * s.y * s.z * over * (part - vec3(corner) - centre);
    }
    return sum;
}

void main()
{
    uint i = thread();
    if (i >= params.vertices) return;
    push[i] = vec4(0.0);
    if (!counts(i)) return;
    vec3 v = speed_of(i), at = spot_of(i, v);
    if (!is_inside(at)) return;
    find_spot(at);
    vec3 a  = params.cohesion * HAIR_CROWD_SPEED * drawn_at(v) + 6.0 * params.volume / params.lower.w * pressed();
    push[i] = vec4(rotate(params.rotation, a), 0.0);
}
