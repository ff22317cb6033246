// sample.glsl - one component of the velocity at any position in the box, linear between faces.
#include "wind/fluid.glsl"

// The lowest of the eight faces around a position, and the fractions beyond it.
struct face_stencil {
    ivec3 face;
    vec3  part;
};

face_stencil stencil_at(int axis, vec3 place)
{
    ivec3      along = axis_of(axis);
    vec3       from  = clamp(place - 0.5 * vec3(1 - along), vec3(0.0), vec3(int(fluid.cells) - 1 + along));
    face_stencil stencil;
    stencil.face = min(ivec3(from), int(fluid.cells) - 2 + along);
    stencil.part = from - vec3(stencil.face);
    return stencil;
}

// Fetch the velocities of the eight faces in the order of their indices.
void fetch_faces(samplerBuffer from, int axis, face_stencil stencil, out vec4 near, out vec4 far)
{
    int at = face_of(axis, stencil.face), y = int(fluid.cells) + 1, z = y * y;
    near = vec4(texelFetch(from, at).x, texelFetch(from, at + 1).x, texelFetch(from, at + y).x,
                texelFetch(from, at + y + 1).x);
    at += z;
    far = vec4(texelFetch(from, at).x, texelFetch(from, at + 1).x, texelFetch(from, at + y).x,
               texelFetch(from, at + y + 1).x);
}

float between(vec4 near, vec4 far, vec3 part)
{
    vec4 z = mix(near, far, part.z);
    vec2 y = mix(z.xy, z.zw, part.y);
    return mix(y.x, y.y, part.x);
}

bool is_in_box(vec3 place) { return all(equal(place, clamp(place, vec3(0.0), vec3(fluid.cells)))); }
