// head_eyes.c - Eyeballs, brows, lashes and fine hairs of the bust.
#include "tools/common/head_parts.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265f
#define IRIS 0.0058f // Radius of the iris, m.
#define PUPIL 0.0021f
#define COLUMNS 48u
#define IRIS_ROWS 20u
#define ROWS 34u

typedef struct head_point point;

// Eyeballs ----------------------------------------------------------------------------------------

static struct head_paint paint_eye(float radius, uint32_t column, point p)
{
    static const float white[3] = {0.50f, 0.455f, 0.42f}, corner[3] = {0.44f, 0.27f, 0.23f};
    static const float inner[3] = {0.115f, 0.060f, 0.028f}, outer[3] = {0.050f, 0.030f, 0.018f};
    uint32_t seed = 7919u * column;
    float fibre = 0.75f + 0.5f * head_random(&seed);
    float ring = head_smooth(IRIS * 0.80f, IRIS * 1.02f, radius),
          pupil = head_smooth(PUPIL * 1.12f, PUPIL, radius);
    float ball = head_smooth(IRIS * 0.95f, IRIS * 1.10f, radius);
    float across = fabsf(fabsf(p.x) - HEAD_EYE.x);
    float red = head_smooth(0.006f, 0.0125f, across);
    struct head_paint paint = {.gloss = 4};
    for (int i = 0; i < 3; ++i) {
        float iris = fibre * head_mix(inner[i], outer[i], head_smooth(PUPIL, IRIS, radius));
        iris = head_mix(head_mix(iris, 0.006f, 0.75f * ring), 0.002f, pupil);
        paint.color[i] = head_mix(iris, head_mix(white[i], corner[i], red), ball);
    }
    // The lids shade the eye from above and from the corners.
    paint.open = 0.75f * head_smooth(1.6155f, 1.6085f, p.y) * head_smooth(0.0165f, 0.008f, across) + 0.12f;
    return paint;
}

static void put_eye(struct head_builder* builder, float side)
{
    // Both eyes look ahead and slightly down.
    const point ahead = head_unit((point){0, -0.04f, 1}), up = {0, ahead.z, -ahead.y};
    const point centre = {side * HEAD_EYE.x, HEAD_EYE.y, HEAD_EYE.z};
    const float iris_angle = asinf(IRIS / HEAD_EYE_RADIUS);
    uint32_t first = builder->mesh.vertex_count;
    for (uint32_t row = 0; row <= ROWS; ++row) {
        float t = (float)row / IRIS_ROWS;
        float angle = row <= IRIS_ROWS
                          ? 1.15f * iris_angle * t
                          : 1.15f * iris_angle + 1.3f * (float)(row - IRIS_ROWS) / (ROWS - IRIS_ROWS);
        for (uint32_t column = 0; column < COLUMNS; ++column) {
            float turn = 2 * PI * (float)column / COLUMNS;
            point out = {sinf(angle) * cosf(turn), sinf(angle) * sinf(turn), cosf(angle)};
            point n = head_add(head_add((point){out.x, 0, 0}, up, out.y), ahead, out.z);
            // The cornea bulges.
            float inside = fmaxf(1 - angle / (1.15f * iris_angle), 0);
            float bulge = 0.0011f * inside * (2 - inside) * head_smooth(0, 0.5f, inside);
            point p = head_add(centre, n, HEAD_EYE_RADIUS - 0.0001f + bulge);
            point tilt = head_unit(head_add(n, ahead, -head_dot(n, ahead)));
            n = head_unit(head_add(n, tilt, 0.35f * inside * head_smooth(0, 0.3f, angle) * 2));
            struct head_paint paint = paint_eye(HEAD_EYE_RADIUS * sinf(angle), column, p);
            head_put_vertex(builder, p, n, &paint);
        }
    }
    for (uint32_t row = 0; row < ROWS; ++row)
        for (uint32_t column = 0; column < COLUMNS; ++column) {
            uint32_t a = first + row * COLUMNS + column, b = first + row * COLUMNS + (column + 1) % COLUMNS;
            head_put_triangle(builder, a, a + COLUMNS, b + COLUMNS);
            head_put_triangle(builder, a, b + COLUMNS, b);
        }
}

