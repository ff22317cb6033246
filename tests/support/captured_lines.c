// captured_lines.c - capture of drawn lines by transform feedback, between the library and OpenGL.
#include "tests/support/captured_lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/passes.h"
#include "tests/support/tessellated.h"

// Functions and state that capture draws between the library and OpenGL.
static struct {
    void(APIENTRY* patches)(GLenum, GLint, GLsizei, GLsizei);
    void(APIENTRY* listed)(GLenum, GLenum, const void*, GLsizei, GLsizei);
    GLuint feedback, buffer, queries[2];
    GLintptr at; // Number of bytes captured so far.
    uint64_t generated, draws;
} capture;

// Start a capture. Each draw is its own transform feedback, because the library could not change
// its program during an active one.
static void begin_capture(void)
{
    GLint64 size;
    glCreateQueries(GL_PRIMITIVES_GENERATED, 1, &capture.queries[0]);
    glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, &capture.queries[1]);
    glGetNamedBufferParameteri64v(capture.buffer, GL_BUFFER_SIZE, &size);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, capture.feedback);
    glTransformFeedbackBufferRange(capture.feedback, 0, capture.buffer, capture.at, size - capture.at);
    glBeginQuery(GL_PRIMITIVES_GENERATED, capture.queries[0]);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, capture.queries[1]);
    glBeginTransformFeedback(GL_LINES);
}

static void end_capture(void)
{
    GLuint64 generated = 0, written = 0;
    glEndTransformFeedback();
    glEndQuery(GL_PRIMITIVES_GENERATED);
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glGetQueryObjectui64v(capture.queries[0], GL_QUERY_RESULT, &generated);
    glGetQueryObjectui64v(capture.queries[1], GL_QUERY_RESULT, &written);
    glDeleteQueries(2, capture.queries);
    capture.generated += generated;
    capture.at += (GLintptr)(written * 2 * sizeof(struct hair_test_vertex));
    ++capture.draws;
}

static void APIENTRY capture_patches(GLenum mode, GLint first, GLsizei count, GLsizei instances)
{
    begin_capture();
    capture.patches(mode, first, count, instances);
    end_capture();
}

static void APIENTRY capture_listed(GLenum mode, GLenum type, const void* commands, GLsizei count,
                                    GLsizei stride)
{
    begin_capture();
    capture.listed(mode, type, commands, count, stride);
    end_capture();
}

#define FIBRES_LINES (HAIR_GL_WITH(FIBRES) | HAIR_GL_WITH(LINES))
#define SHADED_LINES (HAIR_GL_WITH(SHADED) | HAIR_GL_WITH(LINES))
#define HITS HAIR_GL_WITH(HITS)

// Passes that draw lines, and their stages without the fragment shader: without and with colliders
// in reach.
static const struct {
    hair_gl_pass pass[2];
    const char* stages[2];
} paths[] = {
    [HAIR_TEST_TESSELLATION] = {{HAIR_GL_TESSELLATED | FIBRES_LINES,
                                 HAIR_GL_TESSELLATED | HITS | FIBRES_LINES},
                                {"draw/patch.vert draw/patch.tesc draw/strand.tese",
                                 "HAIR_HITS=1 draw/patch.vert draw/patch.tesc draw/strand.tese"}},
    [HAIR_TEST_PROCEDURAL] = {{HAIR_GL_PROCEDURAL | FIBRES_LINES, HAIR_GL_PROCEDURAL | HITS | FIBRES_LINES},
                              {"draw/strand.vert", "HAIR_HITS=1 draw/strand.vert"}},
    [HAIR_TEST_CACHED] = {{HAIR_GL_CACHED | SHADED_LINES, HAIR_GL_CACHED | SHADED_LINES},
                          {"HAIR_VERTEX_CACHE=1 draw/strand.vert", "HAIR_VERTEX_CACHE=1 draw/strand.vert"}},
};

_Static_assert(sizeof paths / sizeof *paths == HAIR_TEST_CAPTURED_PATHS, "");

