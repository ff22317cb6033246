// tfx_fuzz.c - fuzz target of binary .tfx files, versions 3 and 4.
#include "tests/fuzz/fuzz_asset.h"

HAIR_FUZZ(tfx)
{
    return hair_fuzz_asset(bytes, size, hash);
}
