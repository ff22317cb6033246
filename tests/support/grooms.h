// grooms.h - strands and scalps from which grooms are made, and followers evaluated as they are
// drawn.
#ifndef HAIR_TESTS_SUPPORT_GROOMS_H
#define HAIR_TESTS_SUPPORT_GROOMS_H

#include "lib/base/math.h"
#include "lib/groom/groom.h"
#include "lib/groom/guide_spline.h"
#include "tests/support/host.h"

struct hair_test_strands {
    float* positions;
    uint32_t* vertices;
    uint32_t count, vertex_count;
    const uint8_t* groups; // Groups of the strands. NULL puts all into group 0.
    const hair_strand_attribute* attributes;
    uint32_t attribute_count;
    const struct hair_test_scalp* scalp; // Scalp for maps of attributes, or NULL.
};

// Return an empty list with room for `count` strands of at most `max` vertices.
struct hair_test_strands hair_test_strands_make(uint32_t count, uint32_t max);
void hair_test_strands_free(struct hair_test_strands* strands);
// Add a strand of `vertices` vertices, at point(t) for t from 0 to 1.
void hair_test_strands_add(struct hair_test_strands* strands, uint32_t vertices,
                           hair_vec3 (*point)(float t, uint32_t strand, const void* user), const void* user);

// Return fur: leaning strands of about 20 mm and 3 to 8 vertices, scattered over a square of one
// metre.
struct hair_test_strands hair_test_fur(uint32_t count);

// A square scalp of `cells` by `cells` squares of two triangles, `size` m wide, at y = 0 and facing
// up.
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

// Create a groom. The test fails if this fails.
hair_groom* hair_test_groom_of(const hair_groom_desc* desc);
// Check that creation refuses a groom with one error, whose sentence has `words`. Forget the error.
void hair_test_refuse_groom(struct hair_test_host* test, const hair_groom_desc* desc, const char* words);

static inline hair_vec3 hair_test_xyz(hair_vec4 v)
{
    return hair_v3(v.x, v.y, v.z);
}

// Return a point at rest of a follower with a shape of its own, like glsl/strands/shape.glsl.
hair_vec3 hair_test_own(const struct hair_groom* groom, const struct hair_follower* follower, float t);
// Return a point at rest of a follower by its guide 0 alone, like glsl/strands/follower.glsl with a
// look that adds nothing. A follower with a shape of its own has that shape.
hair_vec3 hair_test_single(const struct hair_groom* groom, const struct hair_follower* follower, float t);
// Return a point of a follower between its three guides, like glsl/strands/follower.glsl with a
// look that adds nothing.
hair_vec3 hair_test_multi(const struct hair_groom* groom, const struct hair_follower* follower, float t);

#endif
