// errors_range_test.c - every number of every public struct is refused outside the range that
// hair_describe() says, by name, and accepted at both ends. Structs of other versions are refused,
// and shorter structs accepted.
#include "tests/support/scene.h"

#include <float.h>
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
    hair_strand_attribute attributes[32];
    for (int i = 0; i < 32; ++i) attributes[i] = hair_strand_attribute_default();
    if (!desc->strand_attributes && desc->header.version) desc->strand_attributes = attributes;
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

static hair_groom_desc desc_with_scalp(void)
{
    static const float scalp[9] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const uint32_t triangle[3] = {0, 2, 1};
    hair_groom_desc desc = hair_groom_desc_default();
    desc.scalp_positions = scalp;
    desc.scalp_vertex_count = 3;
    desc.scalp_triangles = triangle;
    desc.scalp_triangle_count = 1;
    return desc;
}
static const float ones[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
static hair_result use_hair_map_set(struct hair_test_scene* user, void* given)
{
    hair_map_set* set = given;
    hair_groom_desc desc = desc_with_scalp();
    set->density.values = set->thickness.values = ones;
    desc.map_sets[0] = set;
    return use_hair_groom_desc(user, &desc);
}
static hair_result use_hair_strand_attribute(struct hair_test_scene* user, void* given)
{
    hair_strand_attribute* attribute = given;
    hair_groom_desc desc = desc_with_scalp();
    attribute->map.values = ones;
    desc.strand_attributes = attribute;
    desc.strand_attribute_count = 1;
    return use_hair_groom_desc(user, &desc);
}
static hair_result make_mesh(struct hair_test_scene* user, hair_collision_mesh_desc* desc,
                             hair_collision_mesh** out)
{
    // A thin blade has few nodes at any resolution.
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 0.01f, 0};
    static const uint32_t triangle[3] = {0, 1, 2};
    desc->host = &user->test->host.host;
    desc->positions = positions;
    desc->triangles = triangle;
    // These fields have no default.
    if (desc->vertex_count == 0 && desc->header.version) desc->vertex_count = 3;
    if (desc->triangle_count == 0 && desc->header.version) desc->triangle_count = 1;
    return hair_collision_mesh_create(desc, out);
}
static hair_result use_hair_collision_mesh_desc(struct hair_test_scene* user, void* desc)
{
    hair_collision_mesh* mesh = NULL;
    hair_result result = make_mesh(user, desc, &mesh);
    hair_collision_mesh_destroy(mesh);
    return result;
}
static hair_result use_hair_body_desc(struct hair_test_scene* user, void* given)
{
    hair_body_desc* desc = given;
    static const uint32_t triangle[3] = {0, 1, 2};
    float positions[9];
    hair_body* body = NULL;
    for (int k = 0; k < 3 && desc->header.version; ++k) {
        // No box has the highest number as its lower corner, or the lowest as its upper corner.
        if (desc->lower[k] == 1e6f) desc->lower[k] = 0;
        if (desc->upper[k] == 0 || desc->upper[k] == -1e6f) desc->upper[k] = 1;
        for (int i = 0; i < 3; ++i) positions[3 * i + k] = (desc->lower[k] + desc->upper[k]) / 2;
    }
    desc->positions = positions;
    desc->triangles = triangle;
    if (desc->vertex_count == 0 && desc->header.version) desc->vertex_count = 3;
    if (desc->triangle_count == 0 && desc->header.version) desc->triangle_count = 1;
    hair_result result = hair_body_create(user->test->context, desc, &body);
    hair_body_destroy(body);
    return result;
}
static hair_result use_hair_collider(struct hair_test_scene* user, void* given)
{
    hair_collider* collider = given;
    // A sphere ignores all sizes but the first. A body without an extent needs a rounding.
    if (collider->size[1] != 0 || collider->size[2] != 0) collider->shape = HAIR_SHAPE_BOX;
    if (collider->rounding == 0) collider->rounding = 0.01f;
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    hair_collision_mesh* mesh = NULL;
    if (collider->shape == HAIR_SHAPE_MESH) assert_int_equal(make_mesh(user, &desc, &mesh), HAIR_OK);
    collider->mesh = mesh;
    hair_result result = hair_set_colliders(user->hair, collider, 1, sizeof *collider);
    hair_collision_mesh_destroy(mesh);
    return result;
}
static hair_result use_hair_pin(struct hair_test_scene* user, void* desc)
{
    return hair_set_pins(user->hair, desc, 1, sizeof(hair_pin));
}
static hair_result use_hair_target_blend(struct hair_test_scene* user, void* given)
{
    hair_target_blend* blend = given;
    float weights[2] = {1, 1};
    if (blend->guide_count == 0) return hair_set_target_blend(user->hair, blend);
    blend->guide_weights = weights;
    return hair_set_target_blend(user->hair, blend);
}
static hair_result use_hair_group_look(struct hair_test_scene* user, void* desc)
{
    return hair_set_group_look(user->hair, 0, desc);
}
static hair_result use_hair_cut_desc(struct hair_test_scene* user, void* desc)
{
    return hair_cut(user->hair, desc, NULL, NULL);
}
static hair_result use_hair_wind(struct hair_test_scene* user, void* given)
{
    hair_wind_source sources[4];
    hair_wind* wind = given;
    for (int i = 0; i < 4; ++i) sources[i] = hair_wind_source_default();
    wind->sources = sources;
    hair_result result = hair_set_wind(user->hair, wind);
    assert_int_equal(hair_set_wind(user->hair, NULL), HAIR_OK);
    return result;
}
static hair_result use_hair_wind_source(struct hair_test_scene* user, void* source)
{
    hair_wind wind = hair_wind_default();
    wind.sources = source;
    wind.source_count = 1;
    hair_result result = hair_set_wind(user->hair, &wind);
    assert_int_equal(hair_set_wind(user->hair, NULL), HAIR_OK);
    return result;
}
static hair_result use_hair_light(struct hair_test_scene* user, void* given)
{
    hair_light* light = given;
    hair_view view = hair_view_default();
    view.lights = light;
    // The cone of a spot needs an edge.
    if (light->inner_angle == 1.57f) light->kind = HAIR_LIGHT_POINT;
    if (light->outer_angle == 0) light->kind = HAIR_LIGHT_POINT;
    return hair_draw(user->hair, &view);
}
static hair_result use_hair_shader_desc(struct hair_test_scene* user, void* given)
{
    hair_shader_desc* desc = given;
    hair_shader* shader = NULL;
    desc->glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.color, 1.0); }";
    hair_result result = hair_shader_create(user->test->context, desc, &shader);
    hair_shader_destroy(shader);
    return result;
}
static hair_result use_hair_buffers(struct hair_test_scene* user, void* desc)
{
    return hair_get_buffers(user->hair, HAIR_READ_FOLLOWERS, desc);
}

