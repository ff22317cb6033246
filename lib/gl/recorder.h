// recorder.h - what recorder.c and commands.c share.
#ifndef HAIR_GL_RECORDER_H
#define HAIR_GL_RECORDER_H

#include "lib/gl/commands.h"

#define HAIR_GL_STORAGE_SLOTS (HAIR_BIND_REDUCTION + 1)
#define HAIR_GL_UNIFORM_SLOTS (HAIR_BIND_FIELD + 1)
#define HAIR_GL_IMAGE_SLOTS (HAIR_IMAGE_COLLIDER + 1)
#define HAIR_GL_WRITES 32 // Maximum buffers that a stream writes.
#define HAIR_GL_CHUNKS 64 // Maximum chunks of memory for data.

enum hair_gl_command_kind {
    HAIR_GL_BIND_STORAGE,
    HAIR_GL_BIND_UNIFORM,
    HAIR_GL_BIND_TEXTURE,
    HAIR_GL_BIND_SAMPLER,
    HAIR_GL_BIND_IMAGE,
    HAIR_GL_WRITE,
    HAIR_GL_COPY,
    HAIR_GL_CLEAR,
    HAIR_GL_BARRIER,
    HAIR_GL_FENCE,
    HAIR_GL_DISPATCH,
    HAIR_GL_DISPATCH_WHOLE,
    HAIR_GL_DISPATCH_INDIRECT
};

// A command. Which members it has depends on its kind.
struct hair_gl_command {
    enum hair_gl_command_kind kind;
    GLuint name, to; // Buffer, texture, sampler or program. Destination of a copy.
    uint32_t index, count, all; // Slot or unit, first group, and numbers of groups.
    GLenum access, format; // Image. `access` also has barriers.
    GLintptr at, to_at;
    GLsizeiptr size; // 0 means the whole buffer.
    GLsync* fence;
};

// A part of a buffer. `size` 0 means the whole buffer.
struct hair_gl_range {
    GLuint buffer;
    GLintptr at;
    GLsizeiptr size;
};

struct hair_gl_image {
    GLuint texture;
    bool is_layered;
    GLenum access, format;
};

// Everything that is bound. Name 0 means that a slot does not matter.
struct hair_gl_bindings {
    struct hair_gl_range storage[HAIR_GL_STORAGE_SLOTS], uniform[HAIR_GL_UNIFORM_SLOTS];
    GLuint texture[HAIR_GL_UNITS];
    GLuint sampler[HAIR_GL_UNITS]; // One more than its name. 0 means that it does not matter.
    struct hair_gl_image image[HAIR_GL_IMAGE_SLOTS];
};

// A buffer that a stream has written, and where its data are.
struct hair_gl_write {
    GLuint name; // 0 once the buffer is deleted.
    struct hair_gl_range data; // `size` 0 until the write has run.
    const void* mapped; // Data of the last write that is recorded, or NULL if it ran at once.
    size_t size;
};

struct hair_gl_stream {
    size_t first, end; // Commands that are recorded and have not run.
    struct hair_gl_bindings bindings;
    struct hair_gl_write write[HAIR_GL_WRITES];
    uint32_t writes;
};

// Memory of the data of uniform buffers.
struct hair_gl_chunk {
    GLuint staging, buffer; // Mapped buffer, and the one that shaders read.
    char* mapped;
    size_t used, copied; // Bytes in the mapped buffer, and those copied from there.
    GLsync fence; // NULL once the GPU is known to be done with it.
};

struct hair_gl_recorder {
    enum { HAIR_GL_OFF, HAIR_GL_RECORDING, HAIR_GL_AT_ONCE } mode;
    struct hair_gl_command* commands;
    size_t count;
    uint32_t room;
    struct hair_gl_stream* stream;
    uint32_t streams, stream_room, current; // Number begun, maximum, and index.
    struct hair_gl_bindings bound; // Bindings of OpenGL.
    GLuint program; // Current program, or 0 if it is unknown.
    struct hair_gl_chunk chunk[HAIR_GL_CHUNKS];
    uint32_t chunks, chunk_now; // The current chunk is `chunks` if there is none.
};

static inline struct hair_gl_stream* hair_gl_current_stream(struct hair_gl_recorder* recorder)
{
    HAIR_ASSERT(recorder->current < recorder->streams);
    return &recorder->stream[recorder->current];
}

// chunks.c ----------------------------------------------------------------------------------------

// Write data to mapped memory. `out` has the data after hair_gl_copy_chunks(). Return false if
// memory is missing.
bool hair_gl_upload(struct hair_gl* gl, size_t size, const void* data, struct hair_gl_range* out,
                    const void** mapped);
// Copy data written since the last call to where shaders read them.
void hair_gl_copy_chunks(struct hair_gl* gl);
// Let chunks be used again once the GPU is done with this recording.
void hair_gl_fence_chunks(struct hair_gl* gl);
void hair_gl_free_chunks(struct hair_gl* gl);

// play.c ------------------------------------------------------------------------------------------

// Bind what the current stream has bound, as far as a program needs it. 0 binds all.
void hair_gl_bind_stream(struct hair_gl* gl, GLuint program);

// recorder.c --------------------------------------------------------------------------------------

// Record a command. Run everything that is recorded first if memory is missing.
void hair_gl_record(struct hair_gl* gl, const struct hair_gl_command* command);
// Run a command of the current stream. Defined in play.c.
void hair_gl_play(struct hair_gl* gl, const struct hair_gl_command* command);
// Let the current stream write a buffer.
void hair_gl_record_write(struct hair_gl* gl, GLuint buffer, size_t size, const void* data);

#endif
