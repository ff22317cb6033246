// field_test.c - the field: contents of its voxels, samples between them, its size, and hostile
// colliders.
#include "tests/support/field_scene.h"
#include "tests/support/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "lib/collide/distance.h"
#include "tests/support/handmade.h"

static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
// A rotated pose, so far away that floats no longer resolve a hundredth of a voxel.
static const struct hair_pose elsewhere = {{30, -20, 10}, {0.36f, 0.48f, 0, 0.8f}};

static void voxels_hold_distance_and_index_of_the_nearest_collider(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_check(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_end(&f);
    hair_test_field_begin(*state, elsewhere, &f);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_check(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_end(&f);
}

static void field_has_32_to_256_voxels_along_its_longest_side(void** state)
{
    struct hair_test_field_scene f;
    static const float asked[] = {0.0005f, 0.002f, 0.005f, 0.02f, 1};
    hair_test_field_begin(*state, origin, &f);
    for (size_t i = 0; i < sizeof asked / sizeof *asked; ++i) {
        struct hair_field_box box = hair_field_box_of(f.groom, asked[i]);
        uint32_t max = 0;
        for (int k = 0; k < 3; ++k) max = box.bricks[k] > max ? box.bricks[k] : max;
        assert_in_range(max, 32 / HAIR_BRICK, 256 / HAIR_BRICK);
        if (max > 32 / HAIR_BRICK && max < 256 / HAIR_BRICK) assert_true(box.voxel == asked[i]);
    }
    hair_test_field_end(&f);
}

static void field_holds_the_hair_but_not_more_than_its_reach(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    const struct hair_field_box* box = &f.field.box;
    const hair_vec3 low = box->lower;
    float brick = HAIR_BRICK * box->voxel, longest = 0;
    hair_vec3 high = hair_add(low, hair_v3(brick * (float)box->bricks[0], brick * (float)box->bricks[1],
                                           brick * (float)box->bricks[2]));
    for (uint32_t i = 0; i < f.groom->info.guide_count; ++i)
        longest = fmaxf(longest, f.groom->guides[i].arc_length);
    for (uint32_t i = 0; i < f.groom->info.guide_vertex_count; ++i) {
        hair_vec4 p = f.groom->rest[i].position;
        assert_true(p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
                    p.z <= high.z);
    }
    // Roots are on the upper half of a ball of 0.1 m.
    float beyond = 0.1f + longest + brick;
    assert_true(low.x > -beyond && low.y > -longest - brick && low.z > -beyond);
    assert_true(high.x < beyond && high.y < beyond && high.z < beyond);
    hair_test_field_end(&f);
}

// Samples -----------------------------------------------------------------------------------------

#define POINTS 20000

struct sample {
    float gradient[3], distance;
};

// Evaluate glsl/field.glsl at `points`. xyz is from the head's origin along the world's axes, and w
// is unused.
static void sample(struct hair_test_field_scene* f, const float (*points)[4], struct sample* out,
                   uint32_t* numbers)
{
    static const char rest[] = "layout(local_size_x = 50) in;\n"
                               "layout(std430, binding = 0) buffer point_block { vec4 point[]; };\n"
                               "layout(std430, binding = 1) buffer sample_block { vec4 found[]; };\n"
                               "layout(std430, binding = 2) buffer number_block { uint number[]; };\n"
                               "void main()\n"
                               "{\n"
                               "    uint i    = gl_GlobalInvocationID.x;\n"
                               "    vec3 p    = point[i].xyz;\n"
                               "    found[i]  = vec4(field_gradient(p), field_distance(p));\n"
                               "    number[i] = field_collider(field_place(p));\n"
                               "}\n";
    struct hair_gl_source source;
    assert_int_equal(hair_gl_read_source(&f->test->host.host, NULL, "field.glsl", "", &source), HAIR_OK);
    const char* text[] = {"#version 450 core\n", source.text, rest};
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 3, text), buffer[3];
    hair_free(&f->test->host.host, source.text);
    glCreateBuffers(3, buffer);
    glNamedBufferStorage(buffer[0], POINTS * sizeof *points, points, 0);
    glNamedBufferStorage(buffer[1], POINTS * sizeof *out, NULL, 0);
    glNamedBufferStorage(buffer[2], POINTS * sizeof *numbers, NULL, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 3, buffer);
    hair_field_bind(&f->field);
    glUseProgram(program);
    glDispatchCompute(POINTS / 50, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer[1], 0, POINTS * sizeof *out, out);
    glGetNamedBufferSubData(buffer[2], 0, POINTS * sizeof *numbers, numbers);
    glUseProgram(0);
    glDeleteProgram(program);
    glDeleteBuffers(3, buffer);
}

// Check interpolation between voxels. Its error is 1 / 4R voxels at a collider with a radius of R
// voxels. It is up to a half between two colliders, and up to 0.87 at edges. Gradients are compared
// away from all three.
static void samples_between_voxels_are_right(void** state)
{
    static float points[POINTS][4];
    static struct sample found[POINTS];
    static uint32_t numbers[POINTS];
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, elsewhere, &f);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    for (int i = 0; i < POINTS; ++i)
        for (int k = 0; k < 3; ++k) points[i][k] = 0.4f * hair_random(&f.random) - 0.2f;
    sample(&f, points, found, numbers);
    double voxel = (double)f.field.box.voxel, max[2] = {0}, turned = 0;
    int near = 0, far = 0, compared = 0;
    for (int i = 0; i < POINTS; ++i) {
        double point[3], gradient[3], dot = 0;
        uint32_t number, second;
        for (int k = 0; k < 3; ++k) point[k] = f.head.position[k] + (double)points[i][k];
        double right = hair_test_nearest(f.colliders, HAIR_TEST_FIELD_COLLIDERS, point, &number),
               own = (double)found[i].distance;
        if (own == (double)f.field.box.far) { // Far from all colliders, or outside the box.
            far += 1;
            assert_true(numbers[i] == HAIR_NO_COLLIDER || right > 3 * voxel);
            continue;
        }
        assert_true(fabs(right) < voxel || (own < 0) == (right < 0));
        if (fabs(right) > 2 * voxel) continue;
        ++near;
        // 1 if a single collider is near, and the collider has no edges.
        hair_collider others[HAIR_TEST_FIELD_COLLIDERS];
        memcpy(others, f.colliders, sizeof others);
        others[number] = others[number ? 0 : 1];
        int round = f.colliders[number].shape <= HAIR_SHAPE_CAPSULE &&
                    hair_test_nearest(others, HAIR_TEST_FIELD_COLLIDERS, point, &second) > right + 2 * voxel;
        max[!round] = fmax(max[!round], fabs(own - right));
        if (!(fabs(own - right) <= (round ? 0.5 : 0.9) * voxel))
            fail_msg("point %d: %g, not %g, of collider %u", i, own, right, number);
        assert_true(numbers[i] < HAIR_TEST_FIELD_COLLIDERS);
        assert_true(hair_distance_to_collider(&f.colliders[numbers[i]], point, NULL) < right + 2 * voxel);
        if (!round || right < -0.5 * (double)f.colliders[number].size[0]) continue;
        ++compared;
        hair_distance_to_collider(&f.colliders[number], point, gradient);
        for (int k = 0; k < 3; ++k) dot += gradient[k] * (double)found[i].gradient[k];
        turned = fmax(turned, 1 - dot);
    }
    print_message("    %d points near, off by at most %.3f voxels, %.3f where there are edges; 1 - gradient "
                  "at %d by at "
                  "most %.3f\n",
                  near, max[0] / voxel, max[1] / voxel, compared, turned);
    assert_true(near > 1000 && far > 1000 && compared > 100);
    assert_true(turned < 0.2);
    hair_test_field_end(&f);
}

