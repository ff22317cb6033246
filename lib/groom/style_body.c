// style_body.c - the bust of the built-in haircuts, as a smooth union of ellipsoids and capsules.
// Based on Quilez, "Distance functions" and "Smooth minimum". The proportions are those of an adult
// head, 0.23 m high.
#include "lib/groom/style_body.h"

struct ellipsoid {
    hair_vec3 center, axes;
};

struct capsule {
    hair_vec3 a, b;
    float radius;
};

static const struct ellipsoid head_sphere = {{0, HAIR_SKULL_HEIGHT, 0},
                                             {HAIR_SKULL_X, HAIR_SKULL_Y, HAIR_SKULL_Z}};
static const struct ellipsoid cheeks = {{0, 1.580f, 0.038f}, {0.060f, 0.063f, 0.053f}};
static const struct ellipsoid jaw = {{0, 1.549f, 0.044f}, {0.046f, 0.040f, 0.046f}};
static const struct ellipsoid chest = {{0, 1.270f, -0.015f}, {0.165f, 0.152f, 0.101f}};
// In front of the face.
static const struct ellipsoid room = {{0, 1.565f, 0.085f}, {0.055f, 0.130f, 0.060f}};

// Parts of the left side. The bust is symmetric, so they are evaluated at |x|.
static const struct ellipsoid breast = {{0.062f, 1.330f, 0.045f}, {0.082f, 0.077f, 0.038f}};
static const struct ellipsoid blade = {{0.055f, 1.345f, -0.062f}, {0.087f, 0.087f, 0.039f}};
static const struct capsule neck = {{0, 1.380f, -0.030f}, {0, 1.550f, -0.004f}, 0.048f};
static const struct capsule shoulder = {{0.030f, 1.434f, -0.032f}, {0.158f, 1.370f, -0.025f}, 0.044f};
static const struct capsule arm = {{0.162f, 1.362f, -0.025f}, {0.182f, 1.200f, -0.020f}, 0.043f};

// Return the distance to first order, |p/a| (|p/a| - 1) / |p/a^2| with semi-axes a. It is exact on
// the surface.
static float ellipsoid_distance(const struct ellipsoid* e, hair_vec3 p)
{
    hair_vec3 q = hair_sub(p, e->center);
    hair_vec3 once = {q.x / e->axes.x, q.y / e->axes.y, q.z / e->axes.z};
    hair_vec3 twice = {once.x / e->axes.x, once.y / e->axes.y, once.z / e->axes.z};
    float k = hair_length(once);
    float slope = hair_length(twice);
    return slope > 1e-6f ? k * (k - 1) / slope : -fminf(e->axes.x, fminf(e->axes.y, e->axes.z));
}

static float capsule_distance(const struct capsule* c, hair_vec3 p)
{
    hair_vec3 axis = hair_sub(c->b, c->a);
    float t = hair_dot(hair_sub(p, c->a), axis) / hair_dot(axis, axis);
    return hair_distance(p, hair_lerp(c->a, c->b, fminf(fmaxf(t, 0), 1))) - c->radius;
}

// Return the smooth minimum of two distances, with a fillet of about k metres.
static float blend(float a, float b, float k)
{
    float h = fmaxf(k - fabsf(a - b), 0) / k;
    return fminf(a, b) - h * h * k * 0.25f;
}

hair_vec3 hair_skull_point(hair_vec3 unit)
{
    return (hair_vec3){HAIR_SKULL_X * unit.x, HAIR_SKULL_HEIGHT + HAIR_SKULL_Y * unit.y,
                       HAIR_SKULL_Z * unit.z};
}

hair_vec3 hair_skull_unit(hair_vec3 p)
{
    hair_vec3 q = {p.x / HAIR_SKULL_X, (p.y - HAIR_SKULL_HEIGHT) / HAIR_SKULL_Y, p.z / HAIR_SKULL_Z};
    return hair_normalize(q, hair_v3(0, 1, 0));
}

hair_vec3 hair_skull_normal(hair_vec3 p)
{
    hair_vec3 u = hair_skull_unit(p);
    return hair_normalize(hair_v3(u.x / HAIR_SKULL_X, u.y / HAIR_SKULL_Y, u.z / HAIR_SKULL_Z), u);
}

static float face_distance(const hair_vec3* m)
{
    return blend(ellipsoid_distance(&cheeks, *m), ellipsoid_distance(&jaw, *m), 0.024f);
}

float hair_body_distance(hair_vec3 p)
{
    hair_vec3 m = {fabsf(p.x), p.y, p.z};
    // The other parts are far below.
    if (p.y > 1.62f) return fminf(face_distance(&m), ellipsoid_distance(&head_sphere, m));
    float d = ellipsoid_distance(&chest, m);
    d = blend(d, capsule_distance(&arm, m), 0.05f);
    d = blend(d, capsule_distance(&shoulder, m), 0.06f);
    d = blend(d, ellipsoid_distance(&breast, m), 0.07f);
    d = blend(d, ellipsoid_distance(&blade, m), 0.04f);
    d = blend(d, capsule_distance(&neck, m), 0.05f);
    if (p.y < 1.42f) return d; // The head is far above.
    d = blend(d, face_distance(&m), 0.016f);
    // Without a fillet, roots stay on the surface.
    return fminf(d, ellipsoid_distance(&head_sphere, m));
}

static hair_vec3 gradient(float (*distance)(hair_vec3), hair_vec3 p)
{
    // Sample the four corners of a tetrahedron (Quilez).
    const float h = 5e-4f;
    float a = distance(hair_v3(p.x + h, p.y - h, p.z - h)), b = distance(hair_v3(p.x - h, p.y - h, p.z + h));
    float c = distance(hair_v3(p.x - h, p.y + h, p.z - h)), d = distance(hair_v3(p.x + h, p.y + h, p.z + h));
    return hair_normalize(hair_v3(a - b - c + d, c + d - a - b, b + d - a - c), hair_v3(0, 1, 0));
}

hair_vec3 hair_body_normal(hair_vec3 p)
{
    return gradient(hair_body_distance, p);
}

float hair_face_distance(hair_vec3 p)
{
    return ellipsoid_distance(&room, p);
}

hair_vec3 hair_face_normal(hair_vec3 p)
{
    return gradient(hair_face_distance, p);
}
