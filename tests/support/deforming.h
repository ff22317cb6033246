// deforming.h - a closed mesh that deforms, its exact distance on the CPU, and the body of it.
#ifndef HAIR_TESTS_SUPPORT_DEFORMING_H
#define HAIR_TESTS_SUPPORT_DEFORMING_H

#include "tests/support/live_hair.h"
#include "tests/support/meshes.h"

#include "lib/collide/triangles.h"

// Return a lump of about 0.1 m. It breathes with `phase`. If `crossed` is not 0 it is turned inside
// out in bands, so that it crosses itself.
struct hair_test_mesh hair_test_lump(uint32_t rows, uint32_t columns, float phase, int crossed);

// Return the desc of a body of a mesh in a box that reaches `far` from the origin along each axis.
hair_body_desc hair_test_body_desc(const struct hair_test_mesh* mesh, float far, uint32_t resolution);
hair_body* hair_test_deforming(struct hair_test* test, const struct hair_test_mesh* mesh, float far,
                               uint32_t resolution);
void hair_test_deform(struct hair_test* test, hair_body* body, const struct hair_test_mesh* mesh);

// Read the distances of a body at its nodes from the GPU. Free them with free().
float* hair_test_body_nodes(const hair_body* body);

// Build the tree of a mesh, for hair_test_exact(). Free it with hair_triangles_free().
struct hair_triangles hair_test_triangles(struct hair_test* test, const struct hair_test_mesh* mesh);
// Return the exact signed distance of a point.
double hair_test_exact(struct hair_triangles* triangles, const double point[3]);
// Return the maximum depth of a vertex in the exact mesh of a collider without rotation, m.
double hair_test_depth_in_body(const struct hair_test_living* living, struct hair_triangles* triangles,
                               const hair_collider* collider);

#endif
