// recorder.c - recording of commands.
#include "lib/gl/recorder.h"

#include <string.h>

#define MIN_ROOM 4096 // Commands that there is memory for at first.

bool hair_gl_is_recording(const struct hair_gl* gl)
{
    return gl->recorder && gl->recorder->mode == HAIR_GL_RECORDING;
}

static bool make_room(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    if (recorder->count < recorder->room) return true;
    void* more =
        hair_grow(&gl->host, recorder->commands, sizeof *recorder->commands, &recorder->room, MIN_ROOM);
    if (!more) return false;
    recorder->commands = more;
    return true;
}

void hair_gl_record(struct hair_gl* gl, const struct hair_gl_command* command)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    struct hair_gl_stream* stream = hair_gl_current_stream(recorder);
    if (!make_room(gl)) hair_gl_flush(gl);
    HAIR_ASSERT(recorder->count < recorder->room);
    HAIR_ASSERT(stream->first == stream->end || stream->end == recorder->count);
    if (stream->first == stream->end) stream->first = stream->end = recorder->count;
    recorder->commands[recorder->count++] = *command;
    stream->end = recorder->count;
}

// Return the write of a buffer in a stream, a new one, or NULL if there are too many.
static struct hair_gl_write* find_write(struct hair_gl_stream* stream, GLuint buffer)
{
    for (uint32_t i = 0; i < stream->writes; ++i)
        if (stream->write[i].name == buffer) return &stream->write[i];
    if (stream->writes == HAIR_GL_WRITES) return NULL;
    struct hair_gl_write* write = &stream->write[stream->writes++];
    *write = (struct hair_gl_write){.name = buffer};
    return write;
}

void hair_gl_record_write(struct hair_gl* gl, GLuint buffer, size_t size, const void* data)
{
    struct hair_gl_stream* stream = hair_gl_current_stream(gl->recorder);
    struct hair_gl_write* write = find_write(stream, buffer);
    struct hair_gl_range range;
    if (!write || !hair_gl_upload(gl, size, data, &range, &write->mapped)) {
        hair_gl_flush(gl);
        gl->NamedBufferData(buffer, (GLsizeiptr)size, data, GL_STREAM_DRAW);
        if (write) *write = (struct hair_gl_write){.name = buffer};
        return;
    }
    write->size = size;
    struct hair_gl_command command = {.kind = HAIR_GL_WRITE,
                                      .name = range.buffer,
                                      .index = (uint32_t)(write - stream->write),
                                      .at = range.at,
                                      .size = range.size};
    if (hair_gl_is_recording(gl)) {
        hair_gl_record(gl, &command);
    } else {
        hair_gl_copy_chunks(gl);
        hair_gl_play(gl, &command);
    }
}

static bool is_bound_by(const struct hair_gl_recorder* recorder, const struct hair_gl_stream* stream,
                        GLuint buffer)
{
    for (size_t i = stream->first; i < stream->end; ++i)
        if (recorder->commands[i].name == buffer && recorder->commands[i].kind <= HAIR_GL_BIND_UNIFORM)
            return true;
    return false;
}

void hair_gl_begin_write(struct hair_gl* gl, GLuint buffer)
{
    if (!hair_gl_is_recording(gl)) return;
    struct hair_gl_stream* stream = hair_gl_current_stream(gl->recorder);
    uint32_t writes = stream->writes;
    struct hair_gl_write* write = find_write(stream, buffer);
    // Passes may read the buffer through a texture, but only after it was written.
    bool is_first = write && stream->writes > writes && !is_bound_by(gl->recorder, stream, buffer);
    if (!is_first) hair_gl_flush(gl);
    if (write) *write = (struct hair_gl_write){.name = buffer};
}

static bool make_streams(struct hair_gl* gl, uint32_t streams)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    if (!recorder) gl->recorder = recorder = hair_alloc(&gl->host, 1, sizeof *recorder);
    if (!recorder) return false;
    if (recorder->stream_room < streams) {
        struct hair_gl_stream* stream = hair_alloc(&gl->host, streams, sizeof *stream);
        if (!stream) return false;
        hair_free(&gl->host, recorder->stream);
        recorder->stream = stream;
        recorder->stream_room = streams;
    }
    return make_room(gl);
}

bool hair_gl_begin_recording(struct hair_gl* gl, uint32_t streams)
{
    HAIR_ASSERT(0 < streams && streams <= HAIR_GL_STREAMS);
    if (!gl->records || !make_streams(gl, streams)) return false;
    struct hair_gl_recorder* recorder = gl->recorder;
    HAIR_ASSERT(recorder->mode == HAIR_GL_OFF && recorder->count == 0);
    recorder->mode = HAIR_GL_RECORDING;
    recorder->streams = 0;
    recorder->program = 0;
    memset(&recorder->bound, 0, sizeof recorder->bound);
    return true;
}

