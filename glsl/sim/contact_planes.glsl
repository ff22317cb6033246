// contact_planes.glsl - planes by which solids hold a vertex of the mixed scheme, two at most.
#define PARALLEL 0.98 // Cosine of the angle between planes that count as one

struct outcome {
    vec3  d;            // displacement out of the solids
    vec4  plane, other; // normal of each, or 0, and the displacement along it on the plane
    vec3  surface;      // displacement of the surface that was left last
    float friction;     // of that surface
};

outcome untouched(vec3 want) { return outcome(want, vec4(0.0), vec4(0.0), vec3(0.0), 0.0); }

// Push a displacement out of one solid by the depth. The planes are those of the last two solids that face
// different ways.
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
