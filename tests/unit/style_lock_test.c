// style_lock_test.c - natural irregularity of the built-in haircuts. Locks of curly hair differ,
// the density falls off at the hairline, tips are layered, and the crown has a whorl.
#include "lib/groom/groom.h"
#include "lib/groom/style_body.h"
#include "lib/groom/style_grow.h"
#include "tests/support/cut.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>

static struct hair_test_host test;

#define PI 3.14159265f
// Heights between which curls hang straight down along the neck, m.
#define UPPER 1.58f
#define LOWER 1.45f

// A curl around a vertical axis.
struct lock {
    float phase; // direction of the tangent at the middle height, radians
    float turns; // between the heights, to the left if negative
    float slope; // mean ratio of the horizontal tangent to the vertical one
    float pitch[2]; // length of a turn in the upper and in the lower half, m
};

static hair_vec3 segment_at(const struct hair_test_cut* cut, uint32_t guide, uint32_t i)
{
    const float* p = cut->info.positions + 3 * ((size_t)guide * cut->each + i);
    return hair_sub(hair_load3(p + 3), hair_load3(p));
}

static float height_at(const struct hair_test_cut* cut, uint32_t guide, uint32_t i)
{
    return cut->info.positions[3 * ((size_t)guide * cut->each + i) + 1];
}

// Measure the curl of a guide by the direction of its horizontal tangent. Return false for a guide
// that does not hang down between the heights.
static bool measure(const struct hair_test_cut* cut, uint32_t guide, struct lock* out)
{
    float angle = 0, last = 0, halves[2] = {0}, heights[2] = {0};
    uint32_t count = 0;
    *out = (struct lock){0};
    for (uint32_t i = 0; i + 1 < cut->each; ++i) {
        float y = height_at(cut, guide, i), middle = 0.5f * (UPPER + LOWER);
        if (y > UPPER || y < LOWER) continue;
        hair_vec3 d = segment_at(cut, guide, i);
        if (d.y > 0) return false;
        float toward = atan2f(d.x, d.z), turn = count ? remainderf(toward - last, 2 * PI) : 0;
        last = toward;
        angle += turn;
        halves[y < middle] += turn, heights[y < middle] -= d.y;
        if (y > middle) out->phase = toward;
        out->slope += hypotf(d.x, d.z) / -d.y;
        ++count;
    }
    if (count < 16 || heights[0] < 0.05f || heights[1] < 0.05f) return false;
    out->slope /= (float)count;
    out->turns = angle / (2 * PI);
    for (int k = 0; k < 2; ++k) out->pitch[k] = heights[k] * 2 * PI / fabsf(halves[k]);
    return true;
}

struct statistics {
    double count, mean, square;
};

static void add(struct statistics* s, double value)
{
    s->mean = (s->mean * s->count + value) / (s->count + 1);
    s->square = (s->square * s->count + value * value) / (s->count + 1);
    s->count += 1;
}

static double deviation(const struct statistics* s)
{
    return sqrt(s->square - s->mean * s->mean);
}

