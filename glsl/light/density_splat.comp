// density_splat.comp - splatting of the drawn strands into the density grid. Each segment adds the
// area that it would shade if it lay across the light. The area is spread over points at most a
// cell apart and over the nodes around them. Sums are integers and do not depend on the order. A
// work group per patch.
#version 450 core
#include "strands/patch.glsl"
#include "light/density.glsl"

#define MAX_PLACES 64.0

void put(density_grid grid, vec3 place, float amount)
{
    uint node;
    vec3 part;
    if (!find_node(grid, place, node, part)) return;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner = uvec3(k & 1u, k >> 1u & 1u, k >> 2u);
        vec3  fraction  = mix(1.0 - part, part, vec3(corner));
        uint  at     = node + corner.x + grid.nodes.x * (corner.y + grid.nodes.y * corner.z);
        atomicAdd(density[at],
                  uint(min(amount * fraction.x * fraction.y * fraction.z, 1e3) * HAIR_DENSITY_UNITS + 0.5));
    }
}

void main()
{
    uint number = hair_group();
    if (number >= uint(textureSize(patch_texture)) / HAIR_PATCH_TEXELS) return;
    hair_patch_lines lines = find_lines(number);
    density_grid     grid  = find_grid();
    uint             count = lines.strands * draw.segments;
    for (uint i = gl_LocalInvocationID.x; i < count; i += HAIR_GROUP_SIZE) {
        uint strand = i / draw.segments,
             vertex = (lines.first + strand) * (draw.segments + 1u) + i % draw.segments;
        vec4  a = strand_vertex[vertex], b = strand_vertex[vertex + 1u];
        vec3  from = place_in(grid, a.xyz), way = place_in(grid, b.xyz) - from;
        float width  = (a.w + b.w) * lines.thickness * (strand + 1u == lines.strands ? lines.fading : 1.0);
        float places = min(1.0 + floor(length(way)), MAX_PLACES);
        float amount = length(way) * width / (grid.cell * places);
        for (float k = 0.5; k < places; k += 1.0) put(grid, from + k / places * way, amount);
    }
}
