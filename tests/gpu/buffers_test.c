// buffers_test.c - the buffers of strands for the application have the vertices that are read back
// and drawn, in this frame and the previous one.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/support/captured_lines.h"
#include "tests/support/torture.h"

static struct hair_test_points points, before;

static hair_look look_of(bool is_curly, uint32_t segments)
{
    hair_look look = hair_look_default();
    if (is_curly) hair_look_apply_preset(&look, HAIR_LOOK_CURLY);
    look.strand.segments = segments;
    return look;
}

// Read components of 32 bits of an attribute.
static void read_components(hair_buffer from, uint32_t components, void* out)
{
    uint32_t last = from.offset + (from.count - 1) * from.stride + 4 * components, *to = out;
    unsigned char* bytes = malloc(last);
    assert_true(from.buffer && from.count);
    glGetNamedBufferSubData(from.buffer, 0, last, bytes);
    for (uint32_t i = 0; i < from.count; ++i)
        memcpy(to + components * i, bytes + from.offset + i * from.stride, 4 * components);
    free(bytes);
}

// Check that an attribute has these positions, to the last bit.
static void check_positions(hair_buffer from, const double origin[3], const struct hair_test_points* expected)
{
    float* at = malloc(12 * (size_t)from.count);
    assert_int_equal(from.format, GL_RGB32F);
    assert_int_equal(from.count, expected->count);
    read_components(from, 3, at);
    for (uint32_t i = 0; i < 3 * from.count; ++i)
        assert_true((float)(origin[i % 3] + (double)at[i]) == expected->at[i]);
    free(at);
}

static void check_indices(const hair_buffers* got)
{
    uint32_t* numbers = malloc(4 * (size_t)got->strand.count);
    assert_int_equal(got->strand.format, GL_R32UI);
    assert_int_equal(got->strand.count, got->strand_count * got->strand_vertices);
    read_components(got->strand, 1, numbers);
    for (uint32_t i = 0; i < got->strand.count; ++i) assert_int_equal(numbers[i], i / got->strand_vertices);
    free(numbers);
}

static void check_bounds(const hair_buffers* got, const struct hair_test_points* all)
{
    for (uint32_t i = 0; i < 3 * all->count; ++i)
        assert_true(got->lower[i % 3] <= all->at[i] && all->at[i] <= got->upper[i % 3]);
}

static void check_followers(struct hair_test_scene* scene, const hair_look* look)
{
    hair_buffers got = hair_test_get_buffers(scene, HAIR_READ_FOLLOWERS, HAIR_TEST_FOLLOWER_ATTRIBUTES);
    hair_test_read_points(scene->test, scene->hair, HAIR_READ_FOLLOWERS, &points);
    assert_int_equal(got.strand_vertices, look->strand.segments + 1);
    assert_int_equal(got.strand_count, scene->groom->info.follower_count);
    check_positions(got.position, got.origin, &points);
    check_indices(&got);
    check_bounds(&got, &points);
}

static void followers_are_those_that_are_read_back(void** state)
{
    static const uint32_t segments[] = {8, 1, 64, 3};
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
    for (int curly = 0; curly < 2; ++curly)
        for (int i = 0; i < 4; ++i) {
            hair_look look = look_of(curly, segments[i]);
            hair_test_ok(scene.test, hair_set_look(scene.hair, &look));
            hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
            check_followers(&scene, &look);
        }
    hair_test_scene_free(&scene);
}

// Compare with the lines that the cached path draws.
static void buffers_have_the_drawn_lines(void** state)
{
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
    for (int curly = 0; curly < 2; ++curly) {
        hair_look look = look_of(curly, 12);
        hair_test_ok(scene.test, hair_set_look(scene.hair, &look));
        hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
        hair_buffers got = hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_TEST_FOLLOWER_ATTRIBUTES);
        float* at = malloc(12 * (size_t)got.position.count);
        float* radius = malloc(4 * (size_t)got.radius.count);
        read_components(got.position, 3, at);
        read_components(got.radius, 1, radius);
        struct hair_test_lines lines =
            hair_test_capture_lines(scene.test, scene.hair, HAIR_TEST_CACHED, 100000, 0, NULL);
        uint32_t each = got.strand_vertices - 1;
        assert_int_equal(lines.segments, got.strand_count * each);
        for (size_t s = 0; s < lines.segments; ++s)
            for (size_t end = 0; end < 2; ++end) {
                const struct hair_test_vertex* drawn = &lines.vertices[2 * s + end];
                size_t k = s / each * got.strand_vertices + s % each + end;
                hair_test_near("x", k, (double)at[3 * k], (double)drawn->x, 1e-6);
                hair_test_near("y", k, (double)at[3 * k + 1], (double)drawn->y, 1e-6);
                hair_test_near("z", k, (double)at[3 * k + 2], (double)drawn->z, 1e-6);
                hair_test_near("radius", k, (double)radius[k], (double)drawn->radius, 1e-9);
            }
        free(lines.vertices), free(at), free(radius);
    }
    hair_test_scene_free(&scene);
}

