// refusal.c - a driver that refuses to create an object.
#include "tests/support/refusal.h"

#include <string.h>

#include <hair/hair_egl.h>

#include "tests/support/support.h"

struct hair_test_refusal hair_test_refusal;

static int refuses(void)
{
    return ++hair_test_refusal.creations == hair_test_refusal.refuse;
}

static void APIENTRY create_buffers(GLsizei count, GLuint* out)
{
    if (!refuses()) glCreateBuffers(count, out);
}
static void APIENTRY create_textures(GLenum target, GLsizei count, GLuint* out)
{
    if (!refuses()) glCreateTextures(target, count, out);
}
static void APIENTRY create_vertex_arrays(GLsizei count, GLuint* out)
{
    if (!refuses()) glCreateVertexArrays(count, out);
}
static void APIENTRY create_samplers(GLsizei count, GLuint* out)
{
    if (!refuses()) glCreateSamplers(count, out);
}
static GLuint APIENTRY create_program(void)
{
    return refuses() ? 0 : glCreateProgram();
}
static GLuint APIENTRY create_shader(GLenum stage)
{
    return refuses() ? 0 : glCreateShader(stage);
}
static void APIENTRY buffer_storage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags)
{
    if (!refuses()) glNamedBufferStorage(buffer, size, data, flags);
}
static void APIENTRY buffer_data(GLuint buffer, GLsizeiptr size, const void* data, GLenum usage)
{
    if (data || !refuses())
        // A call with data only writes an existing buffer.
        glNamedBufferData(buffer, size, data, usage);
}

void* hair_test_refusing_proc(const char* name, void* user)
{
#define REPLACE(gl_name, type, own)                                                                          \
    if (strcmp(name, gl_name) == 0) {                                                                        \
        type function = own;                                                                                 \
        void* address;                                                                                       \
        memcpy(&address, &function, sizeof address);                                                         \
        return address;                                                                                      \
    }
    REPLACE("glCreateBuffers", PFNGLCREATEBUFFERSPROC, create_buffers)
    REPLACE("glCreateTextures", PFNGLCREATETEXTURESPROC, create_textures)
    REPLACE("glCreateVertexArrays", PFNGLCREATEVERTEXARRAYSPROC, create_vertex_arrays)
    REPLACE("glCreateSamplers", PFNGLCREATESAMPLERSPROC, create_samplers)
    REPLACE("glCreateProgram", PFNGLCREATEPROGRAMPROC, create_program)
    REPLACE("glCreateShader", PFNGLCREATESHADERPROC, create_shader)
    REPLACE("glNamedBufferStorage", PFNGLNAMEDBUFFERSTORAGEPROC, buffer_storage)
    REPLACE("glNamedBufferData", PFNGLNAMEDBUFFERDATAPROC, buffer_data)
    return hair_egl_get_proc(name, user);
}
