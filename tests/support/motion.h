// motion.h - heads of hair to which much happens, all of it from a seed, and everything that can be seen of them.
#ifndef HAIR_TESTS_SUPPORT_MOTION_H
#define HAIR_TESTS_SUPPORT_MOTION_H

#include "tests/support/support.h"

#include "lib/api/api.h"
#include "tests/support/handmade.h"
#include "tests/support/ways.h"

#define HAIR_TEST_SUBJECTS 4 // kinds
#define HAIR_TEST_SEEN 65536

// One head of hair and what happens to it: every event follows from `seed` and its number.
struct hair_test_subject {
    struct hair_test_handmade groom;
    hair_desc desc;
    hair_physics physics; // at first
    uint32_t seed;
    int hardens; // and softens again, time after time
};

struct hair_test_subject hair_test_subject_of(uint32_t kind);
hair_instance* hair_test_subject_make(struct hair_test* test, const struct hair_test_subject* subject);

// What the i-th event sets.
void hair_test_set(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t i);
// The i-th event, before the i-th step: the head moves, and now and then jumps or is reset; solids move, come and go.
void hair_test_move(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                    uint32_t i);
// The i-th step, as long as no other.
void hair_test_step(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                    uint32_t i);
// Both, from `first` until before `end`.
void hair_test_run(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t first, uint32_t end);

// All that can be seen of an instance: the state itself, with what its solver has beside it; guides, smoothed guides,
// followers.
struct hair_test_seen {
    float number[HAIR_TEST_SEEN];
    size_t count;
};

void hair_test_look(struct hair_test* test, hair_instance* hair, struct hair_test_seen* out);
void hair_test_same(const struct hair_test_seen* a, const struct hair_test_seen* b); // bit for bit
void hair_test_finite(const struct hair_test_seen* seen);

// A column-major matrix: where the head of a subject is at `time`, more or less.
void hair_test_pose(float time, float transform[16]);

// What hair_save writes. To be freed.
struct hair_test_blob {
    unsigned char* bytes;
    size_t size;
};
struct hair_test_blob hair_test_save(struct hair_test* test, hair_instance* hair);

#endif
