// glstate.c - all of the OpenGL state that an application may care about: set to odd values,
// recorded, compared.
#include "tests/support/glstate.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME(name) #name, name

struct row {
    const char* name;
    GLenum what;
    int count; // number of its components
};

static const struct row integers[] = {
    {NAME(GL_CURRENT_PROGRAM), 1},
    {NAME(GL_PROGRAM_PIPELINE_BINDING), 1},
    {NAME(GL_VERTEX_ARRAY_BINDING), 1},
    {NAME(GL_ARRAY_BUFFER_BINDING), 1},
    {NAME(GL_ELEMENT_ARRAY_BUFFER_BINDING), 1},
    {NAME(GL_COPY_READ_BUFFER_BINDING), 1},
    {NAME(GL_COPY_WRITE_BUFFER_BINDING), 1},
    {NAME(GL_DRAW_INDIRECT_BUFFER_BINDING), 1},
    {NAME(GL_DISPATCH_INDIRECT_BUFFER_BINDING), 1},
    {NAME(GL_PIXEL_PACK_BUFFER_BINDING), 1},
    {NAME(GL_PIXEL_UNPACK_BUFFER_BINDING), 1},
    {NAME(GL_QUERY_BUFFER_BINDING), 1},
    {NAME(GL_TEXTURE_BUFFER_BINDING), 1},
    {NAME(GL_UNIFORM_BUFFER_BINDING), 1},
    {NAME(GL_SHADER_STORAGE_BUFFER_BINDING), 1},
    {NAME(GL_ATOMIC_COUNTER_BUFFER_BINDING), 1},
    {NAME(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING), 1},
    {NAME(GL_TRANSFORM_FEEDBACK_BINDING), 1},
    {NAME(GL_TRANSFORM_FEEDBACK_ACTIVE), 1},
    {NAME(GL_TRANSFORM_FEEDBACK_PAUSED), 1},
    {NAME(GL_DRAW_FRAMEBUFFER_BINDING), 1},
    {NAME(GL_READ_FRAMEBUFFER_BINDING), 1},
    {NAME(GL_RENDERBUFFER_BINDING), 1},
    {NAME(GL_ACTIVE_TEXTURE), 1},
    {NAME(GL_PATCH_VERTICES), 1},
    {NAME(GL_VIEWPORT), 4},
    {NAME(GL_SCISSOR_BOX), 4},
    {NAME(GL_CULL_FACE_MODE), 1},
    {NAME(GL_FRONT_FACE), 1},
    {NAME(GL_POLYGON_MODE), 1},
    {NAME(GL_PROVOKING_VERTEX), 1},
    {NAME(GL_LOGIC_OP_MODE), 1},
    {NAME(GL_BLEND_SRC_RGB), 1},
    {NAME(GL_BLEND_DST_RGB), 1},
    {NAME(GL_BLEND_SRC_ALPHA), 1},
    {NAME(GL_BLEND_DST_ALPHA), 1},
    {NAME(GL_BLEND_EQUATION_RGB), 1},
    {NAME(GL_BLEND_EQUATION_ALPHA), 1},
    {NAME(GL_COLOR_WRITEMASK), 4},
    {NAME(GL_DEPTH_WRITEMASK), 1},
    {NAME(GL_DEPTH_FUNC), 1},
    {NAME(GL_STENCIL_FUNC), 1},
    {NAME(GL_STENCIL_REF), 1},
    {NAME(GL_STENCIL_VALUE_MASK), 1},
    {NAME(GL_STENCIL_WRITEMASK), 1},
    {NAME(GL_STENCIL_FAIL), 1},
    {NAME(GL_STENCIL_PASS_DEPTH_FAIL), 1},
    {NAME(GL_STENCIL_PASS_DEPTH_PASS), 1},
    {NAME(GL_STENCIL_BACK_FUNC), 1},
    {NAME(GL_STENCIL_BACK_REF), 1},
    {NAME(GL_STENCIL_BACK_VALUE_MASK), 1},
    {NAME(GL_STENCIL_BACK_WRITEMASK), 1},
    {NAME(GL_STENCIL_BACK_FAIL), 1},
    {NAME(GL_STENCIL_BACK_PASS_DEPTH_FAIL), 1},
    {NAME(GL_STENCIL_BACK_PASS_DEPTH_PASS), 1},
    {NAME(GL_STENCIL_CLEAR_VALUE), 1},
    {NAME(GL_SAMPLE_COVERAGE_INVERT), 1},
    {NAME(GL_PRIMITIVE_RESTART_INDEX), 1},
    {NAME(GL_CLIP_ORIGIN), 1},
    {NAME(GL_CLIP_DEPTH_MODE), 1},
    {NAME(GL_LINE_SMOOTH_HINT), 1},
    {NAME(GL_POLYGON_SMOOTH_HINT), 1},
    {NAME(GL_TEXTURE_COMPRESSION_HINT), 1},
    {NAME(GL_FRAGMENT_SHADER_DERIVATIVE_HINT), 1},
    {NAME(GL_POINT_SPRITE_COORD_ORIGIN), 1},
    {NAME(GL_PACK_ALIGNMENT), 1},
    {NAME(GL_PACK_ROW_LENGTH), 1},
    {NAME(GL_PACK_IMAGE_HEIGHT), 1},
    {NAME(GL_PACK_SKIP_PIXELS), 1},
    {NAME(GL_PACK_SKIP_ROWS), 1},
    {NAME(GL_PACK_SKIP_IMAGES), 1},
    {NAME(GL_PACK_SWAP_BYTES), 1},
    {NAME(GL_PACK_LSB_FIRST), 1},
    {NAME(GL_UNPACK_ALIGNMENT), 1},
    {NAME(GL_UNPACK_ROW_LENGTH), 1},
    {NAME(GL_UNPACK_IMAGE_HEIGHT), 1},
    {NAME(GL_UNPACK_SKIP_PIXELS), 1},
    {NAME(GL_UNPACK_SKIP_ROWS), 1},
    {NAME(GL_UNPACK_SKIP_IMAGES), 1},
    {NAME(GL_UNPACK_SWAP_BYTES), 1},
    {NAME(GL_UNPACK_LSB_FIRST), 1},
    {NAME(GL_DRAW_BUFFER), 1},
    {NAME(GL_READ_BUFFER), 1},
    {NAME(GL_CLAMP_READ_COLOR), 1},
    {NAME(GL_DEBUG_GROUP_STACK_DEPTH), 1},
};

