// errors_range_test.c - every number of every desc is refused outside its range, by name, and
// accepted at both ends. Structs of other versions are refused, and shorter structs accepted.
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define refused hair_test_refused

// Pass the desc to the library.
static hair_result use_hair_physics(struct hair_test_scene* user, void* desc)
{
    return hair_set_physics(user->hair, desc);
}
static hair_result use_hair_look(struct hair_test_scene* user, void* desc)
{
    return hair_set_look(user->hair, desc);
}
static hair_result use_hair_desc(struct hair_test_scene* user, void* desc)
{
    hair_instance* hair = NULL;
    hair_result result = hair_create(user->test->context, user->groom, desc, &hair);
    hair_destroy(hair);
    return result;
}
static hair_result use_hair_view(struct hair_test_scene* user, void* desc)
{
    return hair_draw(user->hair, desc);
}
static hair_result use_hair_lod(struct hair_test_scene* user, void* desc)
{
    hair_view view = hair_view_default();
    view.lod = desc;
    return hair_draw(user->hair, &view);
}
static hair_result use_hair_context_desc(struct hair_test_scene* user, void* given)
{
    hair_context_desc* desc = given;
    hair_context* context = NULL;
    desc->host = &user->test->host.host;
    desc->get_proc = hair_egl_get_proc;
    hair_result result = hair_context_create(desc, &context);
    hair_context_destroy(context);
    return result;
}
static hair_result use_hair_groom_desc(struct hair_test_scene* user, void* given)
{
    static const uint32_t vertices[1] = {2};
    hair_groom_desc* desc = given;
    hair_groom* groom = NULL;
    // The strand is 10 cm long in any unit.
    float positions[6] = {0, 0, 0, 0, desc->import ? 0.1f / desc->import->scale : 0.1f, 0};
    desc->host = &user->test->host.host;
    desc->positions = positions;
    desc->strand_vertices = vertices;
    // This field has no default.
    if (desc->strand_count == 0 && desc->header.version) desc->strand_count = 1;
    hair_result result = hair_groom_create(desc, &groom);
    hair_groom_destroy(groom);
    return result;
}
static hair_result use_hair_import(struct hair_test_scene* user, void* given)
{
    hair_groom_desc desc = hair_groom_desc_default();
    desc.import = given;
    return use_hair_groom_desc(user, &desc);
}
static hair_result use_hair_style_desc(struct hair_test_scene* user, void* given)
{
    hair_style_desc* desc = given;
    hair_asset* asset = NULL;
    desc->host = &user->test->host.host;
    hair_result result = hair_asset_generate(desc, &asset);
    hair_asset_destroy(asset);
    return result;
}

struct subject {
    const char* name;
    hair_result (*use)(struct hair_test_scene*, void*);
    void (*init)(void*);
    struct hair_schema fields;
};

#define SUBJECT(S)                                                                                           \
    static void init_##S(void* out)                                                                          \
    {                                                                                                        \
        *(S*)out = S##_default();                                                                            \
    }
SUBJECT(hair_physics)
SUBJECT(hair_look)
SUBJECT(hair_desc)
SUBJECT(hair_view)
SUBJECT(hair_lod)
SUBJECT(hair_context_desc)
SUBJECT(hair_groom_desc)
SUBJECT(hair_import)
SUBJECT(hair_style_desc)
#undef SUBJECT

#define SUBJECT(S)                                                                                           \
    {                                                                                                        \
#S, use_##S, init_##S, hair_schema_of_##S()                                                          \
    }

// Return whether the test replaces 0 by a valid value. Only strand_count is replaced.
static int is_filled_in(const char* name)
{
    return strcmp(name, "hair_groom_desc.strand_count") == 0;
}

static void write_value(unsigned char* desc, const struct hair_field* field, double value)
{
    float real = (float)value;
    uint32_t whole = field->type == HAIR_SCHEMA_FLOAT ? 0 : (uint32_t)value;
    if (field->type == HAIR_SCHEMA_BOOL)
        desc[field->offset] = (unsigned char)whole;
    else
        memcpy(desc + field->offset, field->type == HAIR_SCHEMA_FLOAT ? (void*)&real : (void*)&whole, 4);
}