// Hostile colliders -------------------------------------------------------------------------------

static void field_of_any_colliders_is_finite(void** state)
{
    static const hair_collider hostile[] = {
        {HAIR_SHAPE_SPHERE, {0}, {0, 0, 0, 1}, {1e-30f, 0}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_SPHERE, {0}, {0, 0, 0, 1}, {1e6f, 0}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_SPHERE, {0, -1e6f, 0}, {0, 0, 0, 1}, {1e6f, 0}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_SPHERE, {1e9f, -1e9f, 1e9f}, {0, 0, 0, 1}, {1, 0}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CAPSULE, {0}, {0.6f, 0, 0, 0.8f}, {1e-30f, 1e6f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CAPSULE, {0}, {1, 0, 0, 0}, {1e6f, 0}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CAPSULE, {-1e9f, 0, 0}, {0, 0, 1, 0}, {1e6f, 1e6f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_BOX, {0}, {0, 0, 1, 0}, {0, 0, 0}, 1e-30f, .scale = 1, .friction = 1},
        {HAIR_SHAPE_BOX, {0, 1e6f, 0}, {0, 0, 1, 0}, {1e6f, 1e6f, 1e6f}, 1e6f, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CYLINDER, {0}, {0, 0, 1, 0}, {1e-30f, 1e6f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CYLINDER, {0}, {0, 0, 1, 0}, {1e6f, 1e-30f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CONE, {0}, {0, 0, 1, 0}, {1e-30f, 1e-30f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CONE, {0}, {0, 0, 1, 0}, {1e6f, 1e-30f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_PLANE, {0, 1e9f, 0}, {0.6f, 0, 0, 0.8f}, {0}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_PLANE, {1e-30f, 0, 0}, {0.6f, 0, 0, 0.8f}, {0}, 1e6f, .scale = 1, .friction = 1},
    };
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    const uint32_t count = sizeof hostile / sizeof *hostile;
    for (uint32_t i = 0; i <= count; ++i) {
        const hair_collider* colliders = i < count ? &hostile[i] : hostile;
        hair_test_ok(f.test, hair_field_update(&f.field, colliders, i < count ? 1 : count, &f.head));
        if (!hair_field_is_near(&f.field)) continue;
        struct hair_test_field read = hair_test_field_read(&f.field);
        for (size_t k = 0; k < hair_test_field_count(&read); ++k)
            if (!isfinite(read.distance[k])) fail_msg("collider %u: voxel %zu is not finite", i, k);
        hair_test_field_free(&read);
    }
    hair_test_field_end(&f);
}

static void ten_thousand_colliders_are_one_field(void** state)
{
    const uint32_t count = 10000;
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    hair_collider* colliders = calloc(count, sizeof *colliders);
    for (uint32_t i = 0; i < count; ++i)
        colliders[i] = hair_test_any_collider(&f.field.box, &f.head, 0.3f, &f.random);
    hair_test_ok(f.test, hair_field_update(&f.field, colliders, count, &f.head));
    struct hair_test_field read = hair_test_field_read(&f.field);
    for (size_t i = 0; i < hair_test_field_count(&read); i += 997) {
        double point[3];
        uint32_t number;
        hair_test_voxel(&f.field.box, &f.head, i, point);
        double right = fmin(hair_test_nearest(colliders, count, point, &number), (double)f.field.box.far);
        hair_test_near("voxel", i, (double)read.distance[i], right, 0.05 * (double)HAIR_TEST_FIELD_VOXEL);
    }
    hair_test_field_free(&read);
    free(colliders);
    hair_test_field_end(&f);
}

static void thirty_thousand_colliders_are_one_brick(void** state)
{
    const uint32_t count = 30000;
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    hair_collider* colliders = calloc(count, sizeof *colliders);
    const float voxel = HAIR_TEST_FIELD_VOXEL;
    const float middle[] = {f.field.box.lower.x, f.field.box.lower.y, f.field.box.lower.z};
    for (uint32_t i = 0; i < count; ++i) {
        colliders[i] = hair_collider_default();
        colliders[i].shape = HAIR_SHAPE_SPHERE;
        colliders[i].size[0] = 1e-4f;
        for (int k = 0; k < 3; ++k)
            colliders[i].position[k] = middle[k] + (9 + 6 * hair_random(&f.random)) * voxel;
    }
    hair_test_ok(f.test, hair_field_update(&f.field, colliders, count, &f.head));
    struct hair_test_field read = hair_test_field_read(&f.field);
    uint32_t later = 0;
    for (uint32_t i = 0; i < 512; ++i) {
        double point[3];
        uint32_t number;
        uint32_t x = 8 + i % 8, y = 8 + i / 8 % 8, z = 8 + i / 64;
        size_t at = ((size_t)z * read.size[1] + y) * read.size[0] + x;
        hair_test_voxel(&f.field.box, &f.head, at, point);
        double right = hair_test_nearest(colliders, count, point, &number);
        hair_test_near("voxel", at, (double)read.distance[at], right, 0.05 * (double)HAIR_TEST_FIELD_VOXEL);
        later += read.number[at] > count / 2;
    }
    assert_in_range(later, 100, 400);
    hair_test_field_free(&read);
    free(colliders);
    hair_test_field_end(&f);
}

// The application's view --------------------------------------------------------------------------

static void field_info_has_textures_and_their_place(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_desc desc = hair_desc_default();
    hair_collider ball = {HAIR_SHAPE_SPHERE, {1.02f, 2, 3}, {0, 0, 0, 1},
                          {0.05f, 0},        .scale = 1,    .friction = 1};
    hair_field_info info = hair_field_info_default();
    hair_instance* hair = NULL;
    // Rotated by 90 degrees about y.
    const float turned[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 2, 3, 1};
    memcpy(desc.transform, turned, sizeof turned);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_test_ok(test, hair_get_field(hair, &info));
    assert_int_equal(info.distance_texture, 0);
    hair_test_ok(test, hair_set_colliders(hair, &ball, 1, sizeof ball));
    hair_test_ok(test, hair_step(hair, 0.1f));
    hair_test_ok(test, hair_get_field(hair, &info));
    assert_true(info.distance_texture && info.collider_texture);
    float* texels = calloc((size_t)info.size[0] * info.size[1] * info.size[2], sizeof *texels);
    uint32_t bytes = info.size[0] * info.size[1] * info.size[2] * (uint32_t)sizeof *texels;
    glGetTextureImage(info.distance_texture, 0, GL_RED, GL_FLOAT, (GLsizei)bytes, texels);
    // Offsets from the ball's centre along the axes of the world: the centre itself, and points on
    // its surface.
    static const float points[][4] = {
        {0, 0, 0, -0.05f}, {0.05f, 0, 0, 0}, {0, 0.05f, 0, 0}, {0, 0, -0.05f, 0}};
    for (int i = 0; i < 4; ++i) {
        float at[3];
        uint32_t cell[3];
        for (int row = 0; row < 3; ++row) {
            const float* m = info.transform;
            at[row] = m[12 + row];
            for (int k = 0; k < 3; ++k) at[row] += m[4 * k + row] * (ball.position[k] + points[i][k]);
            cell[row] = (uint32_t)(at[row] * (float)info.size[row]);
        }
        float found = texels[(cell[2] * info.size[1] + cell[1]) * info.size[0] + cell[0]];
        hair_test_near("distance", (size_t)i, (double)found, (double)points[i][3], 0.87 * (double)info.voxel);
    }
    free(texels);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(voxels_hold_distance_and_index_of_the_nearest_collider),
        HAIR_TEST(samples_between_voxels_are_right),
        HAIR_TEST(field_has_32_to_256_voxels_along_its_longest_side),
        HAIR_TEST(field_holds_the_hair_but_not_more_than_its_reach),
        HAIR_TEST(field_of_any_colliders_is_finite),
        HAIR_TEST(ten_thousand_colliders_are_one_field),
        HAIR_TEST(thirty_thousand_colliders_are_one_brick),
        HAIR_TEST(field_info_has_textures_and_their_place),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
