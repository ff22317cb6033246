// errors_test.c - every wrong argument is refused with the right code and one message that names
// it.
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/handmade.h"

#define refused hair_test_refused

static hair_instance* make(struct hair_test* test, hair_groom** groom)
{
    hair_instance* hair = NULL;
    hair_desc desc = hair_desc_default();
    *groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_ok(test, hair_create(test->context, *groom, &desc, &hair));
    return hair;
}

static void drop(hair_instance* hair, hair_groom* groom)
{
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void null_objects_are_argument_errors(void** state)
{
    (void)state;
    float transform[16] = {0}, positions[3];
    uint32_t count;
    size_t size;
    assert_int_equal(hair_context_reload(NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_create(NULL, NULL, NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_physics(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_look(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_transform(NULL, transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_physics(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_look(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_wind(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_transform(NULL, transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_colliders(NULL, NULL, 0, 0), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_step(NULL, 0.1f), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_reset(NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_teleport(NULL, transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_save(NULL, NULL, 0, &size), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_load(NULL, transform, sizeof transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_draw(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_read_positions(NULL, HAIR_READ_GUIDES, positions, 1, &count), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_solver_stats(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_field(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_timings(NULL, NULL, 0), 0);
    hair_destroy(NULL);
    hair_context_destroy(NULL);
    hair_groom_destroy(NULL);
    hair_asset_destroy(NULL);
}

static void null_arguments_are_refused_by_name(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_context* context;
    hair_instance* other;
    hair_desc desc = hair_desc_default();
    hair_context_desc of = hair_context_desc_default();
    float positions[3];
    uint32_t count;
    size_t size;
    of.host = &test->host.host;
    refused(test, hair_context_create(&of, &context), HAIR_ERROR_ARGUMENT,
            "hair_context_desc.get_proc is NULL");
    of.get_proc = hair_egl_get_proc;
    refused(test, hair_context_create(&of, NULL), HAIR_ERROR_ARGUMENT, "out is NULL");
    assert_int_equal(hair_context_create(NULL, &context), HAIR_ERROR_ARGUMENT);
    refused(test, hair_create(test->context, NULL, &desc, &other), HAIR_ERROR_ARGUMENT, "groom is NULL");
    refused(test, hair_create(test->context, groom, NULL, &other), HAIR_ERROR_ARGUMENT, "hair_desc is NULL");
    refused(test, hair_create(test->context, groom, &desc, NULL), HAIR_ERROR_ARGUMENT, "out is NULL");
    refused(test, hair_set_physics(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_physics is NULL");
    refused(test, hair_set_look(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_look is NULL");
    refused(test, hair_set_transform(hair, NULL), HAIR_ERROR_ARGUMENT, "transform is NULL");
    refused(test, hair_teleport(hair, NULL), HAIR_ERROR_ARGUMENT, "transform is NULL");
    refused(test, hair_get_physics(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_physics is NULL");
    refused(test, hair_get_look(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_look is NULL");
    refused(test, hair_get_wind(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_wind is NULL");
    refused(test, hair_get_transform(hair, NULL), HAIR_ERROR_ARGUMENT, "transform is NULL");
    refused(test, hair_set_colliders(hair, NULL, 1, sizeof(hair_collider)), HAIR_ERROR_ARGUMENT,
            "colliders is NULL");
    refused(test, hair_save(hair, positions, sizeof positions, NULL), HAIR_ERROR_ARGUMENT, "size is NULL");
    refused(test, hair_save(hair, NULL, 7, &size), HAIR_ERROR_ARGUMENT, "bytes is NULL but capacity is 7");
    refused(test, hair_load(hair, NULL, 7), HAIR_ERROR_ARGUMENT, "bytes is NULL");
    refused(test, hair_draw(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_view is NULL");
    refused(test, hair_read_positions(hair, HAIR_READ_GUIDES, positions, 1, NULL), HAIR_ERROR_ARGUMENT,
            "count is NULL");
    refused(test, hair_read_positions(hair, HAIR_READ_GUIDES, NULL, 1, &count), HAIR_ERROR_ARGUMENT,
            "positions is NULL");
    refused(test, hair_get_solver_stats(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_solver_stats is NULL");
    refused(test, hair_get_field(hair, NULL), HAIR_ERROR_ARGUMENT, "hair_field_info is NULL");
    refused(test, hair_read_positions(hair, (hair_read_source)3, positions, 1, &count), HAIR_ERROR_ARGUMENT,
            "source is 3, not in [0, 2]");
    drop(hair, groom);
}

// Every number of every desc ----------------------------------------------------------------------

struct user {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance* hair;
};

// Pass the desc to the library.
static hair_result use_hair_physics(struct user* user, void* desc)
{
    return hair_set_physics(user->hair, desc);
}
static hair_result use_hair_look(struct user* user, void* desc)
{
    return hair_set_look(user->hair, desc);
}
static hair_result use_hair_desc(struct user* user, void* desc)
{
    hair_instance* hair = NULL;
    hair_result result = hair_create(user->test->context, user->groom, desc, &hair);
    hair_destroy(hair);
    return result;
}
static hair_result use_hair_view(struct user* user, void* desc)
{
    return hair_draw(user->hair, desc);
}
static hair_result use_hair_lod(struct user* user, void* desc)
{
    hair_view view = hair_view_default();
    view.lod = desc;
    return hair_draw(user->hair, &view);
}
static hair_result use_hair_context_desc(struct user* user, void* given)
{
    hair_context_desc* desc = given;
    hair_context* context = NULL;
    desc->host = &user->test->host.host;
    desc->get_proc = hair_egl_get_proc;
    hair_result result = hair_context_create(desc, &context);
    hair_context_destroy(context);
    return result;
}
static hair_result use_hair_groom_desc(struct user* user, void* given)
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
static hair_result use_hair_import(struct user* user, void* given)
{
    hair_groom_desc desc = hair_groom_desc_default();
    desc.import = given;
    return use_hair_groom_desc(user, &desc);
}
static hair_result use_hair_style_desc(struct user* user, void* given)
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
    hair_result (*use)(struct user*, void*);
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

static void check_field(struct user* user, const struct subject* subject, const struct hair_field* field)
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

static void check_subjects(void** state, void (*check)(struct user*, const struct subject*))
{
    struct user user = {.test = *state};
    struct subject subjects[] = {SUBJECT(hair_physics),    SUBJECT(hair_look),   SUBJECT(hair_desc),
                                 SUBJECT(hair_view),       SUBJECT(hair_lod),    SUBJECT(hair_context_desc),
                                 SUBJECT(hair_groom_desc), SUBJECT(hair_import), SUBJECT(hair_style_desc)};
    user.hair = make(user.test, &user.groom);
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; ++i) check(&user, &subjects[i]);
    drop(user.hair, user.groom);
}

static void check_fields(struct user* user, const struct subject* subject)
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
static void check_ends(struct user* user, const struct subject* subject)
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

static void check_made(struct user* user, const struct subject* subject)
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
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_physics physics = hair_physics_default();
    physics.header.size = offsetof(hair_physics, collision.margin);
    physics.damping = 7;
    physics.collision.margin = NAN; // Beyond the end, so it must not be read.
    hair_test_ok(test, hair_set_physics(hair, &physics));
    assert_true(hair->sim.physics.damping == 7);
    assert_true(hair->sim.physics.collision.margin == hair_physics_default().collision.margin);
    drop(hair, groom);
}

// Transforms that are not rigid, steps, colliders -------------------------------------------------

static void transforms_that_are_not_rigid_are_refused(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_desc desc = hair_desc_default();
    for (int i = 0; i < 16; ++i) {
        float wrong[16];
        for (int kind = 0; kind < 3; ++kind) {
            // A position may be anywhere, if it is finite.
            if (kind == 0 && i >= 12 && i < 15) continue;
            memcpy(wrong, desc.transform, sizeof wrong);
            wrong[i] = kind == 0 ? wrong[i] + 0.01f : kind == 1 ? NAN : INFINITY;
            refused(test, hair_set_transform(hair, wrong), HAIR_ERROR_ARGUMENT, "not a rigid motion");
            refused(test, hair_teleport(hair, wrong), HAIR_ERROR_ARGUMENT, "not a rigid motion");
        }
    }
    desc.transform[0] = -1;
    refused(test, hair_set_transform(hair, desc.transform), HAIR_ERROR_ARGUMENT, "no mirror");
    drop(hair, groom);
}

static void step_of_negative_or_nan_time_is_refused(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    refused(test, hair_step(hair, NAN), HAIR_ERROR_ARGUMENT, "dt is ");
    refused(test, hair_step(hair, -1e-6f), HAIR_ERROR_ARGUMENT, "dt is -1e-06, not 0 or more");
    refused(test, hair_step(hair, -INFINITY), HAIR_ERROR_ARGUMENT, "dt is -inf");
    drop(hair, groom);
}

static void substep_that_is_too_short_is_refused(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_instance* other = NULL;
    hair_desc desc = hair_desc_default();
    desc.substep = 9e-6f;
    refused(test, hair_create(test->context, groom, &desc, &other), HAIR_ERROR_ARGUMENT,
            "hair_desc.substep is 9e-06, not 0 or in [1e-05, 0.1]");
    assert_null(other);
    desc.substep = 1e-5f;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &other));
    hair_destroy(other);
    drop(hair, groom);
}

static void invalid_colliders_are_named_and_change_nothing(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_collider good = {HAIR_SHAPE_CAPSULE, {0}, {0, 0, 0, 1}, {0.1f, 0.1f}, .scale = 1, .friction = 1};
    hair_collider many[2] = {good};
    hair_test_ok(test, hair_set_colliders(hair, &good, 1, sizeof good));
    refused(test, hair_set_colliders(hair, many, 1048577, sizeof good), HAIR_ERROR_ARGUMENT,
            "collider count is 1048577, not in [0, 1048576]");
    refused(test, hair_set_colliders(hair, many, 2, 8), HAIR_ERROR_ARGUMENT, "collider stride is 8");
    refused(test, hair_set_colliders(hair, many, 2, 0), HAIR_ERROR_ARGUMENT, "collider stride is 0");
    struct {
        const char* words;
        hair_collider collider;
    } wrong[] = {{"colliders[1].shape is 9", good},        {"colliders[1].position[2] is ", good},
                 {"colliders[1].rotation has norm", good}, {"colliders[1].size[0] is 0", good},
                 {"colliders[1].size[0] is ", good},       {"colliders[1].size[1] is -1", good}};
    wrong[0].collider.shape = (hair_shape)9;
    wrong[1].collider.position[2] = NAN;
    wrong[2].collider.rotation[3] = 0.5f;
    wrong[3].collider.size[0] = 0;
    wrong[4].collider.size[0] = NAN;
    wrong[5].collider.size[1] = -1;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        hair_collider two[2] = {good, wrong[i].collider};
        two[0].size[0] = 0.3f;
        refused(test, hair_set_colliders(hair, two, 2, sizeof good), HAIR_ERROR_ARGUMENT, wrong[i].words);
        assert_int_equal(hair->sim.colliders.current.count, 1);
        assert_memory_equal(&hair->sim.colliders.current.collider[0], &good, sizeof good);
    }
    drop(hair, groom);
}

static void invalid_views_are_refused(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_view view = hair_view_default();
    hair_light light[5];
    for (int i = 0; i < 5; ++i) light[i] = hair_light_default();
    view.lights = light;
    memset(light[0].direction, 0, sizeof light[0].direction);
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT, "lights[0].direction has no direction");
    light[0].kind = HAIR_LIGHT_POINT; // A point light needs no direction.
    refused(test, hair_draw(hair, &view), HAIR_ERROR_OPENGL, "framebuffer is not complete");
    light[0] = hair_light_default();
    view.light_count = 2;
    light[1].kind = HAIR_LIGHT_SPOT;
    light[1].inner_angle = light[1].outer_angle;
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT,
            "lights[1].inner_angle is 0.5, not below its outer_angle");
    light[1] = hair_light_default();
    light[1].color[2] = NAN;
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT, "hair_light.color[2] is nan");
    light[1] = (hair_light){0};
    refused(test, hair_draw(hair, &view), HAIR_ERROR_VERSION, "hair_light.header");
    view.light_count = 1;
    light[0].hair_shadow_map = 1;
    light[0].shadow_matrix[3] = 0.5f;
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT, "shadow_matrix is not orthographic");
    for (int i = 0; i < 5; ++i) {
        light[i] = hair_light_default();
        light[i].hair_shadow_map = 1;
    }
    view.light_count = 5;
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT,
            "5 of hair_view.lights have a hair_shadow_map");
    float sky[27] = {[26] = INFINITY};
    view = hair_view_default();
    view.sky = sky;
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT, "hair_view.sky[26] is inf");

    GLuint cube;
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
    view = hair_view_default();
    view.lights = light;
    light[0].hair_shadow_map = cube;
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT, "not a 2D texture");
    glDeleteTextures(1, &cube);
    refused(test, hair_draw(hair, &view), HAIR_ERROR_ARGUMENT, "not a 2D texture");
    drop(hair, groom);
}

static void a_failed_call_leaves_the_instance_as_it_was(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom;
    hair_instance* hair = make(test, &groom);
    hair_instance before = *hair;
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    physics.damping = -1, look.strand.segments = 0;
    hair_set_physics(hair, &physics);
    hair_set_look(hair, &look);
    hair_set_transform(hair, (float[16]){0});
    hair_teleport(hair, (float[16]){0});
    hair_step(hair, -1);
    hair_load(hair, &look, sizeof look);
    assert_int_equal(hair_test_forgive(test), 6);
    assert_memory_equal(hair, &before, sizeof before);
    drop(hair, groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(null_objects_are_argument_errors),
        HAIR_TEST(null_arguments_are_refused_by_name),
        HAIR_TEST(numbers_outside_their_range_are_refused_by_name),
        HAIR_TEST(ends_of_every_range_are_accepted),
        HAIR_TEST(desc_of_another_version_or_without_header_is_refused),
        HAIR_TEST(shorter_desc_of_an_older_caller_is_accepted),
        HAIR_TEST(transforms_that_are_not_rigid_are_refused),
        HAIR_TEST(step_of_negative_or_nan_time_is_refused),
        HAIR_TEST(substep_that_is_too_short_is_refused),
        HAIR_TEST(invalid_colliders_are_named_and_change_nothing),
        HAIR_TEST(invalid_views_are_refused),
        HAIR_TEST(a_failed_call_leaves_the_instance_as_it_was),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
