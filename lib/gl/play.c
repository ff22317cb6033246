// play.c - commands of streams, run side by side.
#include "lib/gl/recorder.h"

// Return where the contents of a part of a buffer are.
static struct hair_gl_range resolve(const struct hair_gl_stream* stream, struct hair_gl_range range)
{
    for (uint32_t i = 0; i < stream->writes; ++i) {
        const struct hair_gl_write* write = &stream->write[i];
        if (write->name != range.buffer || !write->data.size || !range.buffer) continue;
        struct hair_gl_range data = write->data;
        data.at += range.at;
        data.size = range.size ? range.size : data.size - range.at;
        return data;
    }
    return range;
}

static bool are_equal(struct hair_gl_range a, struct hair_gl_range b)
{
    return a.buffer == b.buffer && a.at == b.at && a.size == b.size;
}

// Bind slots whose parts follow each other in the same way, all whole or all parts.
static void bind_run(struct hair_gl* gl, GLenum target, GLuint first, GLuint count,
                     const struct hair_gl_range* ranges)
{
    GLuint buffer[HAIR_GL_STORAGE_SLOTS];
    GLintptr at[HAIR_GL_STORAGE_SLOTS];
    GLsizeiptr size[HAIR_GL_STORAGE_SLOTS];
    HAIR_ASSERT(count <= HAIR_GL_STORAGE_SLOTS);
    for (GLuint i = 0; i < count; ++i) {
        buffer[i] = ranges[i].buffer;
        at[i] = ranges[i].at;
        size[i] = ranges[i].size;
    }
    hair_gl_save_slots(gl, target, first, (GLsizei)count);
    if (size[0])
        gl->BindBuffersRange(target, first, (GLsizei)count, buffer, at, size);
    else
        gl->BindBuffersBase(target, first, (GLsizei)count, buffer);
}

// Bind the slots in `needed` that differ from what is bound. Slots between them are bound again,
// because each call takes longer than a slot.
static void bind_slots(struct hair_gl* gl, GLenum target, const struct hair_gl_stream* stream,
                       const struct hair_gl_range* wanted, struct hair_gl_range* bound, GLuint slots,
                       uint32_t needed)
{
    GLuint first = slots, end = 0;
    for (GLuint i = 0; i < slots; ++i) {
        if (!(needed >> i & 1)) continue;
        struct hair_gl_range range = resolve(stream, wanted[i]);
        if (!range.buffer || are_equal(range, bound[i])) continue;
        bound[i] = range;
        if (first == slots) first = i;
        end = i + 1;
    }
    while (first < end) { // A run has whole buffers or parts.
        GLuint next = first + 1;
        while (next < end && !bound[next].size == !bound[first].size) ++next;
        bind_run(gl, target, first, next - first, bound + first);
        first = next;
    }
}

// Bind the textures in `needed` that differ. Those between them are bound again, but not where none
// is bound, because the unit may have textures of the application.
static void bind_textures(struct hair_gl* gl, const GLuint* wanted, GLuint* bound, uint32_t needed)
{
    GLuint first = HAIR_GL_UNITS, end = 0;
    for (GLuint i = 0; i <= HAIR_GL_UNITS; ++i) {
        bool is_needed = i < HAIR_GL_UNITS && needed >> i & 1;
        bool is_gap = i == HAIR_GL_UNITS || !((is_needed && wanted[i]) || bound[i]);
        if (is_gap && first < end) {
            hair_gl_save_units(gl, first, (GLsizei)(end - first));
            gl->BindTextures(first, (GLsizei)(end - first), bound + first);
        }
        if (is_gap) first = HAIR_GL_UNITS, end = 0;
        if (is_gap || !is_needed || !wanted[i] || wanted[i] == bound[i]) continue;
        bound[i] = wanted[i];
        if (first == HAIR_GL_UNITS) first = i;
        end = i + 1;
    }
}

