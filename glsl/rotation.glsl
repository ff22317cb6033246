// rotation.glsl - unit quaternions, xyzw.
#ifndef HAIR_ROTATION_GLSL
#define HAIR_ROTATION_GLSL

vec4 quat_conjugate(vec4 q) { return vec4(-q.xyz, q.w); }

vec4 quat_multiply(vec4 a, vec4 b)
{
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

vec3 rotate(vec4 q, vec3 v)
{
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

// Return the direction of a segment, which is the y axis of its frame.
vec3 along_of(vec4 q) { return rotate(q, vec3(0.0, 1.0, 0.0)); }

// Return the smallest rotation that turns unit vector a into unit vector b. For opposite vectors it
// is half a turn about any perpendicular.
vec4 quat_between(vec3 a, vec3 b)
{
    float w = 1.0 + dot(a, b);
    if (w < 1e-6) {
        vec3 p = abs(a.x) < 0.7 ? vec3(0.0, a.z, -a.y) : vec3(a.y, -a.x, 0.0);
        return vec4(normalize(p), 0.0);
    }
    return normalize(vec4(cross(a, b), w));
}

vec3 direction_or(vec3 v, vec3 fallback)
{
    float l = length(v);
    return l > 1e-12 ? v / l : fallback;
}

#endif
