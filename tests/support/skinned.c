// skinned.c - hair on a scalp that an application skins.
#include "tests/support/skinned.h"

#include <math.h>
#include <string.h>

// Evaluate a strand upwards from the level scalp, at a slant.
static hair_vec3 strand(float t, uint32_t number, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(number);
    float step = HAIR_TEST_SCALP_SIDE / HAIR_TEST_SCALP_CELLS,
          x = HAIR_TEST_SCALP_SIDE * hair_random(&random), z = HAIR_TEST_SCALP_SIDE * hair_random(&random);
    hair_vec3 root = {x, 0, z};
    if (number < HAIR_TEST_SCALP_VERTICES)
        root = hair_v3(step * (float)(number % (HAIR_TEST_SCALP_CELLS + 1)), 0,
                       step * (float)(number / (HAIR_TEST_SCALP_CELLS + 1)));
    return hair_add(root, hair_v3(0.03f * t, 0.12f * t, 0.04f * t * t));
}

static hair_groom* make_groom(struct hair_test* test, float* rest)
{
    struct hair_test_strands strands = hair_test_strands_make(HAIR_TEST_SCALP_GUIDES, 10);
    struct hair_test_scalp scalp = hair_test_scalp_make(HAIR_TEST_SCALP_CELLS, HAIR_TEST_SCALP_SIDE);
    for (uint32_t i = 0; i < HAIR_TEST_SCALP_GUIDES; ++i) hair_test_strands_add(&strands, 10, strand, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    hair_test_set_scalp(&desc, &scalp);
    desc.follower_count = HAIR_TEST_SCALP_FOLLOWERS;
    hair_groom* groom = NULL;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    memcpy(rest, scalp.positions, 3 * HAIR_TEST_SCALP_VERTICES * sizeof *rest);
    hair_test_strands_free(&strands);
    hair_test_scalp_free(&scalp);
    return groom;
}

struct hair_test_skinned hair_test_skinned_make(struct hair_test* test, hair_solver solver,
                                                hair_thread_mapping mapping)
{
    struct hair_test_skinned s = {0};
    hair_desc desc = hair_desc_default();
    desc.thread_mapping = mapping;
    hair_look look = hair_look_default();
    look.strand.segments = HAIR_TEST_SCALP_SEGMENTS;
    // Rounding may decide whether a follower hits a collider.
    look.followers.collision = HAIR_FOLLOWER_COLLISION_NONE;
    desc.look = &look;
    desc.solver = solver;
    hair_groom* groom = make_groom(test, s.rest);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &s.hair));
    hair_groom_destroy(groom); // An instance keeps what it needs of the groom.
    memcpy(s.positions, s.rest, sizeof s.positions);
    return s;
}

void hair_test_skinned_set(struct hair_test* test, struct hair_test_skinned* s)
{
    hair_test_ok(test, hair_set_scalp(s->hair, s->positions, HAIR_TEST_SCALP_VERTICES, 12, NULL));
}

void hair_test_skinned_bulge(struct hair_test_skinned* s, float time)
{
    for (int i = 0; i < HAIR_TEST_SCALP_VERTICES; ++i) {
        s->positions[3 * i] = s->rest[3 * i] + 0.1f * time;
        s->positions[3 * i + 1] = 0.02f * sinf(20 * s->rest[3 * i] + 15 * s->rest[3 * i + 2] + 8 * time);
        s->positions[3 * i + 2] = s->rest[3 * i + 2] * (1 + 0.1f * sinf(5 * time));
    }
}
