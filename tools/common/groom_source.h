// groom_source.h - The haircut of a scene, ready for an instance.
#ifndef HAIR_TOOLS_COMMON_GROOM_SOURCE_H
#define HAIR_TOOLS_COMMON_GROOM_SOURCE_H

#include "tools/common/character.h"

// Return the exit status of a tool for a result of the library.
int hair_exit_for(hair_result result);

// Load the haircut. A character, which may be NULL, gets its scalp. Return an exit status for the
// tool, after printing any error.
int hair_groom_source_load(const char* tool, const hair_host* host, const struct hair_scene* scene,
                           struct hair_character* character, hair_groom** out);

#endif
