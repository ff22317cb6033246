// head_collision.c - Surfaces of the bust to collide with: the drawn ones, cut and closed.
//
// The capsules of head.c are for solvers without meshes. They leave gaps of centimetres under the
// nose, the chin and the garment.
#include "tools/common/head_parts.h"
#include "tools/common/head_pose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct head_point point;

#define NONE UINT32_MAX

// Part of the bust that a surface takes. Faces that reach into it are whole, so that the surfaces
// overlap.
struct cut {
    enum head_part part;
    float lowest, highest; // m
    bool is_inside_collar; // leaves out what the garment covers
};

static const struct cut head_cut = {HEAD_SKIN, HAIR_HEAD_MOVES - 0.01f, INFINITY, false};
// Hair reaches no farther down.
static const struct cut body_cuts[] = {{HEAD_SKIN, 1.25f, HAIR_HEAD_MOVES + 0.01f, true},
                                       {HEAD_CLOTH, 1.25f, INFINITY, false}};

#define VOXEL 0.005f // m, of the head

// A surface that is made closed.
struct closed {
    float* positions;
    uint32_t (*triangles)[3];
    uint32_t (*edges)[2]; // Directed edges of the faces.
    uint32_t* next; // Next vertex along a boundary of each vertex, or NONE.
    uint32_t vertex_count, triangle_count, edge_count;
};

static void free_closed(struct closed* closed)
{
    free(closed->next);
    free(closed->edges);
    free(closed->triangles);
    free(closed->positions);
}

static int by_vertices(const void* a, const void* b)
{
    const uint32_t *left = a, *right = b;
    if (left[0] != right[0]) return left[0] < right[0] ? -1 : 1;
    return (left[1] > right[1]) - (left[1] < right[1]);
}

// Allocate room for a surface and its caps. A cap has at most one triangle per edge, and one vertex
// per three edges.
static int reserve(const struct head_surface* surface, struct closed* out)
{
    size_t vertices = surface->vertex_count, edges = 4 * (size_t)surface->face_count;
    out->positions = malloc((vertices + edges / 3) * 3 * sizeof(float));
    out->triangles = malloc((edges / 2 + edges) * sizeof *out->triangles);
    out->edges = malloc(edges * sizeof *out->edges);
    out->next = malloc(vertices * sizeof *out->next);
    return out->positions && out->triangles && out->edges && out->next ? 0 : -1;
}

// Return whether a point of the skin is less than a centimetre under the collar, or not covered.
// The collar is an upright elliptic cylinder, as in bust.py.
static bool is_inside_collar(const float* p)
{
    float ring = hypotf(p[0] / 0.080f, (p[2] + 0.023f) / 0.067f);
    return 0.07f * (ring - 1) < 0.01f || p[1] > 1.492f;
}

static bool reaches(const uint32_t* face, uint32_t corners, const struct cut* cut, const float* positions)
{
    float top = -INFINITY, bottom = INFINITY;
    bool is_inside = !cut->is_inside_collar;
    for (uint32_t k = 0; k < corners; ++k) {
        const float* p = positions + 3 * (size_t)face[k];
        top = fmaxf(top, p[1]), bottom = fminf(bottom, p[1]);
        is_inside |= is_inside_collar(p);
    }
    return top >= cut->lowest && bottom <= cut->highest && is_inside;
}

static void add_face(const uint32_t face[4], const struct cut* cut, struct closed* out)
{
    uint32_t corners = face[3] == HEAD_NO_CORNER ? 3 : 4;
    if (!reaches(face, corners, cut, out->positions)) return;
    for (uint32_t k = 0; k < corners; ++k) {
        uint32_t edge[2] = {face[k], face[(k + 1) % corners]};
        memcpy(out->edges[out->edge_count++], edge, sizeof edge);
    }
    for (uint32_t k = 2; k < corners; ++k) {
        uint32_t triangle[3] = {face[0], face[k - 1], face[k]};
        memcpy(out->triangles[out->triangle_count++], triangle, sizeof triangle);
    }
}

// Find the boundaries: edges without a face on the other side, in the opposite direction.
static void find_boundaries(struct closed* closed, uint32_t vertices)
{
    for (uint32_t i = 0; i < vertices; ++i) closed->next[i] = NONE;
    qsort(closed->edges, closed->edge_count, sizeof *closed->edges, by_vertices);
    for (uint32_t i = 0; i < closed->edge_count; ++i) {
        const uint32_t opposite[2] = {closed->edges[i][1], closed->edges[i][0]};
        if (!bsearch(opposite, closed->edges, closed->edge_count, sizeof *closed->edges, by_vertices))
            closed->next[opposite[0]] = opposite[1];
    }
}

