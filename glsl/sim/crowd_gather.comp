// crowd_gather.comp - what the crowd does to a guide vertex i: it draws its velocity v towards the mean of other guides
// around, and where there is more hair than its space holds, that presses like a gas of constant temperature:
//
//   a = cohesion (sum_n w_in (p_n / m_n - v_i) - sum_j m_j k_ij (v_j - v_i))
//       - volume sum_n grad w_in max(ln(V_n / limit_n), 0)
//
// over the nodes n around, of weights w, and the vertices j of its own guide, k_ij = sum_n w_in w_jn / m_n: being drawn
// to those is taken off, so that a guide by itself feels nothing. Neither of these two takes momentum from all hair
// together; pressure, which knows where hair is at rest, may. One thread per guide vertex.
#version 450 core
#include "sim/crowd.glsl"

float per_mass[8]; // of the nodes around: w_in / m_n

// The sum over j; `own` is v_i.
vec3 drawn_to_itself(uint i, vec3 own)
{
    vec3 sum = vec3(0.0);
    for (uint j = share[i].first; j < share[i].end; ++j) {
        vec3  from  = spot_of(j) - vec3(lowest);
        vec3  lower = max(1.0 - abs(from), 0.0), upper = max(1.0 - abs(from - 1.0), 0.0);
        vec4  x    = lower.x * vec4(per_mass[0], per_mass[2], per_mass[4], per_mass[6]) +
                  upper.x * vec4(per_mass[1], per_mass[3], per_mass[5], per_mass[7]);
        vec2  y    = lower.y * x.xz + upper.y * x.yw;
        float k    = lower.z * y.x + upper.z * y.y;
        if (j != i && counts(j)) sum += float(share[j].mass) * k * (speed_of(j) - own);
    }
    return sum;
}

void main()
{
    uint i = thread();
    if (i >= params.vertices) return;
    push[i] = vec4(0.0);
    if (!counts(i)) return;
    find_spot(i);
    vec3 own = speed_of(i), drawn = vec3(0.0), slope = vec3(0.0);
    uint all = params.nodes_x * params.nodes_y * params.nodes_z;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = shares_of(corner), way = vec3(corner) * 2.0 - 1.0;
        uint  node   = node_of(corner);
        int   mass   = crowd[4u * node];
        per_mass[k]  = 0.0;
        if (mass > 0) {
            vec3 p      = vec3(crowd[4u * node + 1u], crowd[4u * node + 2u], crowd[4u * node + 3u]);
            per_mass[k] = s.x * s.y * s.z / float(mass);
            drawn += s.x * s.y * s.z * (clamp(p / float(mass), vec3(-1.0), vec3(1.0)) - own);
        }
        float filled = float(crowd[4u * all + node]) / limit[node];
        if (filled > 1.0) slope += log(filled) * way * s.yzx * s.zxy;
    }
    if (params.cohesion > 0.0) drawn -= drawn_to_itself(i, own);
    vec3  pressed = -params.volume / params.lower.w * rotate(params.rotation, slope);
    float most    = params.most_push / max(length(pressed), params.most_push);
    push[i]       = vec4(params.cohesion * HAIR_CROWD_SPEED * drawn + most * pressed, 0.0);
}
