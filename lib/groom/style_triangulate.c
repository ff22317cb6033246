// style_triangulate.c - Delaunay triangles of a few thousand points in the plane.
//
// Points are inserted from left to right. A triangle whose circumcircle lies to the left of the
// newest point is final and is not tested again. About the square root of all triangles remain to
// be tested. Based on Bowyer 1981, "Computing Dirichlet tessellations", and Watson 1981, in the
// same year and journal.
#include "lib/groom/style_scalp.h"

#include <stdlib.h>
#include <string.h>

// Coordinate of the corners of a triangle around all points, whose extent is about 1. Circles
// through near corners keep their precision. With far corners, only slivers are lost along the
// outline.
#define FAR_AWAY 100.0

struct face {
    uint32_t corner[3];
    double x, y, square; // centre and squared radius of the circumcircle
};

struct edge {
    uint32_t a, b;
};

struct vertex_place {
    double x;
    uint32_t index;
};

struct work {
    double* points; // followed by the three far corners
    struct vertex_place* order;
    struct face* faces; // not yet final
    struct edge* edges;
    uint32_t face_count, edge_count;
    uint32_t count; // number of points
    uint32_t* out;
    uint32_t out_count;
};

static struct face make_face(const double* points, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = points + 2 * a, *q = points + 2 * b, *r = points + 2 * c;
    double qx = q[0] - p[0], qy = q[1] - p[1], rx = r[0] - p[0], ry = r[1] - p[1];
    double q2 = qx * qx + qy * qy, r2 = rx * rx + ry * ry;
    double twice = 2 * (qx * ry - qy * rx);
    double x = (ry * q2 - qy * r2) / twice, y = (qx * r2 - rx * q2) / twice;
    return (struct face){{a, b, c}, p[0] + x, p[1] + y, x * x + y * y};
}

static int encloses(const struct face* face, const double* p)
{
    double x = p[0] - face->x, y = p[1] - face->y;
    return x * x + y * y < face->square;
}

// Add an edge of the hole. An edge met twice, once in each direction, lies inside the hole and is
// removed.
static void toggle_edge(struct work* work, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < work->edge_count; ++i)
        if (work->edges[i].a == b && work->edges[i].b == a) {
            work->edges[i] = work->edges[--work->edge_count];
            return;
        }
    HAIR_ASSERT(work->edge_count < 3 * (2 * work->count + 8));
    work->edges[work->edge_count++] = (struct edge){a, b};
}

static void keep_face(struct work* work, const struct face* face)
{
    const uint32_t* corner = face->corner;
    if (corner[0] >= work->count || corner[1] >= work->count || corner[2] >= work->count) return;
    HAIR_ASSERT(work->out_count < 2 * work->count);
    memcpy(work->out + 3 * work->out_count++, corner, 3 * sizeof *corner);
}

static int is_final(const struct face* face, double x)
{
    return x > face->x && (x - face->x) * (x - face->x) > face->square;
}

static void insert(struct work* work, uint32_t point)
{
    const double* p = work->points + 2 * point;
    work->edge_count = 0;
    for (uint32_t i = 0; i < work->face_count;) {
        struct face* face = &work->faces[i];
        if (is_final(face, p[0])) {
            keep_face(work, face);
        } else if (encloses(face, p)) {
            for (uint32_t k = 0; k < 3; ++k) toggle_edge(work, face->corner[k], face->corner[(k + 1) % 3]);
        } else {
            ++i;
            continue;
        }
        *face = work->faces[--work->face_count];
    }
    HAIR_ASSERT(work->face_count + work->edge_count <= 2 * work->count + 8);
    for (uint32_t i = 0; i < work->edge_count; ++i)
        work->faces[work->face_count++] = make_face(work->points, work->edges[i].a, work->edges[i].b, point);
}

// Copy the points and append the far corners.
//
// Four points on one circle have two triangulations, and rounding would select them inconsistently.
// Moving each point by a millionth of the extent makes the triangulation unique.
static void copy_points(const double* points, uint32_t count, double* out)
{
    for (uint32_t i = 0; i < 2 * count; ++i)
        out[i] = points[i] + 1e-6 * ((double)(hair_hash(i) >> 8) / 16777216.0 - 0.5);
    const double corners[6] = {-FAR_AWAY, -FAR_AWAY, FAR_AWAY, -FAR_AWAY, 0, FAR_AWAY};
    memcpy(out + 2 * count, corners, sizeof corners);
}

static int compare_places(const void* a, const void* b)
{
    double x = ((const struct vertex_place*)a)->x, y = ((const struct vertex_place*)b)->x;
    return (x > y) - (x < y);
}

static void triangulate(struct work* work)
{
    for (uint32_t i = 0; i < work->count; ++i) work->order[i] = (struct vertex_place){work->points[2 * i], i};
    qsort(work->order, work->count, sizeof *work->order, compare_places);
    work->faces[work->face_count++] = make_face(work->points, work->count, work->count + 1, work->count + 2);
    for (uint32_t i = 0; i < work->count; ++i) insert(work, work->order[i].index);
    for (uint32_t i = 0; i < work->face_count; ++i) keep_face(work, &work->faces[i]);
}

uint32_t hair_triangulate(const hair_host* host, const double* points, uint32_t count, uint32_t* out)
{
    // n points and three corners have 2 n + 1 triangles. A hole of k triangles has at most 3 k
    // edges while it is found.
    size_t max = 2 * (size_t)count + 8;
    struct work work = {.points = hair_alloc(host, 2 * ((size_t)count + 3), sizeof(double)),
                        .order = hair_alloc(host, count, sizeof(struct vertex_place)),
                        .faces = hair_alloc(host, max, sizeof(struct face)),
                        .edges = hair_alloc(host, 3 * max, sizeof(struct edge)),
                        .count = count,
                        .out = out};
    if (work.points && work.order && work.faces && work.edges) {
        copy_points(points, count, work.points);
        triangulate(&work);
    }
    hair_free(host, work.edges);
    hair_free(host, work.faces);
    hair_free(host, work.order);
    hair_free(host, work.points);
    return work.out_count;
}
