// commands.c - bindings, copies and dispatches that run at once or are recorded.
#include "lib/gl/recorder.h"

// Let a command of the recorder be recorded, or run for the current stream. Return false without
// one.
static bool take(struct hair_gl* gl, const struct hair_gl_command* command)
{
    struct hair_gl_recorder* recorder = gl->recorder;
    if (!recorder || recorder->mode == HAIR_GL_OFF) return false;
    if (recorder->mode == HAIR_GL_RECORDING)
        hair_gl_record(gl, command);
    else
        hair_gl_play(gl, command);
    return true;
}

static bool is_direct(const struct hair_gl* gl)
{
    return !gl->recorder || gl->recorder->mode == HAIR_GL_OFF;
}

static enum hair_gl_command_kind kind_of(GLenum target)
{
    return target == GL_UNIFORM_BUFFER ? HAIR_GL_BIND_UNIFORM : HAIR_GL_BIND_STORAGE;
}

void hair_gl_bind_buffers(struct hair_gl* gl, GLenum target, GLuint first, GLsizei count,
                          const GLuint* buffers)
{
    if (is_direct(gl)) {
        hair_gl_save_slots(gl, target, first, count);
        gl->BindBuffersBase(target, first, count, buffers);
        return;
    }
    for (GLsizei i = 0; i < count; ++i) {
        struct hair_gl_command bind = {
            .kind = kind_of(target), .index = first + (GLuint)i, .name = buffers ? buffers[i] : 0};
        take(gl, &bind);
    }
}

void hair_gl_bind_ranges(struct hair_gl* gl, GLenum target, GLuint first, GLsizei count,
                         const GLuint* buffers, const GLintptr* begins, const GLsizeiptr* sizes)
{
    if (is_direct(gl)) {
        hair_gl_save_slots(gl, target, first, count);
        gl->BindBuffersRange(target, first, count, buffers, begins, sizes);
        return;
    }
    for (GLsizei i = 0; i < count; ++i) {
        struct hair_gl_command bind = {.kind = kind_of(target),
                                       .index = first + (GLuint)i,
                                       .name = buffers[i],
                                       .at = begins[i],
                                       .size = sizes[i]};
        take(gl, &bind);
    }
}

void hair_gl_bind_texture(struct hair_gl* gl, GLuint unit, GLuint texture)
{
    struct hair_gl_command bind = {.kind = HAIR_GL_BIND_TEXTURE, .index = unit, .name = texture};
    if (take(gl, &bind)) return;
    hair_gl_save_units(gl, unit, 1);
    gl->BindTextureUnit(unit, texture);
}

void hair_gl_bind_sampler(struct hair_gl* gl, GLuint unit, GLuint sampler)
{
    struct hair_gl_command bind = {.kind = HAIR_GL_BIND_SAMPLER, .index = unit, .name = sampler};
    if (take(gl, &bind)) return;
    hair_gl_save_units(gl, unit, 1);
    gl->BindSampler(unit, sampler);
}

void hair_gl_bind_image(struct hair_gl* gl, GLuint unit, GLuint texture, bool layered, GLenum access,
                        GLenum format)
{
    struct hair_gl_command bind = {.kind = HAIR_GL_BIND_IMAGE,
                                   .index = unit,
                                   .name = texture,
                                   .count = layered,
                                   .access = access,
                                   .format = format};
    if (take(gl, &bind)) return;
    hair_gl_save_image(gl, unit);
    gl->BindImageTexture(unit, texture, 0, layered, 0, access, format);
}

void hair_gl_copy_buffer(struct hair_gl* gl, GLuint from, GLuint to, GLintptr from_at, GLintptr to_at,
                         GLsizeiptr size)
{
    struct hair_gl_command copy = {
        .kind = HAIR_GL_COPY, .name = from, .to = to, .at = from_at, .to_at = to_at, .size = size};
    if (!take(gl, &copy)) gl->CopyNamedBufferSubData(from, to, from_at, to_at, size);
}

void hair_gl_clear_buffer(struct hair_gl* gl, GLuint buffer)
{
    struct hair_gl_command clear = {.kind = HAIR_GL_CLEAR, .name = buffer};
    if (!take(gl, &clear)) gl->ClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
}

void hair_gl_barrier(struct hair_gl* gl, GLbitfield barriers)
{
    struct hair_gl_command barrier = {.kind = HAIR_GL_BARRIER, .access = barriers};
    if (!take(gl, &barrier)) gl->MemoryBarrier(barriers);
}

void hair_gl_fence(struct hair_gl* gl, GLsync* out)
{
    struct hair_gl_command fence = {.kind = HAIR_GL_FENCE, .fence = out};
    if (!take(gl, &fence)) *out = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void hair_gl_write_uniform(struct hair_gl* gl, GLuint buffer, size_t size, const void* data)
{
    HAIR_ASSERT(buffer && size > 0);
    if (is_direct(gl))
        gl->NamedBufferData(buffer, (GLsizeiptr)size, data, GL_STREAM_DRAW);
    else
        hair_gl_record_write(gl, buffer, size, data);
}

void hair_gl_use_program(struct hair_gl* gl, GLuint program)
{
    if (hair_gl_is_recording(gl)) return;
    gl->UseProgram(program);
    if (!gl->recorder) return;
    gl->recorder->program = program;
    if (gl->recorder->mode == HAIR_GL_AT_ONCE) hair_gl_bind_stream(gl, program);
}

void hair_gl_dispatch(struct hair_gl* gl, GLuint program, uint32_t first, uint32_t count, uint32_t all)
{
    HAIR_ASSERT(0 < count && count <= HAIR_MAX_GROUPS && count <= all && first <= all - count);
    struct hair_gl_command dispatch = {
        .kind = HAIR_GL_DISPATCH, .name = program, .index = first, .count = count, .all = all};
    if (take(gl, &dispatch)) return;
    if (count < all) gl->ProgramUniform2ui(program, HAIR_LOCATION_GROUPS, first, all);
    gl->DispatchCompute(count, 1, 1);
}

void hair_gl_dispatch_whole(struct hair_gl* gl, GLuint program)
{
    struct hair_gl_command whole = {.kind = HAIR_GL_DISPATCH_WHOLE, .name = program};
    if (!take(gl, &whole)) gl->ProgramUniform2ui(program, HAIR_LOCATION_GROUPS, 0, 0);
}

void hair_gl_dispatch_indirect(struct hair_gl* gl, GLuint program, GLuint buffer, size_t at)
{
    struct hair_gl_command dispatch = {
        .kind = HAIR_GL_DISPATCH_INDIRECT, .name = program, .to = buffer, .at = (GLintptr)at};
    if (take(gl, &dispatch)) return;
    gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer);
    gl->DispatchComputeIndirect((GLintptr)at);
}
