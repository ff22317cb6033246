// save_hostile_test.c - bytes that are no saved state are refused and do no harm.
#include "tests/support/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/bytes.h"

#define refused hair_test_refused

// Offsets of the fields, as in lib/sim/save_fields.c.
enum {
    VERSION = 8,
    WHOLE = 12,
    SUBSTEP = 32,
    LEFT = 64,
    LAST = 72,
    STRUCK = 80,
    POSES = 84,
    HEAD = POSES + 3 * 40,
    COLLIDERS = POSES + 4 * 40 + 3 * 8, // After the displacement of gusts.
    COLLIDER_BYTES = 72,
    PIN_BYTES = 36,
    // Bytes of sleeping without a pending measurement, of wind without a fluid, and of the level.
    SLEEP = 148
};

// Compute the library's hash, so that harmful bytes look undamaged.
static void seal(struct hair_test_blob* blob)
{
    uint64_t hash = 0xcbf29ce484222325u;
    hair_write_u64(blob->bytes + WHOLE, blob->size);
    for (size_t i = 0; i < blob->size - 8; ++i) hash = (hash ^ blob->bytes[i]) * 0x100000001b3u;
    hair_write_u64(blob->bytes + blob->size - 8, hash);
}

#define HAIR_GRID 3 // Index of the way with a hair-hair grid, saved within a block.

// Create a small moving instance with two colliders. The way with a hair-hair grid has a pin.
static hair_instance* make_small(struct hair_test* test, int way)
{
    struct hair_test_subject subject = hair_test_subject_of(0);
    subject.desc = hair_test_way(way);
    subject.groom.guides = 2;
    subject.groom.fewest = 4, subject.groom.max = 5;
    subject.groom.followers = 8;
    if (way == HAIR_GRID)
        subject.physics.hair_hair.cohesion = 5, subject.physics.hair_hair.pressure_stiffness = 0.2f;
    hair_instance* hair = hair_test_subject_make(test, &subject);
    hair_pin pin = {1, 2, HAIR_PIN_WORLD, {0.1f, 0.2f, 0.1f}};
    if (way == HAIR_GRID) hair_test_ok(test, hair_set_pins(hair, &pin, 1, sizeof pin));
    hair_test_run(test, hair, &subject, 0, 4);
    hair_test_move(test, hair, &subject, 4);
    assert_int_equal(hair->sim.colliders.current.count, 2);
    assert_int_equal(hair->sim.hair_grid.substeps_done > 0, way == HAIR_GRID);
    return hair;
}

struct wrong {
    hair_result (*load)(hair_instance* hair, struct hair_test_blob blob, size_t at);
    size_t at;
    hair_result result;
    const char* words;
};

static hair_result load_sealed(hair_instance* hair, struct hair_test_blob blob)
{
    seal(&blob);
    return hair_load(hair, blob.bytes, blob.size);
}
static hair_result load_nothing(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    (void)at;
    return hair_load(hair, NULL, blob.size);
}
static hair_result load_short(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    return hair_load(hair, blob.bytes, at);
}
static hair_result load_flipped(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    blob.bytes[at] ^= 1;
    return hair_load(hair, blob.bytes, blob.size);
}
static hair_result load_sealed_short(hair_instance* hair, struct hair_test_blob blob, size_t by)
{
    blob.size -= by;
    return load_sealed(hair, blob);
}
static hair_result load_sealed_long(hair_instance* hair, struct hair_test_blob blob, size_t by)
{
    blob.size += by;
    return load_sealed(hair, blob);
}
static hair_result load_with_nan(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_double(blob.bytes + at, (double)NAN);
    return load_sealed(hair, blob);
}
static hair_result load_with_nan_float(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_float(blob.bytes + at, NAN);
    return load_sealed(hair, blob);
}
static hair_result load_with_minus_1(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_double(blob.bytes + at, -1);
    return load_sealed(hair, blob);
}
static hair_result load_with_zero(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_double(blob.bytes + at, 0);
    return load_sealed(hair, blob);
}
static hair_result load_with_2e9(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_double(blob.bytes + at, 2e9);
    return load_sealed(hair, blob);
}
static hair_result load_with_2e9_float(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_float(blob.bytes + at, 2e9f);
    return load_sealed(hair, blob);
}
static hair_result load_with_65(hair_instance* hair, struct hair_test_blob blob, size_t at)
{
    hair_write_u32(blob.bytes + at, 65);
    return load_sealed(hair, blob);
}

