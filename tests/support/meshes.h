// meshes.h - closed triangle meshes, counter-clockwise from outside.
#ifndef HAIR_TESTS_SUPPORT_MESHES_H
#define HAIR_TESTS_SUPPORT_MESHES_H

#include "tests/support/support.h"

#include <stdint.h>

struct hair_test_mesh {
    float* positions;
    uint32_t* triangles;
    uint32_t vertex_count, triangle_count;
};

struct hair_test_mesh hair_test_box_mesh(const float half[3]);

// Return a ball with poles on y. Its vertices lie on the sphere.
struct hair_test_mesh hair_test_ball_mesh(float radius, uint32_t rows, uint32_t columns);

void hair_test_mesh_append(struct hair_test_mesh* mesh, const struct hair_test_mesh* other, int inside_out);
void hair_test_mesh_free(struct hair_test_mesh* mesh);

// Return a collision mesh with `resolution` voxels along its longest side. Free the given mesh.
hair_collision_mesh* hair_test_collision_mesh(struct hair_test* test, struct hair_test_mesh mesh,
                                              uint32_t resolution);

#endif