struct hair_test_lines hair_test_capture_lines(struct hair_test* test, hair_instance* hair, size_t path,
                                               size_t max_segments, int hits, const hair_lod* lod)
{
    struct hair_gl* gl = &test->context->gl;
    bool is_styled = hair_look_is_styled(&hair->geometry.look);
    hair_gl_pass pass = paths[path].pass[hits] | (lod ? HAIR_GL_WITH(WIDENED) : 0);
    pass = hair_geometry_add_style(&hair->geometry, pass);
    struct hair_gl_program* own = hair_gl_get_or_add(gl, pass);
    GLuint whole = own->program, program = 0;
    char stages[128];
    snprintf(stages, sizeof stages, "%s%s%s", is_styled ? "HAIR_STYLED=1 " : "", lod ? "HAIR_WIDENED=1 " : "",
             paths[path].stages[hits]);
    hair_test_ok(test, hair_gl_link(gl, "capture", stages, "strand_position", &program));
    memset(&capture, 0, sizeof capture);
    capture.patches = gl->DrawArraysInstanced;
    capture.listed = gl->MultiDrawElementsIndirect;
    glCreateTransformFeedbacks(1, &capture.feedback);
    glCreateBuffers(1, &capture.buffer);
    // The buffer has room for more than the right number of vertices, to detect too many.
    glNamedBufferStorage(capture.buffer,
                         (GLsizeiptr)((max_segments + 64) * 2 * sizeof(struct hair_test_vertex)), NULL, 0);

    struct hair_test_frame frame; // Without a framebuffer every draw fails.
    hair_test_frame_make(&frame, 4, 4, GL_RGBA8, 0);
    own->program = program;
    gl->DrawArraysInstanced = capture_patches;
    gl->MultiDrawElementsIndirect = capture_listed;
    hair_view view = hair_test_tessellated();
    view.render_path = hair_test_paths[path];
    view.lod = lod;
    view.primitive = HAIR_PRIMITIVE_LINES;
    hair_result result = hair_draw(hair, &view);
    own->program = whole;
    gl->DrawArraysInstanced = capture.patches;
    gl->MultiDrawElementsIndirect = capture.listed;
    hair_test_frame_free(&frame);
    hair_test_ok(test, result);

    struct hair_test_lines drawn = {.segments = (size_t)capture.at / (2 * sizeof(struct hair_test_vertex)),
                                    .generated = capture.generated,
                                    .draws = capture.draws};
    drawn.vertices = malloc((size_t)capture.at + 1);
    glGetNamedBufferSubData(capture.buffer, 0, capture.at, drawn.vertices);
    glDeleteBuffers(1, &capture.buffer);
    glDeleteTransformFeedbacks(1, &capture.feedback);
    glDeleteProgram(program);
    return drawn;
}

hair_look hair_test_even_look(uint32_t segments)
{
    hair_look look = hair_look_default();
    look.strand.segments = segments;
    look.strand.radius = 0.001f;
    look.strand.taper = hair_curve_line(1, 1);
    return look;
}

struct segment {
    struct hair_test_vertex ends[2];
    size_t at;
};

static int by_follower(const void* a, const void* b)
{
    const struct segment *p = a, *q = b;
    if (p->ends[0].radius != q->ends[0].radius) return p->ends[0].radius < q->ends[0].radius ? -1 : 1;
    return p->at < q->at ? -1 : p->at > q->at;
}

void hair_test_sort_lines(struct hair_test_lines* drawn)
{
    struct segment* segments = malloc(drawn->segments * sizeof *segments + 1);
    for (size_t k = 0; k < drawn->segments; ++k)
        segments[k] = (struct segment){{drawn->vertices[2 * k], drawn->vertices[2 * k + 1]}, k};
    qsort(segments, drawn->segments, sizeof *segments, by_follower);
    for (size_t k = 0; k < drawn->segments; ++k)
        memcpy(&drawn->vertices[2 * k], segments[k].ends, sizeof segments[k].ends);
    free(segments);
}
