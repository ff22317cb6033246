// torture.h - calls whose memory, objects and driver are refused at one site after the other.
//
// A call is run undisturbed first, which counts its sites and tells its outcome. Then each visit
// makes everything anew and refuses one site, or that site and all later ones. A call that fails
// must change nothing, and must work when it is repeated. A call that works all the same must have
// the same outcome. Nothing may be left afterwards.
//
// HAIR_TEST_FULL=1 in the environment visits every site. Otherwise a few evenly spread sites of
// each call are visited.
#ifndef HAIR_TESTS_SUPPORT_TORTURE_H
#define HAIR_TESTS_SUPPORT_TORTURE_H

#include "tests/support/scene.h"

#define HAIR_TEST_TORTURE_SIZE 32 // Pixels along a side of the frame.

struct hair_test_torture_cache;

struct hair_test_torture {
    struct hair_test* test;
    const char* name;
    int variant; // Meaning of the callbacks' own.
    bool is_cached; // True if the context has a cache of programs.
    bool has_clobbered_state; // True if the context may change the state of OpenGL.
    bool has_varying_memory; // True if a repeated call may need more memory than the first.
    float tolerance; // Maximum difference of pixels from those of the undisturbed call.
    GLenum format; // Format of the frame. 0 is GL_RGBA32F.
    GLsizei samples;
    // Prepare an instance in `context`. NULL if the call itself makes the context.
    void (*start)(struct hair_test_torture* t);
    hair_result (*call)(struct hair_test_torture* t); // Call that fails.
    void (*finish)(struct hair_test_torture* t); // Free what `start` has made. May be NULL.

    hair_groom* groom;
    hair_context* context;
    hair_context* kept; // Context of all visits, which keeps its programs. NULL disables.
    hair_instance* hair;
    hair_shader* shader;
    hair_view view;
    hair_lod lod;
    hair_light light;
    hair_collision_mesh* mesh;
    GLuint texture[3];
    uint32_t defects; // Defects found by earlier calls.
    void* bytes; // Memory of the callbacks' own.
    size_t size;
    struct hair_test_torture_cache* cache;
    struct hair_test_frame frame;
};

// Return a groom on a square scalp with texture coordinates and colours.
hair_groom* hair_test_torture_groom(struct hair_test* test);
// Return the view of that groom from above.
hair_view hair_test_torture_view(void);
// Create the instance in the context. NULL is the default desc.
void hair_test_torture_add(struct hair_test_torture* t, const hair_desc* desc);
// Set colliders of all kinds among the hair, one of them with a mesh.
void hair_test_torture_collide(struct hair_test_torture* t);

// Create a context as the undisturbed calls have.
hair_result hair_test_torture_context(struct hair_test_torture* t, hair_context** out);
// Refuse the sites of a call.
void hair_test_torture_run(struct hair_test_torture* t);
// Print the numbers of sites and failures of all calls. Fail if a defect was
// found, or if there are fewer failures than `min`.
void hair_test_torture_tell(uint32_t min);

#endif