// Bind what a stream has bound, as far as a program needs it. NULL `inputs` binds all.
static void bind_stream(struct hair_gl* gl, const struct hair_gl_stream* stream,
                        const struct hair_gl_inputs* inputs)
{
    static const struct hair_gl_inputs all = {0, UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
    const struct hair_gl_inputs* needed = inputs ? inputs : &all;
    struct hair_gl_recorder* recorder = gl->recorder;
    const struct hair_gl_bindings* wanted = &stream->bindings;
    struct hair_gl_bindings* bound = &recorder->bound;
    bind_slots(gl, GL_SHADER_STORAGE_BUFFER, stream, wanted->storage, bound->storage, HAIR_GL_STORAGE_SLOTS,
               needed->storage);
    bind_slots(gl, GL_UNIFORM_BUFFER, stream, wanted->uniform, bound->uniform, HAIR_GL_UNIFORM_SLOTS,
               needed->uniform);
    bind_textures(gl, wanted->texture, bound->texture, needed->textures);
    for (GLuint i = 0; i < HAIR_GL_UNITS; ++i) {
        if (!(needed->textures >> i & 1) || !wanted->sampler[i] || wanted->sampler[i] == bound->sampler[i])
            continue;
        bound->sampler[i] = wanted->sampler[i];
        hair_gl_save_units(gl, i, 1);
        gl->BindSampler(i, wanted->sampler[i] - 1);
    }
    for (GLuint i = 0; i < HAIR_GL_IMAGE_SLOTS; ++i) {
        const struct hair_gl_image *want = &wanted->image[i], *has = &bound->image[i];
        if (!(needed->images >> i & 1) || !want->texture ||
            (want->texture == has->texture && want->is_layered == has->is_layered &&
             want->access == has->access && want->format == has->format))
            continue;
        hair_gl_save_image(gl, i);
        gl->BindImageTexture(i, want->texture, 0, want->is_layered, 0, want->access, want->format);
        bound->image[i] = *want;
    }
}

static void use_program(struct hair_gl* gl, GLuint program)
{
    if (gl->recorder->program != program) gl->UseProgram(program);
    gl->recorder->program = program;
}

static void play_dispatch(struct hair_gl* gl, const struct hair_gl_stream* stream,
                          const struct hair_gl_command* command)
{
    bind_stream(gl, stream, hair_gl_find_inputs(gl, command->name));
    use_program(gl, command->name);
    if (command->kind == HAIR_GL_DISPATCH_INDIRECT) {
        gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, command->to);
        gl->DispatchComputeIndirect(command->at);
        return;
    }
    if (command->count < command->all)
        gl->ProgramUniform2ui(command->name, HAIR_LOCATION_GROUPS, command->index, command->all);
    gl->DispatchCompute(command->count, 1, 1);
}

static void play(struct hair_gl* gl, struct hair_gl_stream* stream, const struct hair_gl_command* command)
{
    struct hair_gl_bindings* bindings = &stream->bindings;
    uint32_t index = command->index;
    struct hair_gl_range range = {command->name, command->at, command->size};
    switch (command->kind) {
    case HAIR_GL_BIND_STORAGE: bindings->storage[index] = range; break;
    case HAIR_GL_BIND_UNIFORM: bindings->uniform[index] = range; break;
    case HAIR_GL_BIND_TEXTURE: bindings->texture[index] = command->name; break;
    case HAIR_GL_BIND_SAMPLER: bindings->sampler[index] = command->name + 1; break;
    case HAIR_GL_BIND_IMAGE:
        bindings->image[index] =
            (struct hair_gl_image){command->name, command->count != 0, command->access, command->format};
        break;
    case HAIR_GL_WRITE: stream->write[index].data = range; break;
    case HAIR_GL_COPY:
        range = resolve(stream, range);
        gl->CopyNamedBufferSubData(range.buffer, command->to, range.at, command->to_at, command->size);
        break;
    case HAIR_GL_CLEAR:
        gl->ClearNamedBufferData(command->name, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
        break;
    case HAIR_GL_BARRIER: gl->MemoryBarrier(command->access); break;
    case HAIR_GL_FENCE: *command->fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0); break;
    case HAIR_GL_DISPATCH_WHOLE: gl->ProgramUniform2ui(command->name, HAIR_LOCATION_GROUPS, 0, 0); break;
    case HAIR_GL_DISPATCH:
    case HAIR_GL_DISPATCH_INDIRECT: play_dispatch(gl, stream, command); break;
    }
}

void hair_gl_bind_stream(struct hair_gl* gl, GLuint program)
{
    bind_stream(gl, hair_gl_current_stream(gl->recorder), program ? hair_gl_find_inputs(gl, program) : NULL);
}

void hair_gl_play(struct hair_gl* gl, const struct hair_gl_command* command)
{
    struct hair_gl_stream* stream = hair_gl_current_stream(gl->recorder);
    play(gl, stream, command);
    if (command->kind < HAIR_GL_COPY) bind_stream(gl, stream, NULL);
}

// Run the commands of a stream up to its next barrier, and return the barrier, or 0 at the end.
static GLbitfield play_part(struct hair_gl* gl, struct hair_gl_stream* stream)
{
    const struct hair_gl_command* commands = gl->recorder->commands;
    while (stream->first < stream->end) {
        const struct hair_gl_command* command = &commands[stream->first++];
        if (command->kind == HAIR_GL_BARRIER) return command->access;
        play(gl, stream, command);
    }
    return 0;
}

void hair_gl_flush(struct hair_gl* gl)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    if (!recorder || !recorder->count) return;
    hair_gl_copy_chunks(gl);
    gl->PushDebugGroup(GL_DEBUG_SOURCE_THIRD_PARTY, recorder->streams, -1, "hair of several instances");
    for (bool goes_on = true; goes_on;) {
        GLbitfield barriers = 0;
        goes_on = false;
        for (uint32_t i = 0; i < recorder->streams; ++i) {
            struct hair_gl_stream* stream = &recorder->stream[i];
            if (stream->first == stream->end) continue;
            barriers |= play_part(gl, stream);
            goes_on = true;
        }
        if (barriers) gl->MemoryBarrier(barriers);
    }
    gl->PopDebugGroup();
    recorder->count = 0;
    for (uint32_t i = 0; i < recorder->streams; ++i) recorder->stream[i].first = recorder->stream[i].end = 0;
}
