// subject.h - the haircut of a scene, made ready for an instance.
#ifndef HAIR_TOOLS_COMMON_SUBJECT_H
#define HAIR_TOOLS_COMMON_SUBJECT_H

#include "tools/common/scene.h"

// What a tool should exit with for what the library said.
int hair_exit_for(hair_result result);

// Returns what the tool should exit with, having complained.
int hair_subject_load(const char* tool, const hair_host* host, const struct hair_scene* scene,
                      hair_groom** out);

#endif
