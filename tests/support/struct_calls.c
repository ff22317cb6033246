// struct_calls.c - a call for each public struct that has numbers.
#include "tests/support/struct_calls.h"

#include <string.h>

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
const struct hair_test_struct_call hair_test_struct_calls[HAIR_TEST_STRUCT_CALLS] = {
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
