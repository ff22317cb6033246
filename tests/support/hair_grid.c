// hair_grid.c - hair close together, and its state.
#include "tests/support/hair_grid.h"

#include <stdlib.h>
#include <string.h>

static struct hair_test_strands bundles(uint32_t side, float width)
{
    struct hair_test_strands strands = hair_test_strands_make(side * side, HAIR_TEST_HAIR_GRID_VERTICES);
    for (uint32_t i = 0; i < side * side; ++i) {
        float x = width * (float)(i % side / 2 * 2) / (float)side,
              z = width * (float)(i / side) / (float)side;
        hair_test_add_straight(&strands, HAIR_TEST_HAIR_GRID_VERTICES, hair_v3(x, 0, z), hair_v3(0, -1, 0),
                               0.1f);
    }
    return strands;
}

hair_physics hair_test_only_hair_grid(float cohesion, float volume)
{
    hair_physics physics = hair_test_bare();
    memset(physics.gravity, 0, sizeof physics.gravity);
    physics.damping = 0;
    physics.fiber.youngs_modulus = 0;
    physics.hair_hair.cohesion = cohesion;
    physics.hair_hair.pressure_stiffness = volume;
    return physics;
}

void hair_test_hair_grid(struct hair_test* test, const hair_desc* desc, float width,
                         struct hair_test_living* out)
{
    struct hair_test_strands strands = bundles(6, width);
    hair_test_live(test, &strands, desc, out);
    hair_test_strands_free(&strands);
}

void hair_test_set_state(struct hair_test_living* living, const struct hair_state* state)
{
    struct hair_sim* sim = &living->hair->sim;
    size_t size = sim->guide_vertices * sizeof *state;
    GLuint from;
    glCreateBuffers(1, &from);
    glNamedBufferStorage(from, (GLsizeiptr)size, state, 0);
    glCopyNamedBufferSubData(from, sim->state, 0, 0, (GLsizeiptr)size);
    glDeleteBuffers(1, &from);
    // Solvers with a history also store the velocity there.
    struct hair_history* past = calloc(sim->guide_vertices, sizeof *past);
    for (uint32_t i = 0; i < sim->guide_vertices; ++i)
        past[i].rate = past[i].rate_before = state[i].displacement;
    glCreateBuffers(1, &from);
    glNamedBufferStorage(from, (GLsizeiptr)(sim->guide_vertices * sizeof *past), past, 0);
    if (sim->solver != HAIR_SOLVER_ACCURATE)
        glCopyNamedBufferSubData(from, sim->history, 0, 0, (GLsizeiptr)(sim->guide_vertices * sizeof *past));
    glDeleteBuffers(1, &from);
    free(past);
}

void* hair_test_buffer(GLuint buffer, size_t size)
{
    void* bytes = malloc(size);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)size, bytes);
    return bytes;
}
