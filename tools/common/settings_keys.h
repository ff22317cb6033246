// settings_keys.h - The keys by which users set members of the library's structs in hair_settings.
#ifndef HAIR_TOOLS_COMMON_SETTINGS_KEYS_H
#define HAIR_TOOLS_COMMON_SETTINGS_KEYS_H

#include "tools/common/settings.h"

// A member of a struct in hair_settings, or an element of a vector or colour.
struct hair_setting {
    char key[64];
    hair_struct kind;
    size_t desc; // offset of the struct in hair_settings
    hair_member member;
    uint32_t element; // 0 for a whole member
    char name[64]; // for hair_set_member()
    int group; // group of strands, or -1 for the whole haircut
};

// Return the next setting from position *at on, or false at the end. *at starts with 0. Several
// settings have the same key if several structs have the same member.
bool hair_setting_next(size_t* at, struct hair_setting* out);

// Return the bytes of a setting in `settings`, and their number in *size.
void* hair_setting_bytes(const struct hair_setting* setting, struct hair_settings* settings, size_t* size);

// Set a setting from text, which the library checks. A refusal is sent to `host`.
bool hair_setting_write(const hair_host* host, const struct hair_setting* setting,
                        struct hair_settings* settings, const char* text);

// Write the text of a setting. It is "guessed" or "inherited" for a setting without a value.
void hair_setting_read(const struct hair_setting* setting, const struct hair_settings* settings,
                       char text[256]);

// Return whether the library accepts the values of all settings of a key. A key of several structs
// may have a value that only one of them accepts.
bool hair_setting_is_in_range(const struct hair_settings* settings, const char* key);

#endif
