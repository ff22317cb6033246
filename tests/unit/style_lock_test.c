// style_lock_test.c - locks of the built-in haircuts: every lock of curly hair has a phase, a
// direction and a size of its own.
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
    assert_true(pitch.mean > 0.9 * 0.028 && pitch.mean < 1.1 * 0.028);
    assert_true(deviation(&pitch) > 0.1 * pitch.mean && deviation(&pitch) < 0.3 * pitch.mean);
    assert_true(along.mean > 0.05);
    free(hangs);
    free(locks);
    hair_asset_destroy(cut.asset);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(locks_of_curly_hair_differ)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