// Close a boundary by triangles around the mean of its vertices.
static void put_cap(struct closed* closed, uint32_t first)
{
    uint32_t middle = closed->vertex_count++, count = 0;
    float* sum = closed->positions + 3 * (size_t)middle;
    sum[0] = sum[1] = sum[2] = 0;
    for (uint32_t i = first; closed->next[i] != NONE;) {
        uint32_t next = closed->next[i], triangle[3] = {i, next, middle};
        memcpy(closed->triangles[closed->triangle_count++], triangle, sizeof triangle);
        for (int k = 0; k < 3; ++k) sum[k] += closed->positions[3 * i + (uint32_t)k];
        ++count;
        closed->next[i] = NONE;
        i = next;
    }
    for (int k = 0; k < 3; ++k) sum[k] /= (float)count;
}

static int close_surface(const struct head_surface* surface, const struct cut* cut, struct closed* out)
{
    if (reserve(surface, out)) return -1;
    out->vertex_count = surface->vertex_count;
    for (uint32_t i = 0; i < surface->vertex_count; ++i) {
        const float* v = surface->vertices[i];
        point p = {v[0], v[1], v[2]};
        if (cut->part == HEAD_SKIN) p = head_on_skull(p);
        memcpy(out->positions + 3 * (size_t)i, &p, sizeof p);
    }
    for (uint32_t i = 0; i < surface->face_count; ++i) add_face(surface->faces[i], cut, out);
    find_boundaries(out, surface->vertex_count);
    for (uint32_t i = 0; i < surface->vertex_count; ++i)
        if (out->next[i] != NONE) put_cap(out, i);
    return 0;
}

// Append the triangles of a closed surface and the vertices that they use.
static int append(const struct closed* closed, struct head_solid* out)
{
    uint32_t used = 0;
    size_t vertices = out->vertex_count + closed->vertex_count,
           triangles = out->triangle_count + closed->triangle_count;
    float* positions = realloc(out->positions, vertices * 3 * sizeof *positions);
    if (positions) out->positions = positions;
    uint32_t* corners = realloc(out->triangles, triangles * 3 * sizeof *corners);
    if (corners) out->triangles = corners;
    uint32_t* index = malloc(closed->vertex_count * sizeof *index);
    if (!positions || !corners || !index) {
        free(index);
        return -1;
    }
    for (uint32_t i = 0; i < closed->vertex_count; ++i) index[i] = NONE;
    for (uint32_t i = 0; i < 3 * closed->triangle_count; ++i) {
        uint32_t vertex = closed->triangles[i / 3][i % 3];
        if (index[vertex] == NONE) {
            index[vertex] = out->vertex_count + used;
            memcpy(positions + 3 * (size_t)(out->vertex_count + used++),
                   closed->positions + 3 * (size_t)vertex, 3 * sizeof *positions);
        }
        corners[3 * (size_t)out->triangle_count + i] = index[vertex];
    }
    out->vertex_count += used;
    out->triangle_count += closed->triangle_count;
    free(index);
    return 0;
}

// Append a part of the bust, cut and closed.
static int append_cut(const struct cut* cut, struct head_solid* out)
{
    struct head_surface surface = {0};
    struct closed closed = {0};
    int failed =
        head_load_part(cut->part, &surface) || close_surface(&surface, cut, &closed) || append(&closed, out);
    free_closed(&closed);
    head_surface_free(&surface);
    return failed ? -1 : 0;
}

int head_body_create(struct head_solid* out)
{
    int failed = 0;
    *out = (struct head_solid){0};
    for (size_t i = 0; i < sizeof body_cuts / sizeof *body_cuts; ++i)
        failed = failed || append_cut(&body_cuts[i], out);
    if (failed) head_solid_free(out);
    return failed ? -1 : 0;
}

void head_solid_free(struct head_solid* solid)
{
    free(solid->triangles);
    free(solid->positions);
    *solid = (struct head_solid){0};
}

int head_collision_mesh_create(const hair_host* host, hair_collision_mesh** out)
{
    struct head_solid solid = {0};
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    int failed = append_cut(&head_cut, &solid);
    if (!failed) {
        desc.host = host;
        desc.positions = solid.positions;
        desc.triangles = solid.triangles;
        desc.vertex_count = solid.vertex_count;
        desc.triangle_count = solid.triangle_count;
        desc.voxel_size = VOXEL;
        failed = hair_collision_mesh_create(&desc, out) != HAIR_OK;
    }
    head_solid_free(&solid);
    return failed ? -1 : 0;
}
