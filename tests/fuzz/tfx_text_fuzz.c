// tfx_text_fuzz.c - fuzz target of text .tfx files, versions 1 and 2, with or without a BOM.
#include "tests/fuzz/fuzz_asset.h"

HAIR_FUZZ(tfx_text)
{
    return hair_fuzz_asset(bytes, size, hash);
}
