// head_parts.c - Growing meshes, and the paint of skin.
#include "tools/common/head_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f

typedef struct head_point point;

float head_smooth(float from, float to, float x)
{
    float t = fminf(fmaxf((x - from) / (to - from), 0), 1);
    return t * t * (3 - 2 * t);
}

float head_mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

point head_add(point a, point b, float scale)
{
    return (point){a.x + scale * b.x, a.y + scale * b.y, a.z + scale * b.z};
}

point head_cross(point a, point b)
{
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

float head_dot(point a, point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

point head_unit(point a)
{
    float size = fmaxf(sqrtf(head_dot(a, a)), 1e-12f);
    return (point){a.x / size, a.y / size, a.z / size};
}

float head_random(uint32_t* seed)
{
    uint32_t h = *seed += 0x9e3779b9u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return (float)((h ^ (h >> 16)) >> 8) / 16777216.0f;
}

// Growing -----------------------------------------------------------------------------------------

static bool widen(float** memory, size_t values)
{
    float* more = realloc(*memory, values * sizeof(float));
    if (more) *memory = more;
    return more != NULL;
}

static bool reserve_vertex(struct head_builder* builder)
{
    struct head_mesh* mesh = &builder->mesh;
    if (mesh->vertex_count < builder->vertex_room) return true;
    size_t room = builder->vertex_room ? 2 * (size_t)builder->vertex_room : 1 << 15;
    builder->failed |= !widen(&mesh->positions, 3 * room) || !widen(&mesh->normals, 3 * room) ||
                       !widen(&mesh->colors, 3 * room) || !widen(&mesh->surface, 3 * room);
    if (!builder->failed) builder->vertex_room = (uint32_t)room;
    return !builder->failed;
}

uint32_t head_put_vertex(struct head_builder* builder, point p, point normal, const struct head_paint* paint)
{
    struct head_mesh* mesh = &builder->mesh;
    if (builder->failed || !reserve_vertex(builder)) return 0;
    size_t at = 3 * (size_t)mesh->vertex_count;
    const float surface[3] = {paint->kind, paint->gloss, paint->open};
    memcpy(mesh->positions + at, &p, sizeof p);
    memcpy(mesh->normals + at, &normal, sizeof normal);
    memcpy(mesh->colors + at, paint->color, sizeof paint->color);
    memcpy(mesh->surface + at, surface, sizeof surface);
    return mesh->vertex_count++;
}

void head_put_triangle(struct head_builder* builder, uint32_t a, uint32_t b, uint32_t c)
{
    struct head_mesh* mesh = &builder->mesh;
    if (builder->failed) return;
    if (mesh->triangle_count == builder->triangle_room) {
        size_t room = builder->triangle_room ? 2 * (size_t)builder->triangle_room : 1 << 16;
        uint32_t* more = realloc(mesh->triangles, 3 * room * sizeof *more);
        builder->failed = !more;
        if (!more) return;
        mesh->triangles = more;
        builder->triangle_room = (uint32_t)room;
    }
    uint32_t* triangle = mesh->triangles + 3 * (size_t)mesh->triangle_count++;
    triangle[0] = a, triangle[1] = b, triangle[2] = c;
}

// Paint -------------------------------------------------------------------------------------------

float head_above_hairline(point p)
{
    // Azimuth from the face, in degrees, and height, in m.
    static const float hairline[][2] = {{0, 1.692f},   {22, 1.693f},  {40, 1.694f},  {52, 1.679f},
                                        {62, 1.652f},  {71, 1.624f},  {80, 1.609f},  {89, 1.620f},
                                        {98, 1.625f},  {108, 1.606f}, {117, 1.584f}, {127, 1.575f},
                                        {142, 1.564f}, {160, 1.559f}, {180, 1.558f}};
    const int knots = (int)(sizeof hairline / sizeof *hairline);
    float azimuth = atan2f(fabsf(p.x) / 0.077f, p.z / 0.096f) * (180 / PI);
    int i = 0;
    while (i < knots - 2 && hairline[i + 1][0] < azimuth) ++i;
    // Interpolate as hair_scalp_hairline() does, by the spline of Catmull and Rom (1974).
    float before = hairline[i > 0 ? i - 1 : 1][1], a = hairline[i][1], b = hairline[i + 1][1];
    float after = hairline[i + 2 < knots ? i + 2 : i][1];
    float t = (azimuth - hairline[i][0]) / (hairline[i + 1][0] - hairline[i][0]);
    float cubic = 3 * (a - b) + after - before, square = 2 * before - 5 * a + 4 * b - after;
    return p.y - (a + 0.5f * t * (b - before + t * (square + t * cubic)));
}

// Return the distance of p from the ellipsoid of the skull, to first order.
static float above_skull(point p)
{
    point q = {p.x / 0.077f, (p.y - 1.63f) / 0.098f, p.z / 0.096f};
    point twice = {q.x / 0.077f, q.y / 0.098f, q.z / 0.096f};
    float k = sqrtf(head_dot(q, q));
    return k * (k - 1) / fmaxf(sqrtf(head_dot(twice, twice)), 1e-6f);
}

point head_on_skull(point p)
{
    const float under = 0.0003f, margin = 0.004f; // m
    float out = above_skull(p) + under;
    float weight = head_smooth(-0.012f, -0.001f, head_above_hairline(p)) *
                   head_smooth(margin, 0.5f * margin, fabsf(out));
    point n = {p.x / (0.077f * 0.077f), (p.y - 1.63f) / (0.098f * 0.098f), p.z / (0.096f * 0.096f)};
    return head_add(p, head_unit(n), -weight * out);
}

// Return 1 at the centre of a spot and 0 beyond its radius.
static float spot(point p, point centre, float radius)
{
    point d = head_add((point){fabsf(p.x), p.y, p.z}, centre, -1);
    return head_smooth(radius, 0, sqrtf(head_dot(d, d)));
}

struct head_paint head_paint_skin(point p, float lip, float open)
{
    static const float skin[3] = {0.50f, 0.315f, 0.225f}, blood[3] = {0.47f, 0.215f, 0.165f};
    static const float lips[3] = {0.37f, 0.165f, 0.145f};
    // Blood is near the surface of cheeks, nose and ears.
    float red = 0.55f * spot(p, (point){0.038f, 1.578f, 0.075f}, 0.034f) +
                0.60f * spot(p, (point){0, 1.578f, 0.117f}, 0.020f) +
                0.35f * spot(p, (point){0.077f, 1.600f, -0.005f}, 0.035f) +
                0.25f * spot(p, (point){0, 1.515f, 0.095f}, 0.025f) + 0.30f * spot(p, HEAD_EYE, 0.026f);
    // Hair darkens the skin that it grows from, as on a shaved head.
    float dark = 0.80f * head_smooth(-0.001f, 0.015f, head_above_hairline(p)) *
                 head_smooth(0.004f, 0.001f, above_skull(p));
    dark = fmaxf(dark, 0.6f * head_brow(p));
    struct head_paint paint = {.kind = 1 + dark, .open = open};
    lip = head_smooth(0.25f, 0.85f, lip);
    for (int i = 0; i < 3; ++i) {
        float c = head_mix(skin[i], blood[i], fminf(red, 1));
        paint.color[i] = head_mix(c, lips[i], lip);
    }
    paint.gloss = head_mix(head_mix(1, 1.7f, lip), 0.4f, dark);
    return paint;
}