// A struct, and the name of it in messages.
struct subject {
    hair_struct kind;
    const char* name;
    hair_result (*use)(struct hair_test_scene*, void*);
    void (*init)(void*);
    bool has_header;
};

#define INIT(S)                                                                                              \
    static void init_##S(void* out)                                                                          \
    {                                                                                                        \
        *(S*)out = S##_default();                                                                            \
    }
INIT(hair_import)
INIT(hair_map_set)
INIT(hair_strand_attribute)
INIT(hair_groom_desc)
INIT(hair_context_desc)
INIT(hair_desc)
INIT(hair_physics)
INIT(hair_collision_mesh_desc)
INIT(hair_body_desc)
INIT(hair_collider)
INIT(hair_pin)
INIT(hair_wind_source)
INIT(hair_wind)
INIT(hair_look)
INIT(hair_lod)
INIT(hair_shader_desc)
INIT(hair_light)
INIT(hair_view)
INIT(hair_buffers)
INIT(hair_style_desc)
INIT(hair_target_blend)
INIT(hair_group_look)
INIT(hair_cut_desc)
#define SUBJECT(KIND, S)                                                                                     \
    {                                                                                                        \
        HAIR_STRUCT_##KIND, #S, use_##S, init_##S, true                                                      \
    }
#define PLAIN(KIND, S, name)                                                                                 \
    {                                                                                                        \
        HAIR_STRUCT_##KIND, name, use_##S, init_##S, false                                                   \
    }
