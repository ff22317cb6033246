// errors_range_test.c - every number of every public struct is refused outside the range that
// hair_describe() says, by name, and accepted at both ends. Structs of other versions are refused,
// and shorter structs accepted.
#include "tests/support/struct_calls.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define refused hair_test_refused

// Return whether the test replaces 0 by a valid value. Only counts of required arrays are replaced.
static bool is_filled_in(const struct hair_test_struct_call* subject, const hair_member* member)
{
    return (subject->kind == HAIR_STRUCT_GROOM_DESC && strcmp(member->name, "strand_count") == 0) ||
           ((subject->kind == HAIR_STRUCT_COLLISION_MESH_DESC || subject->kind == HAIR_STRUCT_BODY_DESC) &&
            member->min == 1);
}

static void write_value(unsigned char* desc, const hair_member* member, uint32_t i, double value)
{
    float real = (float)value;
    bool is_float = member->type == HAIR_MEMBER_FLOAT;
    uint32_t whole = is_float ? 0 : (uint32_t)value;
    unsigned char* at = desc + member->offset + i * member->size;
    if (member->type == HAIR_MEMBER_BOOL)
        *at = (unsigned char)whole;
    else
        memcpy(at, is_float ? (void*)&real : (void*)&whole, 4);
}

static int find_wrong_values(const struct hair_test_struct_call* subject, const hair_member* member,
                             double out[6])
{
    int count = 0;
    if (member->type == HAIR_MEMBER_FLOAT) {
        out[count++] = NAN;
        out[count++] = INFINITY;
        out[count++] = -INFINITY;
        if (member->max < 1e30) out[count++] = (double)nextafterf((float)member->max, INFINITY);
        if (member->min > -1e30) out[count++] = (double)nextafterf((float)member->min, -INFINITY);
    } else if (member->type == HAIR_MEMBER_BOOL) {
        out[count++] = 2;
        out[count++] = 255;
    } else if (member->type == HAIR_MEMBER_UINT || member->type == HAIR_MEMBER_ENUM) {
        if (member->max < UINT32_MAX) out[count++] = member->max + 1;
        if (member->max < UINT32_MAX) out[count++] = UINT32_MAX;
        if (member->min > 0 && !is_filled_in(subject, member)) out[count++] = member->min - 1;
    }
    return count;
}

static void check_outside(struct hair_test_scene* user, const struct hair_test_struct_call* subject,
                          const hair_member* member)
{
    _Alignas(16) unsigned char desc[1024];
    double wrong[6];
    char words[96], element[16] = "";
    int count = find_wrong_values(subject, member, wrong);
    for (uint32_t k = 0; k < member->count; ++k) {
        if (member->count > 1)
            snprintf(element, sizeof element, member->layout == HAIR_LAYOUT_CURVE ? ".at[%u]" : "[%u]", k);
        snprintf(words, sizeof words, "%s.%s%s is ", subject->name, member->name, element);
        for (int i = 0; i < count; ++i) {
            subject->init(desc);
            write_value(desc, member, k, wrong[i]);
            refused(user->test, subject->use(user, desc), HAIR_ERROR_ARGUMENT, words);
        }
    }
}

static void check_subjects(void** state,
                           void (*check)(struct hair_test_scene*, const struct hair_test_struct_call*))
{
    struct hair_test_scene user = hair_test_scene_of(*state, NULL, NULL);
    for (size_t i = 0; i < HAIR_TEST_STRUCT_CALLS; ++i) check(&user, &hair_test_struct_calls[i]);
    hair_test_scene_free(&user);
}

static uint32_t describe(const struct hair_test_struct_call* subject, hair_member members[64])
{
    uint32_t count = hair_describe(subject->kind, members, 64, sizeof *members);
    assert_in_range(count, 1, 64);
    return count;
}

static void check_members(struct hair_test_scene* user, const struct hair_test_struct_call* subject)
{
    hair_member members[64];
    uint32_t count = describe(subject, members);
    for (uint32_t i = 0; i < count; ++i) check_outside(user, subject, &members[i]);
}

static void numbers_outside_their_range_are_refused_by_name(void** state)
{
    check_subjects(state, check_members);
}

