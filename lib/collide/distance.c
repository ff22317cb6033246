// distance.c - the exact signed distance to colliders. glsl/collide/collider_distance.glsl is the
// GPU version.
#include "lib/collide/distance.h"

#include <math.h>

#define ELLIPSOID_STEPS 24
#define ELLIPSOID_FLATTEST (1.0 / 256) // Shortest half axis, as a fraction of the longest.
#define ELLIPSOID_MIN_SIZE 1e-9 // Minimum of the longest half axis, m.

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double min, double max)
{
    return fmin(fmax(value, min), max);
}

// Compute v / |v|, or `otherwise` if v has no direction. Return |v|.
static double direction(const double v[3], const double otherwise[3], double out[3])
{
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; ++k) out[k] = length > 1e-30 ? v[k] / length : otherwise[k];
    return length;
}

static const double up[3] = {0, 1, 0};

static double to_capsule(double radius, double half, const double p[3], double gradient[3])
{
    const double out[3] = {p[0], p[1] - clamp(p[1], -half, half), p[2]};
    const double away[3] = {1, 0, 0};
    return direction(out, half > 0 ? away : up, gradient) - radius;
}

static double to_box(const float size[3], const double p[3], double gradient[3])
{
    double out[3], q[3], deepest = -INFINITY;
    int face = 0;
    for (int k = 0; k < 3; ++k) {
        q[k] = fabs(p[k]) - (double)size[k];
        out[k] = copysign(fmax(q[k], 0), p[k]);
        if (q[k] > deepest) deepest = q[k], face = k;
    }
    const double inside[3] = {face == 0 ? copysign(1, p[0]) : 0, face == 1 ? copysign(1, p[1]) : 0,
                              face == 2 ? copysign(1, p[2]) : 0};
    return direction(out, inside, gradient) + fmin(deepest, 0);
}

// Nearest point of a profile so far. A collider of revolution about the y axis is described by its
// profile, a polygon in the half-plane of (distance from the axis, height).
struct profile {
    double distance, out[2]; // `out` is the vector from the nearest point of the profile.
};

