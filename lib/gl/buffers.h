// buffers.h - buffers and textures of the library, and the record of their memory.
#ifndef HAIR_GL_BUFFERS_H
#define HAIR_GL_BUFFERS_H

#include "lib/gl/gl.h"

// memory.c ----------------------------------------------------------------------------------------

// Set the maximum of bytes that buffers and textures may take from now on. 0 disables it.
void hair_gl_memory_set_limit(struct hair_gl* gl, uint64_t bytes);
// Return whether `size` more bytes stay within the memory limit.
bool hair_gl_memory_allows(const struct hair_gl_memory* memory, uint64_t size);
// Make room to record one more object. Return false if memory is missing.
bool hair_gl_memory_grow(struct hair_gl* gl);
// Check whether `size` more bytes for `label` stay within the memory limit. Make room to record one
// more object.
hair_result hair_gl_memory_ask(struct hair_gl* gl, const char* label, uint64_t size);
// Record an object that gl->owner owns from now on. hair_gl_memory_ask() must have allowed it.
void hair_gl_memory_add(struct hair_gl* gl, hair_gl_category category, bool is_texture, GLuint name,
                        uint64_t size);
// Record a new size of a buffer.
void hair_gl_memory_resize(struct hair_gl* gl, GLuint buffer, uint64_t size);
// Forget an object that is about to be deleted. Any owner may be current.
void hair_gl_memory_remove(struct hair_gl* gl, bool is_texture, GLuint name);
// Let a buffer of no owner be shared by all users of `data`. It has one user then.
void hair_gl_memory_open(struct hair_gl* gl, GLuint buffer, const void* data);
// Add a user to the buffer of `data`, and return it, or 0 if there is none.
GLuint hair_gl_memory_join(struct hair_gl* gl, const void* data);
// Remove a user of a buffer. Return whether it has others.
bool hair_gl_memory_leave(struct hair_gl* gl, GLuint buffer);

// buffer.c ----------------------------------------------------------------------------------------

// Create a buffer of `size` bytes, at least 16, with `data`. NULL fills it with zeros. On failure
// `*out` is unchanged. Reports of the current owner count the memory in `category`, here and in all
// functions below.
hair_result hair_gl_buffer(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                           const void* data, GLuint* out);
// Return whether the driver allows a storage buffer of `size` bytes, read as a buffer texture with
// texels of `texel` bytes.
bool hair_gl_fits(const struct hair_gl* gl, uint64_t size, uint32_t texel);
// Create a buffer that shaders read or write as storage. Fail if the driver's largest block is
// smaller.
hair_result hair_gl_storage(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                            const void* data, GLuint* out);
// Create a buffer that never changes, or get the one that was created with the same `data`. `data`
// must not change before the last user has freed the buffer. hair_gl_free_buffer() frees it for one
// user. No report counts its memory.
hair_result hair_gl_shared_buffer(struct hair_gl* gl, const char* label, size_t size, const void* data,
                                  GLuint* out);
// Create a storage buffer of at least 16 bytes with undefined contents, which costs no upload. A
// pass must write all of the buffer before another pass reads it.
hair_result hair_gl_undefined_storage(struct hair_gl* gl, hair_gl_category category, const char* label,
                                      size_t size, GLuint* out);

// Create a uniform buffer, which is written whole before every dispatch or draw that reads it. Each
// write allocates new memory, so that pending commands keep their values. One driver was observed
// to write before an earlier dispatch had run.
hair_result hair_gl_uniform(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                            GLuint* out);
void hair_gl_write_uniform(struct hair_gl* gl, GLuint buffer, size_t size, const void* data);
// Write a uniform buffer and change its size. On failure the size is undefined.
hair_result hair_gl_resize(struct hair_gl* gl, const char* label, size_t size, const void* data,
                           GLuint buffer);

// Create a buffer that the GPU copies into and the application reads at `mapped` for the lifetime
// of the buffer. A copy is visible once a fence after it is signalled.
hair_result hair_gl_mapped(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                           GLuint* out, const void** mapped);

// A part of a buffer, in bytes.
struct hair_gl_part {
    size_t from, size;
};
// Read parts of a buffer one after the other, and wait for the GPU. The GPU copies to memory of the
// processor. The driver of an H100 would move a buffer that is read there, where shaders are slow.
void hair_gl_read_parts(struct hair_gl* gl, GLuint buffer, const struct hair_gl_part* parts, uint32_t count,
                        void* out);
// Read the beginning of a buffer, as hair_gl_read_parts() does.
void hair_gl_read(struct hair_gl* gl, GLuint buffer, size_t size, void* out);

// Create a texture over a buffer, without memory of its own.
hair_result hair_gl_buffer_texture(struct hair_gl* gl, const char* label, GLenum format, GLuint buffer,
                                   GLuint* out);

// Create a storage buffer unless it exists. Create its buffer texture too unless it exists or
// `texture` is NULL.
hair_result hair_gl_ensure_array(struct hair_gl* gl, hair_gl_category category, const char* label,
                                 size_t size, GLuint* buffer, GLenum format, GLuint* texture);
// Free a buffer and its buffer texture. NULL `texture` means that there is none.
void hair_gl_free_array(struct hair_gl* gl, GLuint* buffer, GLuint* texture);

// Create a 3D texture without mipmaps, with undefined contents and clamped edges. On failure `*out`
// is unchanged.
hair_result hair_gl_texture_3d(struct hair_gl* gl, hair_gl_category category, const char* label,
                               GLenum format, const uint32_t size[3], GLenum filter, GLuint* out);
hair_result hair_gl_texture_2d(struct hair_gl* gl, hair_gl_category category, const char* label,
                               GLenum format, uint32_t width, uint32_t height, GLuint* out);
// Fill a texture with four floats per texel, whatever the application's pixel storage modes are.
void hair_gl_fill_texture_3d(struct hair_gl* gl, GLuint texture, const uint32_t size[3], const void* texels);
void hair_gl_free_buffer(struct hair_gl* gl, GLuint* buffer);
void hair_gl_free_buffer_texture(struct hair_gl* gl, GLuint* texture);
// Free a 2D or 3D texture.
void hair_gl_free_texture(struct hair_gl* gl, GLuint* texture);

#endif