static const struct row reals[] = {
    {NAME(GL_BLEND_COLOR), 4},
    {NAME(GL_COLOR_CLEAR_VALUE), 4},
    {NAME(GL_DEPTH_CLEAR_VALUE), 1},
    {NAME(GL_DEPTH_RANGE), 2},
    {NAME(GL_LINE_WIDTH), 1},
    {NAME(GL_POINT_SIZE), 1},
    {NAME(GL_POINT_FADE_THRESHOLD_SIZE), 1},
    {NAME(GL_POLYGON_OFFSET_FACTOR), 1},
    {NAME(GL_POLYGON_OFFSET_UNITS), 1},
    {NAME(GL_SAMPLE_COVERAGE_VALUE), 1},
    {NAME(GL_MIN_SAMPLE_SHADING_VALUE), 1},
    {NAME(GL_PATCH_DEFAULT_INNER_LEVEL), 2},
    {NAME(GL_PATCH_DEFAULT_OUTER_LEVEL), 4},
};

static const struct row switches[] = {
    {NAME(GL_BLEND), 8}, // one switch per draw buffer, viewport or distance
    {NAME(GL_SCISSOR_TEST), 4},
    {NAME(GL_CLIP_DISTANCE0), 0},
    {NAME(GL_CLIP_DISTANCE3), 0},
    {NAME(GL_COLOR_LOGIC_OP), 0},
    {NAME(GL_CULL_FACE), 0},
    {NAME(GL_DEBUG_OUTPUT), 0},
    {NAME(GL_DEBUG_OUTPUT_SYNCHRONOUS), 0},
    {NAME(GL_DEPTH_CLAMP), 0},
    {NAME(GL_DEPTH_TEST), 0},
    {NAME(GL_DITHER), 0},
    {NAME(GL_FRAMEBUFFER_SRGB), 0},
    {NAME(GL_LINE_SMOOTH), 0},
    {NAME(GL_MULTISAMPLE), 0},
    {NAME(GL_POLYGON_OFFSET_FILL), 0},
    {NAME(GL_POLYGON_OFFSET_LINE), 0},
    {NAME(GL_POLYGON_OFFSET_POINT), 0},
    {NAME(GL_POLYGON_SMOOTH), 0},
    {NAME(GL_PRIMITIVE_RESTART), 0},
    {NAME(GL_PRIMITIVE_RESTART_FIXED_INDEX), 0},
    {NAME(GL_PROGRAM_POINT_SIZE), 0},
    {NAME(GL_RASTERIZER_DISCARD), 0},
    {NAME(GL_SAMPLE_ALPHA_TO_COVERAGE), 0},
    {NAME(GL_SAMPLE_ALPHA_TO_ONE), 0},
    {NAME(GL_SAMPLE_COVERAGE), 0},
    {NAME(GL_SAMPLE_MASK), 0},
    {NAME(GL_SAMPLE_SHADING), 0},
    {NAME(GL_STENCIL_TEST), 0},
    {NAME(GL_TEXTURE_CUBE_MAP_SEAMLESS), 0},
};