static void locks_of_curly_hair_differ(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_CURLY);
    struct lock* locks = calloc(cut.info.strand_count, sizeof *locks);
    bool* hangs = calloc(cut.info.strand_count, sizeof *hangs);
    struct statistics pitch = {0}, along = {0}, left = {0}, x = {0}, z = {0};
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        hangs[i] = measure(&cut, i, &locks[i]);
        if (!hangs[i]) continue;
        double mean = 0.5 * (double)(locks[i].pitch[0] + locks[i].pitch[1]);
        add(&pitch, mean);
        add(&along, fabs((double)(locks[i].pitch[0] - locks[i].pitch[1])) / mean);
        add(&left, locks[i].turns < 0);
    }
    for (uint32_t i = 0; i < 3 * cut.info.scalp_triangle_count; ++i) {
        uint32_t a = cut.info.scalp_triangles[i];
        uint32_t b = cut.info.scalp_triangles[i % 3 == 2 ? i - 2 : i + 1];
        if (!hangs[a] || !hangs[b]) continue;
        add(&x, cos((double)(locks[a].phase - locks[b].phase)));
        add(&z, sin((double)(locks[a].phase - locks[b].phase)));
    }
    double coherence = hypot(x.mean, z.mean);
    print_message("    %.0f locks: pitch %.1f mm, deviates by %.3f between locks and by %.3f along them\n",
                  pitch.count, 1e3 * pitch.mean, deviation(&pitch) / pitch.mean, along.mean);
    print_message("    coherence of neighbours %.3f, %.2f turn to the left\n", coherence, left.mean);
    assert_true(pitch.count > 80);
    assert_true(coherence < 0.15);
    assert_true(left.mean > 0.35 && left.mean < 0.65);
    assert_true(pitch.mean > 0.9 * 0.036 && pitch.mean < 1.1 * 0.036);
    assert_true(deviation(&pitch) > 0.1 * pitch.mean && deviation(&pitch) < 0.3 * pitch.mean);
    assert_true(along.mean > 0.05);
    free(hangs);
    free(locks);
    hair_asset_destroy(cut.asset);
}

// Check that guides of curls have enough vertices for their turns, which are zigzags otherwise.
static void curls_turn_little_at_each_vertex(void** state)
{
    (void)state;
    const hair_style styles[] = {HAIR_STYLE_CURLY, HAIR_STYLE_AFRO};
    for (uint32_t s = 0; s < 2; ++s) {
        struct hair_test_cut cut = hair_test_cut_style(&test, styles[s]);
        struct statistics sharp = {0}, angles = {0};
        for (uint32_t i = 0; i < cut.info.strand_count; ++i)
            for (uint32_t k = 0; k + 2 < cut.each; ++k) {
                hair_vec3 a = segment_at(&cut, i, k), b = segment_at(&cut, i, k + 1);
                double angle =
                    (double)atan2f(hair_length(hair_cross(a, b)), hair_dot(a, b)) * 180 / (double)PI;
                add(&angles, angle);
                add(&sharp, angle > 60);
            }
        print_message("    %s: %.0f degrees at a vertex, more than 60 at %.4f of them\n",
                      hair_style_name(styles[s]), angles.mean, sharp.mean);
        assert_true(angles.mean < 45 && sharp.mean < 0.02);
        hair_asset_destroy(cut.asset);
    }
}

// Hairline ----------------------------------------------------------------------------------------

#define BANDS 10
#define BAND 0.002f // m

static hair_vec3 root_of(const hair_groom* groom, const struct hair_follower* follower)
{
    const struct hair_guide* guide = &groom->guides[follower->guide0];
    hair_vec4 p = groom->rest[guide->first].position, q = guide->root_frame, o = follower->offset[0];
    return hair_add(hair_v3(p.x, p.y, p.z),
                    hair_rotate((hair_quat){q.x, q.y, q.z, q.w}, hair_v3(o.x, o.y, o.z)));
}

// Add up the drawn followers by height above the hairline at the nape, where the hairline is level
// and the skull is steep.
static void count_drawn(const hair_groom_desc* desc, double drawn[BANDS])
{
    hair_groom* groom;
    assert_int_equal(hair_groom_create(desc, &groom), HAIR_OK);
    for (int band = 0; band < BANDS; ++band) drawn[band] = 0;
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        const struct hair_patch* patch = &groom->patches[i];
        for (uint32_t k = 0; (float)k < patch->density * (float)patch->count; ++k) {
            hair_vec3 root = root_of(groom, &groom->followers[patch->first + k]),
                      unit = hair_skull_unit(root);
            float azimuth = atan2f(unit.x, unit.z);
            int band = (int)floorf((root.y - hair_scalp_hairline(azimuth)) / BAND);
            if (fabsf(azimuth) > 2.5f && band >= 0 && band < BANDS) drawn[band] += 1;
        }
    }
    hair_groom_destroy(groom);
}

