// colliders.glsl - access to colliders. A few colliders are in the step's parameters. Any number of
// them are in a texture, and a grid lists which of them can be met where (lib/collide/grid.h).
#ifdef HAIR_MESHES
layout(binding = HAIR_UNIT_NODE) uniform samplerBuffer node_texture;
#define NODE(i) texelFetch(node_texture, int(i)).x
#endif

#ifdef HAIR_COLLIDER_GRID
layout(binding = HAIR_UNIT_CONTACT) uniform usamplerBuffer contact_texture;
layout(binding = HAIR_UNIT_CELL) uniform usamplerBuffer cell_texture;

uvec4 contact_bits(uint k, uint part)
{
    return texelFetch(contact_texture, int(uint(HAIR_CONTACT_TEXELS) * k + part));
}
vec4  contact_part(uint k, uint part) { return uintBitsToFloat(contact_bits(k, part)); }
uint  cell_entry(uint i) { return texelFetch(cell_texture, int(i)).x; }

#define COLLIDER_START(k, n) contact_part(k, uint(n))
#define COLLIDER_END(k, n) contact_part(k, 2u + uint(n))
#define COLLIDER_SPIN(k) contact_part(k, 4u)
#define BODY_POSITION(k, n) contact_part(k, 5u + uint(n))
#define BODY_ROTATION(k, n) contact_part(k, 7u + uint(n))
#define BODY_SIZE(k) contact_part(k, 9u)
#define MESH_GRID(k) contact_part(k, 10u)
#define MESH_NODES(k) contact_bits(k, 11u)
#define BALL(k) contact_part(k, 12u)

// Return the range of members of the cell around a place: the first, and the end.
uvec2 cell_members(vec3 place)
{
    uvec3 cells = uvec3(params.cells_x, params.cells_y, params.cells_z);
    vec3  at    = (place - params.cells_lower.xyz) * params.cells_lower.w;
    uvec3 cell  = min(uvec3(clamp(at, vec3(0.0), vec3(cells))), cells - 1u);
    uint  i     = cell.x + cells.x * (cell.y + cells.y * cell.z);
    return uvec2(cell_entry(i), cell_entry(i + 1u));
}
#else
#define COLLIDER_START(k, n) params.collider[k].start[n]
#define COLLIDER_END(k, n) params.collider[k].end[n]
#define COLLIDER_SPIN(k) params.collider[k].spin
#define BODY_POSITION(k, n) params.body[k].position[n]
#define BODY_ROTATION(k, n) params.body[k].rotation[n]
#define BODY_SIZE(k) params.body[k].size
#define MESH_GRID(k) params.mesh[k].grid
#define MESH_NODES(k) \
    uvec4(params.mesh[k].nodes_x, params.mesh[k].nodes_y, params.mesh[k].nodes_z, params.mesh[k].first)
#endif
