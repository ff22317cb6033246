// settings_keys.c - The keys by which users set members of the library's structs in hair_settings,
// made from what hair_describe() says of the structs.
#include "tools/common/settings_keys.h"

#include <stddef.h>
#include <string.h>

#define COUNT(rows) (sizeof(rows) / sizeof *(rows))
#define AT(member) offsetof(struct hair_settings, member)
#define MAX_MEMBERS 64 // of a struct
#define MAX_SETTINGS 512

// Structs in hair_settings in the order of --help, and the beginning of the keys of their members.
static const struct {
    hair_struct kind;
    const char* prefix;
    size_t desc;
} owners[] = {
    {HAIR_STRUCT_IMPORT, "", AT(import)},     {HAIR_STRUCT_STYLE_DESC, "", AT(style)},
    {HAIR_STRUCT_GROOM_DESC, "", AT(groom)},  {HAIR_STRUCT_DESC, "", AT(desc)},
    {HAIR_STRUCT_PHYSICS, "", AT(physics)},   {HAIR_STRUCT_WIND, "wind.", AT(wind)},
    {HAIR_STRUCT_LOOK, "", AT(look)},         {HAIR_STRUCT_VIEW, "", AT(view)},
    {HAIR_STRUCT_LIGHT, "light.", AT(light)}, {HAIR_STRUCT_LOD, "lod.", AT(lod)},
};

// Members whose keys are not their names. NULL leaves out members that other options, scene files
// or the tools set.
static const struct {
    hair_struct kind;
    const char *member, *key;
} renamed[] = {
    {HAIR_STRUCT_IMPORT, "strand_vertices", "vertices"},
    {HAIR_STRUCT_STYLE_DESC, "strand_vertices", "vertices"},
    {HAIR_STRUCT_STYLE_DESC, "guide_count", "guides"},
    {HAIR_STRUCT_STYLE_DESC, "style", NULL},
    {HAIR_STRUCT_GROOM_DESC, "guide_count", "guides"},
    {HAIR_STRUCT_GROOM_DESC, "follower_count", "followers"},
    {HAIR_STRUCT_GROOM_DESC, "strand_count", NULL},
    {HAIR_STRUCT_GROOM_DESC, "strand_attribute_count", NULL},
    {HAIR_STRUCT_GROOM_DESC, "strand_set", NULL},
    {HAIR_STRUCT_GROOM_DESC, "scalp_vertex_count", NULL},
    {HAIR_STRUCT_GROOM_DESC, "scalp_triangle_count", NULL},
    {HAIR_STRUCT_GROOM_DESC, "color_count", NULL},
    {HAIR_STRUCT_DESC, "diagnose", NULL},
    {HAIR_STRUCT_WIND, "velocity", "wind"},
    {HAIR_STRUCT_WIND, "source_count", NULL},
    {HAIR_STRUCT_LIGHT, "direction", "light_direction"},
    {HAIR_STRUCT_LIGHT, "color", "light"},
    {HAIR_STRUCT_LIGHT, "kind", NULL},
    {HAIR_STRUCT_LIGHT, "position", NULL},
    {HAIR_STRUCT_LIGHT, "range", NULL},
    {HAIR_STRUCT_LIGHT, "source_radius", NULL},
    {HAIR_STRUCT_LIGHT, "inner_angle", NULL},
    {HAIR_STRUCT_LIGHT, "outer_angle", NULL},
    {HAIR_STRUCT_LIGHT, "opaque_bias", NULL},
    {HAIR_STRUCT_LIGHT, "shadow_depth_range", NULL},
    {HAIR_STRUCT_LIGHT, "shadow_depth_reversed", NULL},
    {HAIR_STRUCT_LIGHT, "hair_shadow_part.layer", NULL},
    {HAIR_STRUCT_LIGHT, "hair_shadow_part.offset", NULL},
    {HAIR_STRUCT_LIGHT, "hair_shadow_part.size", NULL},
    {HAIR_STRUCT_LIGHT, "opaque_shadow_part.layer", NULL},
    {HAIR_STRUCT_LIGHT, "opaque_shadow_part.offset", NULL},
    {HAIR_STRUCT_LIGHT, "opaque_shadow_part.size", NULL},
    {HAIR_STRUCT_VIEW, "pass", NULL},
    {HAIR_STRUCT_VIEW, "light_count", NULL},
    {HAIR_STRUCT_VIEW, "jitter", NULL},
    {HAIR_STRUCT_VIEW, "frame_index", NULL},
    {HAIR_STRUCT_VIEW, "motion_output", NULL},
};

// Return whether a member is a setting. Matrices and tables are none.
static bool has_key(hair_struct kind, const hair_member* member)
{
    for (size_t i = 0; i < COUNT(renamed); ++i)
        if (renamed[i].kind == kind && !strcmp(renamed[i].member, member->name) && !renamed[i].key)
            return false;
    return member->type != HAIR_MEMBER_POINTER && member->type != HAIR_MEMBER_TEXTURE &&
           member->layout != HAIR_LAYOUT_MATRIX && member->layout != HAIR_LAYOUT_ARRAY;
}

