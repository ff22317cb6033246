// motion_test.c - velocities on the screen. They agree with the strands for moving hair and a
// moving camera, at every level of detail, and through teleports and resets. Jitter moves pictures,
// and not velocities.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"
#include "tests/support/tessellated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 96
#define SEGMENTS 16u
#define ROUNDED 1e-4 // Pixels. Two programs compute the previous and the present position.

struct fixture {
    struct hair_test_scene scene;
    uint32_t count; // Vertices of all followers.
    float *now, *before;
};

static struct fixture start(void** state)
{
    struct fixture f;
    hair_look look = hair_look_default();
    look.strand.radius = 0.003f;
    look.strand.segments = SEGMENTS;
    look.curl.radius = 0.003f;
    f.scene = hair_test_scene_of(*state, NULL, &look);
    f.count = f.scene.groom->info.follower_count * (SEGMENTS + 1);
    f.now = malloc(3 * sizeof(float) * f.count);
    f.before = malloc(3 * sizeof(float) * f.count);
    return f;
}

static void finish(struct fixture* f)
{
    free(f->now), free(f->before);
    hair_test_scene_free(&f->scene);
}

static void set_matrix(float m[16], float x, float y, float z)
{
    for (int i = 0; i < 16; ++i) m[i] = i % 5 == 0;
    m[12] = x, m[13] = y, m[14] = z;
}

// Make a perspective view at the distance of a head's breadth. The eye has moved slightly since the
// previous frame, and the view has become narrower.
static hair_view view_of(hair_pass pass, float moved)
{
    hair_view view = hair_test_tessellated();
    view.pass = pass;
    set_matrix(view.view, 0, 0, -0.8f);
    set_matrix(view.prev_view, moved, 0, -0.8f + 0.5f * moved);
    memset(view.projection, 0, sizeof view.projection);
    view.projection[0] = view.projection[5] = 2;
    view.projection[10] = -1.02f;
    view.projection[11] = -1;
    view.projection[14] = -0.1f;
    memcpy(view.prev_projection, view.projection, sizeof view.projection);
    view.prev_projection[0] -= moved;
    view.prev_projection[5] -= 2 * moved;
    return view;
}

static void read_now(struct fixture* f)
{
    uint32_t count;
    float* swap = f->before;
    f->before = f->now;
    f->now = swap;
    hair_test_ok(f->scene.test,
                 hair_read_positions(f->scene.hair, HAIR_READ_FOLLOWERS, f->now, f->count, &count));
    assert_int_equal(count, f->count);
}

struct picture {
    float motion[4 * SIDE * SIDE];
    uint32_t id[4 * SIDE * SIDE];
};

static void draw(const struct fixture* f, const hair_view* view, struct picture* out)
{
    static const float none[4] = {9, 9, 9, 9};
    struct hair_test_frame frame;
    hair_view own = *view;
    own.render_path = HAIR_RENDER_PATH_CACHED;
    own.pass = HAIR_PASS_MOTION;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    glClearNamedFramebufferfv(frame.framebuffer, GL_COLOR, 0, none);
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &own));
    hair_test_frame_read(&frame, out->motion);
    hair_test_frame_free(&frame);
    hair_test_draw_ids(f->scene.test, f->scene.hair, &own, SIDE, out->id);
}

static void project(const float view[16], const float projection[16], const double p[3], double out[2])
{
    double v[4], c[4];
    for (int i = 0; i < 4; ++i)
        v[i] = (double)view[i] * p[0] + (double)view[4 + i] * p[1] + (double)view[8 + i] * p[2] +
               (double)view[12 + i];
    for (int i = 0; i < 4; ++i) {
        c[i] = 0;
        for (int k = 0; k < 4; ++k) c[i] += (double)projection[4 * k + i] * v[k];
    }
    out[0] = c[0] / c[3], out[1] = c[1] / c[3];
}

static void strand_at(const float* positions, uint32_t strand, double t, double out[3])
{
    double at = fmin(t * SEGMENTS, SEGMENTS);
    uint32_t k = at < SEGMENTS - 1 ? (uint32_t)at : SEGMENTS - 1;
    for (int i = 0; i < 3; ++i) {
        const float* a = positions + 3 * (strand * (SEGMENTS + 1) + k) + i;
        out[i] = (double)a[0] + (at - k) * ((double)a[3] - (double)a[0]);
    }
}

