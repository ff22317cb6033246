// context_loss.h - hair with much to lose, in an OpenGL context that is lost while frames run.
#ifndef HAIR_TESTS_SUPPORT_CONTEXT_LOSS_H
#define HAIR_TESTS_SUPPORT_CONTEXT_LOSS_H

#include "tests/support/scene.h"

#define HAIR_TEST_LOSS_SIDE 32
#define HAIR_TEST_LOSS_FRAMES 3
#define HAIR_TEST_LOSS_PIXELS (4 * HAIR_TEST_LOSS_SIDE * HAIR_TEST_LOSS_SIDE)

// Text of the application's shader.
extern const char hair_test_loss_glsl[];

// Hair with much to lose, drawn in each frame.
struct hair_test_loss {
    struct hair_test* test;
    hair_egl* egl; // the OpenGL context that is lost
    hair_context* context;
    hair_groom* groom;
    hair_instance *hair, *twin; // Lists of both step them in two of three frames.
    hair_shader* shader;
    struct hair_test_frame frame;
    uint32_t blocks;
};

// A run that nothing disturbs.
struct hair_test_loss_run {
    struct hair_test_points guides[HAIR_TEST_LOSS_FRAMES + 1]; // after each step
    float pixels[HAIR_TEST_LOSS_PIXELS]; // of the last frame
    uint32_t calls; // of OpenGL in all frames
};

// Create the context, the hair and the shader.
hair_result hair_test_loss_create(struct hair_test_loss* f, int way, bool restorable);
// Create an OpenGL context that can be lost, a groom and what hair_test_loss_create() creates.
void hair_test_loss_start(struct hair_test_loss* f, struct hair_test* test, int way);
// Destroy what hair_test_loss_create() has created.
void hair_test_loss_destroy(struct hair_test_loss* f);
void hair_test_loss_finish(struct hair_test_loss* f);
// Set what the application sets before step `i`, from 1.
hair_result hair_test_loss_set(struct hair_test_loss* f, int i);
// Draw by two paths. The second shades by the application.
hair_result hair_test_loss_draw(struct hair_test_loss* f);
// Set, step and draw frame `i`, from 1.
hair_result hair_test_loss_frame(struct hair_test_loss* f, int i);
// Run all frames until the context is lost.
hair_result hair_test_loss_run(struct hair_test_loss* f);
// Record a run that nothing disturbs.
void hair_test_loss_record(struct hair_test* test, int way, struct hair_test_loss_run* out);
// Replace the OpenGL context that is lost.
void hair_test_loss_replace_egl(struct hair_test_loss* f);
// Restore, do what has been lost once more, and compare the picture. Return the step restored, or
// -1.
int hair_test_loss_check(struct hair_test_loss* f, const struct hair_test_loss_run* run);

// A restorable context in an OpenGL context of its own.
struct hair_test_restorable {
    hair_context* own; // context of the test
    hair_egl* egl; // OpenGL context that is lost
};

// Give a test a restorable context in place of its own.
void hair_test_restorable_begin(struct hair_test* test, struct hair_test_restorable* f);
// Replace the OpenGL context, with all that it holds.
void hair_test_restorable_lose(struct hair_test* test, struct hair_test_restorable* f);
// Destroy the restorable context, and give the test its own back.
void hair_test_restorable_end(struct hair_test* test, struct hair_test_restorable* f);

// Restore the context of an instance while every allocation is refused in turn. Check that a failed
// restoration changes nothing.
void hair_test_restore_against_refusals(struct hair_test* test, hair_instance* hair);

#endif
