// head.c - Mesh of the bust, and its colliders.
#include "tools/common/head.h"
#include "tools/common/head_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/bust.inl"

typedef struct head_point point;

// First vertex and first face of each part in bust.inl, and the numbers of them.
static const struct {
    uint32_t vertex, vertices, face, faces;
} ranges[HEAD_PARTS] = BUST_PARTS;

// Skin, garment -----------------------------------------------------------------------------------

int head_load_part(enum head_part part, struct head_surface* out)
{
    uint32_t first_vertex = ranges[part].vertex, first_face = ranges[part].face;
    out->vertices = malloc(ranges[part].vertices * sizeof *out->vertices);
    out->faces = malloc(ranges[part].faces * sizeof *out->faces);
    if (!out->vertices || !out->faces) return -1;
    out->vertex_count = ranges[part].vertices, out->face_count = ranges[part].faces;
    for (uint32_t i = 0; i < out->vertex_count; ++i) {
        const int16_t* p = bust_positions[first_vertex + i];
        const uint8_t* paint = bust_paint[first_vertex + i];
        const float values[HEAD_VALUES] = {1e-5f * (float)p[0], 1.45f + 1e-5f * (float)p[1],
                                           1e-5f * (float)p[2], (float)paint[0] / 255, (float)paint[1] / 255};
        memcpy(out->vertices[i], values, sizeof values);
    }
    for (uint32_t i = 0; i < out->face_count; ++i)
        for (uint32_t k = 0; k < 4; ++k) {
            uint16_t corner = bust_faces[first_face + i][k];
            out->faces[i][k] = corner == UINT16_MAX ? HEAD_NO_CORNER : corner - first_vertex;
        }
    return 0;
}

static point point_of(const float* p)
{
    return (point){p[0], p[1], p[2]};
}

static struct head_paint paint_of(enum head_part part, const float* values)
{
    static const struct head_paint cloth = {{0.030f, 0.036f, 0.048f}, 0, 0, 1};
    if (part == HEAD_SKIN) return head_paint_skin(point_of(values), values[3], values[4]);
    struct head_paint paint = cloth;
    paint.open = values[4];
    return paint;
}

// Set normals to the mean of the triangles around each vertex from `first_vertex` on, by area.
static void find_normals(struct head_mesh* mesh, uint32_t first_vertex, uint32_t first_triangle)
{
    for (uint32_t i = first_triangle; i < mesh->triangle_count; ++i) {
        const uint32_t* corner = mesh->triangles + 3 * (size_t)i;
        point a = point_of(mesh->positions + 3 * corner[0]), b = point_of(mesh->positions + 3 * corner[1]);
        point n = head_cross(head_add(b, a, -1), head_add(point_of(mesh->positions + 3 * corner[2]), a, -1));
        for (int k = 0; k < 3; ++k) {
            float* to = mesh->normals + 3 * corner[k];
            to[0] += n.x, to[1] += n.y, to[2] += n.z;
        }
    }
    for (uint32_t i = first_vertex; i < mesh->vertex_count; ++i) {
        point n = head_unit(point_of(mesh->normals + 3 * i));
        memcpy(mesh->normals + 3 * i, &n, sizeof n);
    }
}

static void put_part(struct head_builder* builder, enum head_part part)
{
    struct head_surface surface = {0};
    // Skin is finer, for the sake of lids, lips and the paint of the hairline.
    builder->failed |= head_load_part(part, &surface) || head_subdivide(&surface) ||
                       (part == HEAD_SKIN && head_subdivide(&surface));
    uint32_t first = builder->mesh.vertex_count, triangles = builder->mesh.triangle_count;
    for (uint32_t i = 0; i < surface.vertex_count && !builder->failed; ++i) {
        point p = point_of(surface.vertices[i]);
        struct head_paint paint = paint_of(part, surface.vertices[i]);
        head_put_vertex(builder, part == HEAD_SKIN ? head_on_skull(p) : p, (point){0, 0, 0}, &paint);
    }
    for (uint32_t i = 0; i < surface.face_count; ++i) {
        const uint32_t* face = surface.faces[i];
        head_put_triangle(builder, first + face[0], first + face[1], first + face[2]);
        head_put_triangle(builder, first + face[0], first + face[2], first + face[3]);
    }
    if (!builder->failed) find_normals(&builder->mesh, first, triangles);
    head_surface_free(&surface);
}

int head_mesh_create(const struct head_tie* tie, struct head_mesh* out)
{
    struct head_builder builder = {0};
    for (enum head_part part = HEAD_SKIN; part < HEAD_PARTS && !builder.failed; ++part)
        put_part(&builder, part);
    head_put_eyes(&builder);
    if (tie) head_put_tie(&builder, tie);
    uint32_t coarse = builder.mesh.triangle_count;
    head_put_brows(&builder);
    head_put_lashes(&builder);
    head_put_fringe(&builder, tie != NULL);
    builder.mesh.fine_count = builder.mesh.triangle_count - coarse;
    if (builder.failed)
        head_mesh_free(&builder.mesh);
    else
        *out = builder.mesh;
    return builder.failed ? -1 : 0;
}

void head_mesh_free(struct head_mesh* mesh)
{
    free(mesh->triangles);
    free(mesh->surface);
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
    {{-0.018f, 1.574f, 0.043f}, {0.018f, 1.574f, 0.043f}, 0.038f}, // cheeks
    {{-0.010f, 1.535f, 0.060f}, {0.010f, 1.535f, 0.060f}, 0.028f}, // chin
    {{-0.073f, 1.602f, -0.010f}, {0.073f, 1.602f, -0.010f}, 0.016f}, // ears
    {{0, 1.390f, -0.035f}, {0, 1.550f, -0.018f}, 0.042f}, // neck
    {{-0.040f, 1.420f, -0.045f}, {-0.165f, 1.375f, -0.035f}, 0.050f}, // shoulders
    {{0.040f, 1.420f, -0.045f}, {0.165f, 1.375f, -0.035f}, 0.050f},
    {{-0.085f, 1.385f, -0.010f}, {0.085f, 1.385f, -0.010f}, 0.047f}, // collar bones
    {{-0.085f, 1.360f, -0.040f}, {0.085f, 1.360f, -0.040f}, 0.064f}, // back
    {{-0.060f, 1.312f, 0.018f}, {0.060f, 1.312f, 0.018f}, 0.068f}, // chest
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