// Compute the density at each height as a fraction of the density without a hairline.
static void measure_hairline(hair_style style, double drawn[BANDS])
{
    struct hair_test_cut cut = hair_test_cut_with(&test, style, 500, 1, 1);
    hair_groom_desc desc = hair_groom_desc_default();
    double full[BANDS];
    desc.host = &test.host;
    assert_int_equal(hair_asset_to_groom_desc(cut.asset, &desc), HAIR_OK);
    desc.follower_count = 200000;
    count_drawn(&desc, drawn);
    desc.scalp_density = NULL;
    count_drawn(&desc, full);
    print_message("    density at the hairline of %s, each %g mm:", hair_style_name(style),
                  1e3 * (double)BAND);
    for (int band = 0; band < BANDS; ++band) {
        assert_true(full[band] > 400);
        drawn[band] /= full[band];
        print_message(" %.2f", drawn[band]);
    }
    print_message("\n");
    hair_asset_destroy(cut.asset);
}

static void density_falls_off_over_a_centimetre(void** state)
{
    (void)state;
    double drawn[BANDS];
    measure_hairline(HAIR_STYLE_LONG, drawn);
    assert_true(drawn[0] > 0.2 && drawn[0] < 0.5);
    for (int band = 0; band < 4; ++band) assert_true(drawn[band] < drawn[band + 1] + 0.03);
    assert_true(drawn[2] > 0.5 && drawn[2] < 0.9); // 4 to 6 mm above the hairline
    for (int band = 7; band < BANDS; ++band) assert_true(drawn[band] > 0.95);
}

// Check hair that is combed away from the hairline, which would draw a hard edge.
static void density_falls_off_over_two_centimetres_where_it_shows(void** state)
{
    (void)state;
    double drawn[BANDS];
    measure_hairline(HAIR_STYLE_SHORT, drawn);
    assert_true(drawn[0] > 0.05 && drawn[0] < 0.2);
    for (int band = 0; band < BANDS - 1; ++band) assert_true(drawn[band] < drawn[band + 1] + 0.03);
    assert_true(drawn[5] > 0.35 && drawn[5] < 0.65); // 10 to 12 mm above the hairline
    assert_true(drawn[BANDS - 1] > 0.8);
}

// Check that hair at the nape gets thicker over two centimetres.
static void hair_of_the_hairline_is_finer(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_with(&test, HAIR_STYLE_SHORT, 500, 1, 1);
    hair_groom_desc desc = hair_groom_desc_default();
    struct statistics radius[3] = {{0}};
    hair_groom* groom;
    desc.host = &test.host;
    assert_int_equal(hair_asset_to_groom_desc(cut.asset, &desc), HAIR_OK);
    assert_int_equal(desc.strand_attribute_count, 1);
    desc.follower_count = 20000;
    assert_int_equal(hair_groom_create(&desc, &groom), HAIR_OK);
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        hair_vec3 root = root_of(groom, &groom->followers[i]), unit = hair_skull_unit(root);
        float azimuth = atan2f(unit.x, unit.z), above = root.y - hair_scalp_hairline(azimuth);
        if (fabsf(azimuth) < 2.5f || (above > 0.012f && above < 0.03f)) continue;
        add(&radius[above < 0.004f ? 0 : above < 0.012f ? 1 : 2], (double)groom->followers[i].offset[0].w);
    }
    print_message("    relative radii of %.0f, %.0f and %.0f strands: %.2f, %.2f and %.2f\n", radius[0].count,
                  radius[1].count, radius[2].count, radius[0].mean, radius[1].mean, radius[2].mean);
    assert_true(radius[0].count > 100 && radius[1].count > 100 && radius[2].count > 100);
    assert_true(radius[0].mean < 0.6 * radius[2].mean && radius[1].mean < 0.9 * radius[2].mean);
    assert_true(radius[0].mean > 0.3 * radius[2].mean && radius[0].mean < radius[1].mean);
    hair_groom_destroy(groom);
    hair_asset_destroy(cut.asset);
}

