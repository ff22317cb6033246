// fuzz_corpus_test.c - the inputs of tests/fuzz/corpus, cut off and with flipped bits, are refused
// or keep the properties of the fuzz targets.
#include "tests/fuzz/corpus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

static void replay(const char* name)
{
    const struct hair_fuzz_target* target = hair_fuzz_targets;
    while (target->name && strcmp(target->name, name)) ++target;
    assert_non_null(target->name);
    struct hair_fuzz_replay result;
    assert_true(hair_fuzz_replay(target, "tests/fuzz/corpus", &result));
    print_message("    %u files, %u inputs, %u accepted\n", result.files, result.inputs, result.accepted);
    assert_true(result.accepted > 0 && result.accepted < result.inputs);
}

#define REPLAY(name)                                                                                         \
    static void name##_corpus_keeps_the_properties(void** state)                                             \
    {                                                                                                        \
        (void)state;                                                                                         \
        replay(#name);                                                                                       \
    }
REPLAY(hairfile)
REPLAY(groomfile)
REPLAY(tfx)
REPLAY(tfx_text)
REPLAY(obj)
REPLAY(save)
REPLAY(groom_arguments)
REPLAY(members)
REPLAY(bench_arguments)
REPLAY(scene)
REPLAY(capture_arguments)
REPLAY(gltf)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hairfile_corpus_keeps_the_properties),
        cmocka_unit_test(groomfile_corpus_keeps_the_properties),
        cmocka_unit_test(tfx_corpus_keeps_the_properties),
        cmocka_unit_test(tfx_text_corpus_keeps_the_properties),
        cmocka_unit_test(obj_corpus_keeps_the_properties),
        cmocka_unit_test(save_corpus_keeps_the_properties),
        cmocka_unit_test(groom_arguments_corpus_keeps_the_properties),
        cmocka_unit_test(members_corpus_keeps_the_properties),
        cmocka_unit_test(bench_arguments_corpus_keeps_the_properties),
        cmocka_unit_test(scene_corpus_keeps_the_properties),
        cmocka_unit_test(capture_arguments_corpus_keeps_the_properties),
        cmocka_unit_test(gltf_corpus_keeps_the_properties),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
