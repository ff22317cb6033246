// scene_lights.c - Lights of a scene, from JSON and for shaders.
#include "tools/common/scene_lights.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define AT(member) offsetof(struct hair_scene_light, light.member)
#define FAR 1e6

static bool read_kind(const struct hair_json* json, const char* key, const json_t* value, void* out)
{
    static const char* const names[] = {"directional", "point", "spot"};
    const char* name = json_is_string(value) ? json_string_value(value) : "";
    for (int i = 0; i <= HAIR_LIGHT_SPOT; ++i)
        if (strcmp(name, names[i]) == 0) {
            ((struct hair_scene_light*)out)->light.kind = (hair_light_kind)i;
            return true;
        }
    return hair_json_wrong(json, key, "\"directional\", \"point\" or \"spot\"");
}

bool hair_scene_read_lights(const struct hair_json* json, const char* key, const json_t* value,
                            struct hair_scene_lights* out)
{
    static const struct hair_json_entry entries[] = {
        HAIR_OTHER("kind", read_kind),
        HAIR_NUMBERS("direction", AT(direction), 3, -FAR, FAR),
        HAIR_NUMBERS("position", AT(position), 3, -FAR, FAR),
        HAIR_NUMBERS("color", AT(color), 3, 0, FAR),
        HAIR_NUMBERS("range", AT(range), 1, 0, FAR),
        HAIR_NUMBERS("source_radius", AT(source_radius), 1, 0.001, 1000),
        HAIR_NUMBERS("inner_angle", AT(inner_angle), 1, 0, 1.57),
        HAIR_NUMBERS("outer_angle", AT(outer_angle), 1, 0, 1.57),
        HAIR_BOOLEAN("shadow", offsetof(struct hair_scene_light, shadow)),
        HAIR_END};
    for (int i = 0; i < HAIR_SCENE_LIGHTS - 1; ++i)
        out->at[i] = (struct hair_scene_light){.light = hair_light_default()};
    return hair_json_array(json, key, value, entries, out->at, sizeof *out->at, HAIR_SCENE_LIGHTS - 1,
                           &out->count);
}

struct hair_lit hair_lit_of(const hair_light* light)
{
    const float* t = light->direction;
    float l = sqrtf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    struct hair_lit lit = {.axis = {0, 0, 0, -1}, .more = {1, 0}};
    l = l > 1e-12f ? 1 / l : 0;
    for (int i = 0; i < 3; ++i) {
        lit.to[i] = light->kind ? light->position[i] : t[i] * l;
        lit.color[i] = light->color[i];
        if (light->kind == HAIR_LIGHT_SPOT) lit.axis[i] = t[i] * l;
    }
    lit.to[3] = light->kind ? 1 : 0;
    lit.color[3] = light->kind ? light->source_radius * light->source_radius : 1;
    if (light->kind == HAIR_LIGHT_SPOT) {
        lit.axis[3] = cosf(light->outer_angle);
        lit.more[0] = 1 / fmaxf(cosf(light->inner_angle) - lit.axis[3], 1e-6f);
    }
    if (light->kind && light->range > 0) lit.more[1] = 1 / (light->range * light->range);
    return lit;
}
