// describe_test.c - all members of all public structs are described as they are.
#include "tests/support/kinds.h"
#include "tests/support/support.h"

#include <string.h>

static hair_member members[HAIR_TEST_MEMBERS];

static void all_structs_are_described_in_order(void** state)
{
    (void)state;
    assert_int_equal(sizeof hair_test_kinds / sizeof *hair_test_kinds, HAIR_STRUCT_COUNT);
    for (int i = 0; i < HAIR_STRUCT_COUNT; ++i) {
        assert_string_equal(hair_struct_name((hair_struct)i), hair_test_kinds[i].name);
        assert_int_equal(hair_struct_size((hair_struct)i), hair_test_kinds[i].size);
    }
    static const int wrong[] = {HAIR_STRUCT_COUNT, -1, 1000000};
    for (int i = 0; i < 3; ++i) {
        assert_null(hair_struct_name((hair_struct)wrong[i]));
        assert_int_equal(hair_struct_size((hair_struct)wrong[i]), 0);
        assert_int_equal(hair_describe((hair_struct)wrong[i], members, HAIR_TEST_MEMBERS, sizeof *members),
                         0);
    }
}

static uint32_t size_of(hair_member_type type)
{
    return type == HAIR_MEMBER_BOOL      ? sizeof(bool)
           : type == HAIR_MEMBER_POINTER ? sizeof(void*)
           : type == HAIR_MEMBER_UINT64  ? sizeof(uint64_t)
                                         : 4;
}

// Check that members leave no gap but padding, so that none is missing. The results of hair_buffers
// are no members.
static void members_cover_their_struct_without_overlap(void** state)
{
    (void)state;
    for (int kind = 0; kind < HAIR_STRUCT_COUNT; ++kind) {
        uint32_t count = hair_test_describe((hair_struct)kind, members);
        size_t end = hair_test_kinds[kind].header;
        for (uint32_t i = 0; i < count; ++i) {
            const hair_member* member = &members[i];
            assert_int_equal(member->size, size_of(member->type));
            assert_int_equal(member->offset % member->size, 0);
            if (member->offset < end || member->offset - end >= member->size)
                fail_msg("%s.%s does not follow the member before", hair_test_kinds[kind].name, member->name);
            end = member->offset + (size_t)member->size * member->count;
        }
        assert_true(end <= hair_test_kinds[kind].size);
        if (kind != HAIR_STRUCT_BUFFERS) assert_true(hair_test_kinds[kind].size - end < 8);
    }
}

static void offsets_are_those_of_the_compiler(void** state)
{
    (void)state;
    static const struct {
        hair_struct kind;
        const char* name;
        size_t offset, count;
    } known[] = {{HAIR_STRUCT_LOOK, "strand.segments", offsetof(hair_look, strand.segments), 1},
                 {HAIR_STRUCT_LOOK, "curl.profile_z", offsetof(hair_look, curl.profile_z), 16},
                 {HAIR_STRUCT_PHYSICS, "gravity", offsetof(hair_physics, gravity), 3},
                 {HAIR_STRUCT_VIEW, "occluder_matrix", offsetof(hair_view, occluder_matrix), 16},
                 {HAIR_STRUCT_COLLIDER, "key", offsetof(hair_collider, key), 1},
                 {HAIR_STRUCT_GROOM_DESC, "map_sets", offsetof(hair_groom_desc, map_sets), 4}};
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
        uint32_t count = hair_test_describe(known[i].kind, members), k = 0;
        while (k < count && strcmp(members[k].name, known[i].name)) ++k;
        assert_true(k < count);
        assert_int_equal(members[k].offset, known[i].offset);
        assert_int_equal(members[k].count, known[i].count);
    }
}

static void check_texts(const hair_member* member)
{
    const char* dot = strrchr(member->name, '.');
    size_t length = dot ? (size_t)(dot - member->name) : 0, about = strlen(member->about);
    assert_int_equal(strlen(member->group), length);
    assert_memory_equal(member->group, member->name, length);
    assert_true(about > 5 && member->about[about - 1] == '.');
    assert_true((member->elements != NULL) ==
                (member->layout == HAIR_LAYOUT_VECTOR || member->layout == HAIR_LAYOUT_COLOR));
    for (uint32_t k = 0; member->elements && k < member->count; ++k) assert_non_null(member->elements[k]);
    assert_true((member->choice_count > 0) == (member->type == HAIR_MEMBER_ENUM));
    for (uint32_t k = 0; k < member->choice_count; ++k)
        for (uint32_t j = 0; j < k; ++j) assert_string_not_equal(member->choices[k], member->choices[j]);
}

