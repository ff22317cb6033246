// kinds.c - all structs that hair_describe() describes, for tests.
#include "tests/support/kinds.h"
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/base/schema.h"

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

#define DESC(S) {#S, sizeof(S), init_##S, sizeof(hair_struct_header)},
#define PLAIN(S) {#S, sizeof(S), init_##S, 0},
const struct hair_test_kind hair_test_kinds[HAIR_STRUCT_COUNT] = {HAIR_SCHEMAS(DESC, PLAIN, NONE)};

uint32_t hair_test_describe(hair_struct kind, hair_member out[HAIR_TEST_MEMBERS])
{
    uint32_t count = hair_describe(kind, out, HAIR_TEST_MEMBERS, sizeof *out);
    assert_in_range(count, 1, HAIR_TEST_MEMBERS);
    assert_true(hair_test_kinds[kind].size <= HAIR_TEST_STRUCT);
    return count;
}

bool hair_test_is_text(const hair_member* member)
{
    return member->type != HAIR_MEMBER_POINTER && member->type != HAIR_MEMBER_TEXTURE;
}

void hair_test_vary(void* desc, const hair_member* member, uint32_t* seed)
{
    for (uint32_t k = 0; k < member->count; ++k) {
        uint32_t random = *seed = *seed * 1664525u + 1013904223u;
        double fraction = (double)(random >> 8) / (1 << 24), value;
        switch (random & 7) {
        case 0: value = member->min; break;
        case 1: value = member->max; break;
        case 2:
            value = fmin(member->max, fmax(member->min, ldexp(fraction, -(int)(random >> 3 & 127))));
            break;
        case 3: value = fmin(member->max, fmax(member->min, -0.0)); break;
        default: value = member->min * (1 - fraction) + member->max * fraction;
        }
        char* at = (char*)desc + member->offset + k * member->size;
        float real = (float)value;
        uint64_t key = (uint64_t)random << 32 | ~random;
        uint32_t whole = member->type == HAIR_MEMBER_FLOAT ? 0 : (uint32_t)fmin(value, UINT32_MAX);
        bool is_on = whole != 0;
        const void* from = member->type == HAIR_MEMBER_FLOAT    ? (const void*)&real
                           : member->type == HAIR_MEMBER_UINT64 ? (const void*)&key
                           : member->type == HAIR_MEMBER_BOOL   ? (const void*)&is_on
                                                                : (const void*)&whole;
        memcpy(at, from, member->size);
    }
}
