// groups.h - Settings of groups of strands, applied to an instance.
#ifndef HAIR_TOOLS_COMMON_GROUPS_H
#define HAIR_TOOLS_COMMON_GROUPS_H

#include "tools/common/settings.h"

// Return false after printing an error if a group that the haircut does not have has settings.
bool hair_groups_check(const char* tool, const struct hair_settings* settings, uint32_t group_count);

// Set the physics and looks of groups that differ from those in `old`, which the instance has. NULL
// stands for the settings of a new instance.
hair_result hair_groups_apply(hair_instance* hair, const struct hair_settings* settings,
                              const struct hair_settings* old);

#endif
