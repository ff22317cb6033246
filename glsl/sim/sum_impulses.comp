// sum_impulses.comp - the sums of the impulses of all vertices by collider, which are then 0. One
// thread per guide vertex.
//
// A work group sums the impulses of one collider after the other, in a fixed order. It adds them to
// integers of 64 bits, whose sum depends on no order.
#version 450 core
#include "sim/buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_IMPULSE_SUM) buffer impulse_sum_buffer { uint impulse_sum[]; };
layout(rgba32f, binding = HAIR_IMAGE_IMPULSE) uniform imageBuffer impulse_image;

#define NOBODY 0xffffffffu

shared uint next_collider;
// Sums of threads. Part 0: impulse, and 1 per vertex. Part 1: moment of the impulse, and its
// length. Part 2: the part along normals. Part 3: place times length.
shared vec4 part[4][HAIR_GROUP_SIZE];

// Add a number to a 64-bit integer in units of HAIR_IMPULSE_UNIT. The float splits exactly.
void add_exactly(uint at, float v)
{
    float size = floor(abs(v) * (1.0 / HAIR_IMPULSE_UNIT) + 0.5), upper = floor(size / 4294967296.0);
    uint  high = uint(upper), low = uint(size - 4294967296.0 * upper);
    if (v < 0.0) {
        low  = ~low + 1u;
        high = ~high + (low == 0u ? 1u : 0u);
    }
    uint before = atomicAdd(impulse_sum[at], low);
    atomicAdd(impulse_sum[at + 1u], high + (before + low < before ? 1u : 0u));
}

void add_record(vec4 impulse, vec3 normal, vec3 place, uint i)
{
    float size = length(impulse.xyz);
    part[0][i] += vec4(impulse.xyz, 1.0);
    part[1][i] += vec4(cross(place, impulse.xyz), size);
    part[2][i] += vec4(normal, 0.0);
    part[3][i] += vec4(size * place, 0.0);
}

void sum_parts(uint i)
{
    for (uint reach = HAIR_GROUP_SIZE / 2u; reach > 0u; reach /= 2u) {
        synchronise();
        if (i < reach)
            for (uint p = 0u; p < 4u; ++p) part[p][i] += part[p][i + reach];
    }
    synchronise();
}

void main()
{
    uint  i = gl_LocalInvocationID.x, vertex = hair_group() * HAIR_GROUP_SIZE + i;
    int   texel = int(uint(HAIR_IMPULSE_TEXELS) * vertex);
    vec4  impulse[2] = vec4[2](vec4(0.0), vec4(0.0));
    vec3  normal[2] = vec3[2](vec3(0.0), vec3(0.0)), place = vec3(0.0);
    float touch = 0.0;
    if (vertex < params.vertices) {
        impulse[0] = imageLoad(impulse_image, texel);
        impulse[1] = imageLoad(impulse_image, texel + 1);
        vec4 thrust = imageLoad(impulse_image, texel + 2);
        normal[0]  = thrust.xyz;
        touch      = thrust.w;
        normal[1]  = imageLoad(impulse_image, texel + 3).xyz;
        place      = state[vertex].position.xyz;
    }
    if (impulse[0].w > 0.0) {
        imageStore(impulse_image, texel, vec4(0.0));
        imageStore(impulse_image, texel + 1, vec4(0.0));
        imageStore(impulse_image, texel + 2, vec4(vec3(0.0), touch));
        imageStore(impulse_image, texel + 3, vec4(0.0));
    }
    for (;;) {
        if (i == 0u) next_collider = NOBODY;
        synchronise();
        for (uint k = 0u; k < 2u; ++k)
            if (impulse[k].w > 0.0) atomicMin(next_collider, uint(impulse[k].w) - 1u);
        synchronise();
        uint collider = next_collider;
        synchronise();
        if (collider == NOBODY) break;
        for (uint p = 0u; p < 4u; ++p) part[p][i] = vec4(0.0);
        for (uint k = 0u; k < 2u; ++k)
            if (impulse[k].w > 0.0 && uint(impulse[k].w) - 1u == collider) {
                add_record(impulse[k], normal[k], place, i);
                impulse[k].w = 0.0;
            }
        sum_parts(i);
        uint at = uint(HAIR_IMPULSE_WORDS) * collider;
        if (i < 3u) {
            add_exactly(at + 2u * i, part[0][0][i]);
            add_exactly(at + 2u * (3u + i), part[1][0][i]);
            add_exactly(at + 2u * (6u + i), part[2][0][i]);
            add_exactly(at + 2u * (9u + i), part[3][0][i]);
        }
        if (i == 0u) {
            add_exactly(at + 24u, part[1][0].w);
            atomicAdd(impulse_sum[at + 26u], uint(part[0][0].w));
        }
    }
}
