// head_cut.c - Cut the bust's mesh along the collar, so that skin and garment meet in a sharp line.
#include "tools/common/head_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ON_COLLAR 2e-4f // Tolerance of points on the collar, m. A smaller value makes slivers.

struct cutter {
    struct head_mesh* mesh;
    float* below; // height of the collar above each vertex, 0 on it
    uint32_t* twin; // garment copy of each vertex on the collar, 0 if none
    uint32_t* triangles;
    uint32_t triangle_count;
};

static void color_vertex(struct head_mesh* mesh, uint32_t vertex, int is_worn)
{
    struct head_point p;
    memcpy(&p, mesh->positions + 3 * (size_t)vertex, sizeof p);
    head_color(p, is_worn, mesh->colors + 3 * (size_t)vertex);
}

// Add a vertex at parameter t between vertices a and b.
static uint32_t add_vertex(struct head_mesh* mesh, uint32_t a, uint32_t b, float t, int is_worn)
{
    uint32_t vertex = mesh->vertex_count++;
    for (uint32_t i = 0; i < 3; ++i) {
        const float *p = mesh->positions + i, *n = mesh->normals + i;
        mesh->positions[3 * vertex + i] = p[3 * a] + (p[3 * b] - p[3 * a]) * t;
        mesh->normals[3 * vertex + i] = n[3 * a] + (n[3 * b] - n[3 * a]) * t;
    }
    color_vertex(mesh, vertex, is_worn);
    return vertex;
}

static uint32_t twin_of(struct cutter* cutter, uint32_t vertex)
{
    if (!cutter->twin[vertex]) cutter->twin[vertex] = add_vertex(cutter->mesh, vertex, vertex, 0, 1);
    return cutter->twin[vertex];
}

// Add the part of a triangle above the collar (side -1) or below it (side 1), by Sutherland and
// Hodgman 1974.
static void add_part(struct cutter* cutter, const uint32_t corner[3], float side)
{
    uint32_t polygon[4], count = 0;
    int is_worn = side > 0;
    for (uint32_t i = 0; i < 3; ++i) {
        uint32_t a = corner[i], b = corner[(i + 1) % 3];
        float p = cutter->below[a] * side, q = cutter->below[b] * side;
        if (p >= 0) polygon[count++] = p == 0 && is_worn ? twin_of(cutter, a) : a;
        if ((p > 0 && q < 0) || (p < 0 && q > 0))
            polygon[count++] = add_vertex(cutter->mesh, a, b, p / (p - q), is_worn);
    }
    for (uint32_t i = 2; i < count; ++i) {
        uint32_t* triangle = cutter->triangles + 3 * (size_t)cutter->triangle_count++;
        triangle[0] = polygon[0], triangle[1] = polygon[i - 1], triangle[2] = polygon[i];
    }
}

static void cut(struct cutter* cutter)
{
    const struct head_mesh* mesh = cutter->mesh;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t* corner = mesh->triangles + 3 * (size_t)i;
        const float* below = cutter->below;
        float min = fminf(below[corner[0]], fminf(below[corner[1]], below[corner[2]]));
        float max = fmaxf(below[corner[0]], fmaxf(below[corner[1]], below[corner[2]]));
        if (min < 0 || max == 0) add_part(cutter, corner, -1);
        if (max > 0) add_part(cutter, corner, 1);
    }
}

static int widen(float** memory, size_t count)
{
    float* more = realloc(*memory, count * 3 * sizeof(float));
    if (more) *memory = more;
    return more != NULL;
}

// Allocate for the worst case. Each cut triangle becomes three triangles with four new vertices,
// and each vertex may get a twin.
static int make_room(struct cutter* cutter)
{
    struct head_mesh* mesh = cutter->mesh;
    size_t max = 2 * (size_t)mesh->vertex_count, crossed = 0;
    cutter->below = malloc(mesh->vertex_count * sizeof(float));
    cutter->twin = calloc(mesh->vertex_count, sizeof(uint32_t));
    if (!cutter->below || !cutter->twin) return 0;
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        struct head_point p;
        memcpy(&p, mesh->positions + 3 * (size_t)i, sizeof p);
        float below = head_below_collar(p);
        cutter->below[i] = fabsf(below) < ON_COLLAR ? 0 : below;
        color_vertex(mesh, i, cutter->below[i] > 0);
    }
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i += 3) {
        const uint32_t* corner = mesh->triangles + i;
        for (int k = 0; k < 3; ++k)
            crossed += cutter->below[corner[k]] * cutter->below[corner[(k + 1) % 3]] < 0;
    }
    max += 2 * crossed;
    cutter->triangles = malloc((mesh->triangle_count + crossed) * 3 * sizeof(uint32_t));
    return cutter->triangles && widen(&mesh->positions, max) && widen(&mesh->normals, max) &&
           widen(&mesh->colors, max);
}

int head_cut_collar(struct head_mesh* mesh)
{
    struct cutter cutter = {.mesh = mesh};
    int fits = make_room(&cutter);
    if (fits) {
        cut(&cutter);
        free(mesh->triangles);
        mesh->triangles = cutter.triangles;
        mesh->triangle_count = cutter.triangle_count;
    } else {
        free(cutter.triangles);
    }
    free(cutter.twin);
    free(cutter.below);
    return fits ? 0 : -1;
}
