// head.c - Mesh of the bust by surface nets, and its colliders.
// Based on Gibson 1998, "Constrained elastic surface nets". Each cell that the surface crosses gets
// one vertex, which is projected onto the surface here instead of being relaxed.
#include "tools/common/head.h"
#include "tools/common/head_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COLLAR_REACH 0.0026f // Half the grid spacing at the collar, m.
#define BLOCK 4 // Grid points per side of a block that is skipped when far from the surface.

typedef struct head_point point;

struct axis {
    float at[256];
    uint32_t count;
};

struct net {
    struct axis axis[3];
    float* distance; // at each grid point
    uint32_t* vertex; // index + 1 of each cell's vertex, 0 if the cell has none
    struct head_mesh* mesh;
    uint32_t vertex_capacity, triangle_capacity;
};

// A range of an axis whose grid planes are `spacing` apart. Outside the range the spacing grows by
// an eighth of the distance.
struct stretch {
    float from, to, spacing; // m
};

#define COARSEST 0.010f

static float spacing_at(const struct stretch* stretch, uint32_t count, float at)
{
    float spacing = COARSEST;
    for (uint32_t i = 0; i < count; ++i) {
        float out = fmaxf(fmaxf(stretch[i].from - at, at - stretch[i].to), 0);
        spacing = fminf(spacing, stretch[i].spacing + 0.125f * out);
    }
    return spacing;
}

static void make_axis(struct axis* axis, float from, float to, const struct stretch* stretch, uint32_t count)
{
    axis->count = 0;
    for (float at = from; at < to && axis->count < 255; at += spacing_at(stretch, count, at))
        axis->at[axis->count++] = at;
    axis->at[axis->count++] = to;
}

static size_t index_of(const struct net* net, uint32_t i, uint32_t j, uint32_t k)
{
    return ((size_t)k * net->axis[1].count + j) * net->axis[0].count + i;
}

static point grid_point(const struct net* net, uint32_t i, uint32_t j, uint32_t k)
{
    return (point){net->axis[0].at[i], net->axis[1].at[j], net->axis[2].at[k]};
}