// Compare every pixel's velocity with the velocity of its strand. Return the maximum velocity in
// pixels.
static double check(const char* what, const hair_view* view, const struct picture* picture, const float* now,
                    const float* before)
{
    double worst = 0, max = 0;
    uint32_t covered = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        if (picture->motion[4 * i + 3] == 9) continue;
        ++covered;
        const uint32_t* id = picture->id + 4 * i;
        if (!id[0]) continue; // Edges are rounded differently in the pictures of the two passes.
        double p[3], a[2], b[2], off = 0;
        strand_at(now, id[0] - 1, id[2] / 65535.0, p);
        project(view->view, view->projection, p, a);
        strand_at(before, id[0] - 1, id[2] / 65535.0, p);
        project(view->prev_view, view->prev_projection, p, b);
        for (int k = 0; k < 2; ++k) {
            off = fmax(off, fabs((double)picture->motion[4 * i + k] - 0.5 * (a[k] - b[k])) * SIDE);
            max = fmax(max, fabs((double)picture->motion[4 * i + k]) * SIDE);
        }
        worst = fmax(worst, off);
        assert_true(picture->motion[4 * i + 2] == 0 && picture->motion[4 * i + 3] == 1);
    }
    print_message("    %s: %u pixels, up to %.3f pixels a frame, off by up to %.4f\n", what, covered, max,
                  worst);
    assert_true(covered > 200);
    assert_true(worst < 0.02);
    return max;
}

static void step(struct fixture* f, float x)
{
    float transform[16];
    set_matrix(transform, x, 0, 0);
    hair_test_ok(f->scene.test, hair_set_transform(f->scene.hair, transform));
    hair_test_ok(f->scene.test, hair_step(f->scene.hair, 1.0f / 60));
    read_now(f);
}

static void motion_vectors_include_strands_and_camera(void** state)
{
    static struct picture picture;
    struct fixture f = start(state);
    hair_view view = view_of(HAIR_PASS_MOTION, 0);
    read_now(&f);
    draw(&f, &view, &picture);
    assert_true(check("first", &view, &picture, f.now, f.now) < ROUNDED);
    step(&f, 0.01f);
    draw(&f, &view, &picture);
    assert_true(check("moved", &view, &picture, f.now, f.before) > 0.5);
    // Without a step hair stands still, whatever it did before.
    draw(&f, &view, &picture);
    assert_true(check("paused", &view, &picture, f.now, f.now) < ROUNDED);
    view = view_of(HAIR_PASS_MOTION, 0.02f);
    draw(&f, &view, &picture);
    assert_true(check("camera", &view, &picture, f.now, f.now) > 0.5);
    // Two steps and a shadow map lie between two frames.
    float* shown = malloc(3 * sizeof(float) * f.count);
    memcpy(shown, f.now, 3 * sizeof(float) * f.count);
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, 8, 8, GL_RGBA8, 0);
    hair_view shadow = view_of(HAIR_PASS_DEPTH, 0);
    shadow.render_path = HAIR_RENDER_PATH_CACHED;
    for (int i = 0; i < 2; ++i) {
        step(&f, 0.02f + 0.01f * (float)i);
        hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &shadow));
    }
    hair_test_frame_free(&frame);
    draw(&f, &view, &picture);
    check("two steps", &view, &picture, f.now, shown);
    free(shown);
    finish(&f);
}

static void views_of_one_frame_share_the_previous_frame(void** state)
{
    static struct picture picture;
    struct fixture f = start(state);
    hair_view view = view_of(HAIR_PASS_MOTION, 0);
    view.frame_index = 1;
    read_now(&f);
    draw(&f, &view, &picture);
    step(&f, 0.01f);
    view.frame_index = 2;
    for (int eye = 0; eye < 2; ++eye) {
        view.view[12] = view.prev_view[12] = 0.02f * (float)eye;
        draw(&f, &view, &picture);
        assert_true(check("eye", &view, &picture, f.now, f.before) > 0.3);
    }
    finish(&f);
}

static void motion_vectors_are_right_at_any_level_of_detail(void** state)
{
    static struct picture picture;
    struct fixture f = start(state);
    hair_view view = view_of(HAIR_PASS_MOTION, 0.01f);
    hair_lod lod = hair_lod_default();
    lod.per_patch = false, lod.strand_fraction = 0.6f, lod.segment_fraction = 0.33f;
    view.lod = &lod;
    read_now(&f);
    draw(&f, &view, &picture);
    step(&f, 0.01f);
    // Uses other vertices than the previous frame.
    lod.strand_fraction = 0.8f, lod.segment_fraction = 0.71f;
    draw(&f, &view, &picture);
    // The segments drawn are chords of the strand's segments.
    double sum = 0;
    uint32_t count = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const uint32_t* id = picture.id + 4 * i;
        if (picture.motion[4 * i + 3] == 9 || !id[0]) continue;
        double p[3], a[2], b[2];
        strand_at(f.now, id[0] - 1, id[2] / 65535.0, p);
        project(view.view, view.projection, p, a);
        strand_at(f.before, id[0] - 1, id[2] / 65535.0, p);
        project(view.prev_view, view.prev_projection, p, b);
        sum += hypot(picture.motion[4 * i] - 0.5 * (a[0] - b[0]),
                     picture.motion[4 * i + 1] - 0.5 * (a[1] - b[1])) *
               SIDE;
        ++count;
    }
    print_message("    off by %.4f pixels on average\n", sum / count);
    assert_true(count > 150 && sum / count < 0.05);
    finish(&f);
}

