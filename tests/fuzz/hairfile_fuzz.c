// hairfile_fuzz.c - fuzz target of .hair files.
#include "tests/fuzz/fuzz_asset.h"

HAIR_FUZZ(hairfile)
{
    return hair_fuzz_asset(bytes, size, hash);
}
