// hair_grid_splat.comp - add a guide vertex's mass, momentum and volume to the eight nodes around
// it. The parts add up exactly, because the last node receives the remainder of rounding. Cohesion
// also needs moments. The fluid's grid has mass and momentum only.
//
// One thread per guide vertex, in the order of cells at rest. Vertices of a work group are thus
// mostly close together. The group adds them up in shared memory, and adds each sum to the grid
// once, because additions to one place of the grid wait for each other.
#version 450 core
#include "sim/hair_grid.glsl"

layout(std430, binding = HAIR_BIND_HAIR_GRID) buffer hair_grid_buffer { int hair_grid[]; };
layout(std430, binding = HAIR_BIND_SPLAT) readonly buffer splat_buffer { hair_grid_splat splat[]; };
layout(std430, binding = HAIR_BIND_SPLAT_ORDER) readonly buffer order_buffer { uint order[]; };

#include "sim/hair_grid_part.glsl"

ivec3 whole(vec3 v) { return ivec3(floor(v + 0.5)); }

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

void main()
{
    uint i = 0u;
    clear_sums();
    bool there = thread() < params.vertices;
    if (there) i = order[thread()];
    vec3 speed = speed_of(i), at = grid_position(i, speed);
    there      = there && counts(i) && is_inside(at);
    find_stencil(there ? at : vec3(0.0));
    place_part(there);
    if (there) add_all(i, speed);
    synchronise();
    add_sums();
}
