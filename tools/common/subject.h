// subject.h - The haircut of a scene, ready for an instance.
#ifndef HAIR_TOOLS_COMMON_SUBJECT_H
#define HAIR_TOOLS_COMMON_SUBJECT_H

#include "tools/common/scene.h"

// Return the exit status of a tool for a result of the library.
int hair_exit_for(hair_result result);

// Load the haircut. Return an exit status for the tool, after printing any error.
int hair_subject_load(const char* tool, const hair_host* host, const struct hair_scene* scene,
                      hair_groom** out);

#endif
