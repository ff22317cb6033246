// settings.c - Every setting of a capture that a user can set by name.
#include "tools/common/settings_keys.h"
#include "tools/common/file.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define MAX_EXAMPLE ((size_t)16 << 20) // bytes
#define COUNT(rows) (sizeof(rows) / sizeof *(rows))
#define GROUPS "groups." // beginning of the keys of groups of strands

struct hair_settings hair_settings_default(void)
{
    struct hair_settings settings = {.import = hair_import_default(),
                                     .style = hair_style_desc_default(),
                                     .groom = hair_groom_desc_default(),
                                     .physics = hair_physics_default(),
                                     .wind = hair_wind_default(),
                                     .look = hair_look_default(),
                                     .desc = hair_desc_default(),
                                     .view = hair_view_default(),
                                     .light = hair_light_default(),
                                     .lod = hair_lod_default()};
    settings.import.scale = HAIR_SCALE_GUESSED;
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        settings.groups[g] = (struct hair_group_settings){hair_physics_default(), hair_group_look_default()};
    const float inherited = HAIR_GROUP_INHERITED;
    struct hair_setting setting;
    for (size_t at = 0, size; hair_setting_next(&at, &setting);)
        if (setting.group >= 0 && setting.kind == HAIR_STRUCT_PHYSICS)
            memcpy(hair_setting_bytes(&setting, &settings, &size), &inherited, sizeof inherited);
    return settings;
}

// Settings of the tools ---------------------------------------------------------------------------

// A setting that is not one member of a struct. A preset sets several members.
struct extra {
    const char *key, *about;
    const char* (*preset)(int preset); // name of a preset. NULL for other settings.
    size_t switch_at; // offset of a truth value in hair_settings, or 0
};

static const char* physics_name(int preset)
{
    return hair_preset_name((hair_preset)preset);
}
static const char* look_name(int preset)
{
    return hair_look_name((hair_look_preset)preset);
}
static const char* color_name(int preset)
{
    return hair_color_name((hair_color)preset);
}

static const struct extra extras[] = {
    {"preset", "Kind of hair. Sets several members of hair_physics.", physics_name, 0},
    {"look", "Shape of strands. Sets strand, clump, strays and curl.", look_name, 0},
    {"color", "Colour of strands. Sets color.root, color.tip and color.spread.", color_name, 0},
    {"fit_curl", "File whose first strand is a turn of the curl, 1 mm to 10 m long.", NULL, 0},
    {"lod", "Level of detail, as the members of lod say.", NULL, offsetof(struct hair_settings, has_lod)},
    {"hide", "Occlusion culling of hair behind the head.", NULL, offsetof(struct hair_settings, hides)},
    {"every_strand", "Simulation of all strands that are drawn.", NULL,
     offsetof(struct hair_settings, simulates_all)},
};

static const struct extra* find_extra(const char* key)
{
    for (size_t i = 0; i < COUNT(extras); ++i)
        if (!strcmp(extras[i].key, key)) return &extras[i];
    return NULL;
}

// Write "one of: " and the names that an extra setting takes.
static void write_choices(const struct extra* extra, char out[256])
{
    size_t used = (size_t)snprintf(out, 256, "one of: ");
    for (int i = 0; extra->preset && extra->preset(i) && used < 256; ++i)
        used += (size_t)snprintf(out + used, 256 - used, "%s%s", i ? ", " : "", extra->preset(i));
    if (extra->switch_at) snprintf(out + used, 256 - used, "off, on");
}

static bool set_switch(bool* out, const char* value)
{
    bool is_on = !strcmp(value, "1") || !strcmp(value, "on") || !strcmp(value, "true");
    if (!is_on && strcmp(value, "0") && strcmp(value, "off") && strcmp(value, "false")) return false;
    *out = is_on;
    return true;
}

static bool set_preset(struct hair_settings* settings, const struct extra* extra, const char* value)
{
    int preset = 0;
    while (extra->preset(preset) && strcmp(extra->preset(preset), value)) ++preset;
    if (!extra->preset(preset)) return false;
    if (extra->preset == physics_name)
        return hair_physics_preset(&settings->physics, (hair_preset)preset) == HAIR_OK;
    if (extra->preset == look_name)
        return hair_look_apply_preset(&settings->look, (hair_look_preset)preset) == HAIR_OK;
    return hair_look_color(&settings->look, (hair_color)preset) == HAIR_OK;
}

// Set the curl from the first strand of a file. The whole strand is one turn.
static bool fit_curl(struct hair_settings* settings, const char* path)
{
    struct hair_bytes bytes;
    hair_asset* asset = NULL;
    hair_asset_desc desc = hair_asset_desc_default();
    hair_asset_info info = hair_asset_info_default();
    if (!hair_file_read("fit_curl", path, MAX_EXAMPLE, &bytes)) return false;
    hair_result result = hair_asset_read(&desc, bytes.data, bytes.size, &asset);
    if (!result) result = hair_asset_describe(asset, &info);
    if (!result) result = hair_look_fit_curl(&settings->look, info.positions, info.strand_vertices[0]);
    hair_asset_destroy(asset);
    free(bytes.data);
    return result == HAIR_OK;
}

