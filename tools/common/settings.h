// settings.h - Every setting of a capture that a user can set by name. One table serves the command
// line, scene files and --help.
#ifndef HAIR_TOOLS_COMMON_SETTINGS_H
#define HAIR_TOOLS_COMMON_SETTINGS_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include <hair/hair.h>
#include <hair/hair_asset.h>

#define HAIR_SCALE_GUESSED INFINITY // value of import.scale if none is given
#define HAIR_GROUP_INHERITED INFINITY // value of a member of a group's physics if none is given

// Settings of a group of strands.
struct hair_group_settings {
    hair_physics physics; // Only members that can differ by group are used.
    hair_group_look look;
};

struct hair_settings {
    hair_import import;
    hair_style_desc style;
    hair_groom_desc groom;
    hair_physics physics;
    hair_wind wind;
    hair_look look;
    hair_desc desc;
    hair_view view;
    hair_light light; // first light of the view
    hair_lod lod;
    struct hair_group_settings groups[HAIR_MAX_STRAND_GROUPS];
    bool has_lod; // enables level of detail in views
    bool hides; // enables occlusion culling by the head, which is drawn before the hair
    bool simulates_all; // makes guides of all strands
};

struct hair_settings hair_settings_default(void);

// Set the setting `key` from text, a number or the name of a choice ("lines"). Return false after
// printing an error if the key is unknown, or if the library refuses the value.
bool hair_settings_set(const char* tool, struct hair_settings* settings, const char* key, const char* value);

// Print every key with its default, meaning, unit and range, one per line.
void hair_settings_print(FILE* file);

#endif
