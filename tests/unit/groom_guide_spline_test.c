// groom_guide_spline_test.c - guides and followers at rest, as fitted by the groom, agree with
// those that are drawn.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/reference/reference.h"

// Evaluate a curved strand. Roots are 2 cm apart, and lengths about 20 cm.
static hair_vec3 curved(float t, uint32_t strand, const void* user)
{
    (void)user;
    float bend = 0.5f + 0.1f * (float)(strand % 20), x = 0.02f * (float)(strand % 10),
          z = 0.02f * (float)(strand / 10);
    return hair_v3(x + 0.03f * sinf(9 * bend * t), 0.2f * t * (1 - 0.8f * t * bend),
                   z + 0.02f * t * cosf(7 * t));
}

static struct hair_test_host host;

struct fixture {
    hair_groom* groom;
    struct hair_reference_sample* samples;
    uint32_t each; // Samples of a guide.
};

// Create a groom. A third of its strands have more vertices than a guide may have.
static struct fixture start(uint32_t guide_vertices, hair_strand_set set)
{
    struct fixture fixture = {0};
    hair_test_host_init(&host);
    struct hair_test_strands strands = hair_test_strands_make(100, 256);
    for (uint32_t i = 0; i < 100; ++i)
        hair_test_strands_add(&strands, i % 3 ? 3 + i % 32 : 256, curved, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&host, &strands);
    desc.strand_set = set;
    desc.guide_count = 20;
    desc.follower_count = 200;
    desc.guide_vertices = guide_vertices;
    assert_int_equal(hair_groom_create(&desc, &fixture.groom), HAIR_OK);
    hair_test_strands_free(&strands);

    // The guides are at rest, and the head is at the groom's position.
    hair_groom* groom = fixture.groom;
    static struct hair_step_params params;
    params.rotation_before = params.rotation_after = params.rotation_now = (hair_vec4){0, 0, 0, 1};
    params.smooth_vertices = fixture.each = 2 * (groom->max_vertices - 1) + 1;
    fixture.samples = calloc((size_t)groom->info.guide_count * fixture.each, sizeof *fixture.samples);
    for (uint32_t i = 0; i < groom->info.guide_count; ++i) {
        const struct hair_guide* guide = &groom->guides[i];
        const struct hair_rest* rest = groom->rest + guide->first;
        struct hair_reference_vertex vertex[HAIR_MAX_GUIDE_VERTICES];
        memset(vertex, 0, sizeof vertex);
        for (uint32_t j = 0; j < guide->count; ++j) {
            vertex[j].position[0] = (double)rest[j].position.x;
            vertex[j].position[1] = (double)rest[j].position.y;
            vertex[j].position[2] = (double)rest[j].position.z;
        }
        hair_reference_smooth((struct hair_reference_guide){guide, rest, &params}, vertex,
                              fixture.samples + (size_t)i * fixture.each);
    }
    return fixture;
}

static void finish(struct fixture* fixture)
{
    hair_groom_destroy(fixture->groom);
    free(fixture->samples);
    assert_int_equal(host.blocks, 0);
}

// Numbers of vertices of guides.
static const uint32_t sizes[] = {2, 3, 4, 32, 33, 64, 65, 128, 129, 255, 256};
#define SIZES (sizeof sizes / sizeof *sizes)

static void assert_vec3(hair_vec3 a, const double b[3], double tolerance)
{
    assert_float_equal(a.x, b[0], tolerance);
    assert_float_equal(a.y, b[1], tolerance);
    assert_float_equal(a.z, b[2], tolerance);
}

static void compare_guides(const struct fixture* fixture)
{
    for (uint32_t i = 0; i < fixture->groom->info.guide_count; ++i) {
        struct hair_guide_spline spline;
        const struct hair_guide* guide = &fixture->groom->guides[i];
        double segment = (double)guide->arc_length / (guide->count - 1);
        hair_guide_spline_fit(fixture->groom, i, &spline);
        assert_int_equal(spline.count, fixture->each);
        for (uint32_t k = 0; k < fixture->each; ++k) {
            const struct hair_reference_sample* sample = fixture->samples + (size_t)i * fixture->each + k;
            const double* q = sample->frame;
            hair_quat p = spline.frame[k];
            assert_vec3(spline.position[k], sample->position, 1e-6);
            assert_vec3(spline.tangent[k], sample->tangent, fmax(1e-4, 1e-6 / segment));
            double together =
                (double)p.x * q[0] + (double)p.y * q[1] + (double)p.z * q[2] + (double)p.w * q[3];
            assert_float_equal(fabs(together), 1, 1e-6);
        }
    }
}

static void compare_followers(const struct fixture* fixture)
{
    hair_look look = hair_look_default();
    look.strays.tip_fraction = look.strays.fraction = 0;
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    for (uint32_t i = 0; i < fixture->groom->info.follower_count; ++i)
        for (uint32_t j = 0; j <= 16; ++j) {
            const struct hair_follower* follower = &fixture->groom->followers[i];
            struct hair_reference_point point;
            hair_reference_follower(follower, &look, fixture->each, fixture->samples, j / 16.0, NULL, &point);
            assert_vec3(hair_test_single(fixture->groom, follower, (float)j / 16), point.position, 2e-6);
        }
}

static void guides_are_smoothed_as_the_reference_smooths_them(void** state)
{
    (void)state;
    for (size_t i = 0; i < SIZES; ++i) {
        struct fixture fixture = start(sizes[i], HAIR_STRAND_SET_FULL);
        assert_int_equal(fixture.groom->max_vertices, sizes[i]);
        compare_guides(&fixture);
        finish(&fixture);
    }
}

// Check followers between guides. Those of full strands have shapes of their own: displace_test.
static void followers_equal_the_reference(void** state)
{
    (void)state;
    for (size_t i = 0; i < SIZES; ++i) {
        struct fixture fixture = start(sizes[i], HAIR_STRAND_SET_GUIDES);
        compare_followers(&fixture);
        finish(&fixture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(guides_are_smoothed_as_the_reference_smooths_them),
        cmocka_unit_test(followers_equal_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
