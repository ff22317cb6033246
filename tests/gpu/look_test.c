// look_test.c - followers do what the look specifies: fractions, radii and lengths. Disabled
// settings change no bit.
#include "tests/support/passes.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/strands/geometry.h"

#define FOLLOWERS 4000
#define SEGMENTS 40u
#define EACH (SEGMENTS + 1)
#define CURL_SEGMENTS ((size_t)256)
#define LOCKS ((size_t)100)

// Create straight guides. Offsets by the look are then perpendicular to a line.
static struct hair_test_scene start(void** state, uint32_t guides)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = guides, wanted.turn = 0, wanted.segment = 0.025f, wanted.followers = FOLLOWERS,
    wanted.each = 64;
    return hair_test_scene_of(*state, &wanted, NULL);
}

static hair_look plain_look(void)
{
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    look.strays.tip_fraction = look.strays.fraction = 0;
    return look;
}

static float* read_with(struct hair_test_scene* f, const hair_look* look)
{
    uint32_t count = FOLLOWERS * EACH, there;
    float* positions = malloc(3 * sizeof *positions * count);
    hair_test_ok(f->test, hair_set_look(f->hair, look));
    hair_test_ok(f->test, hair_read_positions(f->hair, HAIR_READ_FOLLOWERS, positions, count, &there));
    assert_int_equal(there, count);
    return positions;
}

static double distance_at(const float* a, const float* b, size_t i)
{
    double sum = 0;
    for (size_t k = 3 * i; k < 3 * i + 3; ++k) sum += pow((double)a[k] - (double)b[k], 2);
    return sqrt(sum);
}

// Return the fraction of strands that have a moved vertex between `first` and `last`.
static double fraction_moved(const float* a, const float* b, size_t first, size_t last)
{
    uint32_t moved = 0;
    for (size_t n = 0; n < FOLLOWERS; ++n) {
        double max = 0;
        for (size_t k = first; k <= last; ++k) max = fmax(max, distance_at(a, b, n * EACH + k));
        moved += max > 1e-6;
    }
    return (double)moved / FOLLOWERS;
}

static void stray_fraction_is_the_fraction_of_strays(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look();
    float* plain = read_with(&f, &look);
    look.strays.tip_fraction = 0.3f;
    float* tips = read_with(&f, &look);
    look.strays.tip_fraction = 0, look.strays.fraction = 0.1f;
    float* whole = read_with(&f, &look);
    look.strays.tip_fraction = look.strays.fraction = 1;
    float* all = read_with(&f, &look);
    print_message("    %.3f stray at their tips, %.3f all along\n", fraction_moved(plain, tips, 0, SEGMENTS),
                  fraction_moved(plain, whole, 0, SEGMENTS));
    // Tolerances are three standard deviations. For 4,000 strands they are 2.2 % at a fraction of
    // 30 %, and 1.4 % at 10 %.
    hair_test_near("tips", 0, fraction_moved(plain, tips, 0, SEGMENTS), 0.3, 0.022);
    hair_test_near("tips, in the first two fifths", 0, fraction_moved(plain, tips, 0, 2 * SEGMENTS / 5), 0,
                   0);
    hair_test_near("whole", 0, fraction_moved(plain, whole, 0, SEGMENTS), 0.1, 0.014);
    hair_test_near("whole, in the first half", 0, fraction_moved(plain, whole, 0, SEGMENTS / 2), 0.1, 0.014);
    hair_test_near("all", 0, fraction_moved(plain, all, 0, SEGMENTS), 1, 0);
    hair_test_near("roots", 0, fraction_moved(plain, all, 0, 0), 0, 0);
    free(plain), free(tips), free(whole), free(all);
    hair_test_scene_free(&f);
}

