// settings.c - Every setting of a capture that a user can set by name.
#include "tools/common/settings_texts.h"
#include "tools/common/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_EXAMPLE ((size_t)16 << 20) // bytes

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
    return settings;
}

// Write a value of 1 or 4 bytes, or a curve, to every number that has the key.
static void store(struct hair_settings* settings, const char* key, const void* value, size_t size)
{
    struct hair_setting setting;
    for (size_t at = 0; hair_setting_next(&at, &setting);)
        if (!strcmp(setting.key, key)) memcpy((char*)settings + setting.offset, value, size);
}

// Set a switch from "off" or "on", or from 0 or 1.
static bool set_switch(struct hair_settings* settings, const char* key, const char* value)
{
    bool is_on = !strcmp(value, "1") || !strcmp(value, "on");
    if (!is_on && strcmp(value, "0") && strcmp(value, "off")) return false;
    store(settings, key, &is_on, sizeof is_on);
    return true;
}

static bool set_choice(struct hair_settings* settings, const char* key, const char* choices,
                       const char* value)
{
    uint32_t choice;
    if (!hair_setting_choose(choices, value, &choice)) return false;
    store(settings, key, &choice, sizeof choice);
    return true;
}

static bool set_number(struct hair_settings* settings, const struct hair_setting* setting, const char* value)
{
    char* end;
    double wide = strtod(value, &end);
    float number = (float)wide;
    bool is_text = end == value || *end;
    if (is_text || !isfinite(number)) return false;
    if (setting->kind == HAIR_SETTING_FLOAT) {
        store(settings, setting->key, &number, sizeof number);
        return true;
    }
    if (wide < 0 || wide > UINT32_MAX || wide != floor(wide)) return false;
    uint32_t count = (uint32_t)wide;
    store(settings, setting->key, &count, sizeof count);
    return true;
}

// Parse a curve such as "0.6" or "0,1". The numbers are evenly spaced from root to tip, at most as
// many as the curve has.
static bool set_curve(struct hair_settings* settings, const char* key, const char* value)
{
    hair_curve curve;
    float number[HAIR_SETTING_CURVE_POINTS];
    int count = 0;
    for (const char* at = value;; ++at) {
        char* end;
        double wide = strtod(at, &end);
        if (end == at || count == HAIR_SETTING_CURVE_POINTS || !isfinite((float)wide)) return false;
        number[count++] = (float)wide;
        if (!*end) break;
        if (*end != ',') return false;
        at = end;
    }
    for (int i = 0; i < HAIR_SETTING_CURVE_POINTS; ++i) {
        float along = (float)(i * (count - 1)) / (HAIR_SETTING_CURVE_POINTS - 1);
        int k = (int)along < count - 1 ? (int)along : count - 1;
        int next = k + 1 < count ? k + 1 : k;
        curve.at[i] = number[k] + (along - (float)k) * (number[next] - number[k]);
    }
    store(settings, key, &curve, sizeof curve);
    return true;
}

// Set the curl from the first strand of a file. The whole strand is one turn.
static bool set_curl_like(struct hair_settings* settings, const char* path)
{
    struct hair_bytes bytes;
    hair_asset* asset = NULL;
    hair_asset_desc desc = hair_asset_desc_default();
    hair_asset_info info = hair_asset_info_default();
    if (!hair_file_read("curl_like", path, MAX_EXAMPLE, &bytes)) return false;
    hair_result result = hair_asset_read(&desc, bytes.data, bytes.size, &asset);
    if (!result) result = hair_asset_describe(asset, &info);
    if (!result) result = hair_look_fit_curl(&settings->look, info.positions, info.strand_vertices[0]);
    hair_asset_destroy(asset);
    free(bytes.data);
    return result == HAIR_OK;
}

// Set the numbers of a preset.
static bool set_preset(struct hair_settings* settings, const char* key, const char* choices,
                       const char* value)
{
    uint32_t preset;
    if (!hair_setting_choose(choices, value, &preset)) return false;
    if (!strcmp(key, "preset"))
        return hair_physics_preset(&settings->physics, (hair_preset)preset) == HAIR_OK;
    if (!strcmp(key, "look"))
        return hair_look_apply_preset(&settings->look, (hair_look_preset)preset) == HAIR_OK;
    return hair_look_color(&settings->look, (hair_color)preset) == HAIR_OK;
}

static bool set_value(struct hair_settings* settings, const struct hair_setting* setting, const char* choices,
                      const char* value)
{
    if (setting->kind == HAIR_SETTING_CURVE) return set_curve(settings, setting->key, value);
    if (setting->kind == HAIR_SETTING_BOOL) return set_switch(settings, setting->key, value);
    return choices ? set_choice(settings, setting->key, choices, value)
                   : set_number(settings, setting, value);
}

bool hair_settings_set(const char* tool, struct hair_settings* settings, const char* key, const char* value)
{
    struct hair_setting setting;
    char names[128];
    const char *choices = hair_setting_choices(key, names), *kind = "a finite number";
    bool is_number = hair_setting_find(key, &setting), is_curl = !strcmp(key, "fit_curl");
    if (!is_number && !is_curl && !choices) {
        hair_complain(tool, "there is no setting %s; --help lists them", *key ? key : "without a name");
        return false;
    }
    if (is_number ? set_value(settings, &setting, choices, value)
        : is_curl ? set_curl_like(settings, value)
                  : set_preset(settings, key, choices, value))
        return true;
    if (choices) {
        hair_complain(tool, "%s is %s, not one of: %s", key, *value ? value : "empty", choices);
        return false;
    }
    if (is_curl)
        kind = "a file whose first strand is a turn of 1 mm to 10 m";
    else if (setting.kind == HAIR_SETTING_UINT)
        kind = "a whole number";
    else if (setting.kind == HAIR_SETTING_CURVE)
        kind = "one to eight finite numbers with commas between";
    hair_complain(tool, "%s is %s, not %s", key, *value ? value : "empty", kind);
    return false;
}