// Check that hair beside the parting hides the skin at the hairline. Elsewhere hair is thin there.
static void hair_beside_a_parting_is_dense_to_the_hairline(void** state)
{
    (void)state;
    const struct hair_parting parting = hair_style_parting(HAIR_STYLE_BOB);
    struct hair_test_cut cut = hair_test_cut_with(&test, HAIR_STYLE_BOB, 1000, 1, 1);
    struct statistics beside = {0}, apart = {0};
    for (uint32_t i = 0; i < cut.info.scalp_vertex_count; ++i) {
        hair_vec3 p = hair_load3(cut.info.scalp_positions + 3 * (size_t)i), unit = hair_skull_unit(p);
        float azimuth = atan2f(unit.x, unit.z), away = fabsf(p.x - hair_parting_x(parting, p.z));
        if (p.y - hair_scalp_hairline(azimuth) > 0.003f || p.z < 0.05f) continue;
        if (away < 0.008f) add(&beside, (double)cut.info.scalp_density[i]);
        if (away > 0.025f) add(&apart, (double)cut.info.scalp_density[i]);
    }
    print_message("    density at the hairline %.2f beside the parting, %.2f elsewhere\n", beside.mean,
                  apart.mean);
    assert_true(beside.count >= 2 && apart.count >= 8);
    assert_true(beside.mean > 0.85 && apart.mean < 0.5);
    hair_asset_destroy(cut.asset);
}

// Tips and crown ----------------------------------------------------------------------------------

static void tips_of_long_hair_are_layered(void** state)
{
    (void)state;
    const hair_style styles[] = {HAIR_STYLE_LONG, HAIR_STYLE_CURLY};
    for (uint32_t s = 0; s < 2; ++s) {
        struct hair_test_cut cut = hair_test_cut_style(&test, styles[s]);
        struct statistics high = {0}, low = {0};
        for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
            float root = height_at(&cut, i, 0), tip = height_at(&cut, i, cut.each - 1);
            if (root > 1.69f) add(&high, (double)tip);
            if (root < 1.60f) add(&low, (double)tip);
        }
        print_message("    %s: tips of the crown are %.0f mm higher, and deviate by %.0f mm\n",
                      hair_style_name(styles[s]), 1e3 * (high.mean - low.mean), 1e3 * deviation(&high));
        assert_true(high.mean - low.mean > 0.025);
        assert_true(deviation(&high) > 0.006);
        hair_asset_destroy(cut.asset);
    }
}

// Check that hair around the crown turns one way around the whorl, and away from it.
static void the_crown_has_a_whorl(void** state)
{
    (void)state;
    const struct hair_parting parting = hair_style_parting(HAIR_STYLE_LONG);
    struct hair_test_cut cut = hair_test_cut_with(&test, HAIR_STYLE_LONG, 1000, 1, 1);
    hair_vec3 whorl = hair_style_whorl(parting);
    struct statistics around = {0}, away = {0};
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        hair_vec3 root = hair_load3(cut.info.positions + 3 * (size_t)i * cut.each);
        hair_vec3 normal = hair_skull_normal(root), out = hair_tangential(hair_sub(root, whorl), normal);
        float distance = hair_length(out);
        if (distance > 0.025f || root.z > parting.crown_z) continue;
        out = hair_scale(out, 1 / distance);
        hair_vec3 along = hair_normalize(hair_tangential(segment_at(&cut, i, 0), normal), out);
        add(&around, (double)hair_dot(along, hair_cross(normal, out)));
        add(&away, (double)hair_dot(along, out));
    }
    print_message("    %.0f guides turn by %.2f around the whorl and by %.2f away from it\n", around.count,
                  around.mean, away.mean);
    assert_true(around.count > 10 && around.mean > 0.3 && away.mean > 0.2);
    hair_asset_destroy(cut.asset);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(locks_of_curly_hair_differ),
        TEST(curls_turn_little_at_each_vertex),
        TEST(density_falls_off_over_a_centimetre),
        TEST(density_falls_off_over_two_centimetres_where_it_shows),
        TEST(hair_of_the_hairline_is_finer),
        TEST(hair_beside_a_parting_is_dense_to_the_hairline),
        TEST(tips_of_long_hair_are_layered),
        TEST(the_crown_has_a_whorl),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
