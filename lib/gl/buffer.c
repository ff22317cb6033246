// buffer.c - buffers and textures, checked: the error flag stays the host's, so sizes are asked back.
#include "lib/gl/gl.h"

hair_result hair_gl_buffer(struct hair_gl* gl, const char* label, size_t size, const void* data, GLuint* out)
{
    GLuint  buffer = 0;
    GLint64 got = 0, want = size < 16 ? 16 : (GLint64)size;
    void*   zeros = data ? NULL : hair_alloc(&gl->host, (size_t)want, 1);
    if (!data && !zeros) return hair_fail_memory(&gl->host, label);
    gl->CreateBuffers(1, &buffer);
    if (buffer) {
        gl->NamedBufferStorage(buffer, (GLsizeiptr)want, data && size >= 16 ? data : zeros,
                               GL_DYNAMIC_STORAGE_BIT);
        gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &got);
        if (data && size && size < 16) gl->NamedBufferSubData(buffer, 0, (GLsizeiptr)size, data);
    }
    hair_free(&gl->host, zeros);
    if (got != want) {
        if (buffer) gl->DeleteBuffers(1, &buffer);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %lld bytes for %s", (long long)want,
                         label);
    }
    gl->ObjectLabel(GL_BUFFER, buffer, -1, label);
    *out = buffer;
    return HAIR_OK;
}

hair_result hair_gl_storage(struct hair_gl* gl, const char* label, size_t size, const void* data, GLuint* out)
{
    GLint most = 0;
    gl->GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (size > (size_t)most)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s takes %zu bytes, more than the driver's %d", label,
                         size, most);
    return hair_gl_buffer(gl, label, size, data, out);
}

hair_result hair_gl_uniform(struct hair_gl* gl, const char* label, size_t size, GLuint* out)
{
    GLuint  buffer = 0;
    GLint64 got    = 0;
    gl->CreateBuffers(1, &buffer);
    if (buffer) {
        gl->NamedBufferData(buffer, (GLsizeiptr)size, NULL, GL_STREAM_DRAW);
        gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &got);
    }
    if (got != (GLint64)size) {
        if (buffer) gl->DeleteBuffers(1, &buffer);
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no %zu bytes for %s", size, label);
    }
    gl->ObjectLabel(GL_BUFFER, buffer, -1, label);
    *out = buffer;
    return HAIR_OK;
}

void hair_gl_write_uniform(struct hair_gl* gl, GLuint buffer, size_t size, const void* data)
{
    gl->NamedBufferData(buffer, (GLsizeiptr)size, data, GL_STREAM_DRAW);
}

hair_result hair_gl_mapped(struct hair_gl* gl, const char* label, size_t size, GLuint* out,
                           const void** mapped)
{
    static const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    GLuint                  buffer = 0;
    GLint64                 got    = 0;
    const void*             at     = NULL;
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
    gl->ObjectLabel(GL_BUFFER, buffer, -1, label);
    *out    = buffer;
    *mapped = at;
    return HAIR_OK;
}

hair_result hair_gl_buffer_texture(struct hair_gl* gl, const char* label, GLenum format, GLuint buffer,
                                   GLuint* out)
{
    GLint64 wide = format == GL_RGBA16F || format == GL_RGBA16 ? 8 : 16;
    GLint64 size = 0, texel = format == GL_R32F || format == GL_R32UI ? 4 : wide;
    GLint   most = 0;
    gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
    gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (size / texel > most)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s takes %lld texels, more than the driver's %d",
                         label, (long long)(size / texel), most);
    GLuint texture = 0;
    gl->CreateTextures(GL_TEXTURE_BUFFER, 1, &texture);
    if (!texture) return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver makes no texture for %s", label);
    gl->TextureBuffer(texture, format, buffer);
    gl->ObjectLabel(GL_TEXTURE, texture, -1, label);
    *out = texture;
    return HAIR_OK;
}

hair_result hair_gl_texture_3d(struct hair_gl* gl, const char* label, GLenum format, const uint32_t size[3],
                               GLenum filter, GLuint* out)
{
    GLuint texture = 0;
    GLint  most = 0, got = 0;
    gl->GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
    for (int i = 0; i < 3; ++i)
        if (size[i] > (uint32_t)most)
            return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s is %u texels long, more than the driver's %d",
                             label, size[i], most);
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
    gl->TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, (GLint)filter);
    gl->TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, (GLint)filter);
    gl->TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->TextureParameteri(texture, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    gl->ObjectLabel(GL_TEXTURE, texture, -1, label);
    *out = texture;
    return HAIR_OK;
}

void hair_gl_fill_texture_3d(struct hair_gl* gl, GLuint texture, const uint32_t size[3], const void* texels)
{
    static const GLenum parts[] = {GL_UNPACK_SWAP_BYTES,  GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT,
                                   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_IMAGES};
    GLint               was[6], buffer = 0;
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
    if (*buffer) gl->DeleteBuffers(1, buffer);
    *buffer = 0;
}

void hair_gl_free_texture(struct hair_gl* gl, GLuint* texture)
{
    if (*texture) gl->DeleteTextures(1, texture);
    *texture = 0;
}
