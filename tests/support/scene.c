// scene.c - hair to draw, with its context, frame and view, draws that are read, and reports of
// draws.
#include "tests/support/scene.h"
#include "tests/support/tessellated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct hair_test_scene hair_test_scene_make(struct hair_test* test,
                                            void* (*get_proc)(const char* name, void* user))
{
    struct hair_test_scene scene = {.test = test, .view = hair_test_tessellated()};
    if (get_proc) scene.context = hair_test_context(test, get_proc);
    return scene;
}

void hair_test_scene_add(struct hair_test_scene* scene, const struct hair_test_handmade* groom,
                         const hair_desc* desc)
{
    hair_desc usual = hair_desc_default();
    scene->groom = hair_test_groom(&scene->test->host.host, groom ? *groom : hair_test_handmade_default());
    hair_test_ok(scene->test, hair_create(scene->context ? scene->context : scene->test->context,
                                          scene->groom, desc ? desc : &usual, &scene->hair));
}

struct hair_test_scene hair_test_scene_of(struct hair_test* test, const struct hair_test_handmade* groom,
                                          const hair_look* look)
{
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    hair_desc desc = hair_desc_default();
    desc.look = look;
    hair_test_scene_add(&scene, groom, &desc);
    return scene;
}

void hair_test_scene_free(struct hair_test_scene* scene)
{
    if (scene->frame.width) hair_test_frame_free(&scene->frame);
    hair_destroy(scene->hair);
    hair_groom_destroy(scene->groom);
    hair_context_destroy(scene->context);
}

void hair_test_scene_set_state(const struct hair_test_scene* scene, const struct hair_state* state)
{
    struct hair_gl* gl = &scene->hair->context->gl;
    // One driver loses data that is written to a buffer while a dispatch writes the buffer.
    glFinish();
    glNamedBufferSubData(scene->hair->sim.state, 0,
                         (GLsizeiptr)(scene->groom->info.guide_vertex_count * sizeof *state), state);
    hair_gl_enter(gl);
    hair_smooth_run(&scene->hair->geometry.smooth, &scene->hair->sim);
    hair_gl_leave(gl);
}

// Return a signed number of some bits.
static int signed_bits(uint64_t bits, int first, int count)
{
    return (int)((int64_t)(bits << (64 - first - count)) >> (64 - count));
}

void hair_test_read_frames(const hair_instance* hair, hair_vec4* tangent, hair_vec4* frame)
{
    const struct hair_smooth* smooth = &hair->geometry.smooth;
    size_t size = smooth->vertices * sizeof(uint64_t);
    uint64_t* packed = malloc(size);
    assert_non_null(packed);
    glGetNamedBufferSubData(smooth->buffer[1], 0, (GLsizeiptr)size, packed);
    for (size_t i = 0; i < smooth->vertices; ++i) {
        uint64_t bits = packed[i], largest = bits >> 54 & 3;
        double q[4], squares = 0;
        for (int k = 0, n = 0; k < 4; ++k) {
            if (k == (int)largest) continue;
            q[k] = sqrt(0.5) / 131071 * signed_bits(bits, 18 * n++, 18);
            squares += q[k] * q[k];
        }
        q[largest] = sqrt(1 - squares);
        frame[i] = (hair_vec4){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
        hair_quat turn = {frame[i].x, frame[i].y, frame[i].z, frame[i].w};
        hair_vec3 y = hair_rotate(turn, hair_v3(0, 1, 0));
        tangent[i] = (hair_vec4){y.x, y.y, y.z, (float)HAIR_FRAME_STRETCH * (float)signed_bits(bits, 56, 8)};
    }
    free(packed);
}

struct hair_reference_sample* hair_test_scene_scatter(const struct hair_test_scene* scene)
{
    const struct hair_groom* groom = scene->groom;
    uint32_t random = 99, each = 2 * groom->max_vertices - 1;
    struct hair_state* state = calloc(groom->info.guide_vertex_count, sizeof *state);
    struct hair_reference_sample* samples = calloc(each * groom->info.guide_count, sizeof *samples);
    const struct hair_step_params params = {.smooth_vertices = each,
                                            .rotation_before = {0, 0, 0, 1},
                                            .rotation_after = {0, 0, 0, 1},
                                            .rotation_now = {0, 0, 0, 1}};
    hair_test_scatter(groom, 0.001f, 0, &random, state);
    hair_test_scene_set_state(scene, state);
    for (uint32_t g = 0; g < groom->info.guide_count; ++g) {
        static struct hair_reference_vertex vertices[HAIR_MAX_GUIDE_VERTICES];
        const struct hair_guide* guide = &groom->guides[g];
        for (uint32_t i = 0; i < guide->count; ++i) {
            hair_vec4 p = state[guide->first + i].position;
            vertices[i] = (struct hair_reference_vertex){{p.x, p.y, p.z}, {0}};
        }
        hair_reference_smooth((struct hair_reference_guide){guide, groom->rest + guide->first, &params},
                              vertices, samples + g * each);
    }
    free(state);
    return samples;
}

void hair_test_set_orthographic(hair_view* view, float scale, float depth, float up)
{
    const float projection[16] = {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, depth, 0, 0, up, 0, 1};
    memcpy(view->projection, projection, sizeof projection);
}

hair_view hair_test_view_by(hair_render_path path)
{
    hair_view view = hair_test_tessellated();
    view.render_path = path;
    hair_test_set_orthographic(&view, 3, 3, 0);
    return view;
}

void hair_test_set_perspective(hair_view* view, float scale, float aspect)
{
    const float projection[16] = {scale / aspect, 0, 0, 0, 0, scale, 0, 0, 0, 0, -1, -1, 0, 0, -0.02f, 0};
    memcpy(view->projection, projection, sizeof projection);
}

void hair_test_draw(const struct hair_test_scene* scene, const hair_view* view, GLsizei width, GLsizei height,
                    GLsizei samples, float* pixels, float* depths)
{
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, width, height, GL_RGBA32F, samples);
    hair_test_ok(scene->test, hair_draw(scene->hair, view));
    hair_test_frame_read(&frame, pixels);
    if (depths) hair_test_frame_read_depth(&frame, depths);
    hair_test_frame_free(&frame);
}

