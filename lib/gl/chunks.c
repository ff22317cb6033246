// chunks.c - memory of the data of uniform buffers. Data is written to mapped memory, and copied to
// memory of the GPU in one piece.
#include "lib/gl/recorder.h"

#include <string.h>

#define CHUNK ((size_t)1 << 20) // Size of a mapped buffer, bytes.
#define ALIGN 256 // Alignment of data in it, the largest that OpenGL lets a driver want.

// Return whether the GPU is done with a chunk.
static bool is_free(struct hair_gl* gl, struct hair_gl_chunk* chunk)
{
    if (chunk->fence) {
        GLenum status = gl->ClientWaitSync(chunk->fence, 0, 0);
        if (status != GL_ALREADY_SIGNALED && status != GL_CONDITION_SATISFIED) return false;
        gl->DeleteSync(chunk->fence);
        chunk->fence = NULL;
        chunk->used = chunk->copied = 0;
    }
    return chunk->used == 0;
}

// Free a buffer of a chunk. hair_gl_free_buffer() would first run everything that is recorded, and
// this happens while commands are recorded.
static void free_buffer(struct hair_gl* gl, GLuint* buffer)
{
    if (!*buffer) return;
    hair_gl_memory_remove(gl, false, *buffer);
    gl->DeleteBuffers(1, buffer);
    *buffer = 0;
}

// Create a buffer. Return 0 if memory is missing, without a message.
static GLuint make_buffer(struct hair_gl* gl, GLbitfield access)
{
    GLuint buffer = 0;
    GLint64 got = 0;
    struct hair_gl_owner* owner = gl->owner;
    if (!hair_gl_memory_allows(&gl->memory, CHUNK) || !hair_gl_memory_grow(gl)) return 0;
    gl->CreateBuffers(1, &buffer);
    if (!buffer) return 0;
    gl->NamedBufferStorage(buffer, CHUNK, NULL, access);
    gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &got);
    if (got != (GLint64)CHUNK) {
        gl->DeleteBuffers(1, &buffer);
        return 0;
    }
    gl->owner = NULL; // All instances share it.
    hair_gl_memory_add(gl, HAIR_GL_NO_CATEGORY, false, buffer, CHUNK);
    gl->owner = owner;
    gl->ObjectLabel(GL_BUFFER, buffer, -1, "hair parameters");
    return buffer;
}

static void free_chunk(struct hair_gl* gl, struct hair_gl_chunk* chunk)
{
    if (chunk->fence) gl->DeleteSync(chunk->fence);
    free_buffer(gl, &chunk->staging);
    free_buffer(gl, &chunk->buffer);
    *chunk = (struct hair_gl_chunk){0};
}

static bool make_chunk(struct hair_gl* gl, struct hair_gl_chunk* chunk)
{
    static const GLbitfield access =
        GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    chunk->staging = make_buffer(gl, access);
    if (chunk->staging) chunk->buffer = make_buffer(gl, 0);
    if (chunk->buffer) chunk->mapped = gl->MapNamedBufferRange(chunk->staging, 0, CHUNK, access);
    if (chunk->mapped) return true;
    free_chunk(gl, chunk);
    return false;
}

// Let the current chunk be one with free memory. Return false if there is none.
static bool find_chunk(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    for (uint32_t i = 0; i < recorder->chunks; ++i)
        if (is_free(gl, &recorder->chunk[i])) {
            recorder->chunk_now = i;
            return true;
        }
    if (recorder->chunks == HAIR_GL_CHUNKS) return false;
    if (!make_chunk(gl, &recorder->chunk[recorder->chunks])) return false;
    recorder->chunk_now = recorder->chunks++;
    return true;
}

bool hair_gl_upload(struct hair_gl* gl, size_t size, const void* data, struct hair_gl_range* out,
                    const void** mapped)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    size_t room = (size + ALIGN - 1) / ALIGN * ALIGN;
    if (room > CHUNK) return false;
    bool has_chunk = recorder->chunk_now < recorder->chunks;
    if (!has_chunk || recorder->chunk[recorder->chunk_now].used + room > CHUNK)
        if (!find_chunk(gl)) return false;
    struct hair_gl_chunk* chunk = &recorder->chunk[recorder->chunk_now];
    memcpy(chunk->mapped + chunk->used, data, size);
    *out = (struct hair_gl_range){chunk->buffer, (GLintptr)chunk->used, (GLsizeiptr)size};
    *mapped = chunk->mapped + chunk->used;
    chunk->used += room;
    return true;
}

void hair_gl_fence_chunks(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    for (uint32_t i = 0; i < recorder->chunks; ++i) {
        struct hair_gl_chunk* chunk = &recorder->chunk[i];
        // Without a fence, the chunk is not used again.
        if (chunk->used && !chunk->fence) chunk->fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    }
    recorder->chunk_now = recorder->chunks;
}

void hair_gl_copy_chunks(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    for (uint32_t i = 0; i < recorder->chunks; ++i) {
        struct hair_gl_chunk* chunk = &recorder->chunk[i];
        if (chunk->copied == chunk->used) continue;
        gl->CopyNamedBufferSubData(chunk->staging, chunk->buffer, (GLintptr)chunk->copied,
                                   (GLintptr)chunk->copied, (GLsizeiptr)(chunk->used - chunk->copied));
        chunk->copied = chunk->used;
    }
}

void hair_gl_free_chunks(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    for (uint32_t i = 0; i < recorder->chunks; ++i) free_chunk(gl, &recorder->chunk[i]);
}
