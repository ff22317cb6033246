// inputs.c - slots and units that programs read or write. A stream binds only those of the program
// that runs, because a binding takes the processor about as long as a dispatch.
#include "lib/gl/gl.h"

// Return the bits of the binding slots of the blocks of an interface.
static uint32_t find_block_slots(struct hair_gl* gl, GLuint program, GLenum interface)
{
    static const GLenum property = GL_BUFFER_BINDING;
    GLint blocks = 0;
    uint32_t slots = 0;
    gl->GetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &blocks);
    for (GLint i = 0; i < blocks; ++i) {
        GLint slot = -1;
        gl->GetProgramResourceiv(program, interface, (GLuint)i, 1, &property, 1, NULL, &slot);
        if (0 <= slot && slot < 32) slots |= 1u << slot;
    }
    return slots;
}

static bool is_image(GLint type)
{
    return GL_IMAGE_1D <= type && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
}

// Find the units of samplers and images. A unit of another uniform only costs a binding.
static void find_units(struct hair_gl* gl, struct hair_gl_inputs* out)
{
    static const GLenum properties[] = {GL_LOCATION, GL_TYPE, GL_ARRAY_SIZE};
    GLint uniforms = 0;
    gl->GetProgramInterfaceiv(out->program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &uniforms);
    for (GLint i = 0; i < uniforms; ++i) {
        GLint has[3] = {-1, 0, 0};
        gl->GetProgramResourceiv(out->program, GL_UNIFORM, (GLuint)i, 3, properties, 3, NULL, has);
        // Members of blocks have no location. HAIR_LOCATION_GROUPS is no unit.
        if (has[0] < 0 || has[1] == GL_UNSIGNED_INT_VEC2) continue;
        for (GLint k = 0; k < has[2]; ++k) {
            GLint unit[16] = {-1}; // Room for a matrix of the application.
            gl->GetUniformiv(out->program, has[0] + k, unit);
            if (unit[0] < 0 || unit[0] >= 32) continue;
            *(is_image(has[1]) ? &out->images : &out->textures) |= 1u << unit[0];
        }
    }
}

const struct hair_gl_inputs* hair_gl_find_inputs(struct hair_gl* gl, GLuint program)
{
    for (uint32_t i = 0; i < gl->inputs_count; ++i)
        if (gl->inputs[i].program == program) return &gl->inputs[i];
    if (gl->inputs_count == gl->inputs_room) {
        void* more = hair_grow(&gl->host, gl->inputs, sizeof *gl->inputs, &gl->inputs_room, 32);
        if (!more) return NULL;
        gl->inputs = more;
    }
    struct hair_gl_inputs* own = &gl->inputs[gl->inputs_count++];
    *own = (struct hair_gl_inputs){.program = program,
                                   .storage = find_block_slots(gl, program, GL_SHADER_STORAGE_BLOCK),
                                   .uniform = find_block_slots(gl, program, GL_UNIFORM_BLOCK)};
    find_units(gl, own);
    return own;
}

void hair_gl_delete_program(struct hair_gl* gl, GLuint program)
{
    for (uint32_t i = 0; i < gl->inputs_count; ++i)
        if (gl->inputs[i].program == program) gl->inputs[i--] = gl->inputs[--gl->inputs_count];
    gl->DeleteProgram(program);
}
