// contact_planes.glsl - the planes by which colliders hold a vertex of the mixed scheme, two at
// most.
// Minimum cosine of the angle between planes that count as one.
#define PARALLEL 0.98
#define NEAR_PLANE 0.25 // Distance from a collider up to which its plane is kept, in segments

struct outcome {
    vec3  d;            // displacement out of the colliders
    // Planes that hold the vertex. xyz: unit normal, or 0. w: displacement along it on the plane.
    vec4  plane, other;
    vec3  surface;      // displacement of the surface of the last collider left
    float friction;     // factor of friction of this surface
};

#ifdef HAIR_IMPULSES
// Colliders of `plane` and `other`, and of the last collider left, from 1.
vec3 plane_pressers;
#endif

outcome untouched(vec3 want) { return outcome(want, vec4(0.0), vec4(0.0), vec3(0.0), 0.0); }

// Return the distance from a collider up to which its plane is kept, m.
float near_distance() { return NEAR_PLANE * segment_length(); }

// Return whether a plane holds a vertex above a collider back if a Newton step moves it.
bool is_near(float depth) { return depth > -near_distance(); }

// Push a displacement out of one collider by the depth. `plane` and `other` become the planes of
// the last two colliders whose normals differ. A collider above which the vertex is takes the place
// of no other.
void push_by(float factor, float depth, vec3 normal, vec3 surface, inout outcome made)
{
    bool is_first = made.plane.xyz == vec3(0.0);
    if (depth <= 0.0 && made.other.xyz != vec3(0.0)) return;
    vec4 found = vec4(normal, dot(normal, made.d) + depth);
    made.d += max(depth, 0.0) * normal;
    bool moves = made.other.xyz != vec3(0.0) && dot(normal, made.other.xyz) <= PARALLEL;
    if (is_first || dot(normal, made.plane.xyz) > PARALLEL) {
        // The plane may be below that of a collider which the vertex touches.
        if (depth <= 0.0 && found.w < made.plane.w && !is_first) return;
        made.plane = found;
#ifdef HAIR_IMPULSES
        plane_pressers.x = presser;
#endif
    } else {
        if (moves) made.plane = made.other;
        made.other = found;
#ifdef HAIR_IMPULSES
        plane_pressers.xy = vec2(moves ? plane_pressers.y : plane_pressers.x, presser);
#endif
    }
    if (depth <= 0.0 && !is_first) return;
#ifdef HAIR_IMPULSES
    plane_pressers.z = presser;
#endif
    made.surface  = surface;
    made.friction = params.friction * factor;
}
