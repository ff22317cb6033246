// buffer.c - creation of buffers and textures. The error flag belongs to the application, so
// success is checked by querying sizes.
#include "lib/gl/commands.h"

#include <string.h>

// Sizes -------------------------------------------------------------------------------------------

static uint64_t buffer_bytes(const struct hair_gl* gl, GLuint buffer)
{
    GLint64 size = 0;
    gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
    return (uint64_t)size;
}

static uint64_t texel_bytes(GLenum format)
{
    switch (format) {
    case GL_R16F: return 2;
    case GL_RG32F:
    case GL_RG32UI:
    case GL_RGBA16:
    case GL_RGBA16F: return 8;
    case GL_RGBA32F:
    case GL_RGBA32UI: return 16;
    default: return 4; // GL_R32F, GL_R32UI
    }
}

static uint64_t texture_bytes(const struct hair_gl* gl, GLuint texture)
{
    GLint format = 0, size[3] = {0};
    gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &size[0]);
    gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &size[1]);
    gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH, &size[2]);
    return texel_bytes((GLenum)format) * (uint64_t)size[0] * (uint64_t)size[1] * (uint64_t)size[2];
}

// Buffers -----------------------------------------------------------------------------------------

// Create a buffer of at least 16 bytes. Its contents are undefined if `data` is NULL.
static hair_result create_buffer(struct hair_gl* gl, hair_gl_category category, const char* label,
                                 size_t size, const void* data, GLuint* out)
{
    HAIR_ASSERT(size >= 16 && !*out);
    GLuint buffer = 0;
    GLint64 got = 0, want = (GLint64)size;
    gl->CreateBuffers(1, &buffer);
    if (buffer) {
        gl->NamedBufferStorage(buffer, (GLsizeiptr)want, data, GL_DYNAMIC_STORAGE_BIT);
        gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &got);
    }
    if (got != want) {
        if (buffer) gl->DeleteBuffers(1, &buffer);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %lld bytes for %s", (long long)want,
                         label);
    }
    hair_gl_memory_add(gl, category, false, buffer, (uint64_t)want);
    gl->ObjectLabel(GL_BUFFER, buffer, -1, label);
    *out = buffer;
    return HAIR_OK;
}

hair_result hair_gl_buffer(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                           const void* data, GLuint* out)
{
    HAIR_ASSERT(label && !*out);
    size_t want = size < 16 ? 16 : size;
    HAIR_TRY(hair_gl_memory_ask(gl, label, (uint64_t)want));
    if (data && size >= 16) return create_buffer(gl, category, label, want, data, out);
    // The zeros are uploaded. The driver of an H100 lost data that glNamedBufferSubData wrote after
    // glClearNamedBufferData.
    void* zeros = hair_alloc(&gl->host, want, 1);
    if (!zeros) return hair_fail_memory(&gl->host, label);
    if (data) memcpy(zeros, data, size);
    hair_result result = create_buffer(gl, category, label, want, zeros, out);
    hair_free(&gl->host, zeros);
    return result;
}

bool hair_gl_fits(const struct hair_gl* gl, uint64_t size, uint32_t texel)
{
    HAIR_ASSERT(texel > 0);
    return size <= (uint64_t)gl->max_storage_bytes && size / texel <= (uint64_t)gl->max_buffer_texels;
}

static hair_result check_storage_size(const struct hair_gl* gl, const char* label, size_t size)
{
    if (size <= (size_t)gl->max_storage_bytes) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s takes %zu bytes, more than the driver's %d", label,
                     size, gl->max_storage_bytes);
}

hair_result hair_gl_storage(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                            const void* data, GLuint* out)
{
    HAIR_TRY(check_storage_size(gl, label, size));
    return hair_gl_buffer(gl, category, label, size, data, out);
}

hair_result hair_gl_shared_buffer(struct hair_gl* gl, const char* label, size_t size, const void* data,
                                  GLuint* out)
{
    GLuint shared = hair_gl_memory_join(gl, data);
    if (shared) {
        *out = shared;
        return HAIR_OK;
    }
    HAIR_TRY(hair_gl_buffer(gl, HAIR_GL_NO_CATEGORY, label, size, data, out));
    hair_gl_memory_open(gl, *out, data);
    return HAIR_OK;
}

hair_result hair_gl_undefined_storage(struct hair_gl* gl, hair_gl_category category, const char* label,
                                      size_t size, GLuint* out)
{
    HAIR_TRY(check_storage_size(gl, label, size));
    HAIR_TRY(hair_gl_memory_ask(gl, label, (uint64_t)size));
    return create_buffer(gl, category, label, size, NULL, out);
}

