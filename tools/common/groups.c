// groups.c - Settings of groups of strands, applied to an instance.
#include "tools/common/groups.h"
#include "tools/common/file.h"
#include "tools/common/settings_keys.h"

#include <string.h>

// Return whether a setting has different values in `a` and `b`.
static bool is_different(const struct hair_setting* setting, struct hair_settings* a, struct hair_settings* b)
{
    size_t size;
    const void* bytes = hair_setting_bytes(setting, a, &size);
    return memcmp(bytes, hair_setting_bytes(setting, b, &size), size) != 0;
}

bool hair_groups_check(const char* tool, const struct hair_settings* settings, uint32_t group_count)
{
    struct hair_settings usual = hair_settings_default(), now = *settings;
    struct hair_setting setting;
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        if (setting.group < (int)group_count || !is_different(&setting, &now, &usual)) continue;
        hair_complain(tool, "%s is set, but the groups of the haircut are [0, %u]", setting.key,
                      group_count - 1);
        return false;
    }
    return true;
}

// Return whether a struct of a group has different values in `a` and `b`.
static bool group_differs(struct hair_settings* a, struct hair_settings* b, hair_struct kind, int group)
{
    struct hair_setting setting;
    for (size_t at = 0; hair_setting_next(&at, &setting);)
        if (setting.group == group && setting.kind == kind && is_different(&setting, a, b)) return true;
    return false;
}

// Set the physics of a group to those of the instance with the group's own values.
static hair_result set_physics(hair_instance* hair, struct hair_settings* settings, int group)
{
    hair_physics physics = hair_physics_default();
    hair_result result = hair_get_physics(hair, &physics);
    struct hair_setting setting;
    bool is_own = false;
    for (size_t at = 0, size; hair_setting_next(&at, &setting);) {
        float value;
        if (setting.group != group || setting.kind != HAIR_STRUCT_PHYSICS) continue;
        memcpy(&value, hair_setting_bytes(&setting, settings, &size), sizeof value);
        if (value == HAIR_GROUP_INHERITED) continue;
        memcpy((char*)&physics + setting.member.offset, &value, sizeof value);
        is_own = true;
    }
    return result ? result : hair_set_group_physics(hair, (uint32_t)group, is_own ? &physics : NULL);
}

hair_result hair_groups_apply(hair_instance* hair, const struct hair_settings* settings,
                              const struct hair_settings* old)
{
    struct hair_settings now = *settings, before = old ? *old : hair_settings_default();
    hair_result result = HAIR_OK;
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS && !result; ++g) {
        if (group_differs(&now, &before, HAIR_STRUCT_PHYSICS, g)) result = set_physics(hair, &now, g);
        if (!result && group_differs(&now, &before, HAIR_STRUCT_GROUP_LOOK, g))
            result = hair_set_group_look(hair, (uint32_t)g, &now.groups[g].look);
    }
    return result;
}