static void refused_load_changes_nothing(void** state)
{
    static struct hair_test_seen before, after;
    struct hair_test* test = *state;
    hair_instance* hair = make_small(test, 0);
    struct hair_test_blob good = hair_test_save(test, hair);
    // The state has the present and previous colliders and no pins. Then it has each vertex's
    // state, frame, rates, and, after a flag, force and rotations.
    size_t vertices = hair->sim.guide_vertices,
           states = COLLIDERS + 12 +
                    COLLIDER_BYTES * (hair->sim.colliders.current.count + hair->sim.colliders.previous.count),
           tip = states + 32 * (vertices - 1);
    size_t frames = states + 32 * vertices, rates = frames + 16 * vertices;
    size_t forces = 4 + 48 * vertices;
    assert_int_equal(rates + 32 * vertices + forces + 4 + SLEEP + 8,
                     good.size); // The position within the grid's block follows.

    // clang-format off
    const struct wrong wrongs[] = {
        {load_nothing, 0, HAIR_ERROR_ARGUMENT, "hair: bytes is NULL"},
        {load_short, 0, HAIR_ERROR_FILE, "the 0 bytes are no saved state"},
        {load_short, 27, HAIR_ERROR_FILE, "the 27 bytes are no saved state"},
        {load_short, 28, HAIR_ERROR_FILE, "ends at byte 28, not at byte "},
        {load_flipped, 3, HAIR_ERROR_FILE, "\"hairsave\" at byte 0"},
        {load_flipped, VERSION, HAIR_ERROR_FILE, "the version at byte 8 of the saved state is 17, not 16"},
        {load_flipped, WHOLE, HAIR_ERROR_FILE, "as byte 12 says"},
        {load_flipped, tip, HAIR_ERROR_FILE, "is damaged"},
        {load_flipped, good.size - 1, HAIR_ERROR_FILE, "is damaged"},
        {load_sealed_short, 1, HAIR_ERROR_FILE, "within the stride of simulated guides at byte "},
        {load_sealed_short, 5, HAIR_ERROR_FILE, "within the whether air is a fluid at byte "},
        {load_sealed_short, SLEEP + 1, HAIR_ERROR_FILE,
         "within the number of substeps since the last update of the hair grid at byte "},
        {load_sealed_short, SLEEP + 5 + forces, HAIR_ERROR_FILE,
         "within the rates of guide vertices at byte "},
        {load_sealed_short, 32 * vertices + SLEEP + 8 + forces, HAIR_ERROR_FILE,
         "within the frames of segments at byte "},
        {load_sealed_short, 48 * vertices + SLEEP + 8 + forces, HAIR_ERROR_FILE,
         "within the guide vertices at byte "},
        {load_sealed_short, good.size - 28, HAIR_ERROR_FILE,
         "end at byte 20, within the marks of a skinned scalp, of targets and of lengths at byte 20"},
        {load_sealed_long, 4, HAIR_ERROR_FILE, "the fields of the saved state end at byte "},
        {load_with_minus_1, SUBSTEP, HAIR_ERROR_ARGUMENT, "its substep is -1, the instance's 0.004166"},
        {load_with_nan, SUBSTEP, HAIR_ERROR_ARGUMENT, "the saved state is another's"},
        {load_with_minus_1, LEFT, HAIR_ERROR_FILE,
         "since the last substep at byte 64 of the saved state is -1"},
        {load_with_nan, LEFT, HAIR_ERROR_FILE, "the time since the last substep"},
        {load_with_nan, LAST, HAIR_ERROR_FILE,
         "the length of the last substep at byte 72 of the saved state is "},
        {load_with_zero, LAST, HAIR_ERROR_FILE, "is 0, not in [1e-06, 0.11]"},
        {load_with_65, STRUCK, HAIR_ERROR_FILE,
         "whether there have been colliders at byte 80 of the saved state is 65, not in [0, 1]"},
        {load_with_nan, POSES, HAIR_ERROR_FILE, "the head at the start of the last substep at byte 84"},
        {load_with_2e9, HEAD, HAIR_ERROR_FILE,
         "the head at byte 204 of the saved state is 2e+09, not in [-1e+09"},
        {load_with_nan, HEAD + 24, HAIR_ERROR_FILE, "the head at byte "},
        {load_with_minus_1, HEAD + 24, HAIR_ERROR_FILE, "the rotation of the head"},
        {load_with_65, COLLIDERS, HAIR_ERROR_FILE,
         "the number of colliders before byte 272 of the saved state is 65, more than it holds"},
        {load_with_65, COLLIDERS + 4, HAIR_ERROR_ARGUMENT, "colliders[0].shape is 65"},
        {load_with_nan_float, COLLIDERS + 4 + 32, HAIR_ERROR_ARGUMENT, "colliders[0].size[0] is "},
        {load_with_nan_float, COLLIDERS + 4 + 2 * COLLIDER_BYTES + 8, HAIR_ERROR_ARGUMENT,
         "colliders[0].position[0] is "},
        {load_with_nan_float, tip, HAIR_ERROR_FILE, "the guide vertices at byte "},
        {load_with_2e9_float, tip + 28, HAIR_ERROR_FILE, "is 2e+09, not in [-1e+09, 1e+09]"},
        {load_with_nan_float, frames, HAIR_ERROR_FILE, "the frames of segments at byte "},
        {load_with_nan_float, rates, HAIR_ERROR_FILE, "the rates of guide vertices at byte "},
    };
    // clang-format on

    struct hair_test_blob wrong = {malloc(good.size + 4), good.size};
    // The instance then differs from the saved state.
    hair_test_step(test, hair, &(struct hair_test_subject){0}, 1);
    hair_test_look(test, hair, &before);
    // The copy includes what the library computes only when it is read.
    hair_instance as_it_was = *hair;
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; ++i) {
        memcpy(wrong.bytes, good.bytes, good.size);
        refused(test, wrongs[i].load(hair, wrong, wrongs[i].at), wrongs[i].result, wrongs[i].words);
        assert_memory_equal(hair, &as_it_was, sizeof as_it_was);
        hair_test_look(test, hair, &after);
        hair_test_same(&after, &before);
        as_it_was = *hair; // A read counts what it writes.
    }
    hair_test_ok(test, hair_load(hair, good.bytes, good.size));
    hair_destroy(hair);
    free(good.bytes), free(wrong.bytes);
}