hair_result hair_gl_uniform(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                            GLuint* out)
{
    HAIR_ASSERT(size > 0 && !*out);
    GLuint buffer = 0;
    GLint64 got = 0;
    HAIR_TRY(hair_gl_memory_ask(gl, label, size));
    gl->CreateBuffers(1, &buffer);
    if (buffer) {
        gl->NamedBufferData(buffer, (GLsizeiptr)size, NULL, GL_STREAM_DRAW);
        gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &got);
    }
    if (got != (GLint64)size) {
        if (buffer) gl->DeleteBuffers(1, &buffer);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %zu bytes for %s", size, label);
    }
    hair_gl_memory_add(gl, category, false, buffer, size);
    gl->ObjectLabel(GL_BUFFER, buffer, -1, label);
    *out = buffer;
    return HAIR_OK;
}

hair_result hair_gl_resize(struct hair_gl* gl, const char* label, size_t size, const void* data,
                           GLuint buffer)
{
    HAIR_ASSERT(buffer && size > 0);
    uint64_t was = buffer_bytes(gl, buffer), got;
    if (size > was) HAIR_TRY(hair_gl_memory_ask(gl, label, size - was));
    hair_gl_begin_write(gl, buffer);
    gl->NamedBufferData(buffer, (GLsizeiptr)size, data, GL_STREAM_DRAW);
    got = buffer_bytes(gl, buffer);
    hair_gl_memory_resize(gl, buffer, got);
    if (got == size) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %zu bytes for %s", size, label);
}

hair_result hair_gl_mapped(struct hair_gl* gl, hair_gl_category category, const char* label, size_t size,
                           GLuint* out, const void** mapped)
{
    HAIR_ASSERT(size > 0 && !*out && !*mapped);
    static const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    GLuint buffer = 0;
    GLint64 got = 0;
    const void* at = NULL;
    HAIR_TRY(hair_gl_memory_ask(gl, label, size));
    gl->CreateBuffers(1, &buffer);
    if (buffer) {
        gl->NamedBufferStorage(buffer, (GLsizeiptr)size, NULL, access);
        gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &got);
        if (got == (GLint64)size) at = gl->MapNamedBufferRange(buffer, 0, (GLsizeiptr)size, access);
    }
    if (!at) {
        if (buffer) gl->DeleteBuffers(1, &buffer);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver maps no %zu bytes for %s", size, label);
    }
    hair_gl_memory_add(gl, category, false, buffer, size);
    gl->ObjectLabel(GL_BUFFER, buffer, -1, label);
    *out = buffer;
    *mapped = at;
    return HAIR_OK;
}

void hair_gl_read_parts(struct hair_gl* gl, GLuint buffer, const struct hair_gl_part* parts, uint32_t count,
                        void* out)
{
    static const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    GLuint copy = 0;
    GLint64 got = 0;
    size_t size = 0, at = 0;
    for (uint32_t i = 0; i < count; ++i) size += parts[i].size;
    HAIR_ASSERT(buffer && size > 0);
    hair_gl_flush(gl);
    // At the limit of memory, a buffer is read directly.
    if (hair_gl_memory_allows(&gl->memory, size)) gl->CreateBuffers(1, &copy);
    if (copy) {
        gl->NamedBufferStorage(copy, (GLsizeiptr)size, NULL, access);
        gl->GetNamedBufferParameteri64v(copy, GL_BUFFER_SIZE, &got);
    }
    bool has_copy = got == (GLint64)size;
    for (uint32_t i = 0; i < count; at += parts[i++].size) {
        GLintptr from = (GLintptr)parts[i].from, to = (GLintptr)at;
        if (has_copy)
            gl->CopyNamedBufferSubData(buffer, copy, from, to, (GLsizeiptr)parts[i].size);
        else
            gl->GetNamedBufferSubData(buffer, from, (GLsizeiptr)parts[i].size, (char*)out + at);
    }
    if (has_copy) gl->GetNamedBufferSubData(copy, 0, (GLsizeiptr)size, out);
    if (copy) gl->DeleteBuffers(1, &copy);
}

void hair_gl_read(struct hair_gl* gl, GLuint buffer, size_t size, void* out)
{
    const struct hair_gl_part part = {.size = size};
    hair_gl_read_parts(gl, buffer, &part, 1, out);
}

// Textures ----------------------------------------------------------------------------------------

hair_result hair_gl_buffer_texture(struct hair_gl* gl, const char* label, GLenum format, GLuint buffer,
                                   GLuint* out)
{
    HAIR_ASSERT(buffer && !*out);
    uint64_t texels = buffer_bytes(gl, buffer) / texel_bytes(format);
    if (texels > (uint64_t)gl->max_buffer_texels)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s takes %llu texels, more than the driver's %d",
                         label, (unsigned long long)texels, gl->max_buffer_texels);
    GLuint texture = 0;
    gl->CreateTextures(GL_TEXTURE_BUFFER, 1, &texture);
    if (!texture) return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver makes no texture for %s", label);
    gl->TextureBuffer(texture, format, buffer);
    gl->ObjectLabel(GL_TEXTURE, texture, -1, label);
    *out = texture;
    return HAIR_OK;
}

