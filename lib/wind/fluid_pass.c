// fluid_pass.c - buffers of the fluid, and running one of its passes.
#include "lib/wind/fluid.h"

hair_result hair_fluid_make_buffer(struct hair_fluid* fluid, const char* label, size_t count, GLenum format,
                                   struct hair_fluid_buffer* out)
{
    HAIR_ASSERT(count > 0 && !out->buffer && !out->texture);
    return hair_gl_ensure_array(fluid->gl, HAIR_GL_CATEGORY_WIND, label, count * 4, &out->buffer, format,
                                &out->texture);
}

void hair_fluid_free_buffer(struct hair_fluid* fluid, struct hair_fluid_buffer* buffer)
{
    hair_gl_free_array(fluid->gl, &buffer->buffer, &buffer->texture);
}

static void bind_fluid(const struct hair_fluid* fluid, hair_gl_pass pass)
{
    struct hair_gl* gl = fluid->gl;
    HAIR_ASSERT(fluid->now < 3 && fluid->current_pressure < 2);
    // Advection writes the next velocity buffer, and correction the one after it.
    const struct hair_fluid_buffer *was = &fluid->velocity[fluid->now], *carried, *next;
    carried = &fluid->velocity[(fluid->now + 1) % 3];
    next = &fluid->velocity[(fluid->now + 2) % 3];
    // The first pass computes how open colliders leave faces. All later passes use the openness
    // that hair leaves.
    int hairy = fluid->hair.grid.buffer && pass != HAIR_GL_FLUID_FACE_FRACTIONS;
    const struct hair_fluid_buffer* wall = hairy ? &fluid->hair.wall_velocity : &fluid->wall_velocity;
    const struct hair_fluid_buffer* open = hairy ? &fluid->hair.face_fraction : &fluid->face_fraction;
    int early = pass == HAIR_GL_FLUID_ADVECT || pass == HAIR_GL_FLUID_MACCORMACK_CORRECT;
    int jacobi = pass == HAIR_GL_FLUID_JACOBI;
    GLuint write[] = {pass == HAIR_GL_FLUID_ADVECT ? carried->buffer : next->buffer,
                      wall->buffer,
                      open->buffer,
                      fluid->pressure[jacobi ? 1 - fluid->current_pressure : fluid->current_pressure].buffer,
                      fluid->rhs.buffer,
                      fluid->motion};
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_VELOCITY, 6, write);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_FLUID, 1, &fluid->params);
    hair_gl_bind_texture(gl, HAIR_UNIT_VELOCITY, early ? was->texture : next->texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_ADVECTED, carried->texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_FACE_FRACTION, open->texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_PRESSURE, fluid->pressure[fluid->current_pressure].texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_RHS, fluid->rhs.texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_WALL_VELOCITY, wall->texture);
    if (!hairy) return;
    hair_gl_bind_texture(gl, HAIR_UNIT_BARE_FACE_FRACTION, fluid->face_fraction.texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_BARE_WALL_VELOCITY, fluid->wall_velocity.texture);
    if (pass == HAIR_GL_FLUID_POROUS) hair_gl_bind_texture(gl, HAIR_UNIT_THICKET, fluid->hair.grid.texture);
}

void hair_fluid_run(struct hair_fluid* fluid, hair_gl_pass pass, uint32_t level, uint32_t color,
                    uint32_t threads)
{
    const GLintptr first = (GLintptr)(2 * level + color) * HAIR_FLUID_ALIGNMENT;
    const GLsizeiptr size = sizeof(struct hair_fluid_level);
    HAIR_ASSERT(level < fluid->levels && color < 2 && threads > 0);
    bind_fluid(fluid, pass);
    hair_gl_bind_ranges(fluid->gl, GL_UNIFORM_BUFFER, HAIR_BIND_LEVEL, 1, &fluid->level_params, &first,
                        &size);
    hair_gl_run(fluid->gl, pass, (threads + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    if (pass == HAIR_GL_FLUID_JACOBI) fluid->current_pressure = 1 - fluid->current_pressure;
}

void hair_fluid_coarsen(struct hair_fluid* fluid)
{
    if (fluid->desc.method != HAIR_FLUID_MULTIGRID) return;
    for (uint32_t i = 0; i + 1 < fluid->levels; ++i)
        hair_fluid_run(fluid, HAIR_GL_FLUID_COARSEN, i, 0,
                       fluid->level[i + 2].slot - fluid->level[i + 1].slot);
}