static void state_of_another_haircut_or_substep_is_refused(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_subject subject = hair_test_subject_of(0);
    hair_instance* hair = hair_test_subject_make(test, &subject);
    struct hair_test_subject others[3];
    const char* words[3] = {"its number of guides is 8, the instance's 7",
                            "its hash of the vertices of each guide is ",
                            "its substep is 0.00999999978, the instance's"};
    for (int i = 0; i < 3; ++i) others[i] = hair_test_subject_of(0);
    others[0].groom.guides = 8;
    others[1].groom.guides = 6, subject.groom.guides = 6;
    others[1].groom.fewest = 15, others[1].groom.max = 17;
    others[2].desc.substep = 0.01f;
    // The guides have 16 vertices each. The total equals that of guides of 15 to 17.
    hair_instance* six = hair_test_subject_make(test, &subject);
    for (int i = 0; i < 3; ++i) {
        hair_instance* other = hair_test_subject_make(test, &others[i]);
        struct hair_test_blob blob = hair_test_save(test, other);
        refused(test, hair_load(i == 1 ? six : hair, blob.bytes, blob.size), HAIR_ERROR_ARGUMENT, words[i]);
        hair_destroy(other);
        free(blob.bytes);
    }
    hair_destroy(hair);
    hair_destroy(six);
}

static void truncated_state_is_refused(void** state)
{
    struct hair_test* test = *state;
    hair_instance* hair = make_small(test, 0);
    struct hair_test_blob good = hair_test_save(test, hair), cut = {malloc(good.size), 0};
    for (cut.size = 0; cut.size < good.size; ++cut.size) {
        // The exact size lets tools detect reads beyond the end.
        unsigned char* exact = malloc(cut.size ? cut.size : 1);
        memcpy(exact, good.bytes, cut.size);
        refused(test, hair_load(hair, exact, cut.size), HAIR_ERROR_FILE, "saved state");
        free(exact);
        if (cut.size < 28) continue;
        memcpy(cut.bytes, good.bytes, cut.size);
        refused(test, load_sealed(hair, cut), HAIR_ERROR_FILE, "saved state");
    }
    hair_destroy(hair);
    free(good.bytes), free(cut.bytes);
}