void head_put_eyes(struct head_builder* builder)
{
    put_eye(builder, 1);
    put_eye(builder, -1);
}

// Hairs -------------------------------------------------------------------------------------------

// The shader replaces the colour by one that follows the hair of the head.
static const struct head_paint small_hair = {{0.022f, 0.014f, 0.010f}, HEAD_KIND_HAIR, 0.35f, 0.8f};

// Add a thin cone from a root, which bends from one direction to another. It has `joints` cross
// sections.
static void put_hair(struct head_builder* builder, point root, point from, point to, float length,
                     float radius, uint32_t joints)
{
    uint32_t first = builder->mesh.vertex_count;
    point p = root;
    for (uint32_t i = 0; i < joints; ++i) {
        float t = (float)i / (float)(joints - 1);
        point way = head_unit(head_add(head_add((point){0, 0, 0}, from, 1 - t), to, t));
        point across = head_unit(head_cross(way, (point){0.3f, 0.2f, 0.93f}));
        point over = head_cross(across, way);
        for (uint32_t k = 0; k < 3; ++k) {
            float turn = 2 * PI * (float)k / 3;
            point n = head_add(head_add((point){0, 0, 0}, across, cosf(turn)), over, sinf(turn));
            head_put_vertex(builder, head_add(p, n, radius * (1 - 0.85f * t)), n, &small_hair);
        }
        p = head_add(p, way, length / (float)(joints - 1));
    }
    for (uint32_t i = 0; i + 1 < joints; ++i)
        for (uint32_t k = 0; k < 3; ++k) {
            uint32_t a = first + 3 * i + k, b = first + 3 * i + (k + 1) % 3;
            head_put_triangle(builder, a, b, b + 3);
            head_put_triangle(builder, a, b + 3, a + 3);
        }
}

// Move the triangles of the forehead to the front of a list. Return their number.
static uint32_t list_forehead(const struct head_mesh* mesh, uint32_t* list)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        const float* p = mesh->positions + 3 * mesh->triangles[3 * (size_t)i];
        if (p[2] > 0.05f && fabsf(p[1] - HEAD_EYE.y - 0.02f) < 0.014f && fabsf(p[0]) < 0.06f)
            list[count++] = i;
    }
    return count;
}

// Find the frontmost of these triangles over the point's x and y. Return false if there is none.
static bool find_front(const struct head_mesh* mesh, const uint32_t* list, uint32_t count, point* p,
                       point* normal)
{
    bool found = false;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t* corner = mesh->triangles + 3 * (size_t)list[i];
        const float *a = mesh->positions + 3 * corner[0], *b = mesh->positions + 3 * corner[1],
                    *c = mesh->positions + 3 * corner[2];
        float area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if (area < 1e-12f) continue;
        float u = ((p->x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (p->y - a[1])) / area;
        float v = ((b[0] - a[0]) * (p->y - a[1]) - (p->x - a[0]) * (b[1] - a[1])) / area;
        float z = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]);
        if (u < 0 || v < 0 || u + v > 1 || (found && z <= p->z)) continue;
        const float* n = mesh->normals + 3 * corner[0];
        p->z = z, *normal = (point){n[0], n[1], n[2]};
        found = true;
    }
    return found;
}

// Brow of the left side: x, height above the eye's centre, half the width and the hair's angle from
// outwards to upwards in degrees.
static const float brow[][4] = {{0.0110f, 0.0160f, 0.0036f, 78},  {0.0165f, 0.0176f, 0.0044f, 52},
                                {0.0260f, 0.0200f, 0.0040f, 30},  {0.0350f, 0.0216f, 0.0033f, 12},
                                {0.0430f, 0.0208f, 0.0022f, -14}, {0.0500f, 0.0172f, 0.0008f, -32}};

static void find_brow(float x, float row[4])
{
    int k = 0;
    while (k < 4 && brow[k + 1][0] < x) ++k;
    float t = (x - brow[k][0]) / (brow[k + 1][0] - brow[k][0]);
    for (int m = 0; m < 4; ++m) row[m] = head_mix(brow[k][m], brow[k + 1][m], t);
}

