// chunks.c - mapped buffers that receive the data of uniform buffers.
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
        chunk->used = 0;
    }
    return chunk->used == 0;
}

static bool make_chunk(struct hair_gl* gl, struct hair_gl_chunk* chunk)
{
    static const GLbitfield access = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    GLint64 got = 0;
    struct hair_gl_owner* owner = gl->owner;
    if (!hair_gl_memory_allows(&gl->memory, CHUNK) || !hair_gl_memory_grow(gl)) return false;
    gl->CreateBuffers(1, &chunk->buffer);
    if (!chunk->buffer) return false;
    gl->NamedBufferStorage(chunk->buffer, CHUNK, NULL, access);
    gl->GetNamedBufferParameteri64v(chunk->buffer, GL_BUFFER_SIZE, &got);
    if (got == (GLint64)CHUNK) chunk->mapped = gl->MapNamedBufferRange(chunk->buffer, 0, CHUNK, access);
    if (!chunk->mapped) {
        gl->DeleteBuffers(1, &chunk->buffer);
        chunk->buffer = 0;
        return false;
    }
    gl->owner = NULL; // All instances share it.
    hair_gl_memory_add(gl, HAIR_GL_NO_CATEGORY, false, chunk->buffer, CHUNK);
    gl->owner = owner;
    gl->ObjectLabel(GL_BUFFER, chunk->buffer, -1, "hair parameters");
    return true;
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

void hair_gl_free_chunks(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    for (uint32_t i = 0; i < recorder->chunks; ++i) {
        if (recorder->chunk[i].fence) gl->DeleteSync(recorder->chunk[i].fence);
        hair_gl_memory_remove(gl, false, recorder->chunk[i].buffer);
        gl->DeleteBuffers(1, &recorder->chunk[i].buffer);
    }
}