static const struct row textures[] = {
    {NAME(GL_TEXTURE_BINDING_1D), 1},
    {NAME(GL_TEXTURE_BINDING_2D), 1},
    {NAME(GL_TEXTURE_BINDING_3D), 1},
    {NAME(GL_TEXTURE_BINDING_1D_ARRAY), 1},
    {NAME(GL_TEXTURE_BINDING_2D_ARRAY), 1},
    {NAME(GL_TEXTURE_BINDING_CUBE_MAP), 1},
    {NAME(GL_TEXTURE_BINDING_CUBE_MAP_ARRAY), 1},
    {NAME(GL_TEXTURE_BINDING_RECTANGLE), 1},
    {NAME(GL_TEXTURE_BINDING_BUFFER), 1},
    {NAME(GL_TEXTURE_BINDING_2D_MULTISAMPLE), 1},
    {NAME(GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY), 1},
    {NAME(GL_SAMPLER_BINDING), 1},
};

// Indexed bindings, with their number and the names of buffer, start and size, or of other parts.
static const struct {
    int count;
    struct row part[6];
} indexed[] = {
    {16,
     {{NAME(GL_SHADER_STORAGE_BUFFER_BINDING), 1},
      {NAME(GL_SHADER_STORAGE_BUFFER_START), 1},
      {NAME(GL_SHADER_STORAGE_BUFFER_SIZE), 1}}},
    {36,
     {{NAME(GL_UNIFORM_BUFFER_BINDING), 1},
      {NAME(GL_UNIFORM_BUFFER_START), 1},
      {NAME(GL_UNIFORM_BUFFER_SIZE), 1}}},
    {8,
     {{NAME(GL_ATOMIC_COUNTER_BUFFER_BINDING), 1},
      {NAME(GL_ATOMIC_COUNTER_BUFFER_START), 1},
      {NAME(GL_ATOMIC_COUNTER_BUFFER_SIZE), 1}}},
    {4,
     {{NAME(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING), 1},
      {NAME(GL_TRANSFORM_FEEDBACK_BUFFER_START), 1},
      {NAME(GL_TRANSFORM_FEEDBACK_BUFFER_SIZE), 1}}},
    {8,
     {{NAME(GL_IMAGE_BINDING_NAME), 1},
      {NAME(GL_IMAGE_BINDING_LEVEL), 1},
      {NAME(GL_IMAGE_BINDING_LAYERED), 1},
      {NAME(GL_IMAGE_BINDING_LAYER), 1},
      {NAME(GL_IMAGE_BINDING_ACCESS), 1},
      {NAME(GL_IMAGE_BINDING_FORMAT), 1}}},
    {1, {{NAME(GL_SAMPLE_MASK_VALUE), 1}}},
};

static const struct row queries[] = {
    {NAME(GL_SAMPLES_PASSED), 1},
    {NAME(GL_PRIMITIVES_GENERATED), 1},
    {NAME(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN), 1},
    {NAME(GL_TIME_ELAPSED), 1},
};

#define COUNT(rows) (sizeof rows / sizeof *rows)
#define UNITS 24

