// field_test.c - the field: contents of its voxels, which voxels an update writes, and hostile
// colliders.
#include "tests/support/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "lib/collide/distance.h"
#include "tests/support/handmade.h"
#include "tests/support/passes.h"

#define VOXEL 0.008f
#define MANY 20

static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
// A rotated pose, so far away that floats no longer resolve a hundredth of a voxel.
static const struct hair_pose elsewhere = {{30, -20, 10}, {0.36f, 0.48f, 0, 0.8f}};

struct fixture {
    struct hair_test* test;
    hair_groom* groom;
    struct hair_collider_field field;
    struct hair_pose head;
    hair_collider colliders[MANY];
    uint32_t random;
};

static void begin(struct hair_test* test, struct hair_pose head, struct fixture* out)
{
    *out = (struct fixture){.test = test, .head = head, .random = 7};
    out->groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_field_create(&out->field, &test->context->sdf_pool, out->groom, VOXEL);
    for (int i = 0; i < MANY; ++i)
        out->colliders[i] = hair_test_any_collider(&out->field.box, &head, 0.1f, &out->random);
}

static void end(struct fixture* f)
{
    hair_field_destroy(&f->field);
    hair_groom_destroy(f->groom);
}

static void update(struct fixture* f, uint32_t count)
{
    hair_test_ok(f->test, hair_field_update(&f->field, f->colliders, count, &f->head));
}

static uint32_t runs(struct fixture* f)
{
    return hair_test_runs(&f->test->context->gl, HAIR_GL_VOXELISE);
}

// Contents of voxels ------------------------------------------------------------------------------

static void check_voxels(struct fixture* f, uint32_t count)
{
    const struct hair_field_box* box = &f->field.box;
    struct hair_test_field read = hair_test_field_read(&f->field);
    double max = 0, voxel = (double)box->voxel;
    size_t near = 0;
    for (size_t i = 0; i < hair_test_field_count(&read); ++i) {
        double point[3];
        uint32_t number, own = read.number[i];
        hair_test_voxel(box, &f->head, i, point);
        double right = fmin(hair_test_nearest(f->colliders, count, point, &number), (double)box->far);
        double off = fabs((double)read.distance[i] - right);
        max = fmax(max, off);
        if (!(off <= 0.05 * voxel))
            fail_msg("voxel %zu holds %g, not %g", i, (double)read.distance[i], right);
        near += own != HAIR_NO_COLLIDER;
        if (own == HAIR_NO_COLLIDER)
            assert_true(right > (double)box->far - 0.01 * voxel);
        else
            assert_true(own < count &&
                        hair_distance_to_collider(&f->colliders[own], point, NULL) < right + 0.01 * voxel);
    }
    print_message("    %zu voxels, %zu near, off by at most %.4f of one\n", hair_test_field_count(&read),
                  near, max / voxel);
    assert_true(near > 1000 && near < hair_test_field_count(&read));
    hair_test_field_free(&read);
}

static void voxels_hold_distance_and_index_of_the_nearest_collider(void** state)
{
    struct fixture f;
    begin(*state, origin, &f);
    update(&f, MANY);
    check_voxels(&f, MANY);
    end(&f);
    begin(*state, elsewhere, &f);
    update(&f, MANY);
    check_voxels(&f, MANY);
    end(&f);
}

static void field_has_32_to_256_voxels_along_its_longest_side(void** state)
{
    struct fixture f;
    static const float asked[] = {0.0005f, 0.002f, 0.005f, 0.02f, 1};
    begin(*state, origin, &f);
    for (size_t i = 0; i < sizeof asked / sizeof *asked; ++i) {
        struct hair_field_box box = hair_field_box_of(f.groom, asked[i]);
        uint32_t max = 0;
        for (int k = 0; k < 3; ++k) max = box.bricks[k] > max ? box.bricks[k] : max;
        assert_in_range(max, 32 / HAIR_BRICK, 256 / HAIR_BRICK);
        if (max > 32 / HAIR_BRICK && max < 256 / HAIR_BRICK) assert_true(box.voxel == asked[i]);
    }
    end(&f);
}

static void field_holds_the_hair_but_not_more_than_its_reach(void** state)
{
    struct fixture f;
    begin(*state, origin, &f);
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
    end(&f);
}

// Samples -----------------------------------------------------------------------------------------

#define POINTS 20000

struct sample {
    float gradient[3], distance;
};

