// cut_save_test.c - lengths of hair in saved states, and after the loss of the OpenGL context.
#include "tests/support/context_loss.h"
#include "tests/support/cut_scene.h"
#include "tests/support/ways.h"

#include <stdlib.h>
#include <string.h>

#define GUIDES HAIR_TEST_CUT_CURL

static void saved_lengths_continue_with_the_same_bits(void** state)
{
    struct hair_test* test = *state;
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        struct hair_test_living saved, loaded;
        size_t size = 0;
        hair_test_cut_live(test, way, &saved), hair_test_cut_live(test, way, &loaded);
        hair_test_cut_shake(&saved, 0, 10);
        hair_test_cut_lengths(&saved, 0.45f, 0.8f);
        hair_test_cut_shake(&saved, 10, 20);
        hair_test_ok(test, hair_save(saved.hair, NULL, 0, &size));
        unsigned char* bytes = malloc(size);
        hair_test_ok(test, hair_save(saved.hair, bytes, size, &size));
        hair_test_cut_shake(&saved, 20, 40);
        hair_test_read_guides(&saved);
        for (int twice = 0; twice < 2; ++twice) {
            float fractions[GUIDES];
            hair_test_ok(test, hair_load(loaded.hair, bytes, size));
            hair_test_ok(test, hair_get_lengths(loaded.hair, 0, GUIDES, fractions));
            assert_true(fractions[0] == 0.45f && fractions[1] == 0.8f);
            hair_test_cut_shake(&loaded, 20, 40);
            hair_test_read_guides(&loaded);
            assert_memory_equal(saved.positions, loaded.positions, saved.vertices * 3 * sizeof(float));
            hair_test_cut_lengths(&loaded, 0.7f, 0.1f);
        }
        free(bytes);
        hair_test_die(&saved), hair_test_die(&loaded);
    }
}

// A state of whole hair makes hair whole that is cut.
static void state_of_whole_hair_makes_hair_whole(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_living whole, cut;
    size_t size = 0;
    hair_test_cut_live(test, 0, &whole), hair_test_cut_live(test, 0, &cut);
    hair_test_cut_shake(&whole, 0, 10);
    hair_test_ok(test, hair_save(whole.hair, NULL, 0, &size));
    unsigned char* bytes = malloc(size);
    hair_test_ok(test, hair_save(whole.hair, bytes, size, &size));
    hair_test_cut_lengths(&cut, 0.3f, 0.4f);
    hair_test_cut_shake(&cut, 0, 5);
    hair_test_ok(test, hair_load(cut.hair, bytes, size));
    assert_null(cut.hair->sim.lengths.guides);
    hair_test_cut_shake(&whole, 10, 20), hair_test_cut_shake(&cut, 10, 20);
    hair_test_read_guides(&whole), hair_test_read_guides(&cut);
    assert_memory_equal(whole.positions, cut.positions, whole.vertices * 3 * sizeof(float));
    free(bytes);
    hair_test_die(&whole), hair_test_die(&cut);
}

// Lengths are settings too, so that those of no snapshot are restored.
static void restored_hair_has_its_lengths_and_moves_on(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_restorable restorable;
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        struct hair_test_living living;
        float fractions[GUIDES];
        hair_test_restorable_begin(test, &restorable);
        hair_test_cut_live(test, way, &living);
        hair_test_cut_shake(&living, 0, 10);
        hair_test_cut_lengths(&living, 0.5f, 1);
        hair_test_cut_shake(&living, 10, 14);
        hair_test_cut_lengths(&living, 0.3f, 0.7f);
        uint32_t count = living.hair->sim.lengths.guides[0].count;
        hair_test_restorable_lose(test, &restorable);
        hair_test_ok(test, hair_context_restore(test->context));
        hair_test_ok(test, hair_get_lengths(living.hair, 0, GUIDES, fractions));
        assert_true(fractions[0] == 0.3f && fractions[1] == 0.7f);
        assert_int_equal(living.hair->sim.lengths.guides[0].count, count);
        hair_test_cut_shake(&living, 14, 24);
        hair_test_read_guides(&living);
        uint32_t first = living.groom->guides[0].first, whole = living.groom->guides[0].count;
        double length = 0;
        for (uint32_t i = first; i + 1 < first + whole; ++i)
            length += (double)hair_distance(hair_load3(living.positions + 3 * (size_t)i),
                                            hair_load3(living.positions + 3 * (size_t)i + 3));
        length /= (double)living.groom->guides[0].arc_length;
        print_message("    %s: %.4f of the length\n", hair_test_way_name(way), length);
        // Redblack stretches guides.
        assert_true(0.29 < length && length < (living.hair->sim.rods ? 0.31 : 0.37));
        hair_test_die(&living);
        hair_test_restorable_end(test, &restorable);
    }
}

static void refused_memory_keeps_lengths_for_the_next_attempt(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_restorable restorable;
    struct hair_test_living living;
    float fractions[GUIDES];
    hair_test_restorable_begin(test, &restorable);
    hair_test_cut_live(test, 0, &living);
    hair_test_cut_shake(&living, 0, 3);
    hair_test_cut_lengths(&living, 0.3f, 0.7f);
    hair_test_restorable_lose(test, &restorable);
    hair_test_restore_against_refusals(test, living.hair);
    hair_test_ok(test, hair_get_lengths(living.hair, 0, GUIDES, fractions));
    assert_true(fractions[0] == 0.3f && fractions[1] == 0.7f);
    hair_test_cut_shake(&living, 3, 6);
    hair_test_die(&living);
    hair_test_restorable_end(test, &restorable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(saved_lengths_continue_with_the_same_bits),
        HAIR_TEST(state_of_whole_hair_makes_hair_whole),
        HAIR_TEST(restored_hair_has_its_lengths_and_moves_on),
        HAIR_TEST(refused_memory_keeps_lengths_for_the_next_attempt),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