static uint32_t min(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static void measure_block(struct net* net, uint32_t i0, uint32_t j0, uint32_t k0)
{
    uint32_t i1 = min(i0 + BLOCK, net->axis[0].count), j1 = min(j0 + BLOCK, net->axis[1].count);
    uint32_t k1 = min(k0 + BLOCK, net->axis[2].count);
    point a = grid_point(net, i0, j0, k0), b = grid_point(net, i1 - 1, j1 - 1, k1 - 1);
    point middle = {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    float reach = sqrtf((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y) + (b.z - a.z) * (b.z - a.z));
    float far = head_distance(middle);
    // The threshold is twice the radius, because the distance is only a bound, plus the step from
    // block to block.
    int skip = fabsf(far) > reach + 0.012f;
    for (uint32_t k = k0; k < k1; ++k)
        for (uint32_t j = j0; j < j1; ++j)
            for (uint32_t i = i0; i < i1; ++i)
                net->distance[index_of(net, i, j, k)] = skip ? far : head_distance(grid_point(net, i, j, k));
}

// Compute the gradient from four points of a tetrahedron around p (Quilez).
static point gradient(point p)
{
    const float h = 3e-4f;
    float a = head_distance((point){p.x + h, p.y - h, p.z - h});
    float b = head_distance((point){p.x - h, p.y - h, p.z + h});
    float c = head_distance((point){p.x - h, p.y + h, p.z - h});
    float d = head_distance((point){p.x + h, p.y + h, p.z + h});
    return (point){(a - b - c + d) / (4 * h), (c + d - a - b) / (4 * h), (b + d - a - c) / (4 * h)};
}

static int grow(void** memory, uint32_t* capacity, uint32_t count, size_t size)
{
    if (count < *capacity) return 0;
    void* more = realloc(*memory, (size_t)*capacity * 2 * size);
    if (!more) return -1;
    *memory = more;
    return 1;
}

// Compute the mean of the surface's intersections with the cell's edges. Return 0 if there are
// none.
static int cross_cell(const struct net* net, uint32_t i, uint32_t j, uint32_t k, point* out)
{
    float d[8];
    uint32_t inside = 0;
    for (uint32_t c = 0; c < 8; ++c) {
        d[c] = net->distance[index_of(net, i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))];
        inside += d[c] < 0;
    }
    if (inside == 0 || inside == 8) return 0;
    point sum = {0, 0, 0};
    float count = 0;
    for (uint32_t c = 0; c < 8; ++c)
        for (uint32_t bit = 1; bit < 8; bit <<= 1) {
            uint32_t e = c | bit;
            if (e == c || (d[c] < 0) == (d[e] < 0)) continue;
            float t = d[c] / (d[c] - d[e]);
            point p = grid_point(net, i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
            point q = grid_point(net, i + (e & 1), j + (e >> 1 & 1), k + (e >> 2));
            sum = (point){sum.x + p.x + (q.x - p.x) * t, sum.y + p.y + (q.y - p.y) * t,
                          sum.z + p.z + (q.z - p.z) * t};
            ++count;
        }
    *out = (point){sum.x / count, sum.y / count, sum.z / count};
    return 1;
}

// Take one step of Newton's method, limited to the cell's neighbourhood.
static point onto_surface(point p)
{
    point g = gradient(p);
    float square = fmaxf(g.x * g.x + g.y * g.y + g.z * g.z, 0.25f);
    float step = fminf(fmaxf(head_distance(p) / square, -0.002f), 0.002f);
    return (point){p.x - g.x * step, p.y - g.y * step, p.z - g.z * step};
}

// Slide a vertex near the collar onto the collar, so that the garment's edge is a smooth line.
static point onto_collar(point p)
{
    float below = head_below_collar(p);
    if (fabsf(below) > COLLAR_REACH) return p;
    const float h = 1e-3f;
    point n = gradient(p);
    point c = {(head_below_collar((point){p.x + h, p.y, p.z}) - below) / h,
               (head_below_collar((point){p.x, p.y + h, p.z}) - below) / h,
               (head_below_collar((point){p.x, p.y, p.z + h}) - below) / h};
    float along = (c.x * n.x + c.y * n.y + c.z * n.z) / fmaxf(n.x * n.x + n.y * n.y + n.z * n.z, 0.25f);
    c = (point){c.x - n.x * along, c.y - n.y * along, c.z - n.z * along};
    float step = below / fmaxf(c.x * c.x + c.y * c.y + c.z * c.z, 0.3f);
    return onto_surface((point){p.x - c.x * step, p.y - c.y * step, p.z - c.z * step});
}

static void put_vertex(struct head_mesh* mesh, uint32_t vertex, point p)
{
    p = onto_collar(onto_surface(p));
    point g = gradient(p);
    float size = fmaxf(sqrtf(g.x * g.x + g.y * g.y + g.z * g.z), 1e-6f);
    memcpy(mesh->positions + 3 * vertex, &p, sizeof p);
    g = (point){g.x / size, g.y / size, g.z / size};
    memcpy(mesh->normals + 3 * vertex, &g, sizeof g);
}

static int grow_vertices(struct net* net)
{
    struct head_mesh* mesh = net->mesh;
    uint32_t count = mesh->vertex_count;
    int grew = grow((void**)&mesh->positions, &net->vertex_capacity, count, 3 * sizeof(float));
    if (grew <= 0) return grew;
    if (grow((void**)&mesh->normals, &net->vertex_capacity, count, 3 * sizeof(float)) < 0) return -1;
    if (grow((void**)&mesh->colors, &net->vertex_capacity, count, 3 * sizeof(float)) < 0) return -1;
    net->vertex_capacity *= 2;
    return 0;
}

static int place_vertices(struct net* net)
{
    for (uint32_t k = 0; k + 1 < net->axis[2].count; ++k)
        for (uint32_t j = 0; j + 1 < net->axis[1].count; ++j)
            for (uint32_t i = 0; i + 1 < net->axis[0].count; ++i) {
                point p;
                if (!cross_cell(net, i, j, k, &p)) continue;
                if (grow_vertices(net)) return -1;
                put_vertex(net->mesh, net->mesh->vertex_count, p);
                net->vertex[index_of(net, i, j, k)] = ++net->mesh->vertex_count;
            }
    return 0;
}

// Add two triangles that connect the four cells around a grid edge that the surface crosses.
static int add_square(struct net* net, const uint32_t corner[4], int flip)
{
    struct head_mesh* mesh = net->mesh;
    int grew = grow((void**)&mesh->triangles, &net->triangle_capacity, mesh->triangle_count + 1,
                    3 * sizeof(uint32_t));
    if (grew < 0) return -1;
    if (grew) net->triangle_capacity *= 2;
    const uint32_t order[2][6] = {{0, 1, 2, 0, 2, 3}, {0, 2, 1, 0, 3, 2}};
    for (int i = 0; i < 6; ++i)
        mesh->triangles[3 * mesh->triangle_count + (uint32_t)i] = corner[order[flip][i]] - 1;
    mesh->triangle_count += 2;
    return 0;
}

static int join_edge(struct net* net, const uint32_t at[3], uint32_t a)
{
    uint32_t b = (a + 1) % 3, c = (a + 2) % 3;
    if (at[b] == 0 || at[c] == 0 || at[a] + 1 >= net->axis[a].count) return 0;
    if (at[b] + 1 >= net->axis[b].count || at[c] + 1 >= net->axis[c].count) return 0;
    uint32_t end[3] = {at[0], at[1], at[2]};
    ++end[a];
    int inside = net->distance[index_of(net, at[0], at[1], at[2])] < 0;
    if (inside == (net->distance[index_of(net, end[0], end[1], end[2])] < 0)) return 0;
    uint32_t corner[4];
    for (uint32_t i = 0; i < 4; ++i) { // around the edge, counter-clockwise seen from its end
        uint32_t cell[3] = {at[0], at[1], at[2]};
        cell[b] -= i == 0 || i == 3;
        cell[c] -= i == 0 || i == 1;
        corner[i] = net->vertex[index_of(net, cell[0], cell[1], cell[2])];
    }
    return add_square(net, corner, !inside);
}

static int join_vertices(struct net* net)
{
    for (uint32_t k = 0; k < net->axis[2].count; ++k)
        for (uint32_t j = 0; j < net->axis[1].count; ++j)
            for (uint32_t i = 0; i < net->axis[0].count; ++i)
                for (uint32_t a = 0; a < 3; ++a)
                    if (join_edge(net, (const uint32_t[3]){i, j, k}, a)) return -1;
    return 0;
}

static int build(struct net* net)
{
    for (uint32_t k = 0; k < net->axis[2].count; k += BLOCK)
        for (uint32_t j = 0; j < net->axis[1].count; j += BLOCK)
            for (uint32_t i = 0; i < net->axis[0].count; i += BLOCK) measure_block(net, i, j, k);
    return place_vertices(net) || join_vertices(net) ? -1 : 0;
}

int head_mesh_create(struct head_mesh* out)
{
    struct head_mesh mesh = {0};
    struct net net = {.mesh = &mesh, .vertex_capacity = 1 << 14, .triangle_capacity = 1 << 15};
    // Fine ranges cover the face (eyes, nose and mouth) and the ears.
    const struct stretch x[] = {{-0.048f, 0.048f, 0.0023f}, {-0.090f, 0.090f, 0.0036f}};
    const struct stretch y[] = {{1.604f, 1.616f, 0.0014f},
                                {1.546f, 1.560f, 0.0018f},
                                {1.510f, 1.645f, 0.0030f},
                                {1.400f, 1.450f, 0.0042f}};
    const struct stretch z[] = {{0.075f, 0.110f, 0.0026f}, {-0.030f, 0.100f, 0.0042f}};
    make_axis(&net.axis[0], -0.235f, 0.235f, x, 2);
    make_axis(&net.axis[1], HEAD_BOTTOM - 0.004f, 1.740f, y, 4);
    make_axis(&net.axis[2], -0.150f, 0.135f, z, 2);

    size_t points = (size_t)net.axis[0].count * net.axis[1].count * net.axis[2].count;
    net.distance = malloc(points * sizeof(float));
    net.vertex = calloc(points, sizeof(uint32_t));
    mesh.positions = malloc((size_t)net.vertex_capacity * 3 * sizeof(float));
    mesh.normals = malloc((size_t)net.vertex_capacity * 3 * sizeof(float));
    mesh.colors = malloc((size_t)net.vertex_capacity * 3 * sizeof(float));
    mesh.triangles = malloc((size_t)net.triangle_capacity * 3 * sizeof(uint32_t));
    int failed =
        !net.distance || !net.vertex || !mesh.positions || !mesh.normals || !mesh.colors || !mesh.triangles;
    failed = failed || build(&net) || head_cut_collar(&mesh);
    free(net.vertex);
    free(net.distance);
    if (failed)
        head_mesh_free(&mesh);
    else
        *out = mesh;
    return failed ? -1 : 0;
}

void head_mesh_free(struct head_mesh* mesh)
{
    free(mesh->triangles);
    free(mesh->colors);
    free(mesh->normals);
    free(mesh->positions);
    memset(mesh, 0, sizeof *mesh);
}

// Colliders ---------------------------------------------------------------------------------------

struct pill {
    point a, b; // ends of its axis
    float radius;
};

// Capsules of the bust. The skull's capsules have equal end spheres inscribed in its ellipsoid, all
// in the plane of symmetry. A random search minimized the gap to the ellipsoid. The gap is at most
// 2.7 mm, and the capsules extend at most 0.4 mm outside.
static const struct pill pills[] = {
    {{0, 1.6606f, -0.0011f}, {0, 1.6047f, 0.0158f}, 0.0668f},
    {{0, 1.6367f, -0.0289f}, {0, 1.6119f, -0.0245f}, 0.0661f},
    {{0, 1.6206f, 0.0240f}, {0, 1.6391f, 0.0241f}, 0.0693f},
    {{0, 1.6341f, -0.0179f}, {0, 1.6112f, -0.0063f}, 0.0731f},
    {{0, 1.6552f, 0.0161f}, {0, 1.6540f, -0.0175f}, 0.0670f},
    {{0, 1.6373f, -0.0014f}, {0, 1.6291f, 0.0068f}, 0.0768f},
    {{-0.035f, 1.634f, 0.048f}, {0.035f, 1.634f, 0.048f}, 0.031f}, // temples
    {{-0.018f, 1.574f, 0.043f}, {0.018f, 1.574f, 0.043f}, 0.042f}, // cheeks
    {{-0.010f, 1.535f, 0.060f}, {0.010f, 1.535f, 0.060f}, 0.028f}, // chin
    {{-0.073f, 1.602f, -0.010f}, {0.073f, 1.602f, -0.010f}, 0.016f}, // ears
    {{0, 1.380f, -0.030f}, {0, 1.550f, -0.004f}, 0.047f}, // neck
    {{-0.045f, 1.424f, -0.036f}, {-0.150f, 1.365f, -0.018f}, 0.054f}, // shoulders
    {{0.045f, 1.424f, -0.036f}, {0.150f, 1.365f, -0.018f}, 0.054f},
    {{-0.100f, 1.372f, 0.014f}, {0.100f, 1.372f, 0.014f}, 0.055f}, // collar bones
    {{-0.085f, 1.360f, -0.040f}, {0.085f, 1.360f, -0.040f}, 0.066f}, // back
    {{-0.075f, 1.316f, 0.014f}, {0.075f, 1.316f, 0.014f}, 0.080f}, // chest
};

_Static_assert(sizeof pills / sizeof *pills <= HEAD_COLLIDERS, "head.h promises how many colliders suffice");

static hair_collider collider_of(const struct pill* pill)
{
    point a = pill->a, b = pill->b, d = {b.x - a.x, b.y - a.y, b.z - a.z};
    float size = sqrtf(d.x * d.x + d.y * d.y + d.z * d.z);
    // Smallest rotation from +y, Euler-Rodrigues.
    float w = 1 + d.y / size, x = d.z / size, z = -d.x / size;
    if (w < 1e-6f) w = 0, x = 1, z = 0; // half a turn
    float norm = sqrtf(w * w + x * x + z * z);
    hair_collider collider = {HAIR_SHAPE_CAPSULE,
                              {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2},
                              {x / norm, 0, z / norm, w / norm},
                              {pill->radius, size / 2},
                              .scale = 1,
                              .friction = 1};
    return collider;
}

uint32_t head_colliders(hair_collider* out, uint32_t capacity)
{
    const uint32_t count = sizeof pills / sizeof *pills;
    for (uint32_t i = 0; i < count && i < capacity; ++i) out[i] = collider_of(&pills[i]);
    return count;
}
