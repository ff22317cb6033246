// deforming.c - a closed mesh that deforms, and the body of it.
#include "tests/support/deforming.h"

#include <math.h>
#include <stdlib.h>

#include "lib/api/api.h"

struct hair_test_mesh hair_test_lump(uint32_t rows, uint32_t columns, float phase, int crossed)
{
    struct hair_test_mesh mesh = hair_test_ball_mesh(1, rows, columns);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        float *p = mesh.positions + 3 * i, around = atan2f(p[0], p[2]), side = hypotf(p[0], p[2]);
        float polar = atan2f(side, p[1]);
        float radius = 0.1f * (1 + 0.25f * sinf(3 * around + phase) * side * side +
                               0.1f * cosf(4 * polar) * cosf(phase));
        float width = crossed ? radius * cosf(6 * polar) : radius;
        p[0] *= width, p[1] *= radius, p[2] *= radius;
    }
    return mesh;
}

hair_body_desc hair_test_body_desc(const struct hair_test_mesh* mesh, float far, uint32_t resolution)
{
    hair_body_desc desc = hair_body_desc_default();
    desc.positions = mesh->positions;
    desc.triangles = mesh->triangles;
    desc.vertex_count = mesh->vertex_count;
    desc.triangle_count = mesh->triangle_count;
    desc.resolution = resolution;
    for (int k = 0; k < 3; ++k) desc.lower[k] = -far, desc.upper[k] = far;
    return desc;
}

hair_body* hair_test_deforming(struct hair_test* test, const struct hair_test_mesh* mesh, float far,
                               uint32_t resolution)
{
    hair_body_desc desc = hair_test_body_desc(mesh, far, resolution);
    hair_body* body = NULL;
    hair_test_ok(test, hair_body_create(test->context, &desc, &body));
    return body;
}

void hair_test_deform(struct hair_test* test, hair_body* body, const struct hair_test_mesh* mesh)
{
    hair_test_ok(test, hair_body_set_positions(body, mesh->positions, mesh->vertex_count, 12));
}

float* hair_test_body_nodes(const hair_body* body)
{
    const struct hair_sdf_pool* pool = body->grid.pool;
    size_t nodes = (size_t)body->mesh->size[0] * body->mesh->size[1] * body->mesh->size[2];
    float* out = malloc(nodes * sizeof *out);
    assert_non_null(out);
    glGetNamedBufferSubData(pool->nodes, (GLintptr)(pool->pooled[body->grid.place].first * sizeof *out),
                            (GLsizeiptr)(nodes * sizeof *out), out);
    return out;
}

struct hair_triangles hair_test_triangles(struct hair_test* test, const struct hair_test_mesh* mesh)
{
    struct hair_triangles triangles = {0};
    hair_test_ok(test, hair_triangles_build(&test->host.host, mesh->positions, mesh->triangles,
                                            mesh->triangle_count, &triangles));
    return triangles;
}

double hair_test_exact(struct hair_triangles* triangles, const double point[3])
{
    hair_vec3 at = {(float)(point[0] - (double)triangles->center.x),
                    (float)(point[1] - (double)triangles->center.y),
                    (float)(point[2] - (double)triangles->center.z)};
    float distance = INFINITY;
    uint32_t nearest = UINT32_MAX;
    hair_triangles_find(triangles, at, &distance, &nearest);
    return fabsf(hair_triangles_winding(triangles, at)) > 0.5f ? -(double)distance : (double)distance;
}

double hair_test_depth_in_body(const struct hair_test_living* living, struct hair_triangles* triangles,
                               const hair_collider* collider)
{
    double deepest = -INFINITY;
    for (uint32_t i = 1; i < living->vertices; ++i) {
        double at[3];
        for (int k = 0; k < 3; ++k)
            at[k] = (double)living->positions[3 * i + (uint32_t)k] - (double)collider->position[k];
        deepest = fmax(deepest, -hair_test_exact(triangles, at));
    }
    return deepest;
}
