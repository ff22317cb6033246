// hair_grid_splat.comp - add a guide vertex's mass, momentum and volume to the eight nodes around
// it. The parts add up exactly, because the last node receives the remainder of rounding. Cohesion
// also needs moments. The fluid's grid has mass and momentum only.
//
// One thread per guide vertex, in the order of cells at rest. Vertices of a work group are thus
// mostly close together. The group adds them up in shared memory, and adds each sum to the grid
// once, because additions to one place of the grid wait for each other.
#version 450 core
#include "sim/hair_grid.glsl"

layout(std430, binding = HAIR_BIND_SPLAT_ORDER) readonly buffer order_buffer { uint order[]; };

#define SIDE 4u // Nodes along an axis of the part of the grid that a work group adds up.
#define PART_NUMBERS (SIDE * SIDE * SIDE * NODE_NUMBERS)
shared int sums[PART_NUMBERS];
shared uint  first_inside; // First thread whose vertex is inside the grid.
shared uvec3 part_lowest;  // Lowest node of the part, beside the cell of that vertex.
bool is_in_part; // All eight nodes around the vertex of this thread are in the part.

ivec3 whole(vec3 v) { return ivec3(floor(v + 0.5)); }

// Return the index of the first number of a node, in the sums or in the grid.
uint place_of(uvec3 corner)
{
    uvec3 at = lowest + corner - part_lowest;
    return is_in_part ? NODE_NUMBERS * (at.x + SIDE * (at.y + SIDE * at.z)) : node_of(corner);
}

void add(uint at, int v)
{
    if (is_in_part) atomicAdd(sums[at], v);
    else atomicAdd(hair_grid[at], v);
}

void add(uint at, ivec3 v)
{
    add(at, v.x);
    add(at + 1u, v.y);
    add(at + 2u, v.z);
}

#ifndef HAIR_FLUID
vec4 own_below, own_above; // Mass of the guide at the four lower and the four upper nodes

// Add vertex j of the guide. Return false if the vertex is out of reach of all eight nodes.
bool add_own(uint j)
{
    if (!counts(j)) return false;
    vec3 from  = grid_position(j, speed_of(j)) - vec3(lowest);
    vec3 lower = max(1.0 - abs(from), 0.0), upper = max(1.0 - abs(from - 1.0), 0.0);
    vec4 mass  = float(splat[j].mass) * vec4(lower.x, upper.x, lower.x, upper.x) * vec4(lower.yy, upper.yy);
    own_below += lower.z * mass;
    own_above += upper.z * mass;
    return all(greaterThan(lower + upper, vec3(0.0)));
}

// Add the vertices before and after i, as far as they reach the nodes.
void find_own(uint i)
{
    own_below = own_above = vec4(0.0);
    uint j = i;
    while (add_own(j) && j > splat[i].first) --j;
    for (j = i + 1u; j < splat[i].end && add_own(j); ++j) {}
}

// Add the values that cohesion needs of each node. A loop of no rounds replaces a branch, because a
// software rasteriser executes both sides of a branch.
void add_motion(uint i, vec3 speed)
{
    for (uint n = 0u, end = params.cohesion > 0.0 ? 1u : 0u; n < end; ++n) find_own(i);
    ivec3 left = ivec3(floor(float(splat[i].mass) * speed + 0.5));
    vec3  all  = vec3(left);
    for (uint k = 0u, end = params.cohesion > 0.0 ? 8u : 0u; k < end; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = fractions_of(corner), r = part - vec3(corner);
        float weight = s.x * s.y * s.z, mass = weight * float(splat[i].mass);
        float own    = (k < 4u ? own_below : own_above)[k & 3u];
        vec3  m      = mass * r;
        ivec3 p      = k == 7u ? left : whole(all * weight);
        uint  node   = place_of(corner);
        add(node + HAIR_GRID_MOMENTUM, p);
        add(node + HAIR_GRID_ANGULAR, whole(cross(m, speed)));
        add(node + HAIR_GRID_SQUARES, whole(m * r));
        add(node + HAIR_GRID_PRODUCTS, whole(m.yzx * r.zxy));
        add(node + HAIR_GRID_ALIKE, int(mass * min(own * params.per_strand, 1.0) + 0.5));
        left -= p;
    }
}

void add_all(uint i, vec3 speed)
{
    ivec2 bulk = ivec2(splat[i].mass, splat[i].volume), left = bulk;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = fractions_of(corner);
        float weight = s.x * s.y * s.z;
        ivec2 m      = k == 7u ? left : ivec2(floor(vec2(bulk) * weight + 0.5));
        uint  node   = place_of(corner);
        add(node, m.x);
        add(node + HAIR_GRID_VOLUME, m.y);
        add(node + HAIR_GRID_MOMENT, whole(float(bulk.x) * weight * (part - vec3(corner))));
        left -= m;
    }
    add_motion(i, speed);
}

#else

void add_all(uint i, vec3 speed)
{
    ivec4 motion = ivec4(int(splat[i].mass), whole(float(splat[i].mass) * speed)), left = motion;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = fractions_of(corner);
        ivec4 m      = k == 7u ? left : ivec4(floor(vec4(motion) * (s.x * s.y * s.z) + 0.5));
        uint  node   = place_of(corner);
        add(node, m.x);
        add(node + HAIR_GRID_MOMENTUM, m.yzw);
        left -= m;
    }
}

#endif

// Add the sums of the work group to the grid.
void add_sums()
{
    for (uint n = gl_LocalInvocationID.x; n < PART_NUMBERS; n += HAIR_GROUP_SIZE) {
        uint  node = n / NODE_NUMBERS;
        uvec3 at = part_lowest + uvec3(node % SIDE, node / SIDE % SIDE, node / (SIDE * SIDE));
        if (sums[n] != 0)
            atomicAdd(hair_grid[NODE_NUMBERS * (at.x + params.nodes_x * (at.y + params.nodes_y * at.z)) +
                                n % NODE_NUMBERS],
                      sums[n]);
    }
}

void main()
{
    uint own = gl_LocalInvocationID.x, i = 0u;
    for (uint n = own; n < PART_NUMBERS; n += HAIR_GROUP_SIZE) sums[n] = 0;
    if (own == 0u) first_inside = HAIR_GROUP_SIZE;
    synchronise();
    bool there = thread() < params.vertices;
    if (there) i = order[thread()];
    vec3 speed = speed_of(i), at = grid_position(i, speed);
    there      = there && counts(i) && is_inside(at);
    find_stencil(there ? at : vec3(0.0));
    if (there) atomicMin(first_inside, own);
    synchronise();
    if (own == first_inside) part_lowest = max(lowest, uvec3(1u)) - 1u;
    synchronise();
    // Differences below 0 wrap around.
    is_in_part = all(lessThan(lowest - part_lowest, uvec3(SIDE - 1u)));
    if (there) add_all(i, speed);
    synchronise();
    add_sums();
}
