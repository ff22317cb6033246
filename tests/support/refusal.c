// refusal.c - a driver that refuses objects, memory, mappings, compilation and limits on demand.
#include "tests/support/refusal.h"

#include <string.h>

#include <hair/hair_egl.h>

#include "tests/support/support.h"

struct hair_test_refusal hair_test_refusal = {.refusable = HAIR_TEST_REFUSE_OBJECTS};

static bool refuses(unsigned kind, const char* name)
{
    struct hair_test_refusal* r = &hair_test_refusal;
    if (!(r->refusable & kind)) return false;
    ++r->creations;
    bool is_refused = r->refuse && (r->is_lasting ? r->creations >= r->refuse : r->creations == r->refuse);
    r->refused += is_refused;
    if (is_refused) r->last = name;
    return is_refused;
}

// Objects -----------------------------------------------------------------------------------------

static void count(GLsizei number, const GLuint* names, int32_t by)
{
    for (GLsizei i = 0; i < number; ++i) hair_test_refusal.live += names[i] ? by : 0;
}

#define CREATE(name, kind)                                                                                   \
    static void APIENTRY create_##name(GLsizei number, GLuint* out)                                          \
    {                                                                                                        \
        if (refuses(kind, "glCreate" #name)) return;                                                         \
        glCreate##name(number, out);                                                                         \
        count(number, out, 1);                                                                               \
    }
#define CREATE_FOR(name, kind)                                                                               \
    static void APIENTRY create_##name(GLenum target, GLsizei number, GLuint* out)                           \
    {                                                                                                        \
        if (refuses(kind, "glCreate" #name)) return;                                                         \
        glCreate##name(target, number, out);                                                                 \
        count(number, out, 1);                                                                               \
    }
#define DELETE(name)                                                                                         \
    static void APIENTRY delete_##name(GLsizei number, const GLuint* names)                                  \
    {                                                                                                        \
        count(number, names, -1);                                                                            \
        glDelete##name(number, names);                                                                       \
    }
CREATE(Buffers, HAIR_TEST_REFUSE_OBJECTS)
CREATE_FOR(Textures, HAIR_TEST_REFUSE_OBJECTS)
CREATE(VertexArrays, HAIR_TEST_REFUSE_OBJECTS)
CREATE(Samplers, HAIR_TEST_REFUSE_OBJECTS)
CREATE(Framebuffers, HAIR_TEST_REFUSE_FRAMES)
CREATE(TransformFeedbacks, HAIR_TEST_REFUSE_FRAMES)
CREATE_FOR(Queries, HAIR_TEST_REFUSE_QUERIES)
DELETE(Buffers)
DELETE(Textures)
DELETE(VertexArrays)
DELETE(Samplers)
DELETE(Framebuffers)
DELETE(TransformFeedbacks)
DELETE(Queries)

static GLuint APIENTRY create_program(void)
{
    GLuint name = refuses(HAIR_TEST_REFUSE_OBJECTS, "glCreateProgram") ? 0 : glCreateProgram();
    count(1, &name, 1);
    return name;
}
static GLuint APIENTRY create_shader(GLenum stage)
{
    GLuint name = refuses(HAIR_TEST_REFUSE_OBJECTS, "glCreateShader") ? 0 : glCreateShader(stage);
    count(1, &name, 1);
    return name;
}
static void APIENTRY delete_program(GLuint name)
{
    count(1, &name, -1);
    glDeleteProgram(name);
}
static void APIENTRY delete_shader(GLuint name)
{
    count(1, &name, -1);
    glDeleteShader(name);
}

// Memory ------------------------------------------------------------------------------------------

static void APIENTRY buffer_storage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags)
{
    if (!refuses(HAIR_TEST_REFUSE_OBJECTS, "glNamedBufferStorage"))
        glNamedBufferStorage(buffer, size, data, flags);
}

// A call with data that do not make the buffer larger only writes the buffer. A refused call that
// makes the buffer larger loses the buffer's memory, as with Mesa.
static void APIENTRY buffer_data(GLuint buffer, GLsizeiptr size, const void* data, GLenum usage)
{
    GLint64 was = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &was);
    if (!data && refuses(HAIR_TEST_REFUSE_OBJECTS, "glNamedBufferData")) return;
    bool is_lost = data && size > was && refuses(HAIR_TEST_REFUSE_MEMORY, "glNamedBufferData");
    glNamedBufferData(buffer, is_lost ? 0 : size, is_lost ? NULL : data, usage);
}
static void APIENTRY storage_2d(GLuint texture, GLsizei levels, GLenum format, GLsizei w, GLsizei h)
{
    if (!refuses(HAIR_TEST_REFUSE_MEMORY, "glTextureStorage2D"))
        glTextureStorage2D(texture, levels, format, w, h);
}
static void APIENTRY storage_3d(GLuint texture, GLsizei levels, GLenum format, GLsizei w, GLsizei h,
                                GLsizei d)
{
    if (!refuses(HAIR_TEST_REFUSE_MEMORY, "glTextureStorage3D"))
        glTextureStorage3D(texture, levels, format, w, h, d);
}
static void* APIENTRY map(GLuint buffer, GLintptr at, GLsizeiptr size, GLbitfield access)
{
    return refuses(HAIR_TEST_REFUSE_MAPS, "glMapNamedBufferRange")
               ? NULL
               : glMapNamedBufferRange(buffer, at, size, access);
}

// Frames and fences -------------------------------------------------------------------------------

static GLenum APIENTRY frame_status(GLenum target)
{
    return refuses(HAIR_TEST_REFUSE_FRAMES, "glCheckFramebufferStatus") ? GL_FRAMEBUFFER_UNSUPPORTED
                                                                        : glCheckFramebufferStatus(target);
}
static GLenum APIENTRY named_frame_status(GLuint frame, GLenum target)
{
    return refuses(HAIR_TEST_REFUSE_FRAMES, "glCheckNamedFramebufferStatus")
               ? GL_FRAMEBUFFER_UNSUPPORTED
               : glCheckNamedFramebufferStatus(frame, target);
}
static GLsync APIENTRY fence(GLenum condition, GLbitfield flags)
{
    if (refuses(HAIR_TEST_REFUSE_QUERIES, "glFenceSync")) return NULL;
    ++hair_test_refusal.live;
    return glFenceSync(condition, flags);
}
static GLenum APIENTRY wait_fence(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    return refuses(HAIR_TEST_REFUSE_QUERIES, "glClientWaitSync") ? GL_WAIT_FAILED
                                                                 : glClientWaitSync(sync, flags, timeout);
}
static void APIENTRY delete_fence(GLsync sync)
{
    hair_test_refusal.live -= sync != NULL;
    glDeleteSync(sync);
}

// Answers -----------------------------------------------------------------------------------------

static void APIENTRY get_shader(GLuint shader, GLenum what, GLint* out)
{
    glGetShaderiv(shader, what, out);
    if (what == GL_COMPILE_STATUS && refuses(HAIR_TEST_REFUSE_PROGRAMS, "glGetShaderiv")) *out = 0;
}
static void APIENTRY get_program(GLuint program, GLenum what, GLint* out)
{
    glGetProgramiv(program, what, out);
    if (what == GL_LINK_STATUS && refuses(HAIR_TEST_REFUSE_PROGRAMS, "glGetProgramiv")) *out = 0;
}
static void APIENTRY get_integer(GLenum what, GLint* out)
{
    glGetIntegerv(what, out);
    bool is_limit = what == GL_MAX_SHADER_STORAGE_BLOCK_SIZE || what == GL_MAX_TEXTURE_BUFFER_SIZE ||
                    what == GL_MAX_3D_TEXTURE_SIZE;
    if (is_limit && refuses(HAIR_TEST_REFUSE_LIMITS, "glGetIntegerv")) *out = 1;
}

void* hair_test_refusing_proc(const char* name, void* user)
{
    static const struct {
        const char* name;
        void (*function)(void);
    } own[] = {
        {"glCreateBuffers", (void (*)(void))create_Buffers},
        {"glCreateTextures", (void (*)(void))create_Textures},
        {"glCreateVertexArrays", (void (*)(void))create_VertexArrays},
        {"glCreateSamplers", (void (*)(void))create_Samplers},
        {"glCreateFramebuffers", (void (*)(void))create_Framebuffers},
        {"glCreateTransformFeedbacks", (void (*)(void))create_TransformFeedbacks},
        {"glCreateQueries", (void (*)(void))create_Queries},
        {"glCreateProgram", (void (*)(void))create_program},
        {"glCreateShader", (void (*)(void))create_shader},
        {"glDeleteBuffers", (void (*)(void))delete_Buffers},
        {"glDeleteTextures", (void (*)(void))delete_Textures},
        {"glDeleteVertexArrays", (void (*)(void))delete_VertexArrays},
        {"glDeleteSamplers", (void (*)(void))delete_Samplers},
        {"glDeleteFramebuffers", (void (*)(void))delete_Framebuffers},
        {"glDeleteTransformFeedbacks", (void (*)(void))delete_TransformFeedbacks},
        {"glDeleteQueries", (void (*)(void))delete_Queries},
        {"glDeleteProgram", (void (*)(void))delete_program},
        {"glDeleteShader", (void (*)(void))delete_shader},
        {"glDeleteSync", (void (*)(void))delete_fence},
        {"glNamedBufferStorage", (void (*)(void))buffer_storage},
        {"glNamedBufferData", (void (*)(void))buffer_data},
        {"glTextureStorage2D", (void (*)(void))storage_2d},
        {"glTextureStorage3D", (void (*)(void))storage_3d},
        {"glMapNamedBufferRange", (void (*)(void))map},
        {"glCheckFramebufferStatus", (void (*)(void))frame_status},
        {"glCheckNamedFramebufferStatus", (void (*)(void))named_frame_status},
        {"glFenceSync", (void (*)(void))fence},
        {"glClientWaitSync", (void (*)(void))wait_fence},
        {"glGetShaderiv", (void (*)(void))get_shader},
        {"glGetProgramiv", (void (*)(void))get_program},
        {"glGetIntegerv", (void (*)(void))get_integer},
    };
    if (refuses(HAIR_TEST_REFUSE_FUNCTIONS, name)) return NULL;
    for (size_t i = 0; i < sizeof own / sizeof *own; ++i) {
        if (strcmp(own[i].name, name) != 0) continue;
        void* address;
        memcpy(&address, &own[i].function, sizeof address);
        return address;
    }
    return hair_egl_get_proc(name, user);
}
