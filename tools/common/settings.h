// settings.h - every number of a capture that a user may set by name: one table for the command line, scene
// files and --help.
#ifndef HAIR_TOOLS_COMMON_SETTINGS_H
#define HAIR_TOOLS_COMMON_SETTINGS_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include <hair/hair.h>
#include <hair/hair_asset.h>

#define HAIR_SCALE_GUESSED INFINITY // import.scale when none was said

struct hair_settings {
    hair_import import;
    hair_style_desc style;
    hair_groom_desc groom;
    hair_physics physics;
    hair_wind wind;
    hair_look look;
    hair_desc desc;
    hair_view view;
    hair_light light; // the first of the view's
    hair_lod lod;
    uint32_t has_lod; // 1: views have it
    uint32_t hides; // 1: and the depth of the head, which is drawn before hair
};

struct hair_settings hair_settings_default(void);

// Set what `key` names from text: a number, or the name of a choice ("lines"). False: no such key, or not a
// number of its kind, and `tool` has complained. Ranges are the library's to check.
bool hair_settings_set(const char* tool, struct hair_settings* settings, const char* key, const char* value);

// Every key, one a line, with its unit and default.
void hair_settings_print(FILE* file);

#endif
