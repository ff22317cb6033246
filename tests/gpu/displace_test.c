// displace_test.c - followers with a shape of their own, and the displacements that move them.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/reference/reference.h"
#include "tests/support/grooms.h"
#include "tests/support/scene.h"

#define STRANDS 150
#define GUIDES 9
#define SEGMENTS 20

struct fixture {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance* hair;
    struct hair_reference_sample* samples; // of all guides, as smoothed on the GPU
    double* displacements; // of the reference
    hair_vec4* drawn; // positions of smoothed guides, then displacements
    uint32_t count; // samples of a guide
};

// Evaluate a curl that hangs from a square of 10 cm. Length, radius and phase vary over the square.
static hair_vec3 curl(float t, uint32_t strand, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(strand);
    hair_vec3 root = {0.1f * hair_random(&random), 0, 0};
    root.z = 0.1f * hair_random(&random);
    float length = 0.2f + root.x, radius = (0.01f + 0.1f * root.z) * fminf(5 * t, 1);
    float angle = 18 * t + 30 * root.x;
    return hair_add(root, hair_v3(radius * cosf(angle) - radius, -length * t, radius * sinf(angle)));
}

static void read_guides(struct fixture* f)
{
    struct hair_gl* gl = &f->test->context->gl;
    struct hair_geometry* geometry = &f->hair->geometry;
    size_t vertices = (size_t)f->count * GUIDES, size = vertices * sizeof(hair_vec4);
    hair_vec4 *tangents = malloc(size), *frames = malloc(size);
    f->drawn = malloc(2 * size);
    f->samples = calloc(vertices, sizeof *f->samples);
    f->displacements = calloc(vertices, 3 * sizeof *f->displacements);
    hair_gl_enter(gl);
    hair_geometry_ensure_guides(geometry, &f->hair->sim);
    gl->GetNamedBufferSubData(geometry->smooth.buffer[0], 0, (GLsizeiptr)(2 * size), f->drawn);
    hair_test_read_frames(f->hair, tangents, frames);
    hair_gl_leave(gl);
    for (size_t i = 0; i < vertices; ++i) {
        const float *p = &f->drawn[i].x, *t = &tangents[i].x, *q = &frames[i].x;
        for (int k = 0; k < 3; ++k) f->samples[i].position[k] = (double)p[k];
        for (int k = 0; k < 3; ++k) f->samples[i].tangent[k] = (double)t[k];
        for (int k = 0; k < 4; ++k) f->samples[i].frame[k] = (double)q[k];
        f->samples[i].to_root = (double)p[3];
    }
    for (size_t g = 0; g < GUIDES; ++g)
        hair_reference_displacements(f->samples + g * f->count, f->groom->guide_shapes + g * f->count,
                                     f->count, f->displacements + 3 * g * f->count);
    free(tangents);
    free(frames);
}

// Move and turn the head for a while. Write its transform.
static void shake(struct fixture* f, float head[16])
{
    for (int k = 1; k <= 20; ++k) {
        float angle = 0.04f * (float)k, c = cosf(angle), s = sinf(angle);
        const float now[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.01f * (float)k, 0, 0, 1};
        hair_test_ok(f->test, hair_set_transform(f->hair, now));
        hair_test_ok(f->test, hair_step(f->hair, 1.0f / 60));
        memcpy(head, now, sizeof now);
    }
}

// Create hair at rest of full strands, or of followers that grow around guides.
static struct fixture make(void** state, hair_strand_set set)
{
    struct fixture f = {.test = *state};
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, 24);
    for (uint32_t i = 0; i < STRANDS; ++i) hair_test_strands_add(&strands, 12 + i % 12, curl, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&f.test->host, &strands);
    desc.strand_set = set;
    desc.guide_count = GUIDES;
    desc.follower_count = 3 * STRANDS; // of HAIR_STRAND_SET_GUIDES
    hair_test_ok(f.test, hair_groom_create(&desc, &f.groom));
    hair_test_strands_free(&strands);
    hair_desc instance = hair_desc_default();
    hair_test_ok(f.test, hair_create(f.test->context, f.groom, &instance, &f.hair));
    return f;
}

// Create full strands, and shake them.
static struct fixture start(void** state)
{
    float head[16];
    struct fixture f = make(state, HAIR_STRAND_SET_FULL);
    shake(&f, head);
    f.count = 2 * f.groom->max_vertices - 1;
    read_guides(&f);
    return f;
}

static void finish(struct fixture* f)
{
    free(f->samples);
    free(f->displacements);
    free(f->drawn);
    hair_destroy(f->hair);
    hair_groom_destroy(f->groom);
}

static void displacements_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    double worst = 0, farthest = 0;
    for (size_t i = 0; i < (size_t)f.count * GUIDES; ++i) {
        const float* p = &f.drawn[(size_t)f.count * GUIDES + i].x;
        for (size_t k = 0; k < 3; ++k) {
            worst = fmax(worst, fabs((double)p[k] - f.displacements[3 * i + k]));
            farthest = fmax(farthest, fabs(f.displacements[3 * i + k]));
        }
    }
    print_message("    off by up to %.2g m of %.2g m\n", worst, farthest);
    // Positions of 0.3 m are rounded to 3e-8 m, and frames turn shapes of 0.3 m.
    assert_true(worst < 3e-7 && farthest > 0.02);
    finish(&f);
}

