// commands.h - bindings, copies, clears and barriers of passes. They run at once, or are recorded
// for several instances and then run together, so that a GPU computes the instances side by side.
#ifndef HAIR_GL_COMMANDS_H
#define HAIR_GL_COMMANDS_H

#include "lib/gl/buffers.h"

// commands.c --------------------------------------------------------------------------------------

// Bind whole storage or uniform buffers to `count` slots from `first` on. NULL unbinds.
void hair_gl_bind_buffers(struct hair_gl* gl, GLenum target, GLuint first, GLsizei count,
                          const GLuint* buffers);
// Bind parts of buffers.
void hair_gl_bind_ranges(struct hair_gl* gl, GLenum target, GLuint first, GLsizei count,
                         const GLuint* buffers, const GLintptr* begins, const GLsizeiptr* sizes);
void hair_gl_bind_texture(struct hair_gl* gl, GLuint unit, GLuint texture);
void hair_gl_bind_sampler(struct hair_gl* gl, GLuint unit, GLuint sampler);
// Bind level 0 of a texture with all layers if `layered`, or layer 0.
void hair_gl_bind_image(struct hair_gl* gl, GLuint unit, GLuint texture, bool layered, GLenum access,
                        GLenum format);

// Copy `size` bytes between buffers.
void hair_gl_copy_buffer(struct hair_gl* gl, GLuint from, GLuint to, GLintptr from_at, GLintptr to_at,
                         GLsizeiptr size);
// Fill a buffer with zeros. OpenGL is given no word, because Mesa reads one as the application has
// texels unpacked, from beyond its end.
void hair_gl_clear_buffer(struct hair_gl* gl, GLuint buffer);
void hair_gl_barrier(struct hair_gl* gl, GLbitfield barriers);
// Create a fence after all commands so far. `*out` receives the fence no later than
// hair_gl_end_recording(), or NULL if the driver refuses it.
void hair_gl_fence(struct hair_gl* gl, GLsync* out);

// Let a program be current. Recorded dispatches do so themselves.
void hair_gl_use_program(struct hair_gl* gl, GLuint program);
// Dispatch work groups of a program. A `count` below `all` dispatches a part from `first` on.
void hair_gl_dispatch(struct hair_gl* gl, GLuint program, uint32_t first, uint32_t count, uint32_t all);
// Let the next dispatch of a program have all groups again.
void hair_gl_dispatch_whole(struct hair_gl* gl, GLuint program);
// Dispatch with the group counts from three numbers at the byte offset `at` of a buffer.
void hair_gl_dispatch_indirect(struct hair_gl* gl, GLuint program, GLuint buffer, size_t at);

// recorder.c --------------------------------------------------------------------------------------

// Commands are recorded in streams, one per instance. The n-th barriers of all streams are one
// barrier, so that a GPU runs the n-th parts of all streams side by side. A stream must not write
// what another one reads or writes. The data of all uniform buffers are written by one copy,
// because the driver of an H200 lets the GPU become idle before it writes a buffer.

#define HAIR_GL_STREAMS 128 // Maximum streams that are recorded together.

// Record commands in up to `streams` streams from now on. Return false if memory is missing, or if
// the driver does not profit. Commands then run at once.
bool hair_gl_begin_recording(struct hair_gl* gl, uint32_t streams);
// Run everything that is recorded, and record no more.
void hair_gl_end_recording(struct hair_gl* gl);
// Begin the next stream.
void hair_gl_begin_stream(struct hair_gl* gl);
// Return whether commands are recorded.
bool hair_gl_is_recording(const struct hair_gl* gl);
// Run everything that is recorded, before a command that is not recorded.
void hair_gl_flush(struct hair_gl* gl);
// Run everything that is recorded, if any of it may read the contents of a buffer of the current
// stream, which are written at once.
void hair_gl_begin_write(struct hair_gl* gl, GLuint buffer);
// Run everything that is recorded, and run commands of a stream at once until
// hair_gl_record_again(). A program that becomes current gets what the stream has bound.
void hair_gl_continue_stream(struct hair_gl* gl, uint32_t index);
// Record commands in a stream again. Run everything that is recorded, if the stream has any.
void hair_gl_resume_stream(struct hair_gl* gl, uint32_t index);
// Run commands of the current stream at once until hair_gl_record_again(). Return whether commands
// were recorded.
bool hair_gl_run_at_once(struct hair_gl* gl);
void hair_gl_record_again(struct hair_gl* gl, bool was_recording);
// Run everything that is recorded, and forget a buffer or texture that is about to be deleted.
void hair_gl_forget(struct hair_gl* gl, bool is_texture, GLuint name);
void hair_gl_free_recorder(struct hair_gl* gl);

#endif