static void tangents_are_unit_and_along_the_strand(void** state)
{
    hair_look look = look_of(false, 64);
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    hair_buffers got = hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_ATTRIBUTE_TANGENT);
    hair_test_read_points(scene.test, scene.hair, HAIR_READ_FOLLOWERS, &points);
    uint16_t* packed = malloc(8 * (size_t)got.tangent.count);
    assert_int_equal(got.tangent.format, GL_RGB16);
    assert_int_equal(got.tangent.stride, 8);
    assert_int_equal(got.position.buffer, 0);
    glGetNamedBufferSubData(got.tangent.buffer, 0, 8 * got.tangent.count, packed);
    double worst = 1;
    for (uint32_t i = 1; i + 1 < got.tangent.count; ++i) {
        if (i % 65 == 0 || i % 65 == 64) continue;
        hair_vec3 t,
            along =
                hair_normalize(hair_sub(hair_load3(points.at + 3 * i + 3), hair_load3(points.at + 3 * i - 3)),
                               hair_v3(0, 0, 0));
        t = hair_v3((float)packed[4 * i] / 32767.5f - 1, (float)packed[4 * i + 1] / 32767.5f - 1,
                    (float)packed[4 * i + 2] / 32767.5f - 1);
        hair_test_near("length", i, (double)hair_length(t), 1, 1e-4);
        worst = fmin(worst, (double)hair_dot(t, along));
    }
    print_message("    cosine of at least %.4f\n", worst);
    assert_true(worst > 0.99);
    free(packed);
    hair_test_scene_free(&scene);
}

static void guides_are_those_that_are_read_back(void** state)
{
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
    hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
    hair_buffers got = hair_test_get_buffers(&scene, HAIR_READ_SMOOTH, HAIR_TEST_GUIDE_ATTRIBUTES);
    hair_test_read_points(scene.test, scene.hair, HAIR_READ_SMOOTH, &points);
    check_positions(got.position, got.origin, &points);
    check_indices(&got);
    float* tangents = malloc(12 * (size_t)got.tangent.count);
    read_components(got.tangent, 3, tangents);
    for (uint32_t i = 0; i < got.tangent.count; ++i)
        hair_test_near("length", i, (double)hair_length(hair_load3(tangents + 3 * i)), 1, 1e-5);
    hair_vec4* y = malloc(sizeof *y * got.tangent.count);
    hair_vec4* frames = malloc(sizeof *frames * got.tangent.count);
    hair_test_read_frames(scene.hair, y, frames);
    for (uint32_t i = 0; i < got.tangent.count; ++i) {
        hair_test_near("x", i, (double)tangents[3 * i], (double)y[i].x, 1e-6);
        hair_test_near("y", i, (double)tangents[3 * i + 1], (double)y[i].y, 1e-6);
        hair_test_near("z", i, (double)tangents[3 * i + 2], (double)y[i].z, 1e-6);
    }
    free(y);
    free(frames);
    free(tangents);
    hair_test_scene_free(&scene);
}

static hair_buffers get_frame(struct hair_test_scene* scene, hair_read_source source, uint32_t frame)
{
    hair_buffers out = hair_buffers_default();
    out.attributes = HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_PREV_POSITION;
    out.frame_index = frame;
    hair_test_ok(scene->test, hair_get_buffers(scene->hair, source, &out));
    return out;
}

