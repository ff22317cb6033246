// groom_followers_test.c - followers without a scalp: fitted to guides, and grown around guides.
#include "tests/support/grooms.h"

#include <hair/hair_asset.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

// Followers of full strands -----------------------------------------------------------------------

// Evaluate a straight strand. Roots are in a square of 10 cm, and directions vary over it.
static hair_vec3 straight(float t, uint32_t strand, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(strand);
    hair_vec3 root = {0.1f * hair_random(&random), 0, 0.1f * hair_random(&random)};
    float length = 0.15f + 0.1f * root.x + 0.02f * hair_random(&random);
    hair_vec3 along = {4 * root.x - 0.2f, -1, 3 * root.z};
    return hair_add(root, hair_scale(hair_normalize(along, along), length * t));
}

// Evaluate a wavy strand. Waves are 4 cm long with an amplitude of 4 mm, and their phase varies
// over the scalp.
static hair_vec3 wavy(float t, uint32_t strand, const void* user)
{
    hair_vec3 p = straight(t, strand, user);
    hair_vec3 root = straight(0, strand, user);
    float s = hair_distance(root, p);
    float phase = 160 * s + 40 * root.x + 20 * root.z;
    return hair_add(p, hair_scale(hair_v3(sinf(phase), 0, cosf(phase)), 0.004f * fminf(30 * s, 1)));
}

// Errors of the groom that HAIR_STRAND_SET_FULL makes of strands, which are found by their roots.
struct fit {
    double rms, worst, root; // Relative to each strand's length. `root` is in metres.
    // Root mean square error if every follower were a copy of its guide, moved to its root.
    double own;
};

static double find_strand(const struct hair_test_strands* strands, hair_vec3 root, const float** found,
                          uint32_t* vertices)
{
    double min = INFINITY;
    const float* p = strands->positions;
    for (uint32_t i = 0; i < strands->count; p += 3 * strands->vertices[i++]) {
        double d = (double)hair_distance(root, hair_load3(p));
        if (d >= min) continue;
        min = d;
        *found = p;
        *vertices = strands->vertices[i];
    }
    return min;
}

static struct fit measure_fit(const hair_groom* groom, const struct hair_test_strands* strands)
{
    struct fit fit = {0};
    double sum = 0, own_sum = 0;
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        const float* strand = NULL;
        uint32_t vertices = 0;
        hair_vec3 root = hair_test_single(groom, follower, 0);
        fit.root = fmax(fit.root, find_strand(strands, root, &strand, &vertices));
        struct hair_follower copy = *follower;
        for (int k = 1; k < 4; ++k) copy.offset[k] = copy.offset[0];
        copy.multi = 0;

        double length = 0, along = 0, squared = 0, own = 0;
        for (uint32_t j = 1; j < vertices; ++j)
            length += (double)hair_distance(hair_load3(strand + 3 * j), hair_load3(strand + 3 * (j - 1)));
        for (uint32_t j = 1; j < vertices; ++j) {
            hair_vec3 p = hair_load3(strand + 3 * j);
            along += (double)hair_distance(p, hair_load3(strand + 3 * (j - 1)));
            double d =
                (double)hair_distance(p, hair_test_single(groom, follower, (float)(along / length))) / length;
            double e =
                (double)hair_distance(p, hair_test_single(groom, &copy, (float)(along / length))) / length;
            squared += d * d / (vertices - 1), own += e * e / (vertices - 1);
        }
        sum += squared, own_sum += own;
        fit.worst = fmax(fit.worst, sqrt(squared));
    }
    fit.rms = sqrt(sum / groom->info.follower_count);
    fit.own = sqrt(own_sum / groom->info.follower_count);
    return fit;
}

static struct fit fit_strands(const char* name, const struct hair_test_strands* strands, uint32_t guides)
{
    hair_groom_desc desc = hair_test_groom_desc(&test, strands);
    desc.guide_count = guides;
    hair_groom* groom = hair_test_groom_of(&desc);
    struct fit fit = measure_fit(groom, strands);
    printf("%-8s %5u strands of %3u guides: rms error %.3f %% of the length, worst strand %.2f %%; copies of "
           "guides: "
           "%.2f %%\n",
           name, strands->count, groom->info.guide_count, 100 * fit.rms, 100 * fit.worst, 100 * fit.own);
    hair_groom_destroy(groom);
    return fit;
}

static void straight_strands_are_followed_exactly(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(2000, 24);
    for (int i = 0; i < 2000; ++i) hair_test_strands_add(&strands, 24, straight, NULL);
    struct fit fit = fit_strands("straight", &strands, 100);
    assert_true(fit.rms < 2e-5);
    assert_true(fit.root < 1e-6);
    hair_test_strands_free(&strands);
}

static void wavy_strands_are_followed_closely(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(2000, 32);
    for (int i = 0; i < 2000; ++i) hair_test_strands_add(&strands, 32, wavy, NULL);
    struct fit fit = fit_strands("wavy", &strands, 200);
    // Strands are about 4 mm, 2.5 % of their length, from their guide. The vertices of the shape
    // lie on chords of a seventh of a wave, which miss its arc by up to a tenth of the amplitude.
    assert_true(fit.rms < 0.1 * 0.025);
    assert_true(fit.own > 0.02);
    assert_true(fit.root < 1e-6);
    hair_test_strands_free(&strands);
}

