// scene_cuts.c - Cuts of a scene, from JSON.
#include "tools/common/scene_cuts.h"

#include <stddef.h>
#include <string.h>

#define AT(member) offsetof(struct hair_scene_cut, member)
#define FAR 1e6

const char* hair_scene_cut_shape(int shape)
{
    static const char* const names[] = {"plane", "capsule", "blade", NULL};
    return names[shape];
}

static bool read_shape(const struct hair_json* json, const char* key, const json_t* value, void* out)
{
    const char* name = json_is_string(value) ? json_string_value(value) : "";
    for (int i = 0; hair_scene_cut_shape(i); ++i)
        if (strcmp(name, hair_scene_cut_shape(i)) == 0) {
            ((struct hair_scene_cut*)out)->desc.shape = (hair_cut_shape)i;
            return true;
        }
    return hair_json_wrong(json, key, "\"plane\", \"capsule\" or \"blade\"");
}

bool hair_scene_read_cuts(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_scene_cuts* out)
{
    static const struct hair_json_entry entries[] = {
        HAIR_COUNTS("frame", AT(frame), 1, 0, 1000000),
        HAIR_OTHER("shape", read_shape),
        HAIR_NUMBERS("start", AT(desc.start), 3, -FAR, FAR),
        HAIR_NUMBERS("end", AT(desc.end), 3, -FAR, FAR),
        HAIR_NUMBERS("normal", AT(desc.normal), 3, -1, 1),
        HAIR_NUMBERS("radius", AT(desc.radius), 1, 0, FAR),
        HAIR_NUMBERS("last_start", AT(desc.last_start), 3, -FAR, FAR),
        HAIR_NUMBERS("last_end", AT(desc.last_end), 3, -FAR, FAR),
        HAIR_COUNTS("groups", AT(desc.groups), 1, 0, 255),
        HAIR_BOOLEAN("pieces", AT(pieces)),
        HAIR_END};
    for (int i = 0; i < HAIR_SCENE_CUTS; ++i)
        out->at[i] = (struct hair_scene_cut){.desc = hair_cut_desc_default(), .pieces = true};
    return hair_json_array(json, key, value, entries, out->at, sizeof *out->at, HAIR_SCENE_CUTS, &out->count);
}
