// desc_test.c - structs of the API grow at their end without breaking callers, and every number in
// them is checked.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/base/desc.h"

struct sample {
    hair_struct_header header;
    float fraction;
    uint32_t count;
    bool is_on;
    float newer; // Not in the struct of an older caller.
};

#define ROW(path, kind, usual, low, high)                                                                    \
    {                                                                                                        \
        .name = #path, .type = kind, .offset = offsetof(struct sample, path),                                \
        .size = sizeof(((struct sample*)0)->path), .count = 1, .defaults = (const double[]){usual},          \
        .min = low, .max = high                                                                              \
    }
static const hair_member rows[] = {
    ROW(fraction, HAIR_MEMBER_FLOAT, 0.3, 0.1, 0.9),
    ROW(count, HAIR_MEMBER_UINT, 5, 2, 4000000000.0),
    ROW(is_on, HAIR_MEMBER_BOOL, 1, 0, 1),
    ROW(newer, HAIR_MEMBER_FLOAT, -1, -2, 0),
};
static const struct hair_schema fields = {"sample", rows, 4, sizeof(struct sample), true};

static struct hair_test_host test;

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    return 0;
}

static struct sample defaults(void)
{
    struct sample sample;
    memset(&sample, 0xff, sizeof sample);
    hair_schema_init(&sample, (hair_struct_header){sizeof sample, HAIR_VERSION}, fields);
    return sample;
}

static hair_result take(const struct sample* from, struct sample* own)
{
    return hair_schema_copy_in(&test.host, from, own, fields);
}

static void defaults_equal_the_schema(void** state)
{
    (void)state;
    struct sample sample = defaults();
    assert_true(sample.fraction == 0.3f);
    assert_int_equal(sample.count, 5);
    assert_true(sample.is_on);
    assert_true(sample.newer == -1);
    assert_int_equal(sample.header.size, sizeof sample);
    assert_int_equal(sample.header.version, HAIR_VERSION);
}

static void defaults_of_an_older_caller_end_at_its_size(void** state)
{
    (void)state;
    struct sample sample;
    memset(&sample, 0x55, sizeof sample);
    struct sample untouched = sample;
    hair_schema_init(&sample, (hair_struct_header){offsetof(struct sample, newer), HAIR_VERSION}, fields);
    assert_int_equal(sample.count, 5);
    assert_memory_equal(&sample.newer, &untouched.newer, sizeof sample.newer);
}

static void members_unknown_to_an_older_caller_have_defaults(void** state)
{
    (void)state;
    struct sample old = defaults(), own;
    old.header.size = offsetof(struct sample, newer);
    old.newer = NAN;
    old.count = 77;
    assert_int_equal(take(&old, &own), HAIR_OK);
    assert_int_equal(own.count, 77);
    assert_true(own.newer == -1);
}

static void members_of_a_newer_caller_are_not_read(void** state)
{
    (void)state;
    struct {
        struct sample known;
        float future[50];
    } larger;
    struct sample own[2];
    memset(&larger, 0xff, sizeof larger);
    larger.known = defaults();
    larger.known.header.size = sizeof larger;
    memset(own, 0x55, sizeof own);
    struct sample beyond = own[1];
    assert_int_equal(take(&larger.known, own), HAIR_OK);
    assert_memory_equal(&own[1], &beyond, sizeof beyond);
}

static void ends_of_a_range_are_accepted(void** state)
{
    (void)state;
    struct sample sample = defaults(), own;
    sample.fraction = 0.1f; // Less than 0.1 as a double.
    assert_int_equal(take(&sample, &own), HAIR_OK);
    sample.fraction = 0.9f;
    sample.count = 4000000000u;
    assert_int_equal(take(&sample, &own), HAIR_OK);
    assert_int_equal(test.errors, 0);
}

static void number_outside_its_range_is_named_with_the_range(void** state)
{
    (void)state;
    struct sample sample = defaults(), own;
    sample.fraction = 1.5f;
    assert_int_equal(take(&sample, &own), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "sample.fraction is 1.5, not in [0.1, 0.9]");
    sample = defaults();
    sample.count = 1;
    assert_int_equal(take(&sample, &own), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "sample.count is 1, not in [2, 4000000000]");
    sample = defaults();
    sample.fraction = NAN;
    assert_int_equal(take(&sample, &own), HAIR_ERROR_ARGUMENT);
    sample.fraction = INFINITY;
    assert_int_equal(take(&sample, &own), HAIR_ERROR_ARGUMENT);
    assert_int_equal(take(NULL, &own), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "sample is NULL");
}