// Append the element's name to a key or a member's name.
static void write_name(char out[64], const char* prefix, const char* name, const struct hair_setting* setting)
{
    bool is_element = setting->member.elements;
    snprintf(out, 64, "%s%s%s%s", prefix, name, is_element ? "." : "",
             is_element ? setting->member.elements[setting->element] : "");
}

static void write_names(const char* prefix, struct hair_setting* setting)
{
    const char* key = setting->member.name;
    for (size_t i = 0; i < COUNT(renamed); ++i)
        if (renamed[i].kind == setting->kind && !strcmp(renamed[i].member, key)) {
            prefix = "";
            key = renamed[i].key;
            break;
        }
    write_name(setting->key, prefix, key, setting);
    write_name(setting->name, "", setting->member.name, setting);
}

// Return whether hair_set_group_physics() accepts a member of hair_physics that differs by group.
static bool can_differ_by_group(const hair_member* member)
{
    return !strcmp(member->group, "shape") || !strcmp(member->name, "fiber.youngs_modulus") ||
           !strcmp(member->name, "tip_mass") || !strcmp(member->name, "damping");
}

// Append the settings of a struct at the offset and of the group of `like`.
static size_t add_settings(const struct hair_setting* like, const char* prefix, struct hair_setting* out)
{
    hair_member members[MAX_MEMBERS];
    uint32_t count = hair_describe(like->kind, members, MAX_MEMBERS, sizeof *members);
    bool is_physics_of_group = like->group >= 0 && like->kind == HAIR_STRUCT_PHYSICS;
    size_t made = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (!has_key(like->kind, &members[i])) continue;
        if (is_physics_of_group && !can_differ_by_group(&members[i])) continue;
        uint32_t elements = members[i].elements ? members[i].count : 1;
        for (uint32_t k = 0; k < elements; ++k) {
            out[made] = *like;
            out[made].member = members[i];
            out[made].element = k;
            write_names(prefix, &out[made++]);
        }
    }
    return made;
}

static size_t make_settings(struct hair_setting out[MAX_SETTINGS])
{
    size_t made = 0;
    for (size_t i = 0; i < COUNT(owners); ++i) {
        struct hair_setting like = {.kind = owners[i].kind, .desc = owners[i].desc, .group = -1};
        made += add_settings(&like, owners[i].prefix, out + made);
    }
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) {
        char prefix[24]; // A compiler assumes that g may have any value.
        snprintf(prefix, sizeof prefix, "groups.%d.", g);
        struct hair_setting like = {.kind = HAIR_STRUCT_PHYSICS, .desc = AT(groups[g].physics), .group = g};
        made += add_settings(&like, prefix, out + made);
        like.kind = HAIR_STRUCT_GROUP_LOOK;
        like.desc = AT(groups[g].look);
        made += add_settings(&like, prefix, out + made);
    }
    return made;
}

bool hair_setting_next(size_t* at, struct hair_setting* out)
{
    static struct hair_setting settings[MAX_SETTINGS];
    static size_t count;
    if (!count) count = make_settings(settings);
    if (*at >= count) return false;
    *out = settings[(*at)++];
    return true;
}

void* hair_setting_bytes(const struct hair_setting* setting, struct hair_settings* settings, size_t* size)
{
    const hair_member* member = &setting->member;
    *size = member->size * (member->elements ? 1 : member->count);
    return (char*)settings + setting->desc + member->offset + setting->element * member->size;
}

bool hair_setting_write(const hair_host* host, const struct hair_setting* setting,
                        struct hair_settings* settings, const char* text)
{
    return hair_set_member(host, setting->kind, (char*)settings + setting->desc,
                           hair_struct_size(setting->kind), setting->name, text) == HAIR_OK;
}

void hair_setting_read(const struct hair_setting* setting, const struct hair_settings* settings,
                       char text[256])
{
    hair_result result = hair_get_member(NULL, setting->kind, (const char*)settings + setting->desc,
                                         hair_struct_size(setting->kind), setting->name, text, 256, NULL);
    // Only HAIR_SCALE_GUESSED and HAIR_GROUP_INHERITED are out of range.
    if (result) snprintf(text, 256, setting->group < 0 ? "guessed" : "inherited");
}

bool hair_setting_is_in_range(const struct hair_settings* settings, const char* key)
{
    struct hair_setting setting;
    for (size_t at = 0; hair_setting_next(&at, &setting);)
        if (!strcmp(setting.key, key) &&
            hair_get_member(NULL, setting.kind, (const char*)settings + setting.desc,
                            hair_struct_size(setting.kind), setting.name, NULL, 0, NULL))
            return false;
    return true;
}
