// settings_fields.h - The numbers of hair_settings and the keys by which users set them, made from
// the table of the library's public numbers.
#ifndef HAIR_TOOLS_COMMON_SETTINGS_FIELDS_H
#define HAIR_TOOLS_COMMON_SETTINGS_FIELDS_H

#include "tools/common/settings.h"

enum hair_setting_kind { HAIR_SETTING_FLOAT, HAIR_SETTING_UINT, HAIR_SETTING_BOOL, HAIR_SETTING_CURVE };

#define HAIR_SETTING_CURVE_POINTS (int)(sizeof(hair_curve) / sizeof(float))

struct hair_setting {
    char key[64];
    enum hair_setting_kind kind;
    size_t offset; // into struct hair_settings
    double min, max; // range that the library accepts
};

// Return the next setting from position *at on, or false at the end. *at starts with 0. Several
// settings have the same key if several descriptors have the same number.
bool hair_setting_next(size_t* at, struct hair_setting* out);
// Find the first setting of a key. Return false without one.
bool hair_setting_find(const char* key, struct hair_setting* out);
// Return whether the library accepts the values of all settings of a key. A key without a setting
// has none that could be refused.
bool hair_setting_is_in_range(const struct hair_settings* settings, const char* key);

#endif