static void check_field(struct hair_test_scene* user, const struct subject* subject,
                        const struct hair_field* field)
{
    _Alignas(16) unsigned char desc[1024];
    double wrong[6] = {NAN};
    int count = 0;
    if (field->type == HAIR_SCHEMA_FLOAT) {
        wrong[count++] = NAN;
        wrong[count++] = INFINITY;
        wrong[count++] = -INFINITY;
        if (field->max < 1e30) wrong[count++] = (double)nextafterf((float)field->max, INFINITY);
        if (field->min > -1e30) wrong[count++] = (double)nextafterf((float)field->min, -INFINITY);
    } else if (field->type == HAIR_SCHEMA_BOOL) {
        wrong[count++] = 2;
        wrong[count++] = 255;
    } else {
        if (field->max < UINT32_MAX) wrong[count++] = field->max + 1;
        if (field->max < UINT32_MAX) wrong[count++] = UINT32_MAX;
        if (field->min > 0 && !is_filled_in(field->name)) wrong[count++] = field->min - 1;
    }
    for (int i = 0; i < count; ++i) {
        subject->init(desc);
        write_value(desc, field, wrong[i]);
        char words[96];
        snprintf(words, sizeof words, "%s is ", field->name);
        refused(user->test, subject->use(user, desc), HAIR_ERROR_ARGUMENT, words);
    }
}

static void check_subjects(void** state, void (*check)(struct hair_test_scene*, const struct subject*))
{
    struct hair_test_scene user = hair_test_scene_of(*state, NULL, NULL);
    struct subject subjects[] = {SUBJECT(hair_physics),    SUBJECT(hair_look),   SUBJECT(hair_desc),
                                 SUBJECT(hair_view),       SUBJECT(hair_lod),    SUBJECT(hair_context_desc),
                                 SUBJECT(hair_groom_desc), SUBJECT(hair_import), SUBJECT(hair_style_desc)};
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; ++i) check(&user, &subjects[i]);
    hair_test_scene_free(&user);
}

static void check_fields(struct hair_test_scene* user, const struct subject* subject)
{
    for (uint32_t i = 0; i < subject->fields.count; ++i)
        check_field(user, subject, &subject->fields.field[i]);
}

static void numbers_outside_their_range_are_refused_by_name(void** state)
{
    check_subjects(state, check_fields);
}

// Check that the library accepts both ends of every range, and the defaults. hair_desc is left out,
// because a matrix of numbers within their ranges is no rigid motion.
static void check_ends(struct hair_test_scene* user, const struct subject* subject)
{
    struct hair_test_frame frame;
    _Alignas(16) unsigned char desc[1024];
    hair_test_frame_make(&frame, 8, 8, GL_RGBA8, 0);
    subject->init(desc);
    hair_test_ok(user->test, subject->use(user, desc));
    for (uint32_t i = 0; i < subject->fields.count; ++i) {
        const struct hair_field* field = &subject->fields.field[i];
        if (strchr(field->name, '[') && field->max > 1e30) continue;
        if (field->type == HAIR_SCHEMA_UINT && field->max > 4096)
            continue; // These fields are counts of arrays, which the desc does not have.
        for (int end = 0; end < 2; ++end) {
            subject->init(desc);
            double value = end ? field->max : field->min;
            write_value(desc, field, value);
            if (strcmp(field->name, "hair_desc.thread_mapping") == 0 &&
                value == HAIR_THREAD_MAPPING_FEEDBACK) // Only one solver has this mapping.
                ((hair_desc*)(void*)desc)->solver = HAIR_SOLVER_REDBLACK;
            hair_test_ok(user->test, subject->use(user, desc));
        }
    }
    hair_test_frame_free(&frame);
}

static void ends_of_every_range_are_accepted(void** state)
{
    check_subjects(state, check_ends);
}

static void check_made(struct hair_test_scene* user, const struct subject* subject)
{
    static const hair_struct_header wrong[] = {
        {0, 0},  {0, HAIR_VERSION},          {7, HAIR_VERSION}, {4097, HAIR_VERSION},
        {64, 0}, {64, HAIR_VERSION + 10000}, {64, 199}};
    _Alignas(16) unsigned char desc[1024];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
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
