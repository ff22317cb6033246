// meshes.c - closed triangle meshes.
#include "tests/support/meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct hair_test_mesh make(uint32_t vertices, uint32_t triangles)
{
    struct hair_test_mesh mesh = {malloc(vertices * 3 * sizeof(float)),
                                  malloc(triangles * 3 * sizeof(uint32_t)), vertices, triangles};
    return mesh;
}

struct hair_test_mesh hair_test_box_mesh(const float half[3])
{
    static const uint32_t triangles[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    struct hair_test_mesh mesh = make(8, 12);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) mesh.positions[3 * i + k] = i >> k & 1 ? half[k] : -half[k];
    memcpy(mesh.triangles, triangles, sizeof triangles);
    return mesh;
}

static uint32_t ball_vertex(uint32_t rows, uint32_t columns, uint32_t row, uint32_t column)
{
    return row == 0 ? 0 : row == rows ? 1 : 2 + (row - 1) * columns + column % columns;
}

struct hair_test_mesh hair_test_ball_mesh(float radius, uint32_t rows, uint32_t columns)
{
    struct hair_test_mesh mesh = make(2 + (rows - 1) * columns, 2 * (rows - 1) * columns);
    uint32_t* out = mesh.triangles;
    const double pi = 3.14159265358979;
    for (uint32_t row = 0; row <= rows; ++row)
        for (uint32_t column = 0; column < columns; ++column) {
            double polar = pi * row / rows, turn = 2 * pi * column / columns;
            float* at = mesh.positions + 3 * ball_vertex(rows, columns, row, column);
            at[0] = (float)((double)radius * sin(polar) * sin(turn));
            at[1] = (float)((double)radius * cos(polar));
            at[2] = (float)((double)radius * sin(polar) * cos(turn));
            if (row == rows) continue;
            uint32_t a = ball_vertex(rows, columns, row, column),
                     b = ball_vertex(rows, columns, row + 1, column),
                     c = ball_vertex(rows, columns, row, column + 1),
                     d = ball_vertex(rows, columns, row + 1, column + 1);
            if (row > 0) *out++ = a, *out++ = b, *out++ = c;
            if (row + 1 < rows) *out++ = c, *out++ = b, *out++ = d;
        }
    return mesh;
}

void hair_test_mesh_append(struct hair_test_mesh* mesh, const struct hair_test_mesh* other, int inside_out)
{
    struct hair_test_mesh both =
        make(mesh->vertex_count + other->vertex_count, mesh->triangle_count + other->triangle_count);
    memcpy(both.positions, mesh->positions, mesh->vertex_count * 3 * sizeof(float));
    memcpy(both.positions + 3 * mesh->vertex_count, other->positions,
           other->vertex_count * 3 * sizeof(float));
    memcpy(both.triangles, mesh->triangles, mesh->triangle_count * 3 * sizeof(uint32_t));
    for (uint32_t i = 0; i < 3 * other->triangle_count; ++i) {
        uint32_t from = inside_out ? i - i % 3 + 2 - i % 3 : i;
        both.triangles[3 * mesh->triangle_count + i] = mesh->vertex_count + other->triangles[from];
    }
    hair_test_mesh_free(mesh);
    *mesh = both;
}

void hair_test_mesh_free(struct hair_test_mesh* mesh)
{
    free(mesh->positions);
    free(mesh->triangles);
    memset(mesh, 0, sizeof *mesh);
}

hair_collision_mesh* hair_test_collision_mesh(struct hair_test* test, struct hair_test_mesh mesh,
                                              uint32_t resolution)
{
    hair_collision_mesh* collision_mesh = NULL;
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    desc.host = &test->host.host;
    desc.positions = mesh.positions;
    desc.triangles = mesh.triangles;
    desc.vertex_count = mesh.vertex_count;
    desc.triangle_count = mesh.triangle_count;
    desc.resolution = resolution;
    hair_test_ok(test, hair_collision_mesh_create(&desc, &collision_mesh));
    hair_test_mesh_free(&mesh);
    return collision_mesh;
}
