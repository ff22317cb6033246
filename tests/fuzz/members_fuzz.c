// members_fuzz.c - fuzz target of public structs as JSON. The first byte chooses the struct.
#include "tests/fuzz/fuzz.h"

#include <string.h>

#include "lib/base/schema.h"

#define LENGTH 16384 // of the JSON of a struct

// Default functions return a copy, whose padding may differ.
#define INIT(S)                                                                                              \
    static void init_##S(void* out)                                                                          \
    {                                                                                                        \
        S##_init(out, (hair_struct_header){sizeof(S), HAIR_VERSION});                                        \
    }
#define INIT_PLAIN(S)                                                                                        \
    static void init_##S(void* out)                                                                          \
    {                                                                                                        \
        S##_init(out, sizeof(S));                                                                            \
    }
#define NONE(S)
HAIR_SCHEMAS(INIT, INIT_PLAIN, NONE)
#define ENTRY(S) init_##S,
static void (*const inits[])(void*) = {HAIR_SCHEMAS(ENTRY, ENTRY, NONE)};

static void add_members(uint64_t* hash, hair_struct kind, const void* desc)
{
    char text[512];
    hair_member members[64];
    uint32_t count = hair_describe(kind, members, 64, sizeof *members);
    HAIR_FUZZ_CHECK(count <= 64);
    for (uint32_t i = 0; i < count; ++i) {
        if (members[i].type == HAIR_MEMBER_POINTER || members[i].type == HAIR_MEMBER_TEXTURE) continue;
        // Counts without a valid default may not be set.
        hair_result result = hair_get_member(NULL, kind, desc, hair_struct_size(kind), members[i].name, text,
                                             sizeof text, NULL);
        HAIR_FUZZ_CHECK(!result || members[i].defaults[0] < members[i].min);
        if (!result) hair_fuzz_add_text(hash, text);
    }
}

HAIR_FUZZ(members)
{
    _Alignas(16) unsigned char desc[1024], again[1024], before[1024];
    char text[LENGTH];
    struct hair_fuzz_host host;
    size_t length;
    if (!size) return false;
    hair_struct kind = (hair_struct)(bytes[0] % HAIR_STRUCT_COUNT);
    size_t own = hair_struct_size(kind);
    inits[kind](desc);
    inits[kind](again);
    memcpy(before, desc, own);
    hair_fuzz_host_init(&host);
    hair_result result = hair_read_json(&host.host, kind, desc, own, (const char*)bytes + 1, size - 1);
    HAIR_FUZZ_CHECK(host.errors == (result != HAIR_OK));
    if (result) {
        HAIR_FUZZ_CHECK(!memcmp(desc, before, own));
        return false;
    }
    hair_fuzz_end_refusals();
    // All values are in range, and their text gives the same bits.
    HAIR_FUZZ_CHECK(!hair_write_json(NULL, kind, desc, own, NULL, text, LENGTH, &length));
    HAIR_FUZZ_CHECK(!hair_read_json(NULL, kind, again, own, text, length));
    HAIR_FUZZ_CHECK(!memcmp(desc, again, own));
    add_members(hash, kind, desc);
    return true;
}
