// smooth_test.c - guides are smoothed on the GPU as in the double-precision reference.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#include "lib/base/math.h"

#define STATES 4096
#define SAMPLES 8192

struct fixture {
    struct hair_test_scene scene;
    struct hair_step_params params;
    struct hair_state state[STATES];
    hair_vec4 position[SAMPLES], tangent[SAMPLES], frame[SAMPLES]; // Results of the GPU.
    struct hair_reference_sample expected[SAMPLES];
    uint32_t samples, random;
    double direction, turn; // Maximum errors of unit vectors and of frames.
};

static hair_vec4 turn_about(hair_vec3 axis, float angle)
{
    axis = hair_scale(hair_normalize(axis, hair_v3(0, 1, 0)), sinf(angle / 2));
    return (hair_vec4){axis.x, axis.y, axis.z, cosf(angle / 2)};
}

// Maximum error of a position, in metres. Lengths and positions are under 1 m and rounded to a
// relative 2^-24, about 20 times per sample. By Higham and Mary 2019, the error is within 6
// sqrt(20) 2^-24 in all but one of a million cases.
#define POSITION (6 * 4.5 / 16777216)

static struct fixture* start_with(void** state, struct hair_test_handmade wanted)
{
    static struct fixture f;
    memset(&f, 0, sizeof f);
    f.scene = hair_test_scene_of(*state, &wanted, NULL);
    f.random = 54321;
    f.params.guides = f.scene.groom->info.guide_count;
    f.params.smooth_vertices = 2 * f.scene.groom->max_vertices - 1;
    f.params.rotation_before = turn_about(hair_v3(1, 2, 3), 0.3f);
    f.params.rotation_after = turn_about(hair_v3(1, 2, 2.5f), 0.4f);
    f.params.rotation_now = turn_about(hair_v3(3, -1, 1), 0.5f);
    f.params.last_displacement = (hair_vec4){0.003f, -0.004f, 0.001f, 0};
    f.params.alpha = 0.375f;
    f.samples = f.params.guides * f.params.smooth_vertices;
    // A direction is the difference of positions that are at least half a segment apart. A frame
    // has the errors of all frames before it, which add up as the square root of their number.
    f.direction = POSITION / (0.5 * (double)wanted.segment);
    f.turn = sqrt(f.scene.groom->max_vertices) * f.direction;
    hair_test_scatter(f.scene.groom, 0.1f * wanted.segment, 0.2f * wanted.segment, &f.random, f.state);
    return &f;
}

// Start with one guide of each number of vertices.
static struct fixture* start(void** state, uint32_t fewest, uint32_t max)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = fewest, wanted.max = max, wanted.guides = max - fewest + 1;
    return start_with(state, wanted);
}

static void run(struct fixture* f)
{
    glFinish(); // One driver loses data that is written to a buffer which a dispatch reads.
    glNamedBufferSubData(f->scene.hair->sim.step, 0, sizeof f->params, &f->params);
    hair_test_scene_set_state(&f->scene, f->state);
    glGetNamedBufferSubData(f->scene.hair->geometry.smooth.buffer[0], 0, f->samples * sizeof(hair_vec4),
                            f->position);
    hair_test_read_frames(f->scene.hair, f->tangent, f->frame);

    for (uint32_t g = 0; g < f->params.guides; ++g) {
        static struct hair_reference_vertex state[HAIR_MAX_GUIDE_VERTICES];
        const struct hair_guide* guide = &f->scene.groom->guides[g];
        for (uint32_t i = 0; i < guide->count; ++i) {
            hair_vec4 p = f->state[guide->first + i].position, d = f->state[guide->first + i].displacement;
            state[i] = (struct hair_reference_vertex){{p.x, p.y, p.z}, {d.x, d.y, d.z}};
        }
        hair_reference_smooth(
            (struct hair_reference_guide){guide, f->scene.groom->rest + guide->first, &f->params}, state,
            f->expected + g * f->params.smooth_vertices);
    }
}

static void near3(const char* what, uint32_t i, const hair_vec4* a, const double* b, double tolerance)
{
    hair_test_near(what, i, a->x, b[0], tolerance);
    hair_test_near(what, i, a->y, b[1], tolerance);
    hair_test_near(what, i, a->z, b[2], tolerance);
}

static void compare(struct fixture* f)
{
    for (uint32_t i = 0; i < f->samples; ++i) {
        const struct hair_reference_sample* expected = &f->expected[i];
        near3("position", i, &f->position[i], expected->position, POSITION);
        hair_test_near("length from the root", i, f->position[i].w, expected->to_root, POSITION);
        near3("tangent", i, &f->tangent[i], expected->tangent, f->direction);
        // q and -q are the same rotation.
        hair_vec4 frame = f->frame[i];
        const double* q = expected->frame;
        if (frame.x * q[0] + frame.y * q[1] + frame.z * q[2] + frame.w * q[3] < 0)
            frame = (hair_vec4){-frame.x, -frame.y, -frame.z, -frame.w};
        near3("frame", i, &frame, q, f->turn);
        hair_test_near("frame w", i, frame.w, q[3], f->turn);
    }
}

