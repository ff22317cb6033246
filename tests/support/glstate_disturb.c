// glstate_disturb.c - OpenGL state at odd values, as an application may leave it.
#include "tests/support/glstate.h"

#include <epoxy/gl.h>

#define COUNT(rows) (sizeof rows / sizeof *rows)

static GLuint make_buffer(GLsizeiptr size)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, size, NULL, GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}

static void disturb_buffers(void)
{
    static const GLenum targets[] = {
        GL_ARRAY_BUFFER,      GL_COPY_READ_BUFFER,     GL_COPY_WRITE_BUFFER,
        GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER,  GL_QUERY_BUFFER,
        GL_TEXTURE_BUFFER,    GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER};
    GLuint feedback, vertices;
    glCreateVertexArrays(1, &vertices);
    glVertexArrayElementBuffer(vertices, make_buffer(64));
    glBindVertexArray(vertices);
    glCreateTransformFeedbacks(1, &feedback);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback);
    // Bind odd ones as a range, even ones whole, and some not at all.
    for (GLuint i = 0; i < 16; ++i)
        if (i % 5 != 4) {
            if (i % 2)
                glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, make_buffer(4096), 256 * i, 64 + 16 * i);
            else
                glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, make_buffer(64));
        }
    for (GLuint i = 0; i < 36; ++i)
        if (i % 2 == 0)
            glBindBufferRange(GL_UNIFORM_BUFFER, i, make_buffer(16384), 256 * i, 16 + i);
        else
            glBindBufferBase(GL_UNIFORM_BUFFER, i, make_buffer(64));
    glBindBufferRange(GL_ATOMIC_COUNTER_BUFFER, 0, make_buffer(64), 4, 8);
    glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, make_buffer(64), 4, 8);
    glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 2, make_buffer(64), 8, 16);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, make_buffer(64));
    glBindBuffer(GL_UNIFORM_BUFFER, make_buffer(64));
    for (size_t i = 0; i < COUNT(targets); ++i) glBindBuffer(targets[i], make_buffer(64));
}

static void disturb_textures(void)
{
    static const GLenum targets[] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
                                     GL_TEXTURE_2D_ARRAY};
    for (GLuint unit = 0; unit < HAIR_TEST_UNITS; ++unit) {
        GLuint texture, sampler;
        for (size_t i = 0; i < COUNT(targets); ++i) {
            glCreateTextures(targets[i], 1, &texture);
            glBindTextureUnit(unit, texture);
        }
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture);
        glTextureBuffer(texture, GL_RGBA32F, make_buffer(256));
        glBindTextureUnit(unit, texture);
        glCreateSamplers(1, &sampler);
        glBindSampler(unit, sampler);
    }
    GLuint image;
    glCreateTextures(GL_TEXTURE_2D, 1, &image);
    glTextureStorage2D(image, 1, GL_R32F, 4, 4);
    for (GLuint i = 0; i < 8; i += 3) glBindImageTexture(i, image, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
    glActiveTexture(GL_TEXTURE3);
}

static void disturb_program(void)
{
    const char* text =
        "#version 450 core\nout gl_PerVertex { vec4 gl_Position; }; // separable programs must say so\n"
        "void main() { gl_Position = vec4(0.0); }\n";
    glUseProgram(glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &text));
    GLuint pipeline;
    glCreateProgramPipelines(1, &pipeline);
    glBindProgramPipeline(pipeline);
}

// Bind a framebuffer of 32 by 32 with two colours, depth and stencil.
static void disturb_targets(void)
{
    GLuint target[4], frame[2];
    glCreateRenderbuffers(4, target);
    glNamedRenderbufferStorage(target[0], GL_RGBA16F, 32, 32);
    glNamedRenderbufferStorage(target[1], GL_RGBA8, 32, 32);
    glNamedRenderbufferStorage(target[2], GL_DEPTH32F_STENCIL8, 32, 32);
    glNamedRenderbufferStorage(target[3], GL_RGBA8, 32, 32);
    glCreateFramebuffers(2, frame);
    glNamedFramebufferRenderbuffer(frame[0], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target[0]);
    glNamedFramebufferRenderbuffer(frame[0], GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER, target[1]);
    glNamedFramebufferRenderbuffer(frame[0], GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, target[2]);
    glNamedFramebufferRenderbuffer(frame[1], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target[3]);
    static const GLenum draw[] = {GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT0};
    glNamedFramebufferDrawBuffers(frame[0], 2, draw);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame[0]);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame[1]);
    glBindRenderbuffer(GL_RENDERBUFFER, target[1]);
    for (GLuint i = 0; i < 4; ++i) {
        glViewportIndexedf(i, 1.5f + i, 2, 20 + i, 17);
        glScissorIndexed(i, (GLint)i, 1, 21, 19);
        glColorMaski(i, i % 2 == 0, 1, i % 2 == 1, 1);
    }
    glDepthRange(0.125, 0.75);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
}