void hair_test_draw_in(const struct hair_test_frame* frame, const struct hair_test* test, hair_instance* hair,
                       const hair_view* view, float* pixels)
{
    hair_test_frame_clear(frame);
    hair_test_ok(test, hair_draw(hair, view));
    hair_test_frame_read(frame, pixels);
}

void hair_test_draw_ids(const struct hair_test* test, hair_instance* hair, const hair_view* view,
                        GLsizei side, uint32_t* ids)
{
    struct hair_test_frame frame;
    hair_view own = *view;
    own.pass = HAIR_PASS_ID, own.shader = NULL;
    hair_test_frame_make(&frame, side, side, GL_RGBA32UI, 0);
    hair_test_ok(test, hair_draw(hair, &own));
    glReadPixels(0, 0, side, side, GL_RGBA_INTEGER, GL_UNSIGNED_INT, ids);
    hair_test_frame_free(&frame);
}

void hair_test_read_points(const struct hair_test* test, hair_instance* hair, hair_read_source source,
                           struct hair_test_points* out)
{
    hair_test_ok(test, hair_read_positions(hair, source, out->at, HAIR_TEST_POINTS, &out->count));
    assert_in_range(out->count, 1, HAIR_TEST_POINTS);
    for (uint32_t i = 0; i < 3 * out->count; ++i) assert_true(isfinite(out->at[i]));
}

double hair_test_points_distance(const struct hair_test_points* a, const struct hair_test_points* b)
{
    double max = 0;
    assert_int_equal(a->count, b->count);
    for (uint32_t i = 0; i < a->count; ++i)
        max = fmax(max, (double)hair_distance(hair_load3(a->at + 3 * i), hair_load3(b->at + 3 * i)));
    return max;
}

hair_buffers hair_test_get_buffers(const struct hair_test_scene* scene, hair_read_source source,
                                   uint32_t attributes)
{
    hair_buffers out = hair_buffers_default();
    out.attributes = attributes;
    hair_test_ok(scene->test, hair_get_buffers(scene->hair, source, &out));
    return out;
}

double hair_test_mean_alpha(const float* pixels, size_t count)
{
    double sum = 0;
    for (size_t i = 3; i < count; i += 4) sum += (double)pixels[i];
    return 4 * sum / (double)count;
}

float hair_test_max_difference(const float* a, const float* b, size_t count)
{
    float max = 0;
    for (size_t i = 0; i < count; ++i) max = fmaxf(max, fabsf(a[i] - b[i]));
    return max;
}

GLuint hair_test_count_begin(void)
{
    GLuint query;
    glGenQueries(1, &query);
    glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    return query;
}

uint32_t hair_test_count_end(GLuint query)
{
    GLuint count = 0;
    glEndQuery(GL_PRIMITIVES_GENERATED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    glDeleteQueries(1, &query);
    return count;
}

hair_render_path hair_test_path_of(const struct hair_renderer* renderer, const hair_view* view)
{
    struct hair_draw_plan plan;
    hair_gl_read_draw_state(renderer->gl);
    hair_draw_make_plan(renderer, view, NULL, &plan);
    return plan.path;
}

hair_report_row hair_test_report_row(const struct hair_test* test, hair_instance* hair, const char* stage)
{
    hair_report_row rows[64] = {{0}};
    hair_report_info info = hair_report_info_default();
    uint32_t count = 0;
    hair_test_ok(test, hair_report(hair, true, &info, rows, sizeof *rows, 64, &count));
    for (uint32_t i = 0; i < count; ++i)
        if (strcmp(rows[i].stage, stage) == 0) return rows[i];
    fail_msg("there is no row %s", stage);
    return rows[0];
}