static void smoothed_guides_of_every_length_equal_the_reference(void** state)
{
    struct fixture* f = start(state, 2, 64);
    run(f);
    compare(f);
    hair_test_scene_free(&f->scene);
}

static void smoothed_guides_of_2_to_256_vertices_equal_the_reference(void** state)
{
    static const uint32_t vertices[] = {2, 3, 32, 33, 64, 65, 128, 129, 255, 256};
    for (uint32_t guides = 1; guides <= sizeof vertices / sizeof *vertices; ++guides) {
        uint32_t max = vertices[guides - 1];
        struct hair_test_handmade wanted = hair_test_handmade_default();
        wanted.guides = guides, wanted.vertices = vertices;
        wanted.segment = max > 64 ? 0.64f / (float)max : 0.01f; // No guide is longer than 1 m.
        struct fixture* f = start_with(state, wanted);
        run(f);
        compare(f);
        hair_test_scene_free(&f->scene);
    }
}

static void smoothing_at_both_ends_of_a_substep_equals_the_reference(void** state)
{
    struct fixture* f = start(state, 2, 9);
    for (int end = 0; end < 2; ++end) {
        f->params.alpha = (float)end;
        run(f);
        compare(f);
    }
    hair_test_scene_free(&f->scene);
}

static double clamp_stretch(double stretch)
{
    return fmax(-127 * HAIR_FRAME_STRETCH, fmin(127 * HAIR_FRAME_STRETCH, stretch));
}

// Check that a sample has the stretch of its segment, within the limits of packed frames. Near a
// vertex, rounding may choose either segment. Every segment has two samples, so the adjacent
// samples have the stretch of both segments.
static void smoothing_outputs_the_stretch_of_each_segment(void** state)
{
    struct fixture* f = start(state, 2, 64);
    run(f);
    for (uint32_t i = 1; i + 1 < f->samples; ++i) {
        double got = f->tangent[i].w, own = clamp_stretch(f->expected[i].stretch);
        double before = clamp_stretch(f->expected[i - 1].stretch);
        double after = clamp_stretch(f->expected[i + 1].stretch);
        if (fabs(got - before) > f->direction && fabs(got - after) > f->direction)
            hair_test_near("stretch", i, got, own, f->direction);
    }
    hair_test_scene_free(&f->scene);
}

// Check what drawing requires: unit tangents, frames with tangents as their y axis, and roots under
// the scalp.
static void frames_follow_the_strand_and_roots_stay_on_the_scalp(void** state)
{
    struct fixture* f = start(state, 2, 64);
    hair_test_scatter(f->scene.groom, 0, 0, &f->random, f->state);
    f->params.alpha = 1;
    f->params.rotation_after = (hair_vec4){0, 0, 0, 1};
    f->params.last_displacement = (hair_vec4){0};
    run(f);
    hair_quat now = {f->params.rotation_now.x, f->params.rotation_now.y, f->params.rotation_now.z,
                     f->params.rotation_now.w};
    for (uint32_t i = 0; i < f->samples; ++i) {
        hair_vec4 q = f->frame[i], t = f->tangent[i];
        hair_vec3 y = hair_rotate((hair_quat){q.x, q.y, q.z, q.w}, hair_v3(0, 1, 0));
        near3("y", i, &t, (double[]){y.x, y.y, y.z}, 1e-5);
        hair_test_near("tangent", i, hair_length(hair_v3(t.x, t.y, t.z)), 1, 1e-6);
        if (i % f->params.smooth_vertices) continue;
        hair_vec4 at =
            f->scene.groom->rest[f->scene.groom->guides[i / f->params.smooth_vertices].first].position;
        hair_vec3 root = hair_rotate(now, hair_v3(at.x, at.y, at.z));
        near3("root", i, &f->position[i], (double[]){root.x, root.y, root.z}, 1e-6);
        assert_true(f->position[i].w == 0);
    }
    hair_test_scene_free(&f->scene);
}

// Check that coincident vertices and strands of no length give finite numbers.
static void smoothed_strand_without_length_is_finite(void** state)
{
    struct fixture* f = start(state, 4, 16);
    for (uint32_t i = 0; i < f->scene.groom->info.guide_vertex_count; ++i) {
        if (i % 3 == 0) f->state[i] = f->state[i - i % 5];
        if (i < 20) f->state[i] = f->state[0];
    }
    run(f);
    for (uint32_t i = 0; i < f->samples; ++i) {
        const hair_vec4 p = f->position[i], t = f->tangent[i], q = f->frame[i];
        assert_true(isfinite(p.x + p.y + p.z + p.w + t.x + t.y + t.z + t.w + q.x + q.y + q.z + q.w));
    }
    hair_test_scene_free(&f->scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(smoothed_guides_of_every_length_equal_the_reference),
        HAIR_TEST(smoothed_guides_of_2_to_256_vertices_equal_the_reference),
        HAIR_TEST(smoothing_at_both_ends_of_a_substep_equals_the_reference),
        HAIR_TEST(smoothing_outputs_the_stretch_of_each_segment),
        HAIR_TEST(frames_follow_the_strand_and_roots_stay_on_the_scalp),
        HAIR_TEST(smoothed_strand_without_length_is_finite),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