static double* unpack(const hair_groom* groom, const struct hair_follower* follower)
{
    uint32_t count = groom->shape_vertices + 2, texels = HAIR_SHAPE_TEXELS(groom->shape_vertices);
    const uint32_t* shapes = (const uint32_t*)(groom->followers + groom->info.follower_count);
    const uint32_t* own = shapes + (size_t)4 * texels * (size_t)follower->offset[3].w;
    double* vertices = calloc(count, 3 * sizeof *vertices);
    for (uint32_t k = 0; k < count; ++k)
        for (uint32_t axis = 0; axis < 3; ++axis) {
            int16_t bits = (int16_t)(own[2 * k + axis / 2] >> 16 * (axis % 2));
            vertices[3 * k + axis] = bits / 32767.0 * (double)follower->offset[2].w;
        }
    return vertices;
}

// Compare all followers with the reference, and their tangents if `is_plain`.
static void compare(struct fixture* f, const hair_look* look, bool is_plain)
{
    struct hair_gl* gl = &f->test->context->gl;
    struct hair_geometry* geometry = &f->hair->geometry;
    uint32_t each = look->strand.segments + 1, shaped = 0;
    size_t count = (size_t)STRANDS * each;
    hair_vec4* vertices = malloc(count * sizeof *vertices);
    uint16_t* tangents = malloc(8 * count);
    double worst = 0, worst_tangent = 0;
    hair_test_ok(f->test, hair_set_look(f->hair, look));
    hair_gl_enter(gl);
    assert_int_equal(hair_geometry_ensure_vertex_cache(geometry, NULL), HAIR_OK);
    gl->GetNamedBufferSubData(geometry->vertex_cache.position, 0, (GLsizeiptr)(count * sizeof *vertices),
                              vertices);
    gl->GetNamedBufferSubData(geometry->vertex_cache.tangent, 0, (GLsizeiptr)(8 * count), tangents);
    hair_geometry_free_vertex_cache(geometry);
    hair_gl_leave(gl);
    for (uint32_t i = 0; i < STRANDS; ++i) {
        const struct hair_follower* follower = &f->groom->followers[i];
        if (follower->multi == 0) continue;
        double* own = unpack(f->groom, follower);
        struct hair_reference_shapes shapes = {f->count, f->samples, f->displacements,
                                               f->groom->shape_vertices, own};
        ++shaped;
        for (uint32_t k = 0; k < each; ++k) {
            struct hair_reference_point expected;
            hair_reference_shaped(follower, look, &shapes, (double)k / look->strand.segments, 0, &expected);
            const float* p = &vertices[(size_t)i * each + k].x;
            const uint16_t* t = tangents + 4 * ((size_t)i * each + k);
            for (int axis = 0; axis < 3; ++axis) {
                worst = fmax(worst, fabs((double)p[axis] - expected.position[axis]));
                worst_tangent = fmax(worst_tangent, fabs(t[axis] / 32767.5 - 1 - expected.tangent[axis]));
            }
            assert_float_equal(p[3], expected.radius, 1e-8);
        }
        free(own);
    }
    print_message("    %u followers off by up to %.2g m, tangents by %.2g\n", shaped, worst, worst_tangent);
    assert_int_equal(shaped, STRANDS - GUIDES);
    assert_true(worst < 2e-6);
    // A sample that rounds to the next segment of a displacement has the tangent of that segment.
    assert_true(!is_plain || worst_tangent < 0.02);
    free(vertices);
    free(tangents);
}

static void followers_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    hair_look look = hair_look_default();
    look.strays.fraction = look.strays.tip_fraction = 0;
    look.strand.segments = SEGMENTS;
    compare(&f, &look, true);
    look.strand.length = 0.7f;
    look.strand.length_variation = 0.5f;
    look.clump.width = hair_curve_line(1, 0.4f);
    compare(&f, &look, true);
    assert_int_equal(hair_look_apply_preset(&look, HAIR_LOOK_CURLY), HAIR_OK);
    compare(&f, &look, false);
    finish(&f);
}

static float* read_followers(struct fixture* f, uint32_t* each)
{
    uint32_t count = 0, there = 0;
    hair_test_ok(f->test, hair_read_positions(f->hair, HAIR_READ_FOLLOWERS, NULL, 0, &count));
    float* positions = malloc(3 * sizeof *positions * count);
    hair_test_ok(f->test, hair_read_positions(f->hair, HAIR_READ_FOLLOWERS, positions, count, &there));
    assert_int_equal(there, count);
    *each = count / f->groom->info.follower_count;
    return positions;
}

// Check that roots stay where the head carries them, however far the first segments of guides turn.
static void roots_of_followers_move_with_the_head_alone(void** state)
{
    static const hair_strand_set sets[] = {HAIR_STRAND_SET_GUIDES, HAIR_STRAND_SET_FULL};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
        float head[16];
        double worst = 0, farthest = 0;
        uint32_t each;
        struct fixture f = make(state, sets[i]);
        float* rest = read_followers(&f, &each);
        shake(&f, head);
        float* now = read_followers(&f, &each);
        for (size_t root = 0; root < f.groom->info.follower_count; ++root) {
            const float *a = rest + 3 * each * root, *b = now + 3 * each * root;
            for (size_t k = 0; k < 3; ++k) {
                float carried = head[k] * a[0] + head[4 + k] * a[1] + head[8 + k] * a[2] + head[12 + k];
                worst = fmax(worst, fabs((double)b[k] - (double)carried));
                farthest = fmax(farthest, fabs((double)b[k] - (double)a[k]));
            }
        }
        print_message("    off by up to %.2g m of %.2g m\n", worst, farthest);
        // Packed frames are off by up to 3e-6, and roots are less than 0.1 m from those of guides.
        assert_true(worst < 1e-6 && farthest > 0.1);
        free(rest);
        free(now);
        finish(&f);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(displacements_equal_the_reference),
        HAIR_TEST(followers_equal_the_reference),
        HAIR_TEST(roots_of_followers_move_with_the_head_alone),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