static void check_slider(const hair_member* member)
{
    double low = member->slider_min, high = member->slider_max;
    bool is_inside = member->min <= low && low <= high && high <= member->max;
    bool is_log = !member->is_logarithmic || low > 0;
    bool has_default = member->type != HAIR_MEMBER_FLOAT ||
                       (low <= member->defaults[0] && member->defaults[0] <= high) || member->count > 1;
    if (!is_inside || !is_log || !has_default || (low == high && hair_test_is_text(member)))
        fail_msg("%s has the slider [%g, %g] in [%g, %g]", member->name, low, high, member->min, member->max);
    assert_true(!member->has_auto || (member->min == 0 && member->defaults[0] == HAIR_AUTO));
}

static void texts_and_sliders_are_consistent(void** state)
{
    (void)state;
    for (int kind = 0; kind < HAIR_STRUCT_COUNT; ++kind) {
        uint32_t count = hair_test_describe((hair_struct)kind, members);
        for (uint32_t i = 0; i < count; ++i) {
            check_texts(&members[i]);
            check_slider(&members[i]);
            for (uint32_t k = 0; k < i; ++k) assert_string_not_equal(members[i].name, members[k].name);
        }
    }
}

static double read_element(const void* desc, const hair_member* member, uint32_t k)
{
    const char* at = (const char*)desc + member->offset + k * member->size;
    float real;
    uint32_t whole = 0;
    memcpy(&real, at, member->size < 4 ? member->size : 4);
    memcpy(&whole, at, member->size < 4 ? member->size : 4);
    return member->type == HAIR_MEMBER_FLOAT ? (double)real : whole;
}

static void described_defaults_are_those_of_the_default_functions(void** state)
{
    (void)state;
    for (int kind = 0; kind < HAIR_STRUCT_COUNT; ++kind) {
        _Alignas(16) unsigned char desc[HAIR_TEST_STRUCT];
        hair_test_kinds[kind].init(desc);
        uint32_t count = hair_test_describe((hair_struct)kind, members);
        for (uint32_t i = 0; i < count; ++i)
            for (uint32_t k = 0; k < members[i].count; ++k) {
                double value = read_element(desc, &members[i], k);
                double said = members[i].defaults ? members[i].defaults[k] : 0;
                if (members[i].type == HAIR_MEMBER_FLOAT) said = (float)said;
                if (value != said)
                    fail_msg("%s.%s[%u] is %g", hair_test_kinds[kind].name, members[i].name, k, value);
            }
    }
}

// Members of hair_member that a caller does not know are not written, and those that the library
// does not know are 0.
static void members_are_written_by_the_stride_of_the_caller(void** state)
{
    (void)state;
    const size_t old = offsetof(hair_member, defaults), wide = sizeof(hair_member) + 16;
    unsigned char bytes[4 * sizeof(hair_member) + 64];
    memset(bytes, 0xff, sizeof bytes);
    uint32_t count = hair_describe(HAIR_STRUCT_LOD, (hair_member*)(void*)bytes, 2, old);
    assert_int_equal(count, 12);
    for (size_t i = 2 * old; i < sizeof bytes; ++i) assert_int_equal(bytes[i], 0xff);
    const char* name;
    memcpy(&name, bytes + old, sizeof name);
    assert_string_equal(name, "segment_fraction");
    memset(bytes, 0xff, sizeof bytes);
    hair_describe(HAIR_STRUCT_LOD, (hair_member*)(void*)bytes, 2, wide);
    memcpy(&name, bytes + wide, sizeof name);
    assert_string_equal(name, "segment_fraction");
    for (size_t i = sizeof(hair_member); i < wide; ++i) assert_int_equal(bytes[i], 0);
    assert_int_equal(bytes[2 * wide], 0xff);
    assert_int_equal(hair_describe(HAIR_STRUCT_LOD, NULL, 0, sizeof(hair_member)), 12);
    assert_int_equal(hair_describe(HAIR_STRUCT_LOD, members, 1, 0), 0);
    assert_int_equal(hair_describe(HAIR_STRUCT_LOD, members, 1, 5000), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_structs_are_described_in_order),
        cmocka_unit_test(members_cover_their_struct_without_overlap),
        cmocka_unit_test(offsets_are_those_of_the_compiler),
        cmocka_unit_test(texts_and_sliders_are_consistent),
        cmocka_unit_test(described_defaults_are_those_of_the_default_functions),
        cmocka_unit_test(members_are_written_by_the_stride_of_the_caller),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
