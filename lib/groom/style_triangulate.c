// style_triangulate.c - Delaunay triangles of a few thousand points in the plane.
// Based on: Bowyer 1981, "Computing Dirichlet tessellations"; Watson 1981, the same year and journal.
#include "lib/groom/style_scalp.h"

#include <string.h>

// Corners of the triangle around all points, whose extent is about 1: near enough for circles through them to
// keep their digits, far enough for only slivers to be lost along the outline.
#define FAR_AWAY 100.0

struct face {
    uint32_t corner[3];
    double   x, y, square; // circumcircle
};

struct edge {
    uint32_t a, b;
};

struct work {
    double*      points; // with the three far corners behind them
    struct face* faces;
    struct edge* edges;
    uint32_t     face_count, edge_count;
};

static struct face make_face(const double* points, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = points + 2 * a, *q = points + 2 * b, *r = points + 2 * c;
    double        qx = q[0] - p[0], qy = q[1] - p[1], rx = r[0] - p[0], ry = r[1] - p[1];
    double        q2 = qx * qx + qy * qy, r2 = rx * rx + ry * ry;
    double        twice = 2 * (qx * ry - qy * rx);
    double        x = (ry * q2 - qy * r2) / twice, y = (qx * r2 - rx * q2) / twice;
    return (struct face){{a, b, c}, p[0] + x, p[1] + y, x * x + y * y};
}

static int encloses(const struct face* face, const double* p)
{
    double x = p[0] - face->x, y = p[1] - face->y;
    return x * x + y * y < face->square;
}

// An edge met twice, once each way, lies inside the hole and goes.
static void toggle_edge(struct work* work, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < work->edge_count; ++i)
        if (work->edges[i].a == b && work->edges[i].b == a) {
            work->edges[i] = work->edges[--work->edge_count];
            return;
        }
    work->edges[work->edge_count++] = (struct edge){a, b};
}

static void insert(struct work* work, uint32_t point)
{
    work->edge_count = 0;
    for (uint32_t i = 0; i < work->face_count;) {
        if (!encloses(&work->faces[i], work->points + 2 * point)) {
            ++i;
            continue;
        }
        const uint32_t* corner = work->faces[i].corner;
        for (uint32_t k = 0; k < 3; ++k) toggle_edge(work, corner[k], corner[(k + 1) % 3]);
        work->faces[i] = work->faces[--work->face_count];
    }
    for (uint32_t i = 0; i < work->edge_count; ++i)
        work->faces[work->face_count++] = make_face(work->points, work->edges[i].a, work->edges[i].b, point);
}

// Four points on one circle have two triangulations, between which rounding would choose differently from
// test to test: moving each by a millionth of the extent makes the answer one.
static void copy_points(const double* points, uint32_t count, double* out)
{
    for (uint32_t i = 0; i < 2 * count; ++i)
        out[i] = points[i] + 1e-6 * ((double)(hair_hash(i) >> 8) / 16777216.0 - 0.5);
    const double corners[6] = {-FAR_AWAY, -FAR_AWAY, FAR_AWAY, -FAR_AWAY, 0, FAR_AWAY};
    memcpy(out + 2 * count, corners, sizeof corners);
}

static uint32_t triangulate(struct work* work, uint32_t count, uint32_t* out)
{
    work->faces[work->face_count++] = make_face(work->points, count, count + 1, count + 2);
    for (uint32_t i = 0; i < count; ++i) insert(work, i);

    uint32_t found = 0;
    for (uint32_t i = 0; i < work->face_count; ++i) {
        const uint32_t* corner = work->faces[i].corner;
        if (corner[0] >= count || corner[1] >= count || corner[2] >= count) continue;
        memcpy(out + 3 * found++, corner, 3 * sizeof *corner);
    }
    return found;
}

uint32_t hair_triangulate(const hair_host* host, const double* points, uint32_t count, uint32_t* out)
{
    // n points and three corners have 2 n + 1 triangles; a hole of k has at most 3 k edges while it is found.
    size_t      most  = 2 * (size_t)count + 8;
    struct work work  = {hair_alloc(host, 2 * ((size_t)count + 3), sizeof(double)),
                         hair_alloc(host, most, sizeof(struct face)),
                         hair_alloc(host, 3 * most, sizeof(struct edge)), 0, 0};
    uint32_t    found = 0;
    if (work.points && work.faces && work.edges) {
        copy_points(points, count, work.points);
        found = triangulate(&work, count, out);
    }
    hair_free(host, work.edges);
    hair_free(host, work.faces);
    hair_free(host, work.points);
    return found;
}
