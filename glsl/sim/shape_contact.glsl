// shape_contact.glsl - colliders that are not capsules. Compute the depth of a vertex by the exact
// distance to the shape.
#include "collide/collider_distance.glsl"

#define BODY_STEPS 10u // Maximum number of distance evaluations: at both ends, and on the way
#define BODY_NEAR 1e-4 // Distance at which a vertex counts as on the surface, m

vec4 body_turn(uint k, float fraction)
{
    return normalize(mix(BODY_ROTATION(k, 0), BODY_ROTATION(k, 1), fraction));
}

vec3 body_place(uint k, float fraction)
{
    return mix(BODY_POSITION(k, 0).xyz, BODY_POSITION(k, 1).xyz, fraction);
}

#ifdef HAIR_MESHES
#include "collide/mesh_distance.glsl"
#define SHAPE_MESH 6u // Value of hair_shape for a collision mesh

mesh_grid mesh_of(uint k)
{
    uvec4 nodes = MESH_NODES(k);
    return mesh_grid(MESH_GRID(k), nodes.xyz, nodes.w);
}
#else
#define mesh_grid uint // There are no collision meshes.
#define mesh_of(k) 0u
#endif

// Return the distance to the surface without rounding, in the collider's own space.
float body_distance(vec4 size, mesh_grid mesh, vec3 at, out vec3 gradient)
{
    float distance;
#ifdef HAIR_MESHES
    if (uint(size.w) == SHAPE_MESH)
        distance = size.x * mesh_distance(mesh, at / size.x, gradient);
    else
#endif
        distance = shape_distance(uint(size.w), size.xyz, at, gradient);
    return distance;
}

// Return the displacement of the surface near a place over the step by the deformation of a body,
// in the collider's own space.
vec3 body_motion(vec4 size, mesh_grid mesh, vec3 at)
{
#ifdef HAIR_DEFORMING
    if (uint(size.w) == SHAPE_MESH && size.y > 0.0) return size.x * mesh_motion(mesh, at / size.x);
#endif
    return vec3(0.0);
}

float depth_of_place(uint k, vec3 place)
{
    vec3 gradient,
        at = rotate(quat_conjugate(body_turn(k, fraction_now)), place - body_place(k, fraction_now));
    vec4 size = BODY_SIZE(k);
    at += (1.0 - fraction_now) * body_motion(size, mesh_of(k), at);
    return BODY_POSITION(k, 0).w + params.collision_margin - body_distance(size, mesh_of(k), at, gradient);
}

// Return the depth as depth_in() does, for a vertex that moves from `start` to `end`. If the vertex
// may have passed through the collider, sphere tracing in the collider's own space finds the entry.
// Each step of the tracing is as long as the distance to the surface. The vertex stops at the
// entry. A body that deforms has its shape at the end of the step. Earlier, a vertex is as far from
// the surface as it is from this shape after it has moved along with the surface.
float depth_in_body(uint k, vec3 start, vec3 end, vec3 head_moved, vec2 granted, out vec3 normal,
                    out vec3 surface)
{
    vec4  turn_then = body_turn(k, fraction_then), turn_after = body_turn(k, fraction_now);
    vec3  place_then = body_place(k, fraction_then), place_after = body_place(k, fraction_now);
    vec3  a = rotate(quat_conjugate(turn_then), start - place_then);
    vec3  b = rotate(quat_conjugate(turn_after), end - place_after), outwards = vec3(0.0, 1.0, 0.0);
    vec4  size = BODY_SIZE(k);
    mesh_grid mesh = mesh_of(k);
    vec3  moved = body_motion(size, mesh, b), moved_then = (1.0 - fraction_then) * moved,
         moved_now = (1.0 - fraction_now) * moved;
    a += moved_then;
    b += moved_now;
    float around = BODY_POSITION(k, 0).w + params.collision_margin, way = length(b - a), t = 1.0, depth = 0.0,
          was = 0.0;
    for (uint i = 0u; i < BODY_STEPS && t <= 1.0; ++i) {
        vec3  gradient, at = mix(a, b, t);
        float distance = body_distance(size, mesh, at, gradient) - around;
        if (i == 0u) {
            depth    = -distance;
            outwards = gradient;
            t        = distance > way + BODY_NEAR ? 2.0 : 0.0; // The way is too short for contact.
        } else if (i == 1u) {
            // A vertex leaves through the side it came from, also from beyond the middle of a thin
            // shape.
            float same  = dot(gradient, outwards);
            bool  holds = distance <= BODY_NEAR && (depth > 0.0 ? same <= 0.5 : same < -0.5);
            was         = -distance;
            depth       = holds ? dot(gradient, at - distance * gradient - b) : depth;
            outwards    = holds ? gradient : outwards;
            t           = same > 0.5 || distance <= BODY_NEAR || distance >= way ? 2.0 : distance / way;
        } else if (distance > BODY_NEAR) {
            t += distance / way;
        } else {
            depth    = dot(gradient, at - b);
            outwards = gradient;
            t        = 2.0;
        }
    }
    vec3 touched = b + depth * outwards;
    normal       = rotate(turn_after, outwards);
    surface      = head_moved + place_after - place_then + rotate(turn_after, touched - moved_now) -
              rotate(turn_then, touched - moved_then);
    return depth - max(was - granted.y, granted.x);
}
