// head_subdivide.c - Subdivision of a mesh of triangles and quadrilaterals into a smooth surface.
// Based on Catmull and Clark 1978, "Recursively generated B-spline surfaces on arbitrary
// topological meshes". Open edges become B-splines of their own.
#include "tools/common/head_subdivide.h"

#include <stdlib.h>
#include <string.h>

struct edge {
    uint32_t from, to; // from < to
    uint32_t faces;
    float sum[HEAD_VALUES]; // of the centres of its faces
};

struct division {
    const struct head_surface* in;
    struct head_surface out;
    struct edge* edges;
    uint32_t* slots; // hash table of edge indices + 1
    uint32_t slot_mask, edge_count;
    uint32_t (*side)[4]; // edge from each corner of a face to the next
    // Sums at each vertex.
    float (*face_sum)[HEAD_VALUES];
    float (*edge_sum)[HEAD_VALUES];
    float (*border_sum)[HEAD_VALUES];
    uint32_t (*count)[3]; // faces, edges and open edges
};

static void add(float* to, const float* value, float scale)
{
    for (uint32_t i = 0; i < HEAD_VALUES; ++i) to[i] += scale * value[i];
}

static uint32_t corners_of(const uint32_t face[4])
{
    return face[3] == HEAD_NO_CORNER ? 3 : 4;
}

// Return the index of the edge between two vertices, which is added if it is new.
static uint32_t find_edge(struct division* d, uint32_t a, uint32_t b)
{
    uint32_t from = a < b ? a : b, to = a < b ? b : a;
    uint32_t slot = (from * 0x9e3779b1u ^ to * 0x85ebca77u) & d->slot_mask;
    for (; d->slots[slot]; slot = (slot + 1) & d->slot_mask) {
        const struct edge* edge = &d->edges[d->slots[slot] - 1];
        if (edge->from == from && edge->to == to) return d->slots[slot] - 1;
    }
    d->edges[d->edge_count] = (struct edge){.from = from, .to = to};
    d->slots[slot] = ++d->edge_count;
    return d->edge_count - 1;
}

// Place a vertex at the centre of each face.
static void divide_faces(struct division* d)
{
    for (uint32_t i = 0; i < d->in->face_count; ++i) {
        const uint32_t* face = d->in->faces[i];
        uint32_t corners = corners_of(face);
        float* centre = d->out.vertices[d->in->vertex_count + i];
        memset(centre, 0, sizeof d->out.vertices[0]);
        for (uint32_t k = 0; k < corners; ++k) add(centre, d->in->vertices[face[k]], 1 / (float)corners);
        for (uint32_t k = 0; k < corners; ++k) {
            d->side[i][k] = find_edge(d, face[k], face[(k + 1) % corners]);
            struct edge* edge = &d->edges[d->side[i][k]];
            ++edge->faces;
            add(edge->sum, centre, 1);
            add(d->face_sum[face[k]], centre, 1);
            ++d->count[face[k]][0];
        }
    }
}

// Place a vertex on each edge.
static void divide_edges(struct division* d)
{
    for (uint32_t i = 0; i < d->edge_count; ++i) {
        const struct edge* edge = &d->edges[i];
        const float *a = d->in->vertices[edge->from], *b = d->in->vertices[edge->to];
        float* at = d->out.vertices[d->in->vertex_count + d->in->face_count + i];
        int open = edge->faces == 1;
        memset(at, 0, sizeof d->out.vertices[0]);
        add(at, a, open ? 0.5f : 0.25f);
        add(at, b, open ? 0.5f : 0.25f);
        if (!open) add(at, edge->sum, 0.5f / (float)edge->faces);
        add(d->edge_sum[edge->from], b, 1);
        add(d->edge_sum[edge->to], a, 1);
        ++d->count[edge->from][1], ++d->count[edge->to][1];
        if (!open) continue;
        add(d->border_sum[edge->from], b, 1);
        add(d->border_sum[edge->to], a, 1);
        ++d->count[edge->from][2], ++d->count[edge->to][2];
    }
}

static void move_vertices(struct division* d)
{
    for (uint32_t i = 0; i < d->in->vertex_count; ++i) {
        float *to = d->out.vertices[i], faces = (float)d->count[i][0], edges = (float)d->count[i][1];
        int open = d->count[i][2] > 0;
        memset(to, 0, sizeof d->out.vertices[0]);
        if (open) {
            add(to, d->in->vertices[i], 0.75f);
            add(to, d->border_sum[i], 0.25f / (float)d->count[i][2]);
        } else if (faces > 0) {
            add(to, d->in->vertices[i], (edges - 2) / edges);
            add(to, d->face_sum[i], 1 / (faces * edges));
            add(to, d->edge_sum[i], 1 / (edges * edges));
        }
    }
}

static void join_faces(struct division* d)
{
    uint32_t centres = d->in->vertex_count, edges = centres + d->in->face_count;
    for (uint32_t i = 0; i < d->in->face_count; ++i) {
        const uint32_t* face = d->in->faces[i];
        uint32_t corners = corners_of(face);
        for (uint32_t k = 0; k < corners; ++k) {
            uint32_t* quad = d->out.faces[d->out.face_count++];
            quad[0] = face[k];
            quad[1] = edges + d->side[i][k];
            quad[2] = centres + i;
            quad[3] = edges + d->side[i][(k + corners - 1) % corners];
        }
    }
    d->out.vertex_count = edges + d->edge_count;
}

static int allocate(struct division* d)
{
    uint32_t vertices = d->in->vertex_count, faces = d->in->face_count;
    uint32_t slots = 16;
    while (slots < 8 * faces) slots *= 2;
    d->slot_mask = slots - 1;
    d->slots = calloc(slots, sizeof *d->slots);
    d->edges = calloc(4 * (size_t)faces + 1, sizeof *d->edges);
    d->side = calloc((size_t)faces + 1, sizeof *d->side);
    d->face_sum = calloc((size_t)vertices + 1, sizeof *d->face_sum);
    d->edge_sum = calloc((size_t)vertices + 1, sizeof *d->edge_sum);
    d->border_sum = calloc((size_t)vertices + 1, sizeof *d->border_sum);
    d->count = calloc((size_t)vertices + 1, sizeof *d->count);
    d->out.vertices = malloc(((size_t)vertices + 5 * (size_t)faces + 1) * sizeof *d->out.vertices);
    d->out.faces = malloc((4 * (size_t)faces + 1) * sizeof *d->out.faces);
    return d->slots && d->edges && d->side && d->face_sum && d->edge_sum && d->border_sum && d->count &&
           d->out.vertices && d->out.faces;
}

int head_subdivide(struct head_surface* surface)
{
    struct division d = {.in = surface};
    int ok = allocate(&d);
    if (ok) {
        divide_faces(&d);
        divide_edges(&d);
        move_vertices(&d);
        join_faces(&d);
        head_surface_free(surface);
        *surface = d.out;
    } else {
        head_surface_free(&d.out);
    }
    free(d.count);
    free(d.border_sum);
    free(d.edge_sum);
    free(d.face_sum);
    free(d.side);
    free(d.edges);
    free(d.slots);
    return ok ? 0 : -1;
}

void head_surface_free(struct head_surface* surface)
{
    free(surface->vertices);
    free(surface->faces);
    memset(surface, 0, sizeof *surface);
}