void hair_gl_begin_stream(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    HAIR_ASSERT(hair_gl_is_recording(gl) && recorder->streams < recorder->stream_room);
    recorder->current = recorder->streams++;
    memset(hair_gl_current_stream(recorder), 0, sizeof *recorder->stream);
}

// Write the data of all streams to the buffers that they are for, because later calls read those.
static void keep_writes(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    for (uint32_t i = 0; i < recorder->streams; ++i)
        for (uint32_t k = 0; k < recorder->stream[i].writes; ++k) {
            const struct hair_gl_write* write = &recorder->stream[i].write[k];
            if (write->name && write->size)
                gl->NamedBufferData(write->name, (GLsizeiptr)write->size, write->mapped, GL_STREAM_DRAW);
        }
}

void hair_gl_end_recording(struct hair_gl* gl)
{
    HAIR_ASSERT(gl->recorder && gl->recorder->mode != HAIR_GL_OFF);
    hair_gl_flush(gl);
    keep_writes(gl);
    hair_gl_fence_chunks(gl);
    gl->recorder->mode = HAIR_GL_OFF;
}

void hair_gl_continue_stream(struct hair_gl* gl, uint32_t index)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    HAIR_ASSERT(recorder->mode != HAIR_GL_OFF && index < recorder->streams);
    hair_gl_flush(gl);
    recorder->mode = HAIR_GL_AT_ONCE;
    recorder->current = index;
}

void hair_gl_resume_stream(struct hair_gl* gl, uint32_t index)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    HAIR_ASSERT(recorder->mode != HAIR_GL_OFF && index < recorder->streams);
    if (recorder->stream[index].first < recorder->stream[index].end) hair_gl_flush(gl);
    recorder->current = index;
    recorder->mode = HAIR_GL_RECORDING;
    recorder->program = 0; // Passes that ran at once have changed it.
}

bool hair_gl_run_at_once(struct hair_gl* gl)
{
    if (!hair_gl_is_recording(gl)) return false;
    hair_gl_continue_stream(gl, gl->recorder->current);
    return true;
}

void hair_gl_record_again(struct hair_gl* gl, bool was_recording)
{
    if (!was_recording) return;
    HAIR_ASSERT(gl->recorder->current + 1 == gl->recorder->streams);
    gl->recorder->mode = HAIR_GL_RECORDING;
    gl->recorder->program = 0; // Passes that ran at once have changed it.
}

// Deletion ----------------------------------------------------------------------------------------

static void forget_in(struct hair_gl_bindings* bindings, bool is_texture, GLuint name)
{
    for (GLuint i = 0; i < HAIR_GL_UNITS && is_texture; ++i)
        if (bindings->texture[i] == name) bindings->texture[i] = 0;
    for (GLuint i = 0; i < HAIR_GL_IMAGE_SLOTS && is_texture; ++i)
        if (bindings->image[i].texture == name) bindings->image[i].texture = 0;
    for (GLuint i = 0; i < HAIR_GL_STORAGE_SLOTS && !is_texture; ++i)
        if (bindings->storage[i].buffer == name) bindings->storage[i].buffer = 0;
    for (GLuint i = 0; i < HAIR_GL_UNIFORM_SLOTS && !is_texture; ++i)
        if (bindings->uniform[i].buffer == name) bindings->uniform[i].buffer = 0;
}

void hair_gl_forget(struct hair_gl* gl, bool is_texture, GLuint name)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    if (!recorder || recorder->mode == HAIR_GL_OFF) return;
    hair_gl_flush(gl);
    for (uint32_t i = 0; i < recorder->streams; ++i) {
        struct hair_gl_stream* stream = &recorder->stream[i];
        forget_in(&stream->bindings, is_texture, name);
        for (uint32_t k = 0; k < stream->writes && !is_texture; ++k)
            if (stream->write[k].name == name) stream->write[k] = (struct hair_gl_write){0};
    }
    hair_gl_unbind(gl); // Mesa unbinds a deleted buffer in a way that changes other state.
    memset(&recorder->bound, 0, sizeof recorder->bound);
    recorder->program = 0;
    if (recorder->mode == HAIR_GL_AT_ONCE) hair_gl_bind_stream(gl, 0);
}

void hair_gl_free_recorder(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    if (!recorder) return;
    hair_gl_free_chunks(gl);
    hair_free(&gl->host, recorder->stream);
    hair_free(&gl->host, recorder->commands);
    hair_free(&gl->host, recorder);
    gl->recorder = NULL;
}