static void edge(const double p[2], const double a[2], const double b[2], struct profile* nearest)
{
    double d[2] = {b[0] - a[0], b[1] - a[1]};
    double length = d[0] * d[0] + d[1] * d[1];
    double t = length > 0 ? clamp(((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / length, 0, 1) : 0;
    double out[2] = {p[0] - a[0] - t * d[0], p[1] - a[1] - t * d[1]};
    double far = sqrt(out[0] * out[0] + out[1] * out[1]);
    if (far < nearest->distance) *nearest = (struct profile){far, {out[0], out[1]}};
}

// Return the signed distance to a collider of revolution. `flank` is the normal of its side, for
// points on the surface.
static double revolve(struct profile nearest, int inside, const double flank[2], const double p[3],
                      double gradient[3])
{
    HAIR_ASSERT(nearest.distance < INFINITY);
    double around = sqrt(p[0] * p[0] + p[2] * p[2]), sign = inside ? -1 : 1;
    double n[2] = {flank[0], flank[1]};
    if (nearest.distance > 1e-15) {
        n[0] = sign * nearest.out[0] / nearest.distance;
        n[1] = sign * nearest.out[1] / nearest.distance;
    }
    gradient[0] = around > 0 ? n[0] * p[0] / around : n[0];
    gradient[1] = n[1];
    gradient[2] = around > 0 ? n[0] * p[2] / around : 0;
    return sign * nearest.distance;
}

static double to_cylinder(double radius, double half, const double p[3], double gradient[3])
{
    const double at[2] = {sqrt(p[0] * p[0] + p[2] * p[2]), p[1]}, flank[2] = {1, 0};
    const double profile[4][2] = {{0, -half}, {radius, -half}, {radius, half}, {0, half}};
    struct profile nearest = {INFINITY, {0, 0}};
    for (int k = 0; k < 3; ++k) edge(at, profile[k], profile[k + 1], &nearest);
    return revolve(nearest, at[0] < radius && fabs(at[1]) < half, flank, p, gradient);
}

static double to_cone(double radius, double half, const double p[3], double gradient[3])
{
    const double at[2] = {sqrt(p[0] * p[0] + p[2] * p[2]), p[1]};
    const double slant = sqrt(radius * radius + 4 * half * half);
    const double flank[2] = {slant > 0 ? 2 * half / slant : 1, slant > 0 ? radius / slant : 0};
    const double profile[3][2] = {{0, -half}, {radius, -half}, {0, half}};
    struct profile nearest = {INFINITY, {0, 0}};
    for (int k = 0; k < 2; ++k) edge(at, profile[k], profile[k + 1], &nearest);
    int inside = at[1] > -half && at[0] * flank[0] + (at[1] - half) * flank[1] < 0;
    return revolve(nearest, inside, flank, p, gradient);
}

// Return the signed distance to an ellipsoid with the half axes r. The nearest point of the surface
// is r^2 p / reach, where reach is s + r^2 - min(r)^2 for each axis, with the greatest s at which
// the point is on the surface. Newton's method for the reciprocal of the norm of r p / reach
// approaches s from below without passing it (More and Sorensen 1983).
static double to_ellipsoid(const float size[3], const double p[3], double gradient[3])
{
    double longest = fmax(fmax((double)size[0], (double)size[1]), fmax((double)size[2], ELLIPSOID_MIN_SIZE));
    double r[3], at[3], beyond[3], normal[3], shortest = 1, s = 0, away = 0;
    for (int k = 0; k < 3; ++k) {
        r[k] = fmax((double)size[k] / longest, ELLIPSOID_FLATTEST);
        at[k] = fmax(fabs(p[k]) / longest, 1e-12 * r[k]); // Off the planes of symmetry.
        shortest = fmin(shortest, r[k]);
    }
    for (int k = 0; k < 3; ++k) {
        beyond[k] = (r[k] - shortest) * (r[k] + shortest);
        s = fmax(s, r[k] * at[k] - beyond[k]);
    }
    for (int i = 0; i < ELLIPSOID_STEPS; ++i) {
        double square = 0, slope = 0;
        for (int k = 0; k < 3; ++k) {
            double q = r[k] * at[k] / (s + beyond[k]);
            square += q * q, slope += q * q / (s + beyond[k]);
        }
        s += square * (sqrt(square) - 1) / slope;
    }
    for (int k = 0; k < 3; ++k) normal[k] = copysign(at[k] / (s + beyond[k]), p[k]);
    direction(normal, up, gradient);
    for (int k = 0; k < 3; ++k) away += fabs(gradient[k]) * at[k] * (1 - r[k] * r[k] / (s + beyond[k]));
    return longest * away;
}

double hair_distance_to_shape(hair_shape shape, const float size[3], const double point[3],
                              double gradient[3])
{
    double own[3];
    double* out = gradient ? gradient : own;
    double a = (double)size[0], b = (double)size[1];
    switch (shape) {
    case HAIR_SHAPE_SPHERE: return to_capsule(a, 0, point, out);
    case HAIR_SHAPE_CAPSULE: return to_capsule(a, b, point, out);
    case HAIR_SHAPE_BOX: return to_box(size, point, out);
    case HAIR_SHAPE_CYLINDER: return to_cylinder(a, b, point, out);
    case HAIR_SHAPE_CONE: return to_cone(a, b, point, out);
    case HAIR_SHAPE_ELLIPSOID: return to_ellipsoid(size, point, out);
    default: out[0] = 0, out[1] = 1, out[2] = 0; return point[1]; // a plane
    }
}

// Forms -------------------------------------------------------------------------------------------

// Interpolate the distances within the grid. `slope` receives the gradient per voxel.
static double interpolate(const hair_collision_mesh* mesh, const double at[3], double slope[3])
{
    size_t node = 0, step[3] = {1, mesh->size[0], (size_t)mesh->size[0] * mesh->size[1]};
    double t[3];
    for (int k = 0; k < 3; ++k) {
        HAIR_ASSERT(mesh->size[k] >= 2);
        double x = (at[k] - (double)mesh->origin[k]) / (double)mesh->voxel;
        double i = clamp(floor(x), 0, mesh->size[k] - 2);
        t[k] = clamp(x - i, 0, 1);
        node += (size_t)i * step[k];
    }
    double value = 0;
    slope[0] = slope[1] = slope[2] = 0;
    for (int corner = 0; corner < 8; ++corner) {
        int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        double u = x ? t[0] : 1 - t[0], v = y ? t[1] : 1 - t[1], w = z ? t[2] : 1 - t[2];
        double d = (double)mesh->distance[node + (size_t)x + (size_t)y * step[1] + (size_t)z * step[2]];
        value += u * v * w * d;
        slope[0] += (x ? 1 : -1) * v * w * d;
        slope[1] += (y ? 1 : -1) * u * w * d;
        slope[2] += (z ? 1 : -1) * u * v * d;
    }
    return value;
}

double hair_distance_to_mesh(const hair_collision_mesh* mesh, const double point[3], double gradient[3])
{
    HAIR_ASSERT(mesh && mesh->distance && mesh->voxel > 0);
    double own[3], inside[3], slope[3], beyond = 0;
    double* out = gradient ? gradient : own;
    for (int k = 0; k < 3; ++k) {
        double first = (double)mesh->origin[k], last = first + (double)mesh->voxel * (mesh->size[k] - 1);
        inside[k] = clamp(point[k], first, last);
        beyond += (point[k] - inside[k]) * (point[k] - inside[k]);
    }
    double distance = interpolate(mesh, inside, slope);
    direction(slope, up, out);
    if (beyond == 0) return distance;
    double away[3];
    for (int k = 0; k < 3; ++k) away[k] = point[k] - inside[k] + distance * out[k];
    return direction(away, up, out);
}

// In the world ------------------------------------------------------------------------------------

// Rotate v by the quaternion q, or by its inverse if `sign` is -1. q is normalised first.
static void rotate(const float q[4], double sign, const double v[3], double out[3])
{
    double norm = 0, u[3];
    for (int k = 0; k < 4; ++k) norm += (double)q[k] * (double)q[k];
    HAIR_ASSERT(norm > 0);
    for (int k = 0; k < 3; ++k) u[k] = sign * (double)q[k] / sqrt(norm);
    double w = (double)q[3] / sqrt(norm);
    double t[3] = {2 * (u[1] * v[2] - u[2] * v[1]), 2 * (u[2] * v[0] - u[0] * v[2]),
                   2 * (u[0] * v[1] - u[1] * v[0])};
    double r[3] = {v[0] + w * t[0] + u[1] * t[2] - u[2] * t[1], v[1] + w * t[1] + u[2] * t[0] - u[0] * t[2],
                   v[2] + w * t[2] + u[0] * t[1] - u[1] * t[0]};
    for (int k = 0; k < 3; ++k) out[k] = r[k];
}

double hair_distance_to_collider(const hair_collider* collider, const double point[3], double gradient[3])
{
    double local[3], normal[3], distance, scale = (double)collider->scale;
    for (int k = 0; k < 3; ++k) local[k] = point[k] - (double)collider->position[k];
    rotate(collider->rotation, -1, local, local);
    if (collider->shape != HAIR_SHAPE_MESH) {
        distance = hair_distance_to_shape(collider->shape, collider->size, local, normal);
    } else if (collider->mesh) {
        for (int k = 0; k < 3; ++k) local[k] /= scale;
        distance = scale * hair_distance_to_mesh(collider->mesh, local, normal);
    } else {
        for (int k = 0; k < 3; ++k) normal[k] = up[k];
        distance = INFINITY;
    }
    if (gradient) rotate(collider->rotation, 1, normal, gradient);
    return distance - (double)collider->rounding;
}