static void truth_value_of_another_byte_is_refused(void** state)
{
    (void)state;
    struct sample sample = defaults(), own;
    for (int byte = 0; byte < 256; ++byte) {
        *((unsigned char*)&sample + offsetof(struct sample, is_on)) = (unsigned char)byte;
        assert_int_equal(take(&sample, &own), byte < 2 ? HAIR_OK : HAIR_ERROR_ARGUMENT);
        if (byte < 2) assert_int_equal(own.is_on, byte);
    }
    assert_string_equal(test.sentence, "sample.is_on is 255, not in [0, 1]");
}

static void copies_of_equal_descs_are_equal_bytes(void** state)
{
    (void)state;
    struct sample sample = defaults(), own[2];
    take(&sample, &own[0]);
    memset((unsigned char*)&sample + offsetof(struct sample, is_on) + 1, 0xff,
           offsetof(struct sample, newer) - offsetof(struct sample, is_on) - 1);
    take(&sample, &own[1]);
    assert_memory_equal(&own[0], &own[1], sizeof *own);
}

static void desc_without_a_header_is_refused(void** state)
{
    (void)state;
    struct sample zero = {{0, 0}, 0.5f, 5, true, 0}, own;
    assert_int_equal(take(&zero, &own), HAIR_ERROR_VERSION);
    assert_string_equal(test.sentence, "sample.header is (0, 0), not from sample_default()");
    struct sample other = defaults();
    other.header.version = HAIR_VERSION + 10000;
    assert_int_equal(take(&other, &own), HAIR_ERROR_VERSION);
    assert_non_null(strstr(test.sentence, "of another major version"));
    other.header.version = 199; // Structs of 0.1 have another layout.
    assert_int_equal(take(&other, &own), HAIR_ERROR_VERSION);
    assert_string_equal(test.sentence, "sample.header.version is 199, older than 200");
    other = defaults();
    other.header.size = 5000;
    assert_int_equal(take(&other, &own), HAIR_ERROR_VERSION);
}

static void desc_of_another_minor_version_is_accepted(void** state)
{
    (void)state;
    struct sample other = defaults(), own;
    other.header.version = HAIR_VERSION_MAJOR * 10000 + 9999;
    assert_int_equal(take(&other, &own), HAIR_OK);
}

#define TEST(function) cmocka_unit_test_setup(function, start)

// Structs without a header take the size of the caller's struct.
static void plain_defaults_end_at_the_size_of_the_caller(void** state)
{
    (void)state;
    struct {
        hair_collider collider;
        unsigned char newer[16];
    } larger;
    hair_collider usual = hair_collider_default(), smaller;
    const size_t old = offsetof(hair_collider, friction);
    memset(&larger, 0xff, sizeof larger);
    memset(&smaller, 0xff, sizeof smaller);
    hair_collider_init(&larger.collider, sizeof larger);
    hair_collider_init(&smaller, old);
    hair_collider_init(NULL, sizeof usual);
    assert_true(usual.scale == 1 && usual.friction == 1 && usual.rotation[3] == 1);
    assert_true(usual.shape == HAIR_SHAPE_SPHERE && !usual.mesh && !usual.key && usual.rounding == 0);
    assert_memory_equal(&larger.collider, &usual, sizeof usual);
    for (size_t i = 0; i < sizeof larger.newer; ++i) assert_int_equal(larger.newer[i], 0);
    assert_memory_equal(&smaller, &usual, old);
    for (size_t i = old; i < sizeof smaller; ++i) assert_int_equal(((unsigned char*)&smaller)[i], 0xff);
}

static void plain_defaults_are_those_of_the_headers(void** state)
{
    (void)state;
    hair_pin pin = hair_pin_default();
    hair_wind_source source = hair_wind_source_default();
    hair_curve curve = hair_curve_line(1, 0.3f);
    assert_true(pin.guide == 0 && pin.vertex == UINT32_MAX && pin.to == HAIR_PIN_HEAD);
    assert_true(source.speed == 5 && source.radius == 0.05f);
    for (int k = 0; k < 3; ++k)
        assert_true(pin.position[k] == 0 && source.position[k] == 0 && source.direction[k] == 0);
    for (int i = 0; i < 8; ++i) hair_test_near("curve", (size_t)i, (double)curve.at[i], 1 - 0.1 * i, 1e-6);
    hair_pin_init(NULL, sizeof pin);
    hair_wind_source_init(NULL, sizeof source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(defaults_equal_the_schema),
        TEST(defaults_of_an_older_caller_end_at_its_size),
        TEST(members_unknown_to_an_older_caller_have_defaults),
        TEST(members_of_a_newer_caller_are_not_read),
        TEST(ends_of_a_range_are_accepted),
        TEST(number_outside_its_range_is_named_with_the_range),
        TEST(truth_value_of_another_byte_is_refused),
        TEST(copies_of_equal_descs_are_equal_bytes),
        TEST(desc_without_a_header_is_refused),
        TEST(desc_of_another_minor_version_is_accepted),
        TEST(plain_defaults_end_at_the_size_of_the_caller),
        TEST(plain_defaults_are_those_of_the_headers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
