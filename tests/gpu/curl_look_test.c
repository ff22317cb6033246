// curl_look_test.c - curls of followers have the radius and the length of turns that the look or
// its preset says, and locks vary.
#include "tests/support/looks.h"

#include <math.h>
#include <stdlib.h>

#define SEGMENTS 40u
#define EACH (SEGMENTS + 1)
#define CURL_SEGMENTS ((size_t)256)
#define LOCKS ((size_t)100)

static void curls_are_their_radius_away_from_the_strand(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    look.strays.tip_fraction = look.strays.fraction = 0;
    float* plain = hair_test_read_look(&f, &look);
    look.curl.radius = 0.004f;
    look.curl.wavelength = 0.04f;
    look.curl.profile = hair_curve_line(1, 1);
    look.curl.spread = 0;
    float* curled = hair_test_read_look(&f, &look);
    for (size_t i = 0; i < HAIR_TEST_LOOK_FOLLOWERS * EACH; ++i)
        hair_test_near("radius", i, hair_test_distance_at(plain, curled, i), 0.004, 1e-6);
    look.curl.profile.at[0] = 0;
    float* rooted = hair_test_read_look(&f, &look);
    for (size_t n = 0; n < HAIR_TEST_LOOK_FOLLOWERS; ++n)
        hair_test_near("root", n, hair_test_distance_at(plain, rooted, n * EACH), 0, 1e-6);
    free(plain), free(curled), free(rooted);
    hair_test_scene_free(&f);
}

// Diameter and length of turns, in m.
struct curl_size {
    double diameter, turn;
};

// Measure curls that have their full radius all along. The angle around the axis tells turns. The
// mean square of the distance from the axis tells the radius of a helix or of a flat one.
static struct curl_size measure_curls(const float* plain, const float* curled, uint32_t segments,
                                      double flatness)
{
    double square = 0, angle = 0, along = 0;
    size_t count = 0, each = segments + 1;
    for (size_t n = 0; n < HAIR_TEST_LOOK_FOLLOWERS; ++n)
        for (size_t k = n * each; k < n * each + segments; ++k) {
            double d[2][3], axis[3], dot = 0, cross = 0;
            for (size_t i = 0; i < 3; ++i) {
                d[0][i] = (double)curled[3 * k + i] - (double)plain[3 * k + i];
                d[1][i] = (double)curled[3 * k + 3 + i] - (double)plain[3 * k + 3 + i];
                axis[i] = (double)plain[3 * k + 3 + i] - (double)plain[3 * k + i];
            }
            double step = hair_test_distance_at(plain, plain + 3, k);
            for (size_t i = 0; i < 3; ++i) {
                size_t a = (i + 1) % 3, b = (i + 2) % 3;
                dot += d[0][i] * d[1][i];
                square += d[0][i] * d[0][i];
                cross += (d[0][a] * d[1][b] - d[0][b] * d[1][a]) * axis[i] / step;
            }
            angle += fabs(atan2(cross, dot));
            along += step;
            ++count;
        }
    double flat = 1 - flatness;
    return (struct curl_size){2 * sqrt(2 * square / (double)count / (1 + flat * flat)),
                              2 * 3.14159265358979 * along / angle};
}

// Return the look of a preset on strands that are straight but for their curls.
static hair_look curls_of(hair_look_preset preset)
{
    hair_look look = hair_look_default();
    assert_int_equal(hair_look_apply_preset(&look, preset), HAIR_OK);
    look.strand.segments = 256, look.curl.profile = hair_curve_line(1, 1);
    look.strays.tip_fraction = look.strays.fraction = 0, look.clump = hair_look_default().clump;
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    return look;
}

// Check the sizes that hair_look.h gives for every `step`-th preset with curls.
static void check_presets(struct hair_test_scene* f, const char* when, size_t step)
{
    static const struct {
        hair_look_preset preset;
        struct curl_size size;
    } rows[] = {{HAIR_LOOK_WAVY, {0.018, 0.085}},  {HAIR_LOOK_CURLY, {0.024, 0.050}},
                {HAIR_LOOK_COILY, {0.009, 0.018}}, {HAIR_LOOK_2A, {0.018, 0.120}},
                {HAIR_LOOK_2B, {0.020, 0.090}},    {HAIR_LOOK_2C, {0.022, 0.065}},
                {HAIR_LOOK_3A, {0.025, 0.055}},    {HAIR_LOOK_3B, {0.014, 0.034}},
                {HAIR_LOOK_3C, {0.008, 0.021}},    {HAIR_LOOK_4A, {0.005, 0.013}},
                {HAIR_LOOK_4B, {0.004, 0.009}},    {HAIR_LOOK_4C, {0.003, 0.007}}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i += step) {
        hair_look look = curls_of(rows[i].preset);
        // A strand may be shorter than a turn. All phases together have the mean of a turn.
        look.curl.strand_phase = 1;
        float* curled = hair_test_read_look(f, &look);
        float flatness = look.curl.flatness;
        look.curl.radius = 0;
        float* plain = hair_test_read_look(f, &look);
        struct curl_size size = measure_curls(plain, curled, look.strand.segments, (double)flatness);
        print_message("    %s, %s: %.1f mm wide, %.1f mm long\n", hair_look_name(rows[i].preset), when,
                      1000 * size.diameter, 1000 * size.turn);
        hair_test_near("diameter", i, size.diameter, rows[i].size.diameter, 0.1 * rows[i].size.diameter);
        hair_test_near("turn", i, size.turn, rows[i].size.turn, 0.1 * rows[i].size.turn);
        free(plain), free(curled);
    }
}

