// scene.h - hair to draw, with its context, frame and view, draws that are read, and reports of
// draws.
#ifndef HAIR_TESTS_SUPPORT_SCENE_H
#define HAIR_TESTS_SUPPORT_SCENE_H

#include "tests/support/support.h" // before what includes OpenGL's own header

#include "lib/api/api.h"
#include "tests/reference/reference.h"
#include "tests/support/frame.h"
#include "tests/support/handmade.h"

struct hair_test_scene {
    struct hair_test* test;
    hair_context* context; // the scene's own. NULL is that of the test.
    hair_groom* groom;
    hair_instance* hair;
    struct hair_test_frame frame; // without size until hair_test_frame_make()
    hair_view view;
};

// Return a scene with the default view, without hair and frame. With `get_proc` the scene has a
// context of its own, which times its passes.
struct hair_test_scene hair_test_scene_make(struct hair_test* test,
                                            void* (*get_proc)(const char* name, void* user));
// Add the hair of a handmade groom. NULL is the default of the groom, and of the instance.
void hair_test_scene_add(struct hair_test_scene* scene, const struct hair_test_handmade* groom,
                         const hair_desc* desc);
// Return a scene in the test's context with the hair of a handmade groom. NULL is the default of
// the groom, and of the look.
struct hair_test_scene hair_test_scene_of(struct hair_test* test, const struct hair_test_handmade* groom,
                                          const hair_look* look);
void hair_test_scene_free(struct hair_test_scene* scene);

// Write the state of all guides, and smooth them.
void hair_test_scene_set_state(const struct hair_test_scene* scene, const struct hair_state* state);
// Read the frames of smoothed guides. Set `tangent` to their y axes, with the stretch in w.
void hair_test_read_frames(const hair_instance* hair, hair_vec4* tangent, hair_vec4* frame);
// Move the guides' vertices at random by up to 1 mm, and smooth them. Return the samples of the
// reference, to be freed. Each guide has 2 * max_vertices - 1.
struct hair_reference_sample* hair_test_scene_scatter(const struct hair_test_scene* scene);

// Set an orthographic projection along -z. It scales x and y by `scale` and z by `depth`, and then
// moves the picture up by `up`.
void hair_test_set_orthographic(hair_view* view, float scale, float depth, float up);
// Return an orthographic view along -z by a render path.
hair_view hair_test_view_by(hair_render_path path);
// Set a perspective projection with that scale of y and `scale` / `aspect` of x. The depth is -1 at
// 1 cm and 1 at infinity.
void hair_test_set_perspective(hair_view* view, float scale, float aspect);

// Draw into a new frame of floats, and read it. `depths` may be NULL.
void hair_test_draw(const struct hair_test_scene* scene, const hair_view* view, GLsizei width, GLsizei height,
                    GLsizei samples, float* pixels, float* depths);
// Clear a frame, draw into it and read it.
void hair_test_draw_in(const struct hair_test_frame* frame, const struct hair_test* test, hair_instance* hair,
                       const hair_view* view, float* pixels);
// Draw strand, guide and position along the strand into a square, each from 1. 0 marks pixels
// without hair.
void hair_test_draw_ids(const struct hair_test* test, hair_instance* hair, const hair_view* view,
                        GLsizei side, uint32_t* ids);

#define HAIR_TEST_POINTS 8192

// Vertices of strands.
struct hair_test_points {
    float at[3 * HAIR_TEST_POINTS];
    uint32_t count;
};

// Read vertices, which must be finite.
void hair_test_read_points(const struct hair_test* test, hair_instance* hair, hair_read_source source,
                           struct hair_test_points* out);
// Return the maximum distance of two vertices of the same index, m.
double hair_test_points_distance(const struct hair_test_points* a, const struct hair_test_points* b);

// Attributes that followers and guides have.
#define HAIR_TEST_FOLLOWER_ATTRIBUTES 127u
#define HAIR_TEST_GUIDE_ATTRIBUTES                                                                           \
    ((uint32_t)(HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_TANGENT | HAIR_ATTRIBUTE_STRAND |                   \
                HAIR_ATTRIBUTE_PREV_POSITION))

// Return the buffers of strands for the application.
hair_buffers hair_test_get_buffers(const struct hair_test_scene* scene, hair_read_source source,
                                   uint32_t attributes);

// Return the mean of the fourth of every four numbers.
double hair_test_mean_alpha(const float* pixels, size_t count);
// Return the maximum difference of two numbers of the same index.
float hair_test_max_difference(const float* a, const float* b, size_t count);

// Count primitives from hair_test_count_begin() to hair_test_count_end().
GLuint hair_test_count_begin(void);
uint32_t hair_test_count_end(GLuint query);

// Return the render path by which a view is drawn.
hair_render_path hair_test_path_of(const struct hair_renderer* renderer, const hair_view* view);
// Return the row of a stage in the report, which must have one.
hair_report_row hair_test_report_row(const struct hair_test* test, hair_instance* hair, const char* stage);

#endif