// Check the radius of curls all along the strand. Therefore the tip gets no nearer to the root.
static void curls_are_their_radius_away_from_the_strand(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look();
    float* plain = read_with(&f, &look);
    look.curl.radius = 0.004f;
    look.curl.wavelength = 0.04f;
    look.curl.profile = hair_curve_line(1, 1);
    look.curl.spread = 0;
    float* curled = read_with(&f, &look);
    for (size_t i = 0; i < FOLLOWERS * EACH; ++i)
        hair_test_near("radius", i, distance_at(plain, curled, i), 0.004, 1e-6);
    look.curl.profile.at[0] = 0;
    float* rooted = read_with(&f, &look);
    hair_test_near("roots", 0, fraction_moved(plain, rooted, 0, 0), 0, 0);
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
    for (size_t n = 0; n < FOLLOWERS; ++n)
        for (size_t k = n * each; k < n * each + segments; ++k) {
            double d[2][3], axis[3], dot = 0, cross = 0;
            for (size_t i = 0; i < 3; ++i) {
                d[0][i] = (double)curled[3 * k + i] - (double)plain[3 * k + i];
                d[1][i] = (double)curled[3 * k + 3 + i] - (double)plain[3 * k + 3 + i];
                axis[i] = (double)plain[3 * k + 3 + i] - (double)plain[3 * k + i];
            }
            double step = distance_at(plain, plain + 3, k);
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

static float* read_segments(struct hair_test_scene* f, const hair_look* look)
{
    uint32_t count = FOLLOWERS * (look->strand.segments + 1), there;
    float* positions = malloc(3 * sizeof *positions * count);
    hair_test_ok(f->test, hair_set_look(f->hair, look));
    hair_test_ok(f->test, hair_read_positions(f->hair, HAIR_READ_FOLLOWERS, positions, count, &there));
    assert_int_equal(there, count);
    return positions;
}

// Return the look of a preset on strands that are straight but for their curls.
static hair_look curls_of(hair_look_preset preset)
{
    hair_look look = hair_look_default();
    assert_int_equal(hair_look_apply_preset(&look, preset), HAIR_OK);
    look.strand.segments = 256, look.curl.profile = hair_curve_line(1, 1);
    look.strays = plain_look().strays, look.clump = plain_look().clump;
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
        float* curled = read_segments(f, &look);
        float flatness = look.curl.flatness;
        look.curl.radius = 0;
        float* plain = read_segments(f, &look);
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
    struct hair_test_scene f = start(state, (uint32_t)LOCKS);
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
    for (size_t n = lock; n < FOLLOWERS; n += LOCKS) {
        size_t root = n * (CURL_SEGMENTS + 1);
        size_t k = root + (size_t)fmin(along / distance_at(plain, plain + 3, root), (double)CURL_SEGMENTS);
        double radius = distance_at(plain, curled, k);
        for (size_t i = 0; i < 3; ++i)
            sum[i] += ((double)curled[3 * k + i] - (double)plain[3 * k + i]) / radius * LOCKS / FOLLOWERS;
    }
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

// Return the mean radius of a strand between two vertices.
static double mean_radius(const float* plain, const float* curled, size_t strand, size_t from, size_t to)
{
    double sum = 0;
    for (size_t k = from; k < to; ++k) sum += distance_at(plain, curled, strand * (CURL_SEGMENTS + 1) + k);
    return sum / (double)(to - from);
}

// Check that strands of a lock turn together and drift apart towards the tips, and that the radius
// varies between locks and along each. Strand n belongs to lock n modulo LOCKS.
static void locks_vary_and_drift_apart_towards_their_tips(void** state)
{
    struct hair_test_scene f = start(state, (uint32_t)LOCKS);
    hair_look look = curls_of(HAIR_LOOK_3B);
    float* curled = read_segments(&f, &look);
    look.curl.radius = 0;
    float* plain = read_segments(&f, &look);
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

static void strands_have_the_length_of_the_look(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look();
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    float* whole = read_with(&f, &look);
    look.strand.length = 0.5f;
    float* half = read_with(&f, &look);
    look.strand.length_variation = 0.8f;
    float* thinned = read_with(&f, &look);
    double mean = 0;
    for (size_t n = 0; n < FOLLOWERS; ++n) {
        // A half strand has as many segments, so every second vertex is a vertex of the whole
        // strand.
        for (size_t k = 0; k <= SEGMENTS / 2; ++k)
            for (size_t i = 0; i < 3; ++i)
                hair_test_near("vertex", n, half[3 * (n * EACH + 2 * k) + i], whole[3 * (n * EACH + k) + i],
                               1e-6);
        size_t root = n * EACH, tip = root + SEGMENTS;
        double a = 0, b = 0;
        for (size_t i = 0; i < 3; ++i) {
            a += pow((double)half[3 * tip + i] - (double)half[3 * root + i], 2);
            b += pow((double)thinned[3 * tip + i] - (double)thinned[3 * root + i], 2);
        }
        mean += sqrt(b / a) / FOLLOWERS;
    }
    print_message("    thinned to %.3f on average\n", mean);
    // Lengths are uniformly distributed from 0.2 to 1.
    hair_test_near("thinned", 0, mean, 0.6, 0.03);
    free(whole), free(half), free(thinned);
    hair_test_scene_free(&f);
}

static void follower_without_offset_is_its_guide(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look();
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    look.clump.width = hair_curve_line(0, 0);
    float* positions = read_with(&f, &look);
    uint32_t count, each = 2 * f.groom->max_vertices - 1;
    float* smooth = malloc(3 * sizeof *smooth * each * f.groom->info.guide_count);
    hair_test_ok(f.test, hair_read_positions(f.hair, HAIR_READ_SMOOTH, smooth,
                                             each * f.groom->info.guide_count, &count));
    for (size_t n = 0; n < FOLLOWERS; ++n)
        for (size_t k = 0; k < EACH; ++k) {
            const struct hair_follower* follower = &f.groom->followers[n];
            double u = (double)follower->length_ratio * (double)k / SEGMENTS * (each - 1);
            size_t at = follower->guide0 * each + (u < each - 2 ? (size_t)u : each - 2);
            double w = u - floor(fmin(u, each - 2)); // A straight guide continues beyond its tip.
            for (size_t i = 0; i < 3; ++i) {
                double expected = (1 - w) * smooth[3 * at + i] + w * smooth[3 * at + 3 + i];
                hair_test_near("coordinate", n, positions[3 * (n * EACH + k) + i], expected, 1e-6);
            }
        }
    free(positions), free(smooth);
    hair_test_scene_free(&f);
}

static void interpolation_modes_are_the_ends_of_the_blend(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look();
    for (int single = 0; single < 2; ++single) {
        look.clump.interpolation = single ? HAIR_INTERPOLATION_SINGLE : HAIR_INTERPOLATION_MULTI;
        float* pure = read_with(&f, &look);
        look.clump.interpolation = HAIR_INTERPOLATION_MIXED;
        look.clump.weight = hair_curve_line((float)single, (float)single);
        float* mixed = read_with(&f, &look);
        assert_memory_equal(pure, mixed, 3 * sizeof *pure * FOLLOWERS * EACH);
        free(pure), free(mixed);
    }
    hair_test_scene_free(&f);
}

static void disabled_look_has_no_effect_and_no_program(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look(), off = look;
    uint32_t styled = hair_test_runs_of(&f.test->context->gl, "_styled");
    size_t size = 3 * sizeof(float) * FOLLOWERS * EACH;
    float* plain = read_with(&f, &look);
    // No strand strays.
    off.strays.tip_distance = off.strays.distance = hair_curve_line(0.1f, 0.2f);
    off.strays.frizz_wavelength = 0.1f;
    off.curl.profile = hair_curve_line(2, 1); // The radius is 0.
    off.curl.wavelength = 0.01f;
    off.curl.turns = 7, off.curl.flatness = 0.5f, off.curl.left_fraction = 0.5f, off.curl.strand_phase = 1,
    off.curl.spread = 0.5f;
    float* same = read_with(&f, &off);
    assert_memory_equal(plain, same, size);
    off.strays.tip_fraction = off.strays.fraction = 1;
    off.strays.tip_distance = off.strays.distance = hair_curve_line(0, 0); // The distance is 0.
    off.curl.radius = 0.1f;
    off.curl.profile = hair_curve_line(0, 0);
    free(same);
    same = read_with(&f, &off);
    assert_memory_equal(plain, same, size);
    assert_int_equal(hair_test_runs_of(&f.test->context->gl, "_styled"), styled);
    off.curl.profile = hair_curve_line(0, 0.1f);
    free(same);
    same = read_with(&f, &off);
    assert_memory_not_equal(plain, same, size);
    assert_true(hair_test_runs_of(&f.test->context->gl, "_styled") == styled + 1);
    free(plain), free(same);
    hair_test_scene_free(&f);
}

static void invalid_looks_are_refused_by_name(void** state)
{
    struct hair_test_scene f = start(state, 7);
    hair_look look = plain_look();
    look.strand.taper.at[3] = NAN;
    hair_test_refused(f.test, hair_set_look(f.hair, &look), HAIR_ERROR_ARGUMENT,
                      "hair_look.strand.taper.at[3]");
    look = plain_look();
    look.curl.radius = -1;
    hair_test_refused(f.test, hair_set_look(f.hair, &look), HAIR_ERROR_ARGUMENT,
                      "hair_look.curl.radius is -1, not in [0, 0.1");
    look = plain_look();
    look.curl.profile_x[15] = 1.5f;
    hair_test_refused(f.test, hair_set_look(f.hair, &look), HAIR_ERROR_ARGUMENT,
                      "hair_look.curl.profile_x[15] is 1.5");
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(stray_fraction_is_the_fraction_of_strays),
        HAIR_TEST(curls_are_their_radius_away_from_the_strand),
        HAIR_TEST(presets_have_their_diameter_and_length_of_turns),
        HAIR_TEST(locks_vary_and_drift_apart_towards_their_tips),
        HAIR_TEST(strands_have_the_length_of_the_look),
        HAIR_TEST(follower_without_offset_is_its_guide),
        HAIR_TEST(interpolation_modes_are_the_ends_of_the_blend),
        HAIR_TEST(disabled_look_has_no_effect_and_no_program),
        HAIR_TEST(invalid_looks_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
