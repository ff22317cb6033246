// groom_source.h - The haircut of a scene, ready for an instance.
#ifndef HAIR_TOOLS_COMMON_GROOM_SOURCE_H
#define HAIR_TOOLS_COMMON_GROOM_SOURCE_H

#include "tools/common/character.h"

// Load the haircut. A character, which may be NULL, gets its scalp. Return an exit status for the
// tool, after printing any error.
int hair_groom_source_load(const char* tool, const hair_host* host, const struct hair_scene* scene,
                           struct hair_character* character, hair_groom** out);

#endif
