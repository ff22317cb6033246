// driver_quirks.c - tests for driver bugs with isolines, by drawing some and reading them back.
//
// Mesa's llvmpipe numbers the vertices of a tessellated draw in 16 bits. Beyond 65,536 vertices,
// later patches silently repeat earlier ones. One old driver swaps the two outer levels.
#include "lib/gl/buffers.h"
#include "lib/gl/capture.h"

#define LINES 64
#define SEGMENTS 32
#define PATCHES 32 // PATCHES * LINES * (SEGMENTS + 1) = 67,584 vertices
#define SAFE_DRAW_VERTICES 33000u // Below 65,536, and in the fastest range of llvmpipe.

struct captured {
    float patch, v;
};

static hair_result judge(struct hair_gl* gl, const struct captured* captured, size_t count)
{
    float max = 0;
    for (size_t i = 0; i < count; ++i)
        if (captured[i].v > max) max = captured[i].v;
    // v of the last of n lines is (n - 1) / n.
    float lines = 1 / (1 - max);
    if (lines > LINES - 4 && lines < LINES + 4)
        gl->lines_level = 0;
    else if (lines > SEGMENTS - 2 && lines < SEGMENTS + 2)
        gl->lines_level = 1;
    else
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "the driver made %.1f isolines where %d were asked for", (double)lines, LINES);
    int wraps = captured[count - 1].patch < PATCHES - 0.5f;
    gl->max_draw_vertices = wraps ? SAFE_DRAW_VERTICES : UINT32_MAX;
    if (wraps)
        hair_log(&gl->host, HAIR_LOG_INFO,
                 "this driver loses isolines beyond 65536 vertices in a draw: drawing in batches of %u",
                 SAFE_DRAW_VERTICES);
    return HAIR_OK;
}

static void draw_captured(struct hair_gl* gl, GLuint program, GLuint feedback, GLuint framebuffer)
{
    struct hair_gl_capture was;
    hair_gl_begin_capture(gl, framebuffer, &was);
    gl->BindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback);
    gl->PatchParameteri(GL_PATCH_VERTICES, 1);
    gl->UseProgram(program);
    gl->BeginTransformFeedback(GL_LINES);
    // Number patches from 1, so that zeros left in the buffer are no patch.
    gl->DrawArrays(GL_PATCHES, 1, PATCHES);
    gl->EndTransformFeedback();
    hair_gl_end_capture(gl, &was);
}

hair_result hair_gl_find_driver_quirks(struct hair_gl* gl)
{
    const size_t count = (size_t)PATCHES * LINES * SEGMENTS * 2;
    struct captured* captured = hair_alloc(&gl->host, count, sizeof *captured);
    if (!captured) return hair_fail_memory(&gl->host, "the self-test");

    GLuint program = 0, buffer = 0, feedback = 0, framebuffer = 0;
    const void* mapped = NULL;
    hair_result result =
        hair_gl_link(gl, "gl/selftest", "draw/patch.vert gl/driver_quirks.tesc gl/driver_quirks.tese",
                     "captured", &program);
    // A buffer that can be mapped is in the memory of the processor from the start. A driver would
    // warn that it moves another one there.
    if (!result)
        result =
            hair_gl_mapped(gl, HAIR_GL_NO_CATEGORY, "self-test", count * sizeof *captured, &buffer, &mapped);
    if (!result) {
        framebuffer = hair_gl_blank_framebuffer(gl);
        gl->CreateTransformFeedbacks(1, &feedback);
        if (!framebuffer || !feedback)
            result = hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no transform feedback");
    }
    if (!result) {
        gl->TransformFeedbackBufferBase(feedback, 0, buffer);
        draw_captured(gl, program, feedback, framebuffer);
        gl->GetNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * sizeof *captured), captured);
        result = judge(gl, captured, count);
    }
    if (feedback) gl->DeleteTransformFeedbacks(1, &feedback);
    if (framebuffer) gl->DeleteFramebuffers(1, &framebuffer);
    hair_gl_free_buffer(gl, &buffer);
    if (program) gl->DeleteProgram(program);
    hair_free(&gl->host, captured);
    return result;
}
