// head_tie.c - Hair tie of the bust: its place among guides, and its mesh.
#include "tools/common/head_tie.h"
#include "tools/common/head_parts.h"

#include <math.h>
#include <stdlib.h>

#define MAX_GUIDES 64u // Guides that are looked at, evenly among all.
#define STEPS 12 // Steps of a search from a vertex.
#define REACH 0.03f // Distance within which a search stays, m.
#define MAX_RADIUS 0.012f // Root mean square distance of tied guides from their mean, m.
#define MAX_NARROW 0.2f // Maximum fraction of the distance of the roots from their mean.
#define FULL 1.4f // Radius of the hair by the root mean square distance.

#define COLUMNS 64u
#define ROWS 16u
#define THICKNESS 0.003f // Radius of the band, m.

typedef struct head_point point;

// Guides that are looked at. Guide i has the vertices from first[i] up to first[i + 1].
struct sample {
    point* vertices;
    uint32_t* first;
    uint32_t guides;
};

static void free_sample(struct sample* sample)
{
    free(sample->vertices);
    free(sample->first);
}

// Take guides evenly. Return false if there are too few, or if memory runs out.
static bool take_sample(const hair_groom* groom, struct sample* out)
{
    hair_groom_info info = hair_groom_info_default();
    *out = (struct sample){0};
    if (hair_groom_describe(groom, &info) || info.guide_count < 3) return false;
    uint32_t every = (info.guide_count + MAX_GUIDES - 1) / MAX_GUIDES, taken = 0, at = 0;
    uint32_t* counts = malloc(info.guide_count * sizeof *counts);
    out->vertices = malloc(info.guide_vertex_count * sizeof *out->vertices);
    out->first = malloc((MAX_GUIDES + 1) * sizeof *out->first);
    bool has_all =
        counts && out->vertices && out->first &&
        !hair_groom_get_guides(groom, counts, info.guide_count, &out->vertices->x, info.guide_vertex_count);
    for (uint32_t i = 0, from = 0; i < info.guide_count && has_all; from += counts[i++]) {
        if (i % every) continue;
        out->first[taken++] = at;
        for (uint32_t k = 0; k < counts[i]; ++k) out->vertices[at++] = out->vertices[from + k];
    }
    if (has_all) out->first[taken] = at;
    out->guides = taken;
    free(counts);
    return has_all;
}

// Return the point of a segment that is nearest to p.
static point find_nearest_on(point a, point b, point p)
{
    point along = head_add(b, a, -1);
    float square = head_dot(along, along);
    float t = square > 0 ? head_dot(head_add(p, a, -1), along) / square : 0;
    return head_add(a, along, fminf(fmaxf(t, 0), 1));
}

// Return the mean of the points of all guides that are nearest to p. Write the mean direction of
// the guides there, and their root mean square distance from p.
static point find_mean(const struct sample* sample, point p, point* direction, float* away)
{
    point sum = {0}, toward = {0};
    float squares = 0;
    for (uint32_t i = 0; i < sample->guides; ++i) {
        float least = INFINITY;
        point nearest = p, way = {0};
        for (uint32_t k = sample->first[i] + 1; k < sample->first[i + 1]; ++k) {
            point a = sample->vertices[k - 1], b = sample->vertices[k], q = find_nearest_on(a, b, p);
            point d = head_add(q, p, -1);
            float square = head_dot(d, d);
            if (square >= least) continue;
            least = square;
            nearest = q;
            way = head_unit(head_add(b, a, -1));
        }
        squares += least;
        sum = head_add(sum, nearest, 1);
        toward = head_add(toward, way, 1);
    }
    *direction = head_unit(toward);
    *away = sqrtf(squares / (float)sample->guides);
    return head_add((point){0}, sum, 1 / (float)sample->guides);
}

// Return the root mean square distance of the roots from their mean.
static float measure_roots(const struct sample* sample)
{
    point sum = {0};
    float squares = 0, part = 1 / (float)sample->guides;
    for (uint32_t i = 0; i < sample->guides; ++i)
        sum = head_add(sum, sample->vertices[sample->first[i]], part);
    for (uint32_t i = 0; i < sample->guides; ++i) {
        point d = head_add(sample->vertices[sample->first[i]], sum, -1);
        squares += part * head_dot(d, d);
    }
    return sqrtf(squares);
}

// Look from each vertex of the first guide, from its root on. A step moves to the mean of the
// nearest points of all guides, which brings them nearer or leaves them as near.
static bool find_ring(const struct sample* sample, struct head_tie* out)
{
    float max = fminf(MAX_RADIUS, MAX_NARROW * measure_roots(sample));
    for (uint32_t k = sample->first[0]; k < sample->first[1]; ++k) {
        point at = sample->vertices[k], axis = {0};
        float away = INFINITY;
        for (int i = 0; i < STEPS; ++i) at = find_mean(sample, at, &axis, &away);
        find_mean(sample, at, &axis, &away);
        point moved = head_add(at, sample->vertices[k], -1);
        if (!(away < max) || head_dot(moved, moved) > REACH * REACH) continue;
        *out = (struct head_tie){{at.x, at.y, at.z}, {axis.x, axis.y, axis.z}, FULL * away};
        return true;
    }
    return false;
}

bool head_find_tie(const hair_groom* groom, struct head_tie* out)
{
    struct sample sample;
    bool is_tied = take_sample(groom, &sample) && find_ring(&sample, out);
    free_sample(&sample);
    return is_tied;
}

void head_put_tie(struct head_builder* builder, const struct head_tie* tie)
{
    static const struct head_paint paint = {{0.02f, 0.02f, 0.022f}, 0, 0, 1};
    const point at = {tie->at[0], tie->at[1], tie->at[2]}, axis = {tie->axis[0], tie->axis[1], tie->axis[2]};
    const point left = {fabsf(axis.x) < 0.7f, fabsf(axis.x) >= 0.7f, 0};
    const point up = head_unit(head_cross(axis, left)), side = head_cross(up, axis);
    float radius = tie->radius + 0.5f * THICKNESS;
    uint32_t first = builder->mesh.vertex_count;
    for (uint32_t column = 0; column < COLUMNS; ++column)
        for (uint32_t row = 0; row < ROWS; ++row) {
            float turn = 2 * 3.14159265f * (float)column / COLUMNS,
                  angle = 2 * 3.14159265f * (float)row / ROWS;
            point out = head_add(head_add((point){0}, side, cosf(turn)), up, sinf(turn));
            point n = head_add(head_add((point){0}, out, cosf(angle)), axis, sinf(angle));
            head_put_vertex(builder, head_add(head_add(at, out, radius), n, THICKNESS), n, &paint);
        }
    for (uint32_t column = 0; column < COLUMNS; ++column)
        for (uint32_t row = 0; row < ROWS; ++row) {
            uint32_t a = first + column * ROWS, b = first + (column + 1) % COLUMNS * ROWS,
                     c = (row + 1) % ROWS;
            head_put_triangle(builder, a + row, b + row, b + c);
            head_put_triangle(builder, a + row, b + c, a + c);
        }
}