static bool set_extra(const char* tool, struct hair_settings* settings, const struct extra* extra,
                      const char* value)
{
    char wanted[256] = "a file whose first strand is a turn of 1 mm to 10 m";
    bool ok = extra->preset      ? set_preset(settings, extra, value)
              : extra->switch_at ? set_switch((bool*)((char*)settings + extra->switch_at), value)
                                 : fit_curl(settings, value);
    if (ok) return true;
    if (extra->preset || extra->switch_at) write_choices(extra, wanted);
    hair_complain(tool, "%s is %s, not %s", extra->key, *value ? value : "empty", wanted);
    return false;
}

// Members of the library's structs ----------------------------------------------------------------

// First sentence that the library has logged.
static void keep_sentence(hair_log_level level, const char* sentence, void* user)
{
    char* out = user;
    (void)level;
    if (!*out) snprintf(out, 512, "%s", sentence);
}

// Copy the value that one struct has accepted to all others with the key. A struct that does not
// accept the value is refused when the library uses it.
static void spread(struct hair_settings* settings, const struct hair_setting* accepted)
{
    struct hair_setting setting;
    size_t size, own_size;
    const void* bytes = hair_setting_bytes(accepted, settings, &size);
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        void* own = hair_setting_bytes(&setting, settings, &own_size);
        if (own != bytes && !strcmp(setting.key, accepted->key) && own_size == size) memcpy(own, bytes, size);
    }
}

bool hair_settings_set(const char* tool, struct hair_settings* settings, const char* key, const char* value)
{
    const struct extra* extra = find_extra(key);
    if (extra) return set_extra(tool, settings, extra, value);
    char sentence[512] = "";
    hair_host host = {.log = keep_sentence, .user = sentence};
    struct hair_setting setting;
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        if (strcmp(setting.key, key) || !hair_setting_write(&host, &setting, settings, value)) continue;
        spread(settings, &setting);
        return true;
    }
    if (*sentence && !strncmp(key, GROUPS, strlen(GROUPS)))
        hair_complain(tool, "%s: %s", key, sentence);
    else if (*sentence)
        hair_complain(tool, "%s", sentence);
    else if (!strncmp(key, GROUPS, strlen(GROUPS)))
        hair_complain(tool, "there is no setting %s; groups are 0 to %d, and --help lists their settings",
                      key, HAIR_MAX_STRAND_GROUPS - 1);
    else
        hair_complain(tool, "there is no setting %s; --help lists them", *key ? key : "without a name");
    return false;
}

// Help --------------------------------------------------------------------------------------------

// Print the sentence of a member, its unit, and its choices or the range that the library accepts.
static void print_about(FILE* file, const hair_member* member)
{
    bool is_number = member->type == HAIR_MEMBER_FLOAT || member->type == HAIR_MEMBER_UINT;
    fprintf(file, "%s", member->about);
    if (is_number && member->max != UINT32_MAX)
        fprintf(file, " [%.10g, %.10g]%s%s.", member->min, member->max, *member->unit ? " " : "",
                member->unit);
    if (member->has_auto) fprintf(file, " 0 is automatic.");
    if (member->type == HAIR_MEMBER_BOOL) fprintf(file, " One of: off, on.");
    for (uint32_t i = 0; i < member->choice_count; ++i)
        fprintf(file, "%s%s", i ? ", " : " One of: ", member->choices[i]);
    fprintf(file, "%s\n", member->choice_count ? "." : "");
}

// Return whether an earlier setting has the key.
static bool is_repeated(const char* key, size_t end)
{
    struct hair_setting setting;
    for (size_t at = 0; at + 1 < end && hair_setting_next(&at, &setting);)
        if (!strcmp(setting.key, key)) return true;
    return false;
}

void hair_settings_print(FILE* file)
{
    const struct hair_settings settings = hair_settings_default();
    struct hair_setting setting;
    char text[256], choices[256];
    for (size_t i = 0; i < COUNT(extras); ++i) {
        const char* usual = extras[i].preset ? extras[i].preset(0) : extras[i].switch_at ? "off" : "none";
        write_choices(&extras[i], choices);
        *choices = 'O';
        fprintf(file, "  %-32s %-12s %s%s%s\n", extras[i].key, usual, extras[i].about,
                extras[i].preset || extras[i].switch_at ? " " : "",
                extras[i].preset || extras[i].switch_at ? choices : "");
    }
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        if (setting.group > 0 || is_repeated(setting.key, at)) continue;
        // One line stands for the settings of all groups.
        if (setting.group == 0) setting.key[strlen(GROUPS)] = 'N';
        hair_setting_read(&setting, &settings, text);
        if (setting.member.type == HAIR_MEMBER_BOOL)
            snprintf(text, sizeof text, "%s", strcmp(text, "true") ? "off" : "on");
        fprintf(file, "  %-32s %-12s ", setting.key, text);
        print_about(file, &setting.member);
    }
}