// All structs but hair_asset_desc, which has no numbers.
static const struct subject subjects[] = {
    SUBJECT(IMPORT, hair_import),
    {HAIR_STRUCT_MAP_SET, "hair_groom_desc.map_sets[0]", use_hair_map_set, init_hair_map_set, true},
    {HAIR_STRUCT_STRAND_ATTRIBUTE, "hair_groom_desc.strand_attributes[0]", use_hair_strand_attribute,
     init_hair_strand_attribute, true},
    SUBJECT(GROOM_DESC, hair_groom_desc),
    SUBJECT(CONTEXT_DESC, hair_context_desc),
    SUBJECT(DESC, hair_desc),
    SUBJECT(PHYSICS, hair_physics),
    SUBJECT(COLLISION_MESH_DESC, hair_collision_mesh_desc),
    SUBJECT(BODY_DESC, hair_body_desc),
    PLAIN(COLLIDER, hair_collider, "colliders[0]"),
    PLAIN(PIN, hair_pin, "pins[0]"),
    PLAIN(WIND_SOURCE, hair_wind_source, "hair_wind.sources[0]"),
    SUBJECT(WIND, hair_wind),
    SUBJECT(LOOK, hair_look),
    SUBJECT(LOD, hair_lod),
    SUBJECT(SHADER_DESC, hair_shader_desc),
    SUBJECT(LIGHT, hair_light),
    SUBJECT(VIEW, hair_view),
    SUBJECT(BUFFERS, hair_buffers),
    SUBJECT(STYLE_DESC, hair_style_desc),
    SUBJECT(TARGET_BLEND, hair_target_blend),
    SUBJECT(GROUP_LOOK, hair_group_look),
    SUBJECT(CUT_DESC, hair_cut_desc),
};
_Static_assert(sizeof subjects / sizeof *subjects == HAIR_STRUCT_COUNT - 1, "a struct is missing");

// Return whether the test replaces 0 by a valid value. Only counts of required arrays are replaced.
static bool is_filled_in(const struct subject* subject, const hair_member* member)
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

static int find_wrong_values(const struct subject* subject, const hair_member* member, double out[6])
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

static void check_outside(struct hair_test_scene* user, const struct subject* subject,
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

static void check_subjects(void** state, void (*check)(struct hair_test_scene*, const struct subject*))
{
    struct hair_test_scene user = hair_test_scene_of(*state, NULL, NULL);
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; ++i) check(&user, &subjects[i]);
    hair_test_scene_free(&user);
}

static uint32_t describe(const struct subject* subject, hair_member members[64])
{
    uint32_t count = hair_describe(subject->kind, members, 64, sizeof *members);
    assert_in_range(count, 1, 64);
    return count;
}

static void check_members(struct hair_test_scene* user, const struct subject* subject)
{
    hair_member members[64];
    uint32_t count = describe(subject, members);
    for (uint32_t i = 0; i < count; ++i) check_outside(user, subject, &members[i]);
}

static void numbers_outside_their_range_are_refused_by_name(void** state)
{
    check_subjects(state, check_members);
}

static void check_end(struct hair_test_scene* user, const struct subject* subject, const hair_member* member,
                      uint32_t i, double value)
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
static void check_ends(struct hair_test_scene* user, const struct subject* subject)
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

static void check_made(struct hair_test_scene* user, const struct subject* subject)
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
