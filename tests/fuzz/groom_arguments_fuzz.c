// groom_arguments_fuzz.c - fuzz target of the command line of hair-groom. An input has one argument
// a line.
#include "tests/fuzz/fuzz.h"
#include "tools/common/file.h"
#include "tools/common/groom_options.h"

HAIR_FUZZ(groom_arguments)
{
    char* arguments[24];
    int count;
    char* text = hair_fuzz_split("hair-groom", bytes, size, &count, arguments, 24);
    struct hair_groom_options options;
    size_t printed = hair_fuzz_printed();
    int code = hair_groom_parse(count, arguments, &options);
    HAIR_FUZZ_CHECK(code == -1 || code == HAIR_EXIT_OK || code == HAIR_EXIT_USAGE);
    HAIR_FUZZ_CHECK((code == HAIR_EXIT_USAGE) == (hair_fuzz_printed() > printed));
    if (code == -1) {
        bool two = options.command != HAIR_GROOM_INFO;
        HAIR_FUZZ_CHECK(options.operand[0] && !options.operand[1] == !two);
        HAIR_FUZZ_CHECK(options.import.up <= HAIR_UP_X && options.style.style < HAIR_STYLE_COUNT);
        HAIR_FUZZ_CHECK(options.format <= HAIR_FORMAT_TFX4 || options.format == HAIR_FORMAT_GROOM);
        hair_fuzz_add(hash, options.command);
        hair_fuzz_add_text(hash, options.operand[0]);
        hair_fuzz_add_text(hash, options.operand[1]);
        hair_fuzz_add_floats(hash, &options.import.scale, 1);
        hair_fuzz_add_floats(hash, &options.import.keep_fraction, 1);
        hair_fuzz_add_floats(hash, &options.style.length, 1);
        hair_fuzz_add(hash, options.import.seed);
        hair_fuzz_add(hash, options.import.strand_vertices);
        hair_fuzz_add(hash, options.style.guide_count);
        hair_fuzz_add(hash, options.format);
    }
    free(text);
    return code == -1;
}