float head_brow(point p)
{
    float x = fabsf(p.x), row[4];
    if (p.z < 0.05f || x < 0.009f || x > 0.051f) return 0;
    find_brow(x, row);
    float across = fabsf(p.y - HEAD_EYE.y - row[1]) / fmaxf(row[2], 0.0008f);
    return head_smooth(1.25f, 0.5f, across) * head_smooth(0.010f, 0.017f, x);
}

static void put_brows(struct head_builder* builder, const uint32_t* list, uint32_t count)
{
    uint32_t seed = 5;
    for (uint32_t i = 0; i < 1100; ++i) {
        float side = i % 2 ? 1.0f : -1.0f, x = 0.0105f + 0.0395f * head_random(&seed), row[4];
        float up = 2 * head_random(&seed) - 1, turn = head_random(&seed), size = head_random(&seed);
        find_brow(x, row);
        point p = {side * x, HEAD_EYE.y + row[1] + up * row[2], 0}, n = {0, 0, 1};
        if (!find_front(&builder->mesh, list, count, &p, &n)) continue;
        // Hairs from above and from below meet along the middle of the brow.
        float angle = row[3] - 26 * up * head_smooth(0.012f, 0.022f, x) + 16 * (turn - 0.5f);
        angle *= PI / 180;
        point way = {side * cosf(angle), sinf(angle), 0};
        way = head_unit(head_add(way, n, -head_dot(way, n)));
        point lifted = head_unit(head_add(way, n, 0.35f)), lying = head_unit(head_add(way, n, -0.04f));
        float length = (0.0050f + 0.0035f * size) * head_mix(0.75f, 1, head_smooth(0.010f, 0.020f, x));
        put_hair(builder, head_add(p, n, -0.0002f), lifted, lying, length, 4.5e-5f, 5);
    }
}

void head_put_brows(struct head_builder* builder)
{
    uint32_t* list = malloc(((size_t)builder->mesh.triangle_count + 1) * sizeof *list);
    builder->failed |= !list;
    if (list) put_brows(builder, list, list_forehead(&builder->mesh, list));
    free(list);
}

// Add lashes along an edge of the left eye's lids, and the mirrored ones of the right eye.
static void put_lid(struct head_builder* builder, const float lid[HEAD_LID_POINTS][3], uint32_t hairs,
                    float lift, float length)
{
    uint32_t seed = hairs;
    for (uint32_t i = 0; i < 2 * hairs; ++i) {
        float side = i % 2 ? 1.0f : -1.0f,
              along = (float)(HEAD_LID_POINTS - 1) * ((float)(i / 2) + head_random(&seed)) / (float)hairs;
        uint32_t k = (uint32_t)along < HEAD_LID_POINTS - 2 ? (uint32_t)along : HEAD_LID_POINTS - 2;
        point a = {lid[k][0], lid[k][1], lid[k][2]}, b = {lid[k + 1][0], lid[k + 1][1], lid[k + 1][2]};
        point p = head_add(a, head_add(b, a, -1), along - (float)k);
        p = head_add(p, head_unit(head_add(p, HEAD_EYE, -1)), 0.0004f);
        float t = along / (float)(HEAD_LID_POINTS - 1), size = 0.7f + 0.3f * head_random(&seed),
              jitter = head_random(&seed) - 0.5f;
        point from = {0.75f * (t - 0.35f) + 0.3f * jitter, -0.25f * lift, 0.9f - 0.35f * t};
        point to = {1.1f * (t - 0.30f) + 0.5f * jitter, 1.3f * lift, 0.5f};
        p.x *= side, from.x *= side, to.x *= side;
        put_hair(builder, p, head_unit(from), head_unit(to), length * size * head_mix(0.65f, 1.1f, t),
                 5.5e-5f, 5);
    }
}

void head_put_lashes(struct head_builder* builder)
{
    put_lid(builder, head_lids[0], 110, 1, 0.0085f);
    put_lid(builder, head_lids[1], 55, -0.6f, 0.0045f);
}

// Hairline ----------------------------------------------------------------------------------------

// Return the number of fine hairs per square metre. It falls off over a centimetre before the
// hairline. There are none on the ears and few at the nape.
static float fringe_density(point p)
{
    float above = head_above_hairline(p), azimuth = fabsf(atan2f(p.x, p.z));
    float side = head_smooth(1.25f, 1.05f, azimuth) + 0.5f * head_smooth(2.0f, 2.3f, azimuth);
    return 6e5f * side * head_smooth(-0.013f, 0.001f, above) * head_smooth(0.005f, 0.003f, above);
}