static void motion_vectors_ignore_teleports_and_restart_at_resets(void** state)
{
    static struct picture picture;
    struct fixture f = start(state);
    hair_view view = view_of(HAIR_PASS_MOTION, 0);
    // A rotation by 90 degrees about y.
    float far[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 500, 3, -200, 1};
    read_now(&f);
    draw(&f, &view, &picture);
    step(&f, 0.01f);
    draw(&f, &view, &picture);
    hair_test_ok(f.scene.test, hair_teleport(f.scene.hair, far));
    read_now(&f);
    // The eye moves with the head, so its view does not change.
    static const float seen[16] = {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 200.01f, -3, -500.8f, 1};
    // The product of view and head is unchanged: view = old view * (new head * old head^-1)^-1.
    memcpy(view.view, seen, sizeof seen);
    view.view[12] = 0.01f - (seen[0] * 500 + seen[4] * 3 + seen[8] * -200);
    view.view[13] = 0 - (seen[1] * 500 + seen[5] * 3 + seen[9] * -200);
    view.view[14] = -0.8f - (seen[2] * 500 + seen[6] * 3 + seen[10] * -200);
    memcpy(view.prev_view, view.view, sizeof view.view);
    draw(&f, &view, &picture);
    double max = 0;
    uint32_t covered = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        if (picture.motion[4 * i + 3] == 9) continue;
        ++covered;
        for (int k = 0; k < 2; ++k) max = fmax(max, fabs((double)picture.motion[4 * i + k]) * SIDE);
    }
    print_message("    teleported: %u pixels, up to %.5f pixels a frame\n", covered, max);
    assert_true(covered > 200 && max < 0.01);
    hair_test_ok(f.scene.test, hair_reset(f.scene.hair));
    draw(&f, &view, &picture);
    for (int i = 0; i < SIDE * SIDE; ++i)
        if (picture.motion[4 * i + 3] != 9)
            for (int k = 0; k < 2; ++k)
                hair_test_near("after a reset", (size_t)i, picture.motion[4 * i + k], 0, 1e-6);
    finish(&f);
}

static void jitter_moves_the_picture_but_no_motion_vector(void** state)
{
    static float pixels[2][4 * SIDE * SIDE];
    static struct picture picture;
    struct fixture f = start(state);
    hair_view view = view_of(HAIR_PASS_COLOR, 0);
    for (int i = 0; i < 2; ++i) {
        view.jitter[0] = (float)(3 * i), view.jitter[1] = (float)(-2 * i);
        hair_test_draw(&f.scene, &view, SIDE, SIDE, 0, pixels[i], NULL);
    }
    uint32_t covered = 0, other = 0;
    for (int y = 2; y < SIDE; ++y)
        for (int x = 0; x < SIDE - 3; ++x) {
            const float *a = pixels[0] + 4 * (y * SIDE + x), *b = pixels[1] + 4 * ((y - 2) * SIDE + x + 3);
            covered += a[3] > 0;
            other += (a[3] > 0) != (b[3] > 0);
        }
    print_message("    %u pixels, %u otherwise\n", covered, other);
    assert_true(covered > 200 && other <= covered / 100);
    read_now(&f);
    draw(&f, &view, &picture);
    view.jitter[0] = -0.3f, view.jitter[1] = 0.45f;
    draw(&f, &view, &picture);
    uint32_t seen = 0;
    for (int i = 0; i < SIDE * SIDE; ++i)
        if (picture.motion[4 * i + 3] != 9) {
            ++seen;
            assert_true(fabs((double)picture.motion[4 * i]) * SIDE < ROUNDED);
            assert_true(fabs((double)picture.motion[4 * i + 1]) * SIDE < ROUNDED);
        }
    assert_true(seen > 200);
    finish(&f);
}

static void history_is_not_kept_without_motion_vectors(void** state)
{
    struct fixture f = start(state);
    struct hair_test_frame frame;
    hair_view view = view_of(HAIR_PASS_COLOR, 0);
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    for (int i = 0; i < 3; ++i) {
        view.render_path = hair_test_paths[i];
        hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
        hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &view));
    }
    assert_int_equal(f.scene.hair->geometry.history.buffer, 0);
    view.pass = HAIR_PASS_MOTION;
    hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &view));
    assert_int_not_equal(f.scene.hair->geometry.history.buffer, 0);
    hair_test_frame_free(&frame);
    finish(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(motion_vectors_include_strands_and_camera),
        HAIR_TEST(views_of_one_frame_share_the_previous_frame),
        HAIR_TEST(motion_vectors_are_right_at_any_level_of_detail),
        HAIR_TEST(motion_vectors_ignore_teleports_and_restart_at_resets),
        HAIR_TEST(jitter_moves_the_picture_but_no_motion_vector),
        HAIR_TEST(history_is_not_kept_without_motion_vectors),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
