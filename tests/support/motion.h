// motion.h - heads of hair with many random events, all from a seed, and everything that can be
// read from the hair.
#ifndef HAIR_TESTS_SUPPORT_MOTION_H
#define HAIR_TESTS_SUPPORT_MOTION_H

#include "tests/support/support.h"

#include "lib/api/api.h"
#include "tests/support/handmade.h"
#include "tests/support/ways.h"

#define HAIR_TEST_SUBJECTS 4 // Number of kinds.
#define HAIR_TEST_SEEN 65536

// One head of hair and its events. Every event follows from `seed` and the event's number.
struct hair_test_subject {
    struct hair_test_handmade groom;
    hair_desc desc;
    hair_physics physics; // at the start
    uint32_t seed;
    int hardens; // 1 if the hair hardens and softens again, time after time
};

struct hair_test_subject hair_test_subject_of(uint32_t kind);
hair_instance* hair_test_subject_make(struct hair_test* test, const struct hair_test_subject* subject);

// Apply the settings of the i-th event.
void hair_test_set(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t i);
// Apply the i-th event, before the i-th step. The head moves and sometimes jumps or is reset.
// Colliders move, appear and disappear.
void hair_test_move(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                    uint32_t i);
// Do the i-th step. Every step has another length.
void hair_test_step(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                    uint32_t i);
// Do events and steps from `first` up to `end`, excluding `end`.
void hair_test_run(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t first, uint32_t end);

// Everything that can be read from an instance: the state, the solver's further state, guides,
// smoothed guides and followers.
struct hair_test_seen {
    float number[HAIR_TEST_SEEN];
    size_t count, followers; // The last `followers` numbers are of followers.
};

void hair_test_look(struct hair_test* test, hair_instance* hair, struct hair_test_seen* out);
// Check that both are equal bit for bit.
void hair_test_same(const struct hair_test_seen* a, const struct hair_test_seen* b);
void hair_test_finite(const struct hair_test_seen* seen);

// Compute the column-major matrix of about where a subject's head is at `time`.
void hair_test_pose(float time, float transform[16]);

// Output of hair_save(), to be freed.
struct hair_test_blob {
    unsigned char* bytes;
    size_t size;
};
struct hair_test_blob hair_test_save(struct hair_test* test, hair_instance* hair);

#endif
