// fluids.h - a fluid around a ball, and the contents of its buffers.
#ifndef HAIR_TESTS_SUPPORT_FLUIDS_H
#define HAIR_TESTS_SUPPORT_FLUIDS_H

#include "tests/support/support.h" // before what includes OpenGL's own header

#include "lib/api/api.h"
#include "lib/wind/fluid.h"

#define HAIR_TEST_FLUID_SIDE 0.8f // Side of the box, m.
#define HAIR_TEST_FLUID_BALL 0.1f // Radius of the ball at its centre, m.

struct hair_test_fluid {
    struct hair_test* test;
    hair_groom* groom; // The field is around it.
    struct hair_collider_field field;
    struct hair_colliders colliders; // one ball at most
    struct hair_fluid fluid;
    struct hair_fluid_now now; // wind of 5 m/s along x, steps of 1/60 s
    uint32_t cells;
    size_t faces, count; // number of faces in an array of velocities, and of cells
};

// Create a fluid. The OpenGL state is entered until hair_test_fluid_end().
void hair_test_fluid_begin(struct hair_test* test, const struct hair_fluid_desc* desc, int ball,
                           struct hair_test_fluid* out);
void hair_test_fluid_end(struct hair_test_fluid* f);

struct hair_fluid_desc hair_test_fluid_desc(uint32_t cells);

// Return the velocity that the last step left, as doubles to be freed.
double* hair_test_fluid_velocity(const struct hair_test_fluid* f);
// Return the first numbers of a buffer, as doubles to be freed.
double* hair_test_floats(GLuint buffer, size_t count);
// Write the first numbers of a buffer.
void hair_test_put_floats(GLuint buffer, const double* numbers, size_t count);
// Return the openness of the faces of a level, 0 being the finest, in three arrays like velocities,
// to be freed.
double* hair_test_fluid_open(const struct hair_test_fluid* f, uint32_t level);

// Return one component at a place in cells from the box's corner, interpolated linearly between
// faces.
double hair_test_fluid_at(const struct hair_test_fluid* f, const double* velocity, int axis,
                          const double place[3]);
// Return the root mean square of the flow into cells that the last step left.
double hair_test_fluid_left(struct hair_test_fluid* f);
// Compute the gusts at a place in cells, m/s, from the texels of their texture.
void hair_test_gust_at(const struct hair_test_fluid* f, const struct hair_wind_gusts* gusts,
                       const float* texel, const double place[3], double out[3]);
double hair_test_rms(const double* numbers, size_t count);

#endif