// Evaluate glsl/field.glsl at `points`. xyz is from the head's origin along the world's axes, and w
// is unused.
static void sample(struct fixture* f, const float (*points)[4], struct sample* out, uint32_t* numbers)
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
                               "    number[i] = field_collider(p);\n"
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
    struct fixture f;
    begin(*state, elsewhere, &f);
    update(&f, MANY);
    for (int i = 0; i < POINTS; ++i)
        for (int k = 0; k < 3; ++k) points[i][k] = 0.4f * hair_random(&f.random) - 0.2f;
    sample(&f, points, found, numbers);
    double voxel = (double)f.field.box.voxel, max[2] = {0}, turned = 0;
    int near = 0, far = 0, compared = 0;
    for (int i = 0; i < POINTS; ++i) {
        double point[3], gradient[3], dot = 0;
        uint32_t number, second;
        for (int k = 0; k < 3; ++k) point[k] = f.head.position[k] + (double)points[i][k];
        double right = hair_test_nearest(f.colliders, MANY, point, &number), own = (double)found[i].distance;
        if (own == (double)f.field.box.far) { // Far from all colliders, or outside the box.
            far += 1;
            assert_true(numbers[i] == HAIR_NO_COLLIDER || right > 3 * voxel);
            continue;
        }
        assert_true(fabs(right) < voxel || (own < 0) == (right < 0));
        if (fabs(right) > 2 * voxel) continue;
        ++near;
        // 1 if a single collider is near, and the collider has no edges.
        hair_collider others[MANY];
        memcpy(others, f.colliders, sizeof others);
        others[number] = others[number ? 0 : 1];
        int round = f.colliders[number].shape <= HAIR_SHAPE_CAPSULE &&
                    hair_test_nearest(others, MANY, point, &second) > right + 2 * voxel;
        max[!round] = fmax(max[!round], fabs(own - right));
        if (!(fabs(own - right) <= (round ? 0.5 : 0.9) * voxel))
            fail_msg("point %d: %g, not %g, of collider %u", i, own, right, number);
        assert_true(numbers[i] < MANY);
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
    end(&f);
}

// Writes ------------------------------------------------------------------------------------------

static void assert_as_made_at_once(struct fixture* f, uint32_t count)
{
    struct hair_collider_field fresh;
    hair_field_create(&fresh, &f->test->context->sdf_pool, f->groom, VOXEL);
    hair_test_ok(f->test, hair_field_update(&fresh, f->colliders, count, &f->head));
    struct hair_test_field a = hair_test_field_read(&f->field), b = hair_test_field_read(&fresh);
    size_t voxels = hair_test_field_count(&a);
    assert_memory_equal(a.distance, b.distance, voxels * sizeof *a.distance);
    assert_memory_equal(a.number, b.number, voxels * sizeof *a.number);
    hair_test_field_free(&a);
    hair_test_field_free(&b);
    hair_field_destroy(&fresh);
}

static void updated_field_equals_a_new_field_bit_for_bit(void** state)
{
    struct fixture f;
    begin(*state, elsewhere, &f);
    uint32_t count = MANY / 2;
    update(&f, count);
    for (int round = 0; round < 12; ++round) {
        uint32_t which = (uint32_t)(hair_random(&f.random) * (float)count);
        // Colliders are added or removed.
        if (round % 4 == 3) count = 1 + (uint32_t)(hair_random(&f.random) * (MANY - 1));
        f.colliders[which] = hair_test_any_collider(&f.field.box, &f.head, 0.15f, &f.random);
        if (round % 4 == 2) f.colliders[which].position[1] += 100; // Moves out of the box.
        update(&f, count);
        assert_as_made_at_once(&f, count);
    }
    end(&f);
}

// Remove the functions of OpenGL, and check that an update without motion calls none.
static void field_update_without_motion_calls_no_opengl(void** state)
{
    struct fixture f;
    begin(*state, elsewhere, &f);
    update(&f, MANY);
    uint32_t before = runs(&f);
    struct hair_gl *gl = &f.test->context->gl, kept = *gl;
#define FUNCTION(type, name, parameters) gl->name = NULL;
#include "lib/gl/functions.inl"
#undef FUNCTION
    hair_result result = hair_field_update(&f.field, f.colliders, MANY, &f.head);
    // Motion within rounding does not count either.
    f.colliders[3].position[0] += 1e-6f;
    hair_result again = hair_field_update(&f.field, f.colliders, MANY, &f.head);
    *gl = kept;
    assert_int_equal(result, HAIR_OK);
    assert_int_equal(again, HAIR_OK);
    f.colliders[3].position[0] += 1e-3f;
    update(&f, MANY);
    assert_int_equal(runs(&f), before + 1);
    end(&f);
}

