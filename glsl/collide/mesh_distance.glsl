// mesh_distance.glsl - signed distance to the surface of a collision mesh, interpolated
// between the nodes of its grid, and the unit gradient. Positions are in the mesh's own space.
// Outside the grid the distance continues from the point where the grid ends.
// lib/collide/distance.c has the same function for the CPU. NODE(i) is the i-th node of all
// collision meshes.
//
// The distances of a body, which deforms, are followed by the displacement of the nearest surface
// since its last shape: three numbers per node.
struct mesh_grid {
    vec4  place; // xyz: first node, m. w: spacing of nodes, m.
    uvec3 size;  // Nodes along x, y and z.
    uint  first; // Index of the first node.
};

float mesh_distance(mesh_grid mesh, vec3 p, out vec3 gradient)
{
    uvec3 size   = mesh.size;
    vec3  last   = vec3(size - 1u);
    vec3  at     = (p - mesh.place.xyz) / mesh.place.w, within = clamp(at, vec3(0.0), last);
    uvec3 corner = min(uvec3(within), size - 2u);
    vec3  t      = within - vec3(corner);
    uint i = mesh.first + corner.x + size.x * (corner.y + size.y * corner.z), row = size.x,
         layer = size.x * size.y;
    vec4  near   = vec4(NODE(i), NODE(i + 1u), NODE(i + row), NODE(i + row + 1u));
    vec4 far = vec4(NODE(i + layer), NODE(i + layer + 1u), NODE(i + layer + row), NODE(i + layer + row + 1u));
    vec4  flat_  = mix(near, far, t.z), steps = far - near;
    vec2  line   = mix(flat_.xy, flat_.zw, t.y), rise = flat_.zw - flat_.xy;
    float value  = mix(line.x, line.y, t.x);
    vec3 slope = vec3(line.y - line.x, mix(rise.x, rise.y, t.x),
                      mix(mix(steps.x, steps.y, t.x), mix(steps.z, steps.w, t.x), t.y));
    gradient     = direction_or(slope, vec3(0.0, 1.0, 0.0));
    bool inside  = at == within;
    vec3 away    = mesh.place.w * (at - within) + value * gradient;
    gradient     = inside ? gradient : direction_or(away, gradient);
    return inside ? value : length(away);
}

#ifdef HAIR_DEFORMING
vec3 motion_at(uint i) { return vec3(NODE(i), NODE(i + 1u), NODE(i + 2u)); }

// Return the displacement of the surface of a body near p, m.
vec3 mesh_motion(mesh_grid mesh, vec3 p)
{
    uvec3 size   = mesh.size;
    vec3  within = clamp((p - mesh.place.xyz) / mesh.place.w, vec3(0.0), vec3(size - 1u));
    uvec3 corner = min(uvec3(within), size - 2u);
    vec3  t      = within - vec3(corner);
    uint  row = 3u * size.x, layer = row * size.y;
    uint  own = corner.x + size.x * (corner.y + size.y * corner.z);
    uint  i = mesh.first + size.x * size.y * size.z + 3u * own, k = i + layer;
    vec3 a = mix(motion_at(i), motion_at(i + 3u), t.x);
    vec3 b = mix(motion_at(i + row), motion_at(i + row + 3u), t.x);
    vec3 c = mix(motion_at(k), motion_at(k + 3u), t.x);
    vec3 d = mix(motion_at(k + row), motion_at(k + row + 3u), t.x);
    return mix(mix(a, b, t.y), mix(c, d, t.y), t.z);
}
#endif