// Turn the head to and fro at 2 Hz while `frames` frames of 1/60 s pass. `angle` is the amplitude.
static void shake(struct hair_test_scene* f, int frames, float angle)
{
    for (int i = 1; i <= frames; ++i) {
        float turn = angle * sinf(6.2831853f * 2 * (float)i / 60), c = cosf(turn), s = sinf(turn);
        const float head[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
        hair_test_ok(f->test, hair_set_transform(f->hair, head));
        hair_test_ok(f->test, hair_step(f->hair, 1.0f / 60));
    }
}

static void presets_have_their_diameter_and_length_of_turns(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, (uint32_t)LOCKS);
    check_presets(&f, "at rest", 1);
    shake(&f, 52, 0.6f);
    check_presets(&f, "in a shake", 4);
    shake(&f, 8, 0.6f);
    shake(&f, 120, 0);
    check_presets(&f, "after a shake", 4);
    hair_test_scene_free(&f);
}

// Return the length of the mean of the unit offsets of a lock's strands, `along` metres from their
// roots. It is 1 if all strands are in phase, and near 0 if phases are random.
static double coherence_of(const float* plain, const float* curled, size_t lock, double along)
{
    double sum[3] = {0};
    for (size_t n = lock; n < HAIR_TEST_LOOK_FOLLOWERS; n += LOCKS) {
        size_t root = n * (CURL_SEGMENTS + 1);
        size_t k =
            root + (size_t)fmin(along / hair_test_distance_at(plain, plain + 3, root), (double)CURL_SEGMENTS);
        double radius = hair_test_distance_at(plain, curled, k);
        for (size_t i = 0; i < 3; ++i)
            sum[i] += ((double)curled[3 * k + i] - (double)plain[3 * k + i]) / radius * LOCKS /
                      HAIR_TEST_LOOK_FOLLOWERS;
    }
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

// Return the mean radius of a strand between two vertices.
static double mean_radius(const float* plain, const float* curled, size_t strand, size_t from, size_t to)
{
    double sum = 0;
    for (size_t k = from; k < to; ++k)
        sum += hair_test_distance_at(plain, curled, strand * (CURL_SEGMENTS + 1) + k);
    return sum / (double)(to - from);
}

// Check that strands of a lock turn together and drift apart towards the tips, and that the radius
// varies between locks and along each. Strand n belongs to lock n modulo LOCKS.
static void locks_vary_and_drift_apart_towards_their_tips(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, (uint32_t)LOCKS);
    hair_look look = curls_of(HAIR_LOOK_3B);
    float* curled = hair_test_read_look(&f, &look);
    look.curl.radius = 0;
    float* plain = hair_test_read_look(&f, &look);
    double near_root = 0, tip = 0, mean = 0, square = 0, along = 0;
    for (size_t lock = 0; lock < LOCKS; ++lock) {
        near_root += coherence_of(plain, curled, lock, 0.02) / LOCKS;
        tip += coherence_of(plain, curled, lock, 0.15) / LOCKS;
        double radius = mean_radius(plain, curled, lock, 0, CURL_SEGMENTS + 1), most = 0, least = 1;
        for (size_t part = 0; part < 4; ++part) {
            double there =
                mean_radius(plain, curled, lock, part * CURL_SEGMENTS / 4, (part + 1) * CURL_SEGMENTS / 4);
            most = fmax(most, there), least = fmin(least, there);
        }
        mean += radius / LOCKS, square += radius * radius / LOCKS, along += (most - least) / radius / LOCKS;
    }
    double spread = sqrt(square - mean * mean) / mean;
    print_message("    coherence of a lock %.3f near the root and %.3f at the tip\n", near_root, tip);
    print_message("    radius varies by %.3f between locks and %.3f along them\n", spread, along);
    assert_true(near_root > 0.98 && tip < 0.97 && tip > 0.5);
    assert_true(spread > 0.1 && spread < 0.25);
    assert_true(along > 0.1 && along < 0.5);
    free(plain), free(curled);
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(curls_are_their_radius_away_from_the_strand),
        HAIR_TEST(presets_have_their_diameter_and_length_of_turns),
        HAIR_TEST(locks_vary_and_drift_apart_towards_their_tips),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