// Load sealed bytes. Check that they are refused, or finite at once and after a step with substeps.
// Return whether they are loaded.
static int survives(struct hair_test* test, hair_instance* hair, struct hair_test_blob blob)
{
    static struct hair_test_seen seen;
    hair_result result = load_sealed(hair, blob);
    assert_int_equal(hair_test_forgive(test), result ? 1 : 0);
    if (result) return 0;
    hair_test_look(test, hair, &seen);
    hair_test_finite(&seen);
    hair_test_ok(test, hair_step(hair, 0.02f));
    hair_test_look(test, hair, &seen);
    hair_test_finite(&seen);
    return 1;
}

static void flip_every_bit(struct hair_test* test, int way)
{
    hair_instance* hair = make_small(test, way);
    struct hair_test_blob good = hair_test_save(test, hair), wrong = {malloc(good.size), good.size};
    uint32_t accepted = 0, sealed = 0, random = 3;
    for (size_t bit = 0; bit < 8 * good.size; ++bit) {
        memcpy(wrong.bytes, good.bytes, good.size);
        wrong.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
        refused(test, hair_load(hair, wrong.bytes, wrong.size), HAIR_ERROR_FILE, "saved state");
        // Beyond the header one bit per byte is enough, and a different bit in each byte of a
        // number.
        if (bit >= 64 * 8 && bit % 8 != bit / 8 * 3 % 8) continue;
        accepted += (uint32_t)survives(test, hair, wrong);
        ++sealed;
    }
    print_message("    %u of %u accepted once they are sealed\n", accepted, sealed);
    // All bits of the magic, the version, and the five fields that identify the owner are refused,
    // and some exponents too.
    assert_in_range(accepted, sealed / 2, sealed - 8 * (8 + 4 + 40) - 30);
    for (int n = 0; n < 200; ++n) { // Several numbers at once.
        memcpy(wrong.bytes, good.bytes, good.size);
        for (int k = 0; k < 4; ++k) {
            size_t at = 64 + 4 * (size_t)((double)hair_random(&random) * (double)((good.size - 72) / 4));
            hair_write_float(wrong.bytes + at,
                             ldexpf(hair_random(&random) - 0.5f, (int)(60 * hair_random(&random)) - 25));
        }
        survives(test, hair, wrong);
    }
    hair_destroy(hair);
    free(good.bytes), free(wrong.bytes);
}

static void state_with_a_flipped_bit_is_refused_or_harmless(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 3) flip_every_bit(*state, way);
}

// Load the maximum of every accepted number, all together, and then a number so small that its
// exponent is 0, from which a part of a substep would get no size.
static void load_extremes(struct hair_test* test, int way)
{
    hair_instance* hair = make_small(test, way);
    struct hair_test_blob blob = hair_test_save(test, hair);
    size_t pushes = hair->sim.hair_grid.substeps_done ? hair->sim.guide_vertices * sizeof(hair_vec4) : 0;
    size_t beat = blob.size - 8 - SLEEP - pushes - 4;
    size_t flag = beat - 4 - (hair->sim.bend ? 48 * (size_t)hair->sim.guide_vertices : 0);
    size_t pins = 4 + hair->sim.pins.count * PIN_BYTES;
    for (int n = 0; n < 3; ++n) {
        float sign = n == 0 ? -1 : 1;
        for (int p = 0; p < 4; ++p)
            for (int k = 0; k < 3; ++k)
                hair_write_double(blob.bytes + POSES + 40 * p + 8 * k, p == 3 ? 1e9 : (double)sign * 1e12);
        for (size_t at = COLLIDERS + 2 * (4 + 2 * COLLIDER_BYTES) + pins; at < blob.size - 8 - SLEEP; at += 4)
            if (at != beat && at != flag) {
                float max = at > flag && at < beat - 4 ? 1e15f : 1e9f;
                hair_write_float(blob.bytes + at, n == 2 ? 1e-40f : at % 8 ? max : sign * -max);
            }
        assert_true(survives(test, hair, blob));
    }
    hair_destroy(hair);
    free(blob.bytes);
}

static void state_of_extreme_values_is_stepped_and_drawn_finitely(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) load_extremes(*state, way);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(refused_load_changes_nothing),
        HAIR_TEST(state_of_another_haircut_or_substep_is_refused),
        HAIR_TEST(truncated_state_is_refused),
        HAIR_TEST(state_with_a_flipped_bit_is_refused_or_harmless),
        HAIR_TEST(state_of_extreme_values_is_stepped_and_drawn_finitely),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
