// settings_texts.h - What --help says of settings, and the names of their choices.
#ifndef HAIR_TOOLS_COMMON_SETTINGS_TEXTS_H
#define HAIR_TOOLS_COMMON_SETTINGS_TEXTS_H

#include <stdint.h>

#include "tools/common/settings_fields.h"

// Return the names of the values 0, 1, … of a setting with commas between, or NULL without names.
const char* hair_setting_choices(const char* key, char out[128]);
// Find the value of a name in a list of choices. Return false without one.
bool hair_setting_choose(const char* choices, const char* name, uint32_t* out);

#endif
