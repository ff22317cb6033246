// warm_up.c - a first run of a program on nothing.
//
// A software rasteriser compiles machine code when a program first runs. The run has buffers of
// zeros, which hold no guides, strands or pixels. Its writes go to these buffers.
#include "lib/gl/gl.h"

#define SCRATCH 65536 // Bytes of the buffer. Every driver allows uniform buffers of 16 KiB.

static void bind_scratch(struct hair_gl* gl, GLuint buffer)
{
    const GLintptr first = 0;
    const GLsizeiptr uniform_size = 16384;
    for (GLuint i = 0; i <= HAIR_BIND_REDUCTION; ++i)
        gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, i, 1, &buffer);
    for (GLuint i = 0; i <= HAIR_BIND_FIELD; ++i)
        gl->BindBuffersRange(GL_UNIFORM_BUFFER, i, 1, &buffer, &first, &uniform_size);
    for (GLuint i = 0; i <= HAIR_IMAGE_COLLIDER; ++i)
        gl->BindImageTexture(i, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
}

void hair_gl_warm_up(struct hair_gl* gl, struct hair_gl_program* own)
{
    GLuint buffer = 0;
    HAIR_ASSERT(own->program && !own->is_warm);
    own->is_warm = true;
    gl->CreateBuffers(1, &buffer);
    if (!buffer) return; // The first run compiles the program then.
    gl->NamedBufferStorage(buffer, SCRATCH, NULL, 0);
    gl->ClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    hair_gl_save_all_slots(gl);
    bind_scratch(gl, buffer);
    gl->UseProgram(own->program);
    gl->DispatchCompute(1, 1, 1);
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    hair_gl_unbind(gl);
    gl->DeleteBuffers(1, &buffer);
}
