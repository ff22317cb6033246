// host_test.c - memory and log go only through the application's callbacks.
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

#include "lib/base/host.h"

static struct hair_test_host test;

static void memory_is_zero_and_aligned(void** state)
{
    (void)state;
    for (size_t size = 1; size < 100; size += 7) {
        unsigned char* memory = hair_alloc(&test.host, 3, size);
        assert_int_equal((uintptr_t)memory % 16, 0);
        for (size_t i = 0; i < 3 * size; ++i) assert_int_equal(memory[i], 0);
        hair_free(&test.host, memory);
    }
}

// Check sizes at deallocation, which the test host counts in bytes.
static void freed_size_equals_the_allocated_size(void** state)
{
    (void)state;
    void* a = hair_alloc(&test.host, 10, 10);
    void* b = hair_alloc(&test.host, 1, 1);
    assert_int_equal(test.blocks, 2);
    assert_true(test.live >= 101);
    hair_free(&test.host, a);
    hair_free(&test.host, b);
    assert_int_equal(test.live, 0);
}

static void allocation_of_zero_elements_is_not_null(void** state)
{
    (void)state;
    void* memory = hair_alloc(&test.host, 0, 100);
    assert_non_null(memory);
    hair_free(&test.host, memory);
    hair_free(&test.host, NULL);
}

static void overflowing_size_is_refused_without_a_host_call(void** state)
{
    (void)state;
    assert_null(hair_alloc(&test.host, SIZE_MAX, 2));
    assert_null(hair_alloc(&test.host, SIZE_MAX / 2, 4));
    assert_null(hair_alloc(&test.host, (size_t)1 << 62, 2));
    assert_null(hair_alloc(&test.host, 1, PTRDIFF_MAX));
    assert_int_equal(test.allocations, 0);
}

static void grown_array_keeps_its_elements_and_is_freed(void** state)
{
    (void)state;
    uint32_t room = 0, *array = NULL;
    for (uint32_t count = 0; count < 100; ++count) {
        if (count == room) array = hair_grow(&test.host, array, sizeof *array, &room, 5);
        array[count] = count + 1;
    }
    assert_int_equal(room, 160);
    for (uint32_t i = 0; i < room; ++i) assert_int_equal(array[i], i < 100 ? i + 1 : 0);
    assert_int_equal(test.blocks, 1);
    test.refuse = test.allocations + 1;
    assert_null(hair_grow(&test.host, array, sizeof *array, &room, 5));
    assert_int_equal(room, 160);
    assert_int_equal(array[99], 100);
    hair_free(&test.host, array);
}

static void memory_refused_by_the_host_is_null(void** state)
{
    (void)state;
    test.refuse = 1;
    assert_null(hair_alloc(&test.host, 1, 1));
}

static void missing_host_selects_the_c_library(void** state)
{
    (void)state;
    hair_host own = hair_host_or_default(NULL);
    void* memory = hair_alloc(&own, 1, 5);
    assert_non_null(memory);
    hair_free(&own, memory);
    assert_int_equal(hair_fail(&own, HAIR_ERROR_FILE, "nobody hears this"), HAIR_ERROR_FILE);
}

static void host_with_only_one_of_alloc_and_free_uses_neither(void** state)
{
    (void)state;
    hair_host half = test.host;
    half.free = NULL;
    hair_host own = hair_host_or_default(&half);
    hair_free(&own, hair_alloc(&own, 1, 5));
    assert_int_equal(test.allocations, 0);
    assert_ptr_equal(own.log, test.host.log);
}

static void failure_logs_one_sentence_and_returns_its_code(void** state)
{
    (void)state;
    assert_int_equal(hair_fail(&test.host, HAIR_ERROR_ARGUMENT, "%s is %d", "it", 7), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "it is 7");
    assert_int_equal(hair_fail_memory(&test.host, "a groom"), HAIR_ERROR_MEMORY);
    assert_string_equal(test.sentence, "out of memory for a groom");
    assert_int_equal(test.errors, 2);
    hair_log(&test.host, HAIR_LOG_WARNING, "mind");
    assert_int_equal(test.warnings, 1);
    assert_int_equal(test.errors, 2);
}

static void long_log_sentence_is_truncated(void** state)
{
    (void)state;
    char much[2000];
    memset(much, 'x', sizeof much);
    much[sizeof much - 1] = 0;
    hair_fail(&test.host, HAIR_ERROR_FILE, "%s", much);
    assert_int_equal(strlen(test.sentence), 511);
}

static void every_result_has_a_string(void** state)
{
    (void)state;
    for (int i = 0; i <= HAIR_ERROR_CONTEXT_LOST; ++i)
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(hair_result_string((hair_result)i), hair_result_string((hair_result)k));
    assert_string_equal(hair_result_string((hair_result)99), "an unknown result");
    assert_int_equal(hair_version(), HAIR_VERSION);
}

#define TEST(function) HAIR_TEST_WITH_HOST(function, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(memory_is_zero_and_aligned),
        TEST(freed_size_equals_the_allocated_size),
        TEST(allocation_of_zero_elements_is_not_null),
        TEST(overflowing_size_is_refused_without_a_host_call),
        TEST(grown_array_keeps_its_elements_and_is_freed),
        TEST(memory_refused_by_the_host_is_null),
        TEST(missing_host_selects_the_c_library),
        TEST(host_with_only_one_of_alloc_and_free_uses_neither),
        TEST(failure_logs_one_sentence_and_returns_its_code),
        TEST(long_log_sentence_is_truncated),
        TEST(every_result_has_a_string),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