static void put(struct hair_test_glstate* out, const char* name, int i, int64_t value)
{
    if (out->count == HAIR_TEST_VALUES) abort();
    if (i < 0)
        snprintf(out->values[out->count].name, sizeof out->values->name, "%s", name);
    else
        snprintf(out->values[out->count].name, sizeof out->values->name, "%s %d", name, i);
    out->values[out->count++].value = value;
}

static void put_reals(struct hair_test_glstate* out, const char* name, int count, const float* values)
{
    for (int k = 0; k < count; ++k) {
        int32_t bits;
        memcpy(&bits, &values[k], sizeof bits);
        put(out, name, k, bits);
    }
}

static void put_switches(struct hair_test_glstate* out)
{
    for (size_t i = 0; i < COUNT(switches); ++i) {
        put(out, switches[i].name, -1, glIsEnabled(switches[i].what));
        for (int k = 0; k < switches[i].count; ++k)
            put(out, switches[i].name, k, glIsEnabledi(switches[i].what, (GLuint)k));
    }
}

static void put_indexed(struct hair_test_glstate* out)
{
    for (size_t i = 0; i < COUNT(indexed); ++i)
        for (int k = 0; k < indexed[i].count; ++k)
            for (int part = 0; part < 6 && indexed[i].part[part].name; ++part) {
                GLint64 value = -1;
                glGetInteger64i_v(indexed[i].part[part].what, (GLuint)k, &value);
                put(out, indexed[i].part[part].name, k, value);
            }
    for (GLuint unit = 0; unit < UNITS; ++unit)
        for (size_t i = 0; i < COUNT(textures); ++i) {
            GLint value = -1;
            glGetIntegeri_v(textures[i].what, unit, &value);
            put(out, textures[i].name, (int)unit, value);
        }
    for (GLuint k = 0; k < 4; ++k) {
        float viewport[4];
        GLint scissor[4], mask[4];
        glGetFloati_v(GL_VIEWPORT, k, viewport);
        put_reals(out, "GL_VIEWPORT of one", 4, viewport);
        glGetIntegeri_v(GL_SCISSOR_BOX, k, scissor);
        glGetIntegeri_v(GL_COLOR_WRITEMASK, k, mask);
        for (int c = 0; c < 4; ++c) {
            put(out, "GL_SCISSOR_BOX of one", c, scissor[c]);
            put(out, "GL_COLOR_WRITEMASK of one", c, mask[c]);
        }
    }
}

void hair_test_glstate_read(struct hair_test_glstate* out)
{
    out->count = 0;
    for (size_t i = 0; i < COUNT(integers); ++i) {
        GLint64 values[4] = {-1, -1, -1, -1};
        glGetInteger64v(integers[i].what, values);
        for (int k = 0; k < integers[i].count; ++k)
            put(out, integers[i].name, integers[i].count > 1 ? k : -1, values[k]);
    }
    for (size_t i = 0; i < COUNT(reals); ++i) {
        float values[4] = {0};
        glGetFloatv(reals[i].what, values);
        put_reals(out, reals[i].name, reals[i].count, values);
    }
    for (size_t i = 0; i < COUNT(queries); ++i) {
        GLint value = -1;
        glGetQueryiv(queries[i].what, GL_CURRENT_QUERY, &value);
        put(out, queries[i].name, -1, value);
    }
    put_switches(out);
    put_indexed(out);
}

size_t hair_test_glstate_differ(const struct hair_test_glstate* a, const struct hair_test_glstate* b,
                                size_t first)
{
    for (size_t i = first; i < a->count; ++i)
        if (a->values[i].value != b->values[i].value) return i;
    return a->count;
}

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
    for (GLuint unit = 0; unit < UNITS; ++unit) {
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
    for (size_t i = 0; i < COUNT(on); ++i) glEnable(on[i]);
    glDisable(GL_DITHER);
    glEnablei(GL_BLEND, 1);
    glDisablei(GL_SCISSOR_TEST, 2);
    for (size_t i = 0; i < COUNT(queries); ++i) {
        GLuint query;
        glCreateQueries(queries[i].what, 1, &query);
        glBeginQuery(queries[i].what, query);
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
}
