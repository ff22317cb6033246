// heads.h - ten small heads of hair in motion, one per subject. Hashes compare their states.
#ifndef HAIR_TESTS_SUPPORT_HEADS_H
#define HAIR_TESTS_SUPPORT_HEADS_H

#include <hair/hair.h>

#define HAIR_TEST_HEADS 10 // Number of kinds.

// One kind of head. Instances of a kind share its groom.
struct hair_test_head_kind {
    const char* name;
    hair_solver solver;
    hair_groom* groom;
    float* scalp; // Positions of the scalp at rest, if the kind skins it. NULL otherwise.
    uint32_t scalp_vertices;
};

// Make all kinds on the CPU. No function of this file calls cmocka, so that threads may call them.
hair_result hair_test_head_kinds_make(const hair_host* host,
                                      struct hair_test_head_kind kinds[HAIR_TEST_HEADS]);
void hair_test_head_kinds_free(struct hair_test_head_kind kinds[HAIR_TEST_HEADS]);

// A head whose i-th step depends on i only.
struct hair_test_head {
    const struct hair_test_head_kind* kind;
    uint32_t number; // index of the kind
    uint32_t steps; // number of steps done
    hair_instance* hair;
};

hair_result hair_test_head_create(hair_context* context, const struct hair_test_head_kind* kinds,
                                  uint32_t number, struct hair_test_head* out);
// Move the head, its colliders, pins and scalp, and step by 1/60 s.
hair_result hair_test_head_step(struct hair_test_head* head);
hair_result hair_test_head_steps(struct hair_test_head* head, uint32_t count);
// Compute a hash of the saved state and of the vertices of followers.
hair_result hair_test_head_hash(const struct hair_test_head* head, uint64_t* hash);
// Replace the instance by a new one with the saved state of the old one.
hair_result hair_test_head_renew(struct hair_test_head* head, hair_context* context,
                                 const struct hair_test_head_kind* kinds);

#endif
