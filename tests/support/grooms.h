// grooms.h - strands and scalps to make grooms of, and followers evaluated as they are drawn.
#ifndef HAIR_TESTS_SUPPORT_GROOMS_H
#define HAIR_TESTS_SUPPORT_GROOMS_H

#include "lib/base/math.h"
#include "lib/groom/groom.h"
#include "lib/groom/smoothed.h"
#include "tests/support/host.h"

struct hair_test_strands {
    float* positions;
    uint32_t* vertices;
    uint32_t count, vertex_count;
};

// Empty, with room for `count` strands of at most `most` vertices.
struct hair_test_strands hair_test_strands_make(uint32_t count, uint32_t most);
void hair_test_strands_free(struct hair_test_strands* strands);
// Another strand, of `vertices`, with point(t) at t from 0 to 1.
void hair_test_strands_add(struct hair_test_strands* strands, uint32_t vertices,
                           hair_vec3 (*point)(float t, uint32_t strand, const void* user), const void* user);

// Fur: leaning strands about 20 mm long, strewn over a square of one metre, of 3 to 8 vertices.
struct hair_test_strands hair_test_fur(uint32_t count);

// A square scalp of `cells` by `cells` squares of two triangles, `size` m wide, at y = 0, facing up.
struct hair_test_scalp {
    float* positions;
    uint32_t* triangles;
    uint32_t vertex_count, triangle_count;
};
struct hair_test_scalp hair_test_scalp_make(uint32_t cells, float size);
void hair_test_scalp_free(struct hair_test_scalp* scalp);

hair_groom_desc hair_test_groom_desc(const struct hair_test_host* host,
                                     const struct hair_test_strands* strands);
void hair_test_set_scalp(hair_groom_desc* desc, const struct hair_test_scalp* scalp);

// As glsl/follower.glsl, of a look that adds nothing: following guide 0 alone, or between its three guides.
hair_vec3 hair_test_single(const struct hair_groom* groom, const struct hair_follower* follower, float t);
hair_vec3 hair_test_multi(const struct hair_groom* groom, const struct hair_follower* follower, float t);

#endif
