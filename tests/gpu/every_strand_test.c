// every_strand_test.c - haircuts of the tools all of whose strands are simulated.
#include "tests/support/support.h"
#include "tools/common/every_strand.h"
#include "tools/common/file.h"
#include "tools/common/groom_source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SEGMENTS 16

static const char few[] = "{\"style\": \"long\", \"settings\": {\"followers\": 200, \"guides\": 32, "
                          "\"strand.segments\": 16, \"guide_vertices\": 17, \"curl.radius\": 0.005}}";

static void parse(const char* text, struct hair_scene* scene)
{
    assert_true(hair_scene_parse("test", "tests.json", text, strlen(text), scene));
}

static hair_groom* load(struct hair_test* test, const struct hair_scene* scene)
{
    hair_groom* groom = NULL;
    assert_int_equal(hair_groom_source_load("test", &test->host.host, scene, NULL, &groom), 0);
    return groom;
}

// Return the vertices of all strands at rest, and write their number.
static float* read_all(struct hair_test* test, const struct hair_scene* scene, const hair_groom* groom,
                       hair_read_source kind, uint32_t* count)
{
    hair_look look = hair_every_strand_look(&scene->settings);
    hair_desc desc = scene->settings.desc;
    hair_instance* hair = NULL;
    desc.physics = &scene->settings.physics;
    desc.look = &look;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_test_ok(test, hair_read_positions(hair, kind, NULL, 0, count));
    float* positions = malloc(3 * (size_t)*count * sizeof *positions);
    assert_non_null(positions);
    hair_test_ok(test, hair_read_positions(hair, kind, positions, *count, count));
    hair_destroy(hair);
    return positions;
}

static double distance(const float* a, const float* b)
{
    double x = (double)a[0] - (double)b[0], y = (double)a[1] - (double)b[1], z = (double)a[2] - (double)b[2];
    return sqrt(x * x + y * y + z * z);
}

// Return the distance of a point from the segment from `a` to `b`.
static double distance_from_segment(const float* p, const float* a, const float* b)
{
    double along = 0, square = 0;
    for (int i = 0; i < 3; ++i) {
        along += ((double)p[i] - (double)a[i]) * ((double)b[i] - (double)a[i]);
        square += ((double)b[i] - (double)a[i]) * ((double)b[i] - (double)a[i]);
    }
    float t = square > 0 ? (float)fmin(fmax(along / square, 0), 1) : 0, at[3];
    for (int i = 0; i < 3; ++i) at[i] = a[i] + t * (b[i] - a[i]);
    return distance(p, at);
}

// Return the greatest distance of a vertex of `strand` from the strand of `all` that is nearest in
// this respect. Vertices of followers are evenly spaced along their strand, and need not lie at
// those of `all`.
static double find_strand(const float* strand, const float* all, uint32_t strands)
{
    double least = INFINITY;
    for (uint32_t i = 0; i < strands; ++i) {
        const float* other = all + 3 * (size_t)i * (SEGMENTS + 1);
        double most = distance(strand, other);
        most = fmax(most, distance(strand + (size_t)3 * SEGMENTS, other + (size_t)3 * SEGMENTS));
        for (uint32_t k = 1; k < SEGMENTS && most < least; ++k) {
            double nearest = INFINITY;
            for (uint32_t j = 0; j < SEGMENTS; ++j)
                nearest =
                    fmin(nearest, distance_from_segment(strand + 3 * k, other + 3 * j, other + 3 * j + 3));
            most = fmax(most, nearest);
        }
        least = fmin(least, most);
    }
    return least;
}

static void guides_and_followers_are_the_strands_of_the_haircut(void** state)
{
    struct hair_test* test = *state;
    struct hair_scene scene;
    uint32_t count, all_count;
    parse(few, &scene);
    hair_groom* groom = load(test, &scene);
    float* strands = read_all(test, &scene, groom, HAIR_READ_FOLLOWERS, &count);
    scene.settings.simulates_all = true;
    assert_int_equal(hair_every_strand_make("test", &test->host.host, test->context, &scene, &groom), 0);
    hair_groom_info info = hair_groom_info_default();
    hair_test_ok(test, hair_groom_describe(groom, &info));
    assert_int_equal(info.guide_count, 200);
    assert_int_equal(info.follower_count, 200);
    for (int kind = 0; kind < 2; ++kind) {
        float* all = read_all(test, &scene, groom, kind ? HAIR_READ_FOLLOWERS : HAIR_READ_GUIDES, &all_count);
        assert_int_equal(all_count, count);
        double most = 0;
        for (uint32_t i = 0; i < 200; ++i)
            most = fmax(most, find_strand(all + 3 * (size_t)i * (SEGMENTS + 1), strands, 200));
        print_message("    %s are at most %.3f mm from the strands of the haircut\n",
                      kind ? "followers" : "guides", 1e3 * most);
        // A follower is a smooth curve, and the strand is a chain of chords of it.
        assert_true(most < (kind ? 3e-3 : 1e-6));
        free(all);
    }
    free(strands);
    hair_groom_destroy(groom);
    hair_scene_free(&scene);
}

static void groom_stays_unless_every_strand_is_wanted_and_allowed(void** state)
{
    struct hair_test* test = *state;
    struct hair_scene scene;
    parse(few, &scene);
    hair_groom *groom = load(test, &scene), *same = groom;
    assert_int_equal(hair_every_strand_make("test", &test->host.host, test->context, &scene, &groom), 0);
    assert_ptr_equal(groom, same);
    struct hair_settings other = scene.settings;
    other.look.curl.radius = 0.001f;
    assert_false(hair_every_strand_differs(&scene.settings, &other));
    scene.settings.simulates_all = true;
    assert_true(hair_every_strand_differs(&scene.settings, &other));
    other.simulates_all = true;
    assert_true(hair_every_strand_differs(&scene.settings, &other));
    other.look = scene.settings.look;
    other.look.strand.radius *= 2;
    assert_false(hair_every_strand_differs(&scene.settings, &other));
    strcpy(scene.character.file, "walker.glb");
    assert_int_equal(hair_every_strand_make("test", &test->host.host, test->context, &scene, &groom),
                     HAIR_EXIT_USAGE);
    assert_ptr_equal(groom, same);
    hair_groom_destroy(groom);

    *scene.character.file = 0;
    static const float positions[] = {0, 0, 0, 0, 0.1f, 0, 0.1f, 0, 0, 0.1f, 0.1f, 0};
    static const uint32_t vertices[] = {2, 2};
    static const uint8_t groups[] = {0, 1};
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &test->host.host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_groups = groups;
    desc.strand_count = 2;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    same = groom;
    assert_int_equal(hair_every_strand_make("test", &test->host.host, test->context, &scene, &groom),
                     HAIR_EXIT_INPUT);
    assert_ptr_equal(groom, same);
    hair_groom_destroy(groom);
    hair_scene_free(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(guides_and_followers_are_the_strands_of_the_haircut),
        HAIR_TEST(groom_stays_unless_every_strand_is_wanted_and_allowed),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
