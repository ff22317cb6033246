// fluids.h - air about a ball, and what is in its buffers.
#ifndef HAIR_TESTS_SUPPORT_FLUIDS_H
#define HAIR_TESTS_SUPPORT_FLUIDS_H

#include "tests/support/support.h" // before what includes OpenGL's own header

#include "lib/api/api.h"
#include "lib/wind/fluid.h"

#define HAIR_TEST_FLUID_SIDE 0.8f // m: of the box
#define HAIR_TEST_FLUID_BALL 0.1f // m: radius of the ball in its middle

struct hair_test_fluid {
    struct hair_test* test;
    hair_groom* groom; // the field is around it
    struct hair_solid_field field;
    struct hair_solids solids; // one ball, if any
    struct hair_fluid fluid;
    struct hair_fluid_now now; // wind of 5 m/s along x, steps of 1/60 s
    uint32_t cells;
    size_t faces, count; // of faces in an array of velocities; of cells
};

// With the OpenGL state entered until the end.
void hair_test_fluid_begin(struct hair_test* test, const struct hair_fluid_desc* desc, int ball,
                           struct hair_test_fluid* out);
void hair_test_fluid_end(struct hair_test_fluid* f);

struct hair_fluid_desc hair_test_fluid_desc(uint32_t cells);

// Where the last step left it, as doubles to be freed.
double* hair_test_fluid_velocity(const struct hair_test_fluid* f);
// The first numbers of a buffer, likewise; and put there.
double* hair_test_floats(GLuint buffer, size_t count);
void hair_test_put_floats(GLuint buffer, const double* numbers, size_t count);
// Of the finest level or one beyond, in three arrays as of velocities, likewise.
double* hair_test_fluid_open(const struct hair_test_fluid* f, uint32_t level);

// One component at a place in cells from the box's corner, linear between faces.
double hair_test_fluid_at(const struct hair_test_fluid* f, const double* velocity, int axis,
                          const double place[3]);
// Root mean square of what flows into cells as the last step left them.
double hair_test_fluid_left(struct hair_test_fluid* f);
// Gusts at such a place, m/s, from their texture's texels.
void hair_test_gust_at(const struct hair_test_fluid* f, const struct hair_air_gusts* gusts,
                       const float* texel, const double place[3], double out[3]);
double hair_test_rms(const double* numbers, size_t count);

#endif
