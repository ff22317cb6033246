// math.h - vectors, unit quaternions (xyzw) and column-major matrices as values, all inline.
#ifndef HAIR_BASE_MATH_H
#define HAIR_BASE_MATH_H

#include <math.h>
#include <stdint.h>

#include "lib/base/assert.h"

typedef struct hair_vec3 {
    float x, y, z;
} hair_vec3;

typedef struct hair_quat {
    float x, y, z, w;
} hair_quat;

static inline hair_vec3 hair_v3(float x, float y, float z)
{
    return (hair_vec3){x, y, z};
}
static inline hair_vec3 hair_load3(const float* p)
{
    return (hair_vec3){p[0], p[1], p[2]};
}
static inline void hair_store3(float* p, hair_vec3 a)
{
    p[0] = a.x, p[1] = a.y, p[2] = a.z;
}
static inline hair_vec3 hair_add(hair_vec3 a, hair_vec3 b)
{
    return (hair_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline hair_vec3 hair_sub(hair_vec3 a, hair_vec3 b)
{
    return (hair_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline hair_vec3 hair_scale(hair_vec3 a, float s)
{
    return (hair_vec3){a.x * s, a.y * s, a.z * s};
}
static inline float hair_dot(hair_vec3 a, hair_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline float hair_length(hair_vec3 a)
{
    return sqrtf(hair_dot(a, a));
}
static inline float hair_distance(hair_vec3 a, hair_vec3 b)
{
    return hair_length(hair_sub(a, b));
}

static inline hair_vec3 hair_lerp(hair_vec3 a, hair_vec3 b, float t)
{
    return hair_add(a, hair_scale(hair_sub(b, a), t));
}

static inline hair_vec3 hair_cross(hair_vec3 a, hair_vec3 b)
{
    return (hair_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Return whether a has the length 1, within 1e-3.
static inline int hair_is_unit(hair_vec3 a)
{
    return fabsf(hair_dot(a, a) - 1) < 2e-3f;
}

// Return whether q is a rotation, within 1e-3.
static inline int hair_quat_is_unit(hair_quat q)
{
    return fabsf(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 2e-3f;
}

// Return the unit vector of a, or `fallback` if a has no direction.
static inline hair_vec3 hair_normalize(hair_vec3 a, hair_vec3 fallback)
{
    float l = hair_length(a);
    return l > 1e-20f ? hair_scale(a, 1 / l) : fallback;
}

// Return any unit vector perpendicular to the unit vector a (Duff et al. 2017, "Building an
// Orthonormal Basis, Revisited").
static inline hair_vec3 hair_perpendicular(hair_vec3 a)
{
    HAIR_ASSERT(hair_is_unit(a));
    float sign = a.z >= 0 ? 1.0f : -1.0f;
    float b = -1 / (sign + a.z);
    return (hair_vec3){1 + sign * a.x * a.x * b, sign * a.x * a.y * b, -sign * a.x};
}

static inline hair_quat hair_quat_multiply(hair_quat a, hair_quat b)
{
    return (hair_quat){
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

static inline hair_quat hair_quat_conjugate(hair_quat q)
{
    return (hair_quat){-q.x, -q.y, -q.z, q.w};
}

static inline hair_quat hair_quat_normalize(hair_quat q)
{
    float l = sqrtf(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return l > 1e-20f ? (hair_quat){q.x / l, q.y / l, q.z / l, q.w / l} : (hair_quat){0, 0, 0, 1};
}

static inline hair_vec3 hair_rotate(hair_quat q, hair_vec3 v)
{
    hair_vec3 u = {q.x, q.y, q.z};
    hair_vec3 t = hair_scale(hair_cross(u, v), 2);
    return hair_add(v, hair_add(hair_scale(t, q.w), hair_cross(u, t)));
}

// Return the smallest rotation that turns unit a into unit b. For opposite vectors it is half a
// turn about any perpendicular axis.
static inline hair_quat hair_quat_between(hair_vec3 a, hair_vec3 b)
{
    float w = 1 + hair_dot(a, b);
    if (w < 1e-6f) {
        hair_vec3 p = hair_perpendicular(a);
        return (hair_quat){p.x, p.y, p.z, 0};
    }
    hair_vec3 c = hair_cross(a, b);
    return hair_quat_normalize((hair_quat){c.x, c.y, c.z, w});
}

// Interpolate along the shortest arc from a (t = 0) to b (t = 1).
static inline hair_quat hair_slerp(hair_quat a, hair_quat b, float t)
{
    float d = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    float s = d < 0 ? -1.0f : 1.0f;
    d *= s;
    float u = 1 - t, v = t;
    if (d < 0.9995f) { // The sine of smaller angles loses digits that the chord keeps.
        float angle = acosf(d);
        u = sinf(u * angle) / sinf(angle);
        v = sinf(v * angle) / sinf(angle);
    }
    v *= s;
    return hair_quat_normalize(
        (hair_quat){u * a.x + v * b.x, u * a.y + v * b.y, u * a.z + v * b.z, u * a.w + v * b.w});
}

// Return the rotation whose columns are the unit vectors x, y, z (Shepperd 1978: divide by the
// largest component).
static inline hair_quat hair_quat_from_axes(hair_vec3 x, hair_vec3 y, hair_vec3 z)
{
    float trace = x.x + y.y + z.z;
    hair_quat q;
    if (trace > 0)
        q = (hair_quat){y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
    else if (x.x >= y.y && x.x >= z.z)
        q = (hair_quat){1 + x.x - y.y - z.z, x.y + y.x, x.z + z.x, y.z - z.y};
    else if (y.y >= z.z)
        q = (hair_quat){x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y, z.x - x.z};
    else
        q = (hair_quat){x.z + z.x, y.z + z.y, 1 - x.x - y.y + z.z, x.y - y.x};
    return hair_quat_normalize(q);
}

// Compute c = a b. c must not overlap a or b.
static inline void hair_mat4_multiply(const float a[16], const float b[16], float c[16])
{
    HAIR_ASSERT(c != a && c != b);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            c[4 * j + i] = a[i] * b[4 * j] + a[4 + i] * b[4 * j + 1] + a[8 + i] * b[4 * j + 2] +
                           a[12 + i] * b[4 * j + 3];
}

// Return a 32-bit hash that C and GLSL share (glsl/random.glsl): the PCG output of Jarzynski and
// Olano 2020.
static inline uint32_t hair_hash(uint32_t x)
{
    uint32_t state = x * 747796405u + 2891336453u;
    uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// Return a uniform random number in [0, 1) and advance `seed`.
static inline float hair_random(uint32_t* seed)
{
    *seed = hair_hash(*seed + 0x9e3779b9u);
    return (float)(*seed >> 8) * (1.0f / 16777216.0f);
}

#endif