static void strands_of_a_real_haircut_are_followed_closely(void** state)
{
    (void)state;
    FILE* file = fopen("../shared/data/tressfx/ratboy_mohawk.tfx", "rb");
    if (!file) {
        printf("no haircut at hand, none followed\n");
        return;
    }
    static unsigned char bytes[1 << 21];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    hair_asset_desc asset_desc = hair_asset_desc_default();
    asset_desc.host = &test.host;
    hair_asset* asset = NULL;
    assert_int_equal(hair_asset_read(&asset_desc, bytes, size, &asset), HAIR_OK);
    hair_asset_info info = hair_asset_info_default();
    hair_asset_describe(asset, &info);
    struct hair_test_strands strands = hair_test_strands_make(info.strand_count, info.max_vertices);
    memcpy(strands.positions, info.positions, 3 * info.vertex_count * sizeof(float));
    memcpy(strands.vertices, info.strand_vertices, info.strand_count * sizeof(uint32_t));
    strands.count = info.strand_count;
    struct fit fit = fit_strands("mohawk", &strands, 0);
    assert_true(fit.rms < 0.001);
    hair_test_strands_free(&strands);
    hair_asset_destroy(asset);
}

static void guides_follow_themselves_without_an_offset(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(500);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* groom = hair_test_groom_of(&desc);
    uint32_t own = 0;
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        if (hair_length(hair_test_xyz(follower->offset[0])) > 0) {
            assert_true(follower->multi == -1);
            continue;
        }
        ++own;
        assert_true(follower->multi == 0 && follower->weight1 == 0 && follower->weight2 == 0);
        for (int k = 0; k < 4; ++k) assert_true(hair_length(hair_test_xyz(follower->offset[k])) == 0);
        assert_true(follower->length_ratio == 1);
    }
    assert_int_equal(own, groom->info.guide_count);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void strands_of_different_vertex_counts_are_followed_in_one_groom(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(1000, 101);
    for (uint32_t i = 0; i < 1000; ++i) hair_test_strands_add(&strands, 2 + i % 100, straight, NULL);
    assert_true(fit_strands("mixed", &strands, 100).rms < 2e-5);
    hair_test_strands_free(&strands);
}

static void a_follower_is_as_long_as_its_strand(void** state)
{
    (void)state;
    float positions[] = {0, 0, 0, 0, 3, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 6, 0};
    uint32_t vertices[] = {2, 2, 2};
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &test.host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 3;
    desc.guide_count = 1;
    hair_groom* groom = hair_test_groom_of(&desc);
    for (uint32_t i = 0; i < 3; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        hair_vec3 root = hair_test_single(groom, follower, 0);
        float length = positions[6 * (int)(root.x + 0.5f) + 4];
        assert_float_equal(follower->length_ratio * groom->guides[0].arc_length, length, 1e-5);
        assert_float_equal(hair_test_single(groom, follower, 1).y, length, 3e-5 * (double)length);
    }
    hair_groom_destroy(groom);
}

// Followers around guides -------------------------------------------------------------------------

static void groom_without_followers_draws_each_guide(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(100);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 0;
    hair_groom* groom = hair_test_groom_of(&desc);
    bool drawn[100] = {false};
    assert_int_equal(groom->info.follower_count, 100);
    for (uint32_t i = 0; i < 100; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        assert_false(drawn[follower->guide0]);
        drawn[follower->guide0] = true;
        for (int k = 0; k < 4; ++k) assert_true(hair_length(hair_test_xyz(follower->offset[k])) == 0);
        assert_true(follower->length_ratio == 1 && follower->multi == 0);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void followers_surround_their_guides_within_the_clump_radius(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(100);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 5050;
    desc.clump_radius = 0.004f;
    hair_groom* groom = hair_test_groom_of(&desc);
    uint32_t own[100] = {0}, inner = 0, side[4] = {0};
    for (uint32_t i = 0; i < 5050; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        hair_vec3 offset = hair_test_xyz(follower->offset[0]);
        ++own[follower->guide0];
        assert_true(offset.y == 0);
        assert_true(hair_length(offset) <= 0.004f);
        assert_true(hair_length(hair_test_xyz(follower->offset[3])) <= 0.5f * hair_length(offset));
        assert_true(follower->length_ratio >= 0.6f && follower->length_ratio <= 1);
        assert_true(follower->multi == 0);
        inner += hair_length(offset) < 0.002f;
        ++side[2 * (offset.x > 0) + (offset.z > 0)];
    }
    for (int i = 0; i < 100; ++i) assert_in_range(own[i], 50, 51);
    // The fraction within half the radius, which is one standard deviation, is (1 - exp(-1/2)) / (1
    // - exp(-2)) = 0.455.
    assert_float_equal(inner / 5050.0, 0.455, 0.02);
    for (int i = 0; i < 4; ++i) assert_float_equal(side[i] / 5050.0, 0.25, 0.02);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(straight_strands_are_followed_exactly),
        TEST(wavy_strands_are_followed_closely),
        TEST(strands_of_a_real_haircut_are_followed_closely),
        TEST(guides_follow_themselves_without_an_offset),
        TEST(strands_of_different_vertex_counts_are_followed_in_one_groom),
        TEST(a_follower_is_as_long_as_its_strand),
        TEST(groom_without_followers_draws_each_guide),
        TEST(followers_surround_their_guides_within_the_clump_radius),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