// Move the head and the hair in three frames, and hold them in a fourth.
static void previous_positions_are_those_of_the_frame_before(void** state)
{
    for (int source = HAIR_READ_SMOOTH; source <= HAIR_READ_FOLLOWERS; ++source) {
        struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
        hair_desc head = hair_desc_default();
        for (uint32_t frame = 1; frame <= 4; ++frame) {
            head.transform[12] = 0.01f * (float)frame;
            if (frame < 4) {
                hair_test_ok(scene.test, hair_set_transform(scene.hair, head.transform));
                hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
            }
            for (int again = 0; again < 2; ++again) {
                hair_buffers got = get_frame(&scene, (hair_read_source)source, frame);
                hair_test_read_points(scene.test, scene.hair, (hair_read_source)source, &points);
                if (frame == 1) before = points;
                check_positions(got.position, got.origin, &points);
                check_positions(got.prev_position, got.prev_origin, &before);
                if (frame > 1 && frame < 4) assert_true(hair_test_points_distance(&points, &before) > 1e-3);
                assert_true(got.prev_rotation[3] == 1 && got.prev_rotation[0] == 0);
            }
            before = points;
        }
        hair_test_scene_free(&scene);
    }
}

// A teleport carries the previous frame along, and a reset forgets it.
static void teleport_carries_previous_positions(void** state)
{
    static const float turned[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 3, 2, 1, 1};
    for (int source = HAIR_READ_SMOOTH; source <= HAIR_READ_FOLLOWERS; ++source) {
        struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
        hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
        get_frame(&scene, (hair_read_source)source, 1);
        hair_test_ok(scene.test, hair_teleport(scene.hair, turned));
        hair_test_ok(scene.test, hair_step(scene.hair, 1e-6f));
        hair_buffers got = get_frame(&scene, (hair_read_source)source, 2);
        hair_test_read_points(scene.test, scene.hair, (hair_read_source)source, &points);
        const float* q = got.prev_rotation;
        float* at = malloc(12 * (size_t)got.prev_position.count);
        read_components(got.prev_position, 3, at);
        for (uint32_t i = 0; i < got.prev_position.count; ++i) {
            hair_vec3 p = hair_rotate((hair_quat){q[0], q[1], q[2], q[3]}, hair_load3(at + 3 * i));
            const float place[3] = {p.x, p.y, p.z};
            for (int k = 0; k < 3; ++k)
                hair_test_near("place", i, got.prev_origin[k] + (double)place[k],
                               (double)points.at[3 * i + (uint32_t)k], 1e-4);
        }
        free(at);
        hair_test_ok(scene.test, hair_reset(scene.hair));
        got = get_frame(&scene, (hair_read_source)source, 3);
        assert_int_equal(got.prev_position.buffer, got.position.buffer);
        hair_test_scene_free(&scene);
    }
}

static double half_of(uint32_t h)
{
    int exponent = (int)(h >> 10 & 31), fraction = (int)(h & 1023);
    return exponent ? ldexp(1024 + fraction, exponent - 25) : ldexp(fraction, -24);
}

// Without variation, reflectance goes linearly from the colour of the root to that of the tip.
static void colors_are_those_of_the_look(void** state)
{
    hair_look look = look_of(false, 8);
    look.color.spread = look.color.hue_spread = look.color.streaks = 0;
    look.color.groom_colors = 0;
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    for (int change = 0; change < 3; ++change) {
        if (change == 1) look.color.root[1] = 0.7f, look.color.tip[2] = 0.9f;
        if (change == 2) look.pigment.weight = 0.8f, look.pigment.dye[2] = 0.5f;
        float root[3], tip[3];
        hair_test_ok(scene.test, hair_set_look(scene.hair, &look));
        hair_test_ok(scene.test, hair_look_find_colors(&look, root, tip));
        assert_true((memcmp(tip, look.color.tip, sizeof tip) != 0) == (change == 2));
        hair_buffers got = hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_ATTRIBUTE_COLOR);
        uint16_t* halves = malloc(8 * (size_t)got.color.count);
        assert_int_equal(got.color.format, GL_RGBA16F);
        glGetNamedBufferSubData(got.color.buffer, 0, 8 * got.color.count, halves);
        for (uint32_t i = 0; i < got.color.count; ++i) {
            float t = (float)(i % 9) / 8;
            for (uint32_t k = 0; k < 3; ++k)
                hair_test_near("colour", i, half_of(halves[4 * i + k]),
                               (double)(root[k] + t * (tip[k] - root[k])), 1e-3);
            assert_true(half_of(halves[4 * i + 3]) == 1);
        }
        free(halves);
    }
    hair_test_scene_free(&scene);
}

