// head_collision.c - Collision meshes of the bust: the drawn surface, cut and closed.
//
// The capsules of head.c are for solvers without meshes. They leave gaps of centimetres under the
// nose, the chin and the garment.
#include "tools/common/head_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct head_point point;

#define NONE UINT32_MAX

// Meshes without the part below a height, where other colliders begin or hair does not reach.
static const struct {
    enum head_part part;
    float lowest, voxel; // m
} cuts[HEAD_MESHES] = {{HEAD_SKIN, 1.47f, 0.005f}, {HEAD_CLOTH, 1.25f, 0.008f}};

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

static void add_face(const uint32_t face[4], float lowest, struct closed* out)
{
    uint32_t corners = face[3] == HEAD_NO_CORNER ? 3 : 4;
    float top = -INFINITY;
    for (uint32_t k = 0; k < corners; ++k) top = fmaxf(top, out->positions[3 * face[k] + 1]);
    if (top < lowest) return;
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

static int close_surface(const struct head_surface* surface, enum head_part part, float lowest,
                         struct closed* out)
{
    if (reserve(surface, out)) return -1;
    out->vertex_count = surface->vertex_count;
    for (uint32_t i = 0; i < surface->vertex_count; ++i) {
        const float* v = surface->vertices[i];
        point p = {v[0], v[1], v[2]};
        if (part == HEAD_SKIN) p = head_on_skull(p);
        memcpy(out->positions + 3 * (size_t)i, &p, sizeof p);
    }
    for (uint32_t i = 0; i < surface->face_count; ++i) add_face(surface->faces[i], lowest, out);
    find_boundaries(out, surface->vertex_count);
    for (uint32_t i = 0; i < surface->vertex_count; ++i)
        if (out->next[i] != NONE) put_cap(out, i);
    return 0;
}

static int create(const hair_host* host, enum head_part part, float lowest, float voxel,
                  hair_collision_mesh** out)
{
    struct head_surface surface = {0};
    struct closed closed = {0};
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    int failed = head_load_part(part, &surface) || close_surface(&surface, part, lowest, &closed);
    if (!failed) {
        desc.host = host;
        desc.positions = closed.positions;
        desc.triangles = closed.triangles[0];
        desc.vertex_count = closed.vertex_count;
        desc.triangle_count = closed.triangle_count;
        desc.voxel_size = voxel;
        failed = hair_collision_mesh_create(&desc, out) != HAIR_OK;
    }
    free_closed(&closed);
    head_surface_free(&surface);
    return failed ? -1 : 0;
}

int head_collision_meshes_create(const hair_host* host, hair_collision_mesh* out[HEAD_MESHES])
{
    hair_collision_mesh* made[HEAD_MESHES] = {0};
    for (int i = 0; i < HEAD_MESHES; ++i)
        if (create(host, cuts[i].part, cuts[i].lowest, cuts[i].voxel, &made[i])) {
            while (i > 0) hair_collision_mesh_destroy(made[--i]);
            return -1;
        }
    memcpy(out, made, sizeof made);
    return 0;
}
