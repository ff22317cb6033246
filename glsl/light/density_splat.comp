// density_splat.comp - splatting of the drawn strands into the density grid. Each segment adds the
// area that it would shade if it lay across the light. The area is spread over points at most a
// cell apart and over the nodes around them. Sums are integers and do not depend on the order.
//
// Neighbouring strands meet the same nodes, and additions to the grid bound the time. A work group
// therefore covers the same segments of all strands of a patch, adds to a hash table of its own,
// and adds the sums of the table to the grid.
#version 450 core
#include "strands/patch.glsl"
#include "light/density.glsl"

#define MAX_PLACES 64.0
#define SLOT_BITS 9
#define SLOTS (1u << SLOT_BITS)
#define PROBES 4u // Slots that a node may have.
#define NO_NODE 0xffffffffu

shared uint node_of_slot[SLOTS], sum_of_slot[SLOTS];

// Add to a node in the table, or in the grid if other nodes have its slots.
void add(uint node, uint amount)
{
    uint slot = node * 2654435769u >> (32 - SLOT_BITS); // Fibonacci hashing (Knuth 1973).
    for (uint i = 0u; i < PROBES; ++i) {
        uint own = node_of_slot[slot];
        if (own == NO_NODE) own = atomicCompSwap(node_of_slot[slot], NO_NODE, node);
        if (own == NO_NODE || own == node) {
            atomicAdd(sum_of_slot[slot], amount);
            return;
        }
        slot = (slot + 1u) % SLOTS;
    }
    atomicAdd(density[node], amount);
}

void put(density_grid grid, vec3 place, float amount)
{
    uint node;
    vec3 part;
    if (!find_node(grid, place, node, part)) return;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner   = uvec3(k & 1u, k >> 1u & 1u, k >> 2u);
        vec3  fraction = mix(1.0 - part, part, vec3(corner));
        float own      = min(amount * fraction.x * fraction.y * fraction.z, 1e3);
        add(node + corner.x + grid.nodes.x * (corner.y + grid.nodes.y * corner.z),
            uint(own * HAIR_DENSITY_UNITS + 0.5));
    }
}

void put_segment(density_grid grid, hair_patch_lines lines, uint strand, uint segment)
{
    uint  vertex = (lines.first + strand) * (draw.segments + 1u) + segment;
    vec4  a = strand_vertex[vertex], b = strand_vertex[vertex + 1u];
    vec3  from = place_in(grid, a.xyz), way = place_in(grid, b.xyz) - from;
    float width  = (a.w + b.w) * lines.thickness * (strand + 1u == lines.strands ? lines.fading : 1.0);
    float places = min(1.0 + floor(length(way)), MAX_PLACES);
    float amount = length(way) * width / (grid.cell * places);
    for (float k = 0.5; k < places; k += 1.0) put(grid, from + k / places * way, amount);
}

void main()
{
    uint groups = (draw.chunks + HAIR_SPLAT_ROUNDS - 1u) / HAIR_SPLAT_ROUNDS;
    uint group = hair_group() % groups, number = hair_group() / groups;
    if (number >= count_patches()) return;
    hair_patch_lines lines = find_lines(number);
    lines.strands = limit_to_cache(number, lines.first, lines.all, lines.strands);
    lines.first   = first_in_cache(number, lines.first);
    density_grid     grid  = find_grid();
    uint             count = lines.strands * draw.segments, each = (count + groups - 1u) / groups;
    uint             end   = min((group + 1u) * each, count);
    for (uint i = gl_LocalInvocationID.x; i < SLOTS; i += HAIR_GROUP_SIZE)
        node_of_slot[i] = NO_NODE, sum_of_slot[i] = 0u;
    synchronise();
    for (uint i = group * each + gl_LocalInvocationID.x; i < end; i += HAIR_GROUP_SIZE)
        put_segment(grid, lines, i % lines.strands, i / lines.strands);
    synchronise();
    for (uint i = gl_LocalInvocationID.x; i < SLOTS; i += HAIR_GROUP_SIZE)
        if (sum_of_slot[i] > 0u) atomicAdd(density[node_of_slot[i]], sum_of_slot[i]);
}
