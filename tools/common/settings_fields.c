// settings_fields.c - The numbers of hair_settings and the keys by which users set them, made from
// the table of the library's public numbers.
#include "tools/common/settings_fields.h"
#include "lib/draw/render_path.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// A number of a public struct.
struct field {
    const char* owner; // name of the struct
    const char* member; // such as "gravity[0]" or "strand.taper.at[3]"
    enum hair_setting_kind kind;
    size_t offset; // into the struct
    double min, max;
};

static const struct field fields[] = {
    {"hair_settings", "has_lod", HAIR_SETTING_BOOL, offsetof(struct hair_settings, has_lod), 0, 1},
    {"hair_settings", "hides", HAIR_SETTING_BOOL, offsetof(struct hair_settings, hides), 0, 1},
#define BEGIN(S)
#define FIELD(S, member, type, value, min, max)                                                              \
    {#S, #member, HAIR_SETTING_##type, offsetof(S, member), min, max},
#define MATRIX(S, member)
#define END(S)
#include "lib/api/schema.inl"
#undef BEGIN
#undef FIELD
#undef MATRIX
#undef END
};

#define AT(member) offsetof(struct hair_settings, member)

// Structs in hair_settings, and the beginning of the keys of their numbers.
static const struct {
    const char *owner, *prefix;
    size_t offset;
} owners[] = {
    {"hair_settings", "", 0},           {"hair_import", "", AT(import)},
    {"hair_groom_desc", "", AT(groom)}, {"hair_style_desc", "", AT(style)},
    {"hair_physics", "", AT(physics)},  {"hair_wind", "wind.", AT(wind)},
    {"hair_look", "", AT(look)},        {"hair_desc", "", AT(desc)},
    {"hair_view", "", AT(view)},        {"hair_light", "light.", AT(light)},
    {"hair_lod", "lod.", AT(lod)},
};

// Members whose keys are not their names.
static const struct {
    const char *owner, *member, *key;
} renamed[] = {
    {"hair_settings", "has_lod", "lod"},
    {"hair_settings", "hides", "hide"},
    {"hair_import", "strand_vertices", "vertices"},
    {"hair_style_desc", "strand_vertices", "vertices"},
    {"hair_groom_desc", "guide_count", "guides"},
    {"hair_style_desc", "guide_count", "guides"},
    {"hair_groom_desc", "follower_count", "followers"},
    {"hair_wind", "velocity", "wind"},
    {"hair_light", "direction", "light_direction"},
    {"hair_light", "color", "light"},
};

// Members that users do not set as numbers, because other options, scene files or the tools do.
static const char* const excluded[][2] = {
    {"hair_groom_desc", "strand_count"},
    {"hair_groom_desc", "strand_set"},
    {"hair_groom_desc", "scalp_vertex_count"},
    {"hair_groom_desc", "scalp_triangle_count"},
    {"hair_groom_desc", "color_count"},
    {"hair_style_desc", "style"},
    {"hair_desc", "diagnose"},
    {"hair_wind", "source_count"},
    {"hair_look", "curl.profile_x"},
    {"hair_look", "curl.profile_z"},
    {"hair_light", "kind"},
    {"hair_light", "position"},
    {"hair_light", "range"},
    {"hair_light", "source_radius"},
    {"hair_light", "inner_angle"},
    {"hair_light", "outer_angle"},
    {"hair_light", "opaque_bias"},
    {"hair_view", "pass"},
    {"hair_view", "light_count"},
    {"hair_view", "jitter"},
    {"hair_view", "frame_index"},
    {"hair_view", "occluder_matrix"},
};

// Names of the components of arrays. All other arrays have x, y and z.
static const struct {
    const char *owner, *member, *name[3];
} components[] = {
    {"hair_look", "color.root", {"r", "g", "b"}},
    {"hair_look", "color.tip", {"r", "g", "b"}},
    {"hair_look", "color.streak_color", {"r", "g", "b"}},
    {"hair_look", "shading.roughness", {"along", "round"}},
    {"hair_look", "shading.specular", {"white", "tinted"}},
    {"hair_look", "shading.gloss", {"white", "tinted"}},
    {"hair_light", "color", {"r", "g", "b"}},
    {"hair_view", "ambient", {"r", "g", "b"}},
};

#define COUNT(rows) (sizeof(rows) / sizeof *(rows))

static bool is_excluded(const char* owner, const char* member)
{
    for (size_t i = 0; i < COUNT(excluded); ++i)
        if (!strcmp(excluded[i][0], owner) && !strcmp(excluded[i][1], member)) return true;
    return false;
}

static const char* component_of(const char* owner, const char* member, int index)
{
    static const char* const usual[] = {"x", "y", "z"};
    for (size_t i = 0; i < COUNT(components); ++i)
        if (!strcmp(components[i].owner, owner) && !strcmp(components[i].member, member))
            return components[i].name[index];
    return usual[index];
}

// Write the key of a member without its index.
static void write_key(size_t owner, const char* member, char* out, size_t size)
{
    for (size_t i = 0; i < COUNT(renamed); ++i)
        if (!strcmp(renamed[i].owner, owners[owner].owner) && !strcmp(renamed[i].member, member)) {
            snprintf(out, size, "%s", renamed[i].key);
            return;
        }
    snprintf(out, size, "%s%s", owners[owner].prefix, member);
}

// Make the setting of a field. Return false if the field is none, or a further point of a curve.
static bool make_setting(const struct field* field, struct hair_setting* out)
{
    char member[48];
    size_t owner = 0;
    while (owner < COUNT(owners) && strcmp(owners[owner].owner, field->owner)) ++owner;
    if (owner == COUNT(owners)) return false;
    const char *bracket = strchr(field->member, '['), *curve = strstr(field->member, ".at[");
    int index = bracket ? (int)strtol(bracket + 1, NULL, 10) : 0;
    size_t length = curve ? (size_t)(curve - field->member) : strcspn(field->member, "[");
    snprintf(member, sizeof member, "%.*s", (int)length, field->member);
    if (is_excluded(field->owner, member) || (curve && index > 0) || index > 2) return false;
    out->kind = curve ? HAIR_SETTING_CURVE : field->kind;
    out->offset = owners[owner].offset + field->offset;
    out->min = field->min;
    out->max = field->max;
    write_key(owner, member, out->key, sizeof out->key);
    if (bracket && !curve) {
        size_t used = strlen(out->key);
        snprintf(out->key + used, sizeof out->key - used, ".%s", component_of(field->owner, member, index));
    }
    return true;
}

// Return all settings, which are made at the first call, and their number in *count.
static const struct hair_setting* get_settings(size_t* count)
{
    static struct hair_setting settings[COUNT(fields)];
    static size_t made;
    static bool is_made;
    for (size_t i = 0; !is_made && i < COUNT(fields); ++i) made += make_setting(&fields[i], &settings[made]);
    is_made = true;
    *count = made;
    return settings;
}

bool hair_setting_next(size_t* at, struct hair_setting* out)
{
    size_t count;
    const struct hair_setting* settings = get_settings(&count);
    if (*at >= count) return false;
    *out = settings[(*at)++];
    return true;
}

bool hair_setting_find(const char* key, struct hair_setting* out)
{
    for (size_t at = 0; hair_setting_next(&at, out);)
        if (!strcmp(out->key, key)) return true;
    return false;
}

static bool is_float_in_range(const struct hair_setting* setting, const void* at)
{
    int count = setting->kind == HAIR_SETTING_CURVE ? HAIR_SETTING_CURVE_POINTS : 1;
    for (int i = 0; i < count; ++i) {
        float value;
        memcpy(&value, (const char*)at + (size_t)i * sizeof value, sizeof value);
        if (!(value >= (float)setting->min && value <= (float)setting->max)) return false;
    }
    return true;
}

static bool is_in_range(const struct hair_setting* setting, const void* at)
{
    uint32_t count;
    if (setting->kind == HAIR_SETTING_BOOL) return true;
    if (setting->kind != HAIR_SETTING_UINT) return is_float_in_range(setting, at);
    memcpy(&count, at, sizeof count);
    return count >= setting->min && count <= setting->max;
}

bool hair_setting_is_in_range(const struct hair_settings* settings, const char* key)
{
    struct hair_setting setting;
    for (size_t at = 0; hair_setting_next(&at, &setting);)
        if (!strcmp(setting.key, key) && !is_in_range(&setting, (const char*)settings + setting.offset))
            return false;
    return true;
}
