// bench_arguments_fuzz.c - fuzz target of the command line of hair-bench. An input has one argument
// a line. The suites are stubs.
#include "tests/fuzz/fuzz.h"
#include "tools/bench/bench.h"
#include "tools/common/file.h"

#define STUB(n) const struct bench_suite bench_##n = {.name = #n, .about = "a stub"};
BENCH_SUITES(STUB)

HAIR_FUZZ(bench_arguments)
{
    char* arguments[24];
    int count;
    char* text = hair_fuzz_split("hair-bench", bytes, size, &count, arguments, 24);
    struct bench_options options;
    size_t printed = hair_fuzz_printed();
    int code = bench_parse(count, arguments, &options);
    HAIR_FUZZ_CHECK(code == -1 || code == HAIR_EXIT_OK || code == HAIR_EXIT_USAGE);
    HAIR_FUZZ_CHECK((code == HAIR_EXIT_USAGE) == (hair_fuzz_printed() > printed));
    if (code == -1) {
        HAIR_FUZZ_CHECK(options.suite && options.strands <= 262144 && options.size <= 4096);
        HAIR_FUZZ_CHECK(options.mapping <= 2 && options.device >= -1 && options.device <= 1000);
        HAIR_FUZZ_CHECK(options.scene + (uint64_t)options.scenes <= 1000000000);
        hair_fuzz_add_text(hash, options.suite->name);
        hair_fuzz_add_text(hash, options.json);
        hair_fuzz_add_text(hash, options.csv);
        hair_fuzz_add_text(hash, options.only_case);
        hair_fuzz_add_text(hash, options.only_method);
        hair_fuzz_add(hash, options.scene);
        hair_fuzz_add(hash, options.scenes);
        hair_fuzz_add(hash, options.strands);
        hair_fuzz_add(hash, options.size);
    }
    free(text);
    return code == -1;
}