// Check colliders that move with the head. Their position in the world is rounded at each step, and
// the errors must not add up.
static void colliders_that_move_with_the_head_are_not_rewritten(void** state)
{
    struct fixture f;
    begin(*state, origin, &f);
    update(&f, MANY);
    uint32_t before = runs(&f);
    hair_collider rest[MANY];
    memcpy(rest, f.colliders, sizeof rest);
    for (int step = 1; step <= 20; ++step) {
        float angle = 0.3f * (float)step;
        f.head.rotation = (hair_quat){0, sinf(angle / 2), 0, cosf(angle / 2)};
        f.head.position[0] = 0.1 * step;
        for (int i = 0; i < MANY; ++i) {
            hair_vec3 at = hair_rotate(f.head.rotation, hair_load3(rest[i].position));
            hair_quat own = {rest[i].rotation[0], rest[i].rotation[1], rest[i].rotation[2],
                             rest[i].rotation[3]};
            own = hair_quat_multiply(f.head.rotation, own);
            hair_store3(f.colliders[i].position, hair_add(at, hair_v3((float)f.head.position[0], 0, 0)));
            memcpy(f.colliders[i].rotation, &own, sizeof own);
        }
        update(&f, MANY);
    }
    assert_int_equal(runs(&f), before);
    check_voxels(&f, MANY);
    end(&f);
}

static void field_is_absent_without_a_collider_near(void** state)
{
    struct fixture f;
    begin(*state, origin, &f);
    size_t bytes = f.test->host.live;
    uint32_t before = runs(&f);
    update(&f, 0);
    assert_false(hair_field_is_near(&f.field));
    for (int i = 0; i < MANY; ++i) f.colliders[i].position[2] += 50;
    update(&f, MANY);
    assert_false(hair_field_is_near(&f.field));
    assert_int_equal(f.field.distance, 0);
    assert_int_equal(runs(&f), before);
    f.colliders[0].position[2] -= 50; // A collider comes near, and leaves.
    update(&f, MANY);
    assert_true(hair_field_is_near(&f.field));
    f.colliders[0].position[2] += 50;
    update(&f, MANY);
    assert_false(hair_field_is_near(&f.field));
    update(&f, 0);
    assert_int_equal(f.field.distance, 0);
    assert_int_equal(f.test->host.live, bytes);
    end(&f);
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
    struct fixture f;
    begin(*state, origin, &f);
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
    end(&f);
}

static void ten_thousand_colliders_are_one_field(void** state)
{
    const uint32_t count = 10000;
    struct fixture f;
    begin(*state, origin, &f);
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
        hair_test_near("voxel", i, (double)read.distance[i], right, 0.05 * (double)VOXEL);
    }
    hair_test_field_free(&read);
    free(colliders);
    end(&f);
}

static void APIENTRY make_nothing(GLuint texture, GLsizei levels, GLenum format, GLsizei x, GLsizei y,
                                  GLsizei z)
{
    (void)texture, (void)levels, (void)format, (void)x, (void)y, (void)z;
}

static void field_recovers_from_refused_driver_memory(void** state)
{
    struct fixture f;
    begin(*state, origin, &f);
    struct hair_gl* gl = &f.test->context->gl;
    size_t bytes = f.test->host.live;
    void(APIENTRY * kept)(GLuint, GLsizei, GLenum, GLsizei, GLsizei, GLsizei) = gl->TextureStorage3D;
    gl->TextureStorage3D = make_nothing;
    hair_result result = hair_field_update(&f.field, f.colliders, MANY, &f.head);
    gl->TextureStorage3D = kept;
    hair_test_refused(f.test, result, HAIR_ERROR_MEMORY, "the driver has no");
    assert_int_equal(f.test->host.live, bytes);
    update(&f, MANY);
    check_voxels(&f, MANY);
    end(&f);
}

static void field_recovers_from_refused_host_memory(void** state)
{
    struct fixture f;
    begin(*state, origin, &f);
    size_t bytes = f.test->host.live;
    uint32_t refused = 0;
    for (;; ++refused) {
        f.test->host.refuse = f.test->host.allocations + 1 + refused;
        hair_result result = hair_field_update(&f.field, f.colliders, MANY, &f.head);
        f.test->host.refuse = 0;
        if (result == HAIR_OK) break;
        hair_test_refused(f.test, result, HAIR_ERROR_MEMORY, "out of memory for");
        assert_int_equal(f.test->host.live, bytes);
    }
    assert_true(refused > 5);
    check_voxels(&f, MANY);
    end(&f);
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
        HAIR_TEST(updated_field_equals_a_new_field_bit_for_bit),
        HAIR_TEST(field_update_without_motion_calls_no_opengl),
        HAIR_TEST(colliders_that_move_with_the_head_are_not_rewritten),
        HAIR_TEST(field_is_absent_without_a_collider_near),
        HAIR_TEST(field_of_any_colliders_is_finite),
        HAIR_TEST(ten_thousand_colliders_are_one_field),
        HAIR_TEST(field_recovers_from_refused_driver_memory),
        HAIR_TEST(field_recovers_from_refused_host_memory),
        HAIR_TEST(field_info_has_textures_and_their_place),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
