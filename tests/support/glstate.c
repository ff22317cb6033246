// glstate.c - all of the OpenGL state that an application may care about, recorded and compared.
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

void hair_test_glstate_put(struct hair_test_glstate* out, const char* name, int i, int64_t value)
{
    if (out->count == HAIR_TEST_VALUES) abort();
    if (i < 0)
        snprintf(out->values[out->count].name, sizeof out->values->name, "%s", name);
    else
        snprintf(out->values[out->count].name, sizeof out->values->name, "%s %d", name, i);
    out->values[out->count++].value = value;
}

void hair_test_glstate_put_reals(struct hair_test_glstate* out, const char* name, int count,
                                 const float* values)
{
    for (int k = 0; k < count; ++k) {
        int32_t bits;
        memcpy(&bits, &values[k], sizeof bits);
        hair_test_glstate_put(out, name, k, bits);
    }
}

static void put_switches(struct hair_test_glstate* out)
{
    for (size_t i = 0; i < COUNT(switches); ++i) {
        hair_test_glstate_put(out, switches[i].name, -1, glIsEnabled(switches[i].what));
        for (int k = 0; k < switches[i].count; ++k)
            hair_test_glstate_put(out, switches[i].name, k, glIsEnabledi(switches[i].what, (GLuint)k));
    }
}

static void put_indexed(struct hair_test_glstate* out)
{
    for (size_t i = 0; i < COUNT(indexed); ++i)
        for (int k = 0; k < indexed[i].count; ++k)
            for (int part = 0; part < 6 && indexed[i].part[part].name; ++part) {
                GLint64 value = -1;
                glGetInteger64i_v(indexed[i].part[part].what, (GLuint)k, &value);
                hair_test_glstate_put(out, indexed[i].part[part].name, k, value);
            }
    for (GLuint unit = 0; unit < HAIR_TEST_UNITS; ++unit)
        for (size_t i = 0; i < COUNT(textures); ++i) {
            GLint value = -1;
            glGetIntegeri_v(textures[i].what, unit, &value);
            hair_test_glstate_put(out, textures[i].name, (int)unit, value);
        }
    for (GLuint k = 0; k < 4; ++k) {
        float viewport[4];
        GLint scissor[4], mask[4];
        glGetFloati_v(GL_VIEWPORT, k, viewport);
        hair_test_glstate_put_reals(out, "GL_VIEWPORT of one", 4, viewport);
        glGetIntegeri_v(GL_SCISSOR_BOX, k, scissor);
        glGetIntegeri_v(GL_COLOR_WRITEMASK, k, mask);
        for (int c = 0; c < 4; ++c) {
            hair_test_glstate_put(out, "GL_SCISSOR_BOX of one", c, scissor[c]);
            hair_test_glstate_put(out, "GL_COLOR_WRITEMASK of one", c, mask[c]);
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
            hair_test_glstate_put(out, integers[i].name, integers[i].count > 1 ? k : -1, values[k]);
    }
    for (size_t i = 0; i < COUNT(reals); ++i) {
        float values[4] = {0};
        glGetFloatv(reals[i].what, values);
        hair_test_glstate_put_reals(out, reals[i].name, reals[i].count, values);
    }
    for (size_t i = 0; i < COUNT(queries); ++i) {
        GLint value = -1;
        glGetQueryiv(queries[i].what, GL_CURRENT_QUERY, &value);
        hair_test_glstate_put(out, queries[i].name, -1, value);
    }
    put_switches(out);
    put_indexed(out);
    if (hair_test_glstate_is_legacy()) hair_test_glstate_read_legacy(out);
}

size_t hair_test_glstate_differ(const struct hair_test_glstate* a, const struct hair_test_glstate* b,
                                size_t first)
{
    for (size_t i = first; i < a->count; ++i)
        if (a->values[i].value != b->values[i].value) return i;
    return a->count;
}