static void check_end(struct hair_test_scene* user, const struct hair_test_struct_call* subject,
                      const hair_member* member, uint32_t i, double value)
{
    _Alignas(16) unsigned char desc[1024];
    subject->init(desc);
    write_value(desc, member, i, value);
    if (subject->kind == HAIR_STRUCT_DESC && strcmp(member->name, "thread_mapping") == 0 &&
        value == HAIR_THREAD_MAPPING_FEEDBACK) // Only one solver has this mapping.
        ((hair_desc*)(void*)desc)->solver = HAIR_SOLVER_REDBLACK;
    if (subject->use(user, desc) != HAIR_OK)
        fail_msg("%s.%s = %.9g was refused", subject->name, member->name, value);
    hair_test_forgive(user->test);
}

// Check that the library accepts both ends of every range, and the defaults. Matrices are left out,
// because one of numbers within their ranges is no rigid motion.
static void check_ends(struct hair_test_scene* user, const struct hair_test_struct_call* subject)
{
    struct hair_test_frame frame;
    _Alignas(16) unsigned char desc[1024];
    hair_member members[64];
    uint32_t count = describe(subject, members);
    hair_test_frame_make(&frame, 8, 8, GL_RGBA8, 0);
    subject->init(desc);
    hair_test_ok(user->test, subject->use(user, desc));
    for (uint32_t i = 0; i < count; ++i) {
        const hair_member* member = &members[i];
        bool is_number = member->type == HAIR_MEMBER_FLOAT || member->type == HAIR_MEMBER_UINT ||
                         member->type == HAIR_MEMBER_BOOL || member->type == HAIR_MEMBER_ENUM;
        if (!is_number || (member->type == HAIR_MEMBER_FLOAT && member->max >= (double)FLT_MAX)) continue;
        if (member->type == HAIR_MEMBER_UINT && member->max > 16384)
            continue; // These are counts of arrays, which the desc does not have, or indices.
        for (uint32_t k = 0; k < member->count; ++k) {
            check_end(user, subject, member, k, member->min);
            check_end(user, subject, member, k, member->max);
        }
    }
    hair_test_frame_free(&frame);
}

static void ends_of_every_range_are_accepted(void** state)
{
    check_subjects(state, check_ends);
}

static void check_made(struct hair_test_scene* user, const struct hair_test_struct_call* subject)
{
    static const hair_struct_header wrong[] = {
        {0, 0},  {0, HAIR_VERSION},          {7, HAIR_VERSION}, {4097, HAIR_VERSION},
        {64, 0}, {64, HAIR_VERSION + 10000}, {64, 199}};
    _Alignas(16) unsigned char desc[1024];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong && subject->has_header; ++i) {
        subject->init(desc);
        memcpy(desc, &wrong[i], sizeof wrong[i]);
        // The library may not trust the host of a wrong desc, so there may be no message.
        hair_result result = subject->use(user, desc);
        if (result != HAIR_ERROR_VERSION)
            fail_msg("%s.header of (%u, %u): %s", subject->name, wrong[i].size, wrong[i].version,
                     hair_result_string(result));
        assert_in_range(hair_test_forgive(user->test), 0, 1);
    }
}

static void desc_of_another_version_or_without_header_is_refused(void** state)
{
    check_subjects(state, check_made);
}

// Check that callers compiled against an older header may pass shorter structs. Fields beyond the
// end have their defaults.
static void shorter_desc_of_an_older_caller_is_accepted(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_physics physics = hair_physics_default();
    physics.header.size = offsetof(hair_physics, collision.margin);
    physics.damping = 7;
    physics.collision.margin = NAN; // Beyond the end, so it must not be read.
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    assert_true(f.hair->sim.physics.damping == 7);
    assert_true(f.hair->sim.physics.collision.margin == hair_physics_default().collision.margin);
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(numbers_outside_their_range_are_refused_by_name),
        HAIR_TEST(ends_of_every_range_are_accepted),
        HAIR_TEST(desc_of_another_version_or_without_header_is_refused),
        HAIR_TEST(shorter_desc_of_an_older_caller_is_accepted),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