static void put_fine_hair(struct head_builder* builder, point p, point n, uint32_t* seed)
{
    float side = p.x + 0.006f * (head_random(seed) - 0.5f) < 0 ? -1.0f : 1.0f, size = head_random(seed);
    point way = {side * (0.45f + 0.5f * head_random(seed)), p.z > 0 ? 0.15f : -0.8f,
                 -0.7f * head_random(seed)};
    way = head_unit(head_add(way, n, -head_dot(way, n)));
    float near = head_smooth(-0.014f, 0.001f, head_above_hairline(p));
    point lifted = head_unit(head_add(way, n, 0.5f)), lying = head_unit(head_add(way, n, -0.1f));
    put_hair(builder, head_add(p, n, -0.0003f), lifted, lying,
             (0.004f + 0.012f * size * size) * near + 0.002f, 3.0e-5f, 3);
}

// Return the number of loose hairs per square metre that the tie does not hold. They are short ones
// at the nape and at the temples.
static float wisp_density(point p)
{
    float above = head_above_hairline(p), azimuth = fabsf(atan2f(p.x, p.z));
    float side = head_smooth(1.9f, 2.2f, azimuth) +
                 0.7f * head_smooth(0.95f, 1.1f, azimuth) * head_smooth(1.5f, 1.35f, azimuth);
    return 1.6e5f * side * head_smooth(-0.005f, 0.001f, above) * head_smooth(0.008f, 0.004f, above);
}

// Add a loose hair, which leaves the skin and soon falls along it.
static void put_wisp(struct head_builder* builder, point p, point n, uint32_t* seed)
{
    float size = head_random(seed), x = head_random(seed) - 0.5f, z = head_random(seed) - 0.5f;
    point from = head_unit(head_add((point){1.2f * x, 0.1f, 1.2f * z}, n, 0.5f));
    point to = head_unit(head_add((point){0.8f * x, -1.2f, 0.8f * z}, n, -0.25f));
    put_hair(builder, head_add(p, n, -0.0003f), from, to, 0.012f + 0.034f * size * size, 4.0e-5f, 8);
}

// A kind of hairs along the hairline: how many there are on a square metre, and one of them.
struct hairs {
    float (*density)(point p);
    void (*put)(struct head_builder* builder, point p, point n, uint32_t* seed);
};

static void put_hairs(struct head_builder* builder, const struct hairs* hairs, uint32_t triangles)
{
    uint32_t seed = 11;
    for (uint32_t i = 0; i < triangles && !builder->failed; ++i) {
        const uint32_t* corner = builder->mesh.triangles + 3 * (size_t)i;
        const float *a = builder->mesh.positions + 3 * corner[0],
                    *b = builder->mesh.positions + 3 * corner[1],
                    *c = builder->mesh.positions + 3 * corner[2], *n = builder->mesh.normals + 3 * corner[0];
        point p = {a[0], a[1], a[2]}, normal = {n[0], n[1], n[2]};
        if (p.y < 1.54f || builder->mesh.surface[3 * (size_t)corner[0]] < 1) continue;
        float density = hairs->density(p);
        if (density <= 0) continue;
        point u = head_add((point){b[0], b[1], b[2]}, p, -1), v = head_add((point){c[0], c[1], c[2]}, p, -1);
        point across = head_cross(u, v);
        float wanted = 0.5f * density * sqrtf(head_dot(across, across));
        for (; head_random(&seed) < wanted; wanted -= 1) {
            float s = sqrtf(head_random(&seed)), t = head_random(&seed);
            hairs->put(builder, head_add(head_add(p, u, s * (1 - t)), v, s * t), normal, &seed);
        }
    }
}

void head_put_fringe(struct head_builder* builder, bool is_tied)
{
    static const struct hairs fringe = {fringe_density, put_fine_hair}, wisps = {wisp_density, put_wisp};
    uint32_t triangles = builder->mesh.triangle_count;
    put_hairs(builder, &fringe, triangles);
    if (is_tied) put_hairs(builder, &wisps, triangles);
}
