// hair_grid_part.glsl - the part of the hair-hair grid that a work group adds up in shared memory.
// Vertices outside the part are added to the grid itself. Sums are those of integers, so it does
// not matter which vertices are inside.
#define SIDE 4u // Nodes along an axis of the part of the grid that a work group adds up.
#define PART_NUMBERS (SIDE * SIDE * SIDE * NODE_NUMBERS)
shared int sums[PART_NUMBERS];
shared uint  first_inside; // First thread whose vertex is inside the grid.
shared uvec3 part_lowest;  // Lowest node of the part, beside the cell of that vertex.
bool is_in_part; // All eight nodes around the vertex of this thread are in the part.

void clear_sums()
{
    for (uint n = gl_LocalInvocationID.x; n < PART_NUMBERS; n += HAIR_GROUP_SIZE) sums[n] = 0;
    if (gl_LocalInvocationID.x == 0u) first_inside = HAIR_GROUP_SIZE;
    synchronise();
}

// Place the part around the cell of the first vertex that is inside the grid. `inside` is whether
// that of this thread is.
void place_part(bool inside)
{
    if (inside) atomicMin(first_inside, gl_LocalInvocationID.x);
    synchronise();
    if (gl_LocalInvocationID.x == first_inside) part_lowest = max(lowest, uvec3(1u)) - 1u;
    synchronise();
    // Differences below 0 wrap around.
    is_in_part = all(lessThan(lowest - part_lowest, uvec3(SIDE - 1u)));
}

// Return the index of the first number of a node, in the sums or in the grid.
uint place_of(uvec3 corner)
{
    uvec3 at = lowest + corner - part_lowest;
    return NODE_NUMBERS * (is_in_part ? at.x + SIDE * (at.y + SIDE * at.z) : node_of(corner));
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
