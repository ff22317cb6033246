// contact_planes.glsl - the planes by which colliders hold a vertex of the mixed scheme, two at
// most.
// Minimum cosine of the angle between planes that count as one.
#define PARALLEL 0.98

struct outcome {
    vec3  d;            // displacement out of the colliders
    // Planes that hold the vertex. xyz: unit normal, or 0. w: displacement along it on the plane.
    vec4  plane, other;
    vec3  surface;      // displacement of the surface of the last collider left
    float friction;     // factor of friction of this surface
};

outcome untouched(vec3 want) { return outcome(want, vec4(0.0), vec4(0.0), vec3(0.0), 0.0); }

// Push a displacement out of one collider by the depth. `plane` and `other` become the planes of
// the last two colliders whose normals differ.
void push_by(float factor, float depth, vec3 normal, vec3 surface, inout outcome made)
{
    made.d += depth * normal;
    vec4 found = vec4(normal, dot(normal, made.d));
    if (made.plane.xyz == vec3(0.0) || dot(normal, made.plane.xyz) > PARALLEL) {
        made.plane = found;
    } else {
        if (made.other.xyz != vec3(0.0) && dot(normal, made.other.xyz) <= PARALLEL) made.plane = made.other;
        made.other = found;
    }
    made.surface  = surface;
    made.friction = params.friction * factor;
}