static void disturb_numbers(void)
{
    glPatchParameteri(GL_PATCH_VERTICES, 7);
    glPatchParameterfv(GL_PATCH_DEFAULT_INNER_LEVEL, (float[]){2, 3});
    glPatchParameterfv(GL_PATCH_DEFAULT_OUTER_LEVEL, (float[]){2, 3, 4, 5});
    glCullFace(GL_FRONT);
    glFrontFace(GL_CW);
    glPolygonOffset(1.5f, 2.5f);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glLogicOp(GL_INVERT);
    glBlendFuncSeparate(GL_DST_COLOR, GL_SRC_ALPHA, GL_ONE, GL_CONSTANT_COLOR);
    glBlendEquationSeparate(GL_FUNC_SUBTRACT, GL_MAX);
    glBlendColor(0.1f, 0.2f, 0.3f, 0.4f);
    glClearColor(0.5f, 0.6f, 0.7f, 0.8f);
    glClearDepth(0.25);
    glClearStencil(3);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glStencilFuncSeparate(GL_FRONT, GL_LEQUAL, 5, 0x3f);
    glStencilFuncSeparate(GL_BACK, GL_NOTEQUAL, 6, 0x1f);
    glStencilMaskSeparate(GL_FRONT, 0x0f);
    glStencilMaskSeparate(GL_BACK, 0x07);
    glStencilOpSeparate(GL_FRONT, GL_INCR, GL_DECR, GL_INVERT);
    glStencilOpSeparate(GL_BACK, GL_ZERO, GL_REPLACE, GL_INCR_WRAP);
    glLineWidth(1);
    glPointSize(3);
    glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 2);
    glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_LOWER_LEFT);
    glPrimitiveRestartIndex(1234);
    glSampleCoverage(0.5f, GL_TRUE);
    glSampleMaski(0, 0xfffffff5u);
    glMinSampleShading(0.25f);
    glHint(GL_LINE_SMOOTH_HINT, GL_NICEST);
    glHint(GL_POLYGON_SMOOTH_HINT, GL_FASTEST);
    glClampColor(GL_CLAMP_READ_COLOR, GL_TRUE);
    static const GLenum stores[] = {GL_PACK_ROW_LENGTH,   GL_PACK_IMAGE_HEIGHT,   GL_PACK_SKIP_PIXELS,
                                    GL_PACK_SKIP_ROWS,    GL_PACK_SKIP_IMAGES,    GL_PACK_SWAP_BYTES,
                                    GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                                    GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_IMAGES,  GL_UNPACK_SWAP_BYTES};
    for (size_t i = 0; i < COUNT(stores); ++i) glPixelStorei(stores[i], 1 + (GLint)i);
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
}

static void disturb_switches(void)
{
    static const GLenum on[] = {GL_CULL_FACE,         GL_DEPTH_TEST,          GL_STENCIL_TEST,
                                GL_SCISSOR_TEST,      GL_POLYGON_OFFSET_FILL, GL_DEPTH_CLAMP,
                                GL_PRIMITIVE_RESTART, GL_FRAMEBUFFER_SRGB,    GL_SAMPLE_MASK,
                                GL_SAMPLE_COVERAGE,   GL_PROGRAM_POINT_SIZE,  GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                GL_CLIP_DISTANCE3};
    static const GLenum queries[] = {GL_SAMPLES_PASSED, GL_PRIMITIVES_GENERATED,
                                     GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, GL_TIME_ELAPSED};
    for (size_t i = 0; i < COUNT(on); ++i) glEnable(on[i]);
    glDisable(GL_DITHER);
    glEnablei(GL_BLEND, 1);
    glDisablei(GL_SCISSOR_TEST, 2);
    for (size_t i = 0; i < COUNT(queries); ++i) {
        GLuint query;
        glCreateQueries(queries[i], 1, &query);
        glBeginQuery(queries[i], query);
    }
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "the host");
}

void hair_test_glstate_disturb(void)
{
    disturb_targets();
    disturb_textures();
    disturb_buffers();
    disturb_program();
    disturb_numbers();
    disturb_switches();
    if (hair_test_glstate_is_legacy()) hair_test_glstate_disturb_legacy();
}