static void root_uvs_are_those_of_the_groom(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_scene scene = {.test = test, .groom = hair_test_torture_groom(test)};
    hair_desc desc = hair_desc_default();
    hair_test_ok(test, hair_create(test->context, scene.groom, &desc, &scene.hair));
    hair_buffers got = hair_test_get_buffers(&scene, HAIR_READ_FOLLOWERS, HAIR_TEST_FOLLOWER_ATTRIBUTES);
    const float* expected = scene.groom->root_uvs;
    float* uv = malloc(8 * (size_t)got.root_uv.count);
    assert_true(got.root_uv.is_per_strand && got.root_uv.format == GL_RG32F);
    assert_int_equal(got.root_uv.count, scene.groom->info.follower_count);
    read_components(got.root_uv, 2, uv);
    assert_memory_equal(uv, expected, 8 * got.root_uv.count);
    free(uv);
    hair_destroy(scene.hair);
    hair_groom_destroy(scene.groom);
    struct hair_test_scene bald = hair_test_scene_of(test, NULL, NULL);
    // This groom has none.
    got = hair_test_get_buffers(&bald, HAIR_READ_FOLLOWERS, HAIR_ATTRIBUTE_ROOT_UV);
    assert_true(got.root_uv.buffer == 0 && got.root_uv.count == 0);
    hair_test_scene_free(&bald);
}

// A view with levels of detail and shadows by strands writes only what it draws into the cache.
static void buffers_are_whole_after_a_view_with_levels(void** state)
{
    hair_look look = look_of(true, 16);
    hair_lod lod = hair_lod_default();
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    hair_test_frame_make(&scene.frame, 32, 32, GL_RGBA8, 0);
    lod.per_patch = false;
    lod.strand_fraction = 0.3f, lod.segment_fraction = 0.4f;
    for (int path = 0; path < 3; ++path) {
        scene.view.render_path = (hair_render_path)path;
        scene.view.lod = &lod;
        hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
        hair_test_ok(scene.test, hair_draw(scene.hair, &scene.view));
        check_followers(&scene, &look);
        hair_test_ok(scene.test, hair_draw(scene.hair, &scene.view));
        check_followers(&scene, &look);
    }
    hair_test_scene_free(&scene);
}

// Followers that colliders push out are pushed out in the buffers too.
static void buffers_have_followers_that_are_pushed_out(void** state)
{
    hair_look look = look_of(false, 16);
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.12f;
    ball.position[1] = 0.02f;
    hair_test_ok(scene.test, hair_set_colliders(scene.hair, &ball, 1, sizeof ball));
    for (int i = 0; i < 5; ++i) hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
    check_followers(&scene, &look);
    hair_test_scene_free(&scene);
}

static void buffers_are_made_again_after_a_restoration(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_scene scene = {.test = test};
    hair_context_desc context = hair_context_desc_default();
    hair_desc desc = hair_desc_default();
    hair_look look = look_of(true, 10);
    hair_egl* other = NULL;
    context.host = &test->host.host;
    context.get_proc = hair_egl_get_proc;
    context.restorable = true;
    desc.look = &look;
    hair_test_ok(test, hair_context_create(&context, &scene.context));
    scene.groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_ok(test, hair_create(scene.context, scene.groom, &desc, &scene.hair));
    hair_test_ok(test, hair_step(scene.hair, 1.0f / 60));
    check_followers(&scene, &look);
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &other));
    hair_test_ok(test, hair_context_restore(scene.context));
    hair_test_ok(test, hair_step(scene.hair, 1.0f / 60));
    check_followers(&scene, &look);
    hair_destroy(scene.hair);
    hair_groom_destroy(scene.groom);
    hair_context_destroy(scene.context);
    hair_egl_destroy(other);
    hair_egl_make_current(test->egl);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(followers_are_those_that_are_read_back),
        HAIR_TEST(buffers_have_the_drawn_lines),
        HAIR_TEST(tangents_are_unit_and_along_the_strand),
        HAIR_TEST(guides_are_those_that_are_read_back),
        HAIR_TEST(previous_positions_are_those_of_the_frame_before),
        HAIR_TEST(teleport_carries_previous_positions),
        HAIR_TEST(colors_are_those_of_the_look),
        HAIR_TEST(root_uvs_are_those_of_the_groom),
        HAIR_TEST(buffers_are_whole_after_a_view_with_levels),
        HAIR_TEST(buffers_have_followers_that_are_pushed_out),
        HAIR_TEST(buffers_are_made_again_after_a_restoration),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