hair_result hair_gl_texture_3d(struct hair_gl* gl, hair_gl_category category, const char* label,
                               GLenum format, const uint32_t size[3], GLenum filter, GLuint* out)
{
    HAIR_ASSERT(size[0] > 0 && size[1] > 0 && size[2] > 0 && !*out);
    GLuint texture = 0;
    GLint max = 0, got = 0;
    gl->GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &max);
    for (int i = 0; i < 3; ++i)
        if (size[i] > (uint32_t)max)
            return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s is %u texels long, more than the driver's %d",
                             label, size[i], max);
    uint64_t bytes = texel_bytes(format) * size[0] * size[1] * size[2];
    HAIR_TRY(hair_gl_memory_ask(gl, label, bytes));
    gl->CreateTextures(GL_TEXTURE_3D, 1, &texture);
    if (texture) {
        gl->TextureStorage3D(texture, 1, format, (GLsizei)size[0], (GLsizei)size[1], (GLsizei)size[2]);
        gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH, &got);
    }
    if (got != (GLint)size[2]) {
        if (texture) gl->DeleteTextures(1, &texture);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %u x %u x %u texels for %s",
                         size[0], size[1], size[2], label);
    }
    hair_gl_memory_add(gl, category, true, texture, bytes);
    gl->TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, (GLint)filter);
    gl->TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, (GLint)filter);
    gl->TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->TextureParameteri(texture, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    gl->ObjectLabel(GL_TEXTURE, texture, -1, label);
    *out = texture;
    return HAIR_OK;
}

hair_result hair_gl_texture_2d(struct hair_gl* gl, hair_gl_category category, const char* label,
                               GLenum format, uint32_t width, uint32_t height, GLuint* out)
{
    HAIR_ASSERT(width > 0 && height > 0 && !*out);
    GLuint texture = 0;
    uint64_t bytes = texel_bytes(format) * width * height;
    HAIR_TRY(hair_gl_memory_ask(gl, label, bytes));
    gl->CreateTextures(GL_TEXTURE_2D, 1, &texture);
    if (texture) gl->TextureStorage2D(texture, 1, format, (GLsizei)width, (GLsizei)height);
    if (!texture || texture_bytes(gl, texture) != bytes) {
        if (texture) gl->DeleteTextures(1, &texture);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %u x %u texels for %s", width,
                         height, label);
    }
    hair_gl_memory_add(gl, category, true, texture, bytes);
    gl->ObjectLabel(GL_TEXTURE, texture, -1, label);
    *out = texture;
    return HAIR_OK;
}

void hair_gl_fill_texture_3d(struct hair_gl* gl, GLuint texture, const uint32_t size[3], const void* texels)
{
    static const GLenum parts[] = {GL_UNPACK_SWAP_BYTES,  GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT,
                                   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_IMAGES};
    GLint was[6], buffer = 0;
    gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &buffer);
    if (buffer) gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (int i = 0; i < 6; ++i) {
        gl->GetIntegerv(parts[i], &was[i]);
        gl->PixelStorei(parts[i], 0);
    }
    gl->TextureSubImage3D(texture, 0, 0, 0, 0, (GLsizei)size[0], (GLsizei)size[1], (GLsizei)size[2], GL_RGBA,
                          GL_FLOAT, texels);
    for (int i = 0; i < 6; ++i) gl->PixelStorei(parts[i], was[i]);
    if (buffer) gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)buffer);
}

void hair_gl_free_buffer(struct hair_gl* gl, GLuint* buffer)
{
    if (!*buffer) return;
    if (hair_gl_memory_leave(gl, *buffer)) {
        *buffer = 0;
        return;
    }
    hair_gl_memory_remove(gl, false, *buffer);
    hair_gl_forget(gl, false, *buffer);
    gl->DeleteBuffers(1, buffer);
    *buffer = 0;
}

void hair_gl_free_buffer_texture(struct hair_gl* gl, GLuint* texture)
{
    if (!*texture) return;
    hair_gl_forget(gl, true, *texture);
    gl->DeleteTextures(1, texture);
    *texture = 0;
}

void hair_gl_free_texture(struct hair_gl* gl, GLuint* texture)
{
    if (!*texture) return;
    hair_gl_memory_remove(gl, true, *texture);
    hair_gl_forget(gl, true, *texture);
    gl->DeleteTextures(1, texture);
    *texture = 0;
}

// Arrays ------------------------------------------------------------------------------------------

hair_result hair_gl_ensure_array(struct hair_gl* gl, hair_gl_category category, const char* label,
                                 size_t size, GLuint* buffer, GLenum format, GLuint* texture)
{
    if (!*buffer) HAIR_TRY(hair_gl_storage(gl, category, label, size, NULL, buffer));
    if (!texture || *texture) return HAIR_OK;
    return hair_gl_buffer_texture(gl, label, format, *buffer, texture);
}

void hair_gl_free_array(struct hair_gl* gl, GLuint* buffer, GLuint* texture)
{
    if (texture) hair_gl_free_buffer_texture(gl, texture);
    hair_gl_free_buffer(gl, buffer);
}
