// scene_write.c - Scenes as JSON files that hair_scene_read() reads back to equal scenes.
#define _XOPEN_SOURCE 700
#include "tools/common/scene_write.h"
#include "tools/common/builtin.h"
#include "tools/common/file.h"
#include "tools/common/settings_keys.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Return a number with the fewest digits that give the same float.
static json_t* number_of(float value)
{
    char text[32];
    for (int digits = 1; digits <= 9; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) break;
    }
    double number = strtod(text, NULL);
    bool is_whole = number == floor(number) && fabs(number) < 1e9;
    return is_whole ? json_integer((json_int_t)number) : json_real(number);
}

static json_t* numbers_of(const float* values, size_t count)
{
    if (count == 1) return number_of(*values);
    json_t* array = json_array();
    for (size_t i = 0; i < count; ++i) json_array_append_new(array, number_of(values[i]));
    return array;
}

// Add an array of floats unless it has its default.
static void put(json_t* object, const char* key, const float* values, const float* usual, size_t count)
{
    if (memcmp(values, usual, count * sizeof *values))
        json_object_set_new(object, key, numbers_of(values, count));
}

static void put_object(json_t* object, const char* key, json_t* member)
{
    if (json_object_size(member))
        json_object_set_new(object, key, member);
    else
        json_decref(member);
}

// Subject -----------------------------------------------------------------------------------------

static void put_groom(json_t* root, const struct hair_scene* scene)
{
    char* absolute = realpath(scene->groom, NULL);
    json_object_set_new(root, "groom", json_string(absolute ? absolute : scene->groom));
    free(absolute);
}

static void put_subject(json_t* root, const struct hair_scene* scene)
{
    if (scene->subject == HAIR_SUBJECT_STYLE)
        json_object_set_new(root, "style", json_string(hair_style_name(scene->settings.style.style)));
    else if (scene->subject == HAIR_SUBJECT_FILE)
        put_groom(root, scene);
    else
        json_object_set_new(root, "fur",
                            json_pack("{s:i, s:o, s:o, s:o}", "strands", (int)scene->fur_strands, "length",
                                      number_of(scene->fur_length), "comb", numbers_of(scene->fur_comb, 3),
                                      "ball", number_of(scene->ball_radius)));
    if (scene->head_is_said || scene->head != (scene->subject == HAIR_SUBJECT_STYLE))
        json_object_set_new(root, "head", json_boolean(scene->head));
}

static json_t* rows_of(const struct hair_scene_map* map, float one)
{
    json_t* rows = json_array();
    for (uint32_t y = 0; y < map->height; ++y) {
        char row[HAIR_SCENE_MAP + 1] = "";
        for (uint32_t x = 0; x < map->width; ++x)
            row[x] = (char)('0' + lroundf(map->value[y * map->width + x] * one));
        json_array_append_new(rows, json_string(row));
    }
    return rows;
}

static void put_maps(json_t* root, const struct hair_scene_maps* maps)
{
    if (!maps->count) return;
    json_t* sets = json_array();
    for (uint32_t i = 0; i < maps->count; ++i) {
        json_t* set = json_object();
        const struct hair_scene_map *density = &maps->set[i].density, *thickness = &maps->set[i].thickness;
        if (density->height) json_object_set_new(set, "density", rows_of(density, 9));
        if (thickness->height) json_object_set_new(set, "thickness", rows_of(thickness, 3));
        json_array_append_new(sets, set);
    }
    json_object_set_new(root, "maps", sets);
}

static void put_attributes(json_t* root, const struct hair_scene_attributes* attributes)
{
    if (!attributes->count) return;
    json_t* array = json_array();
    for (uint32_t i = 0; i < attributes->count; ++i) {
        const struct hair_scene_attribute* attribute = &attributes->at[i];
        json_t* object = json_object();
        json_object_set_new(object, "kind", json_string(hair_strand_attribute_name(attribute->kind)));
        json_object_set_new(object, "map", rows_of(&attribute->map, 9));
        put(object, "range", attribute->range, (const float[]){0.2f, 1}, 2);
        json_array_append_new(array, object);
    }
    json_object_set_new(root, "attributes", array);
}

// Motion, colliders, lights -----------------------------------------------------------------------

static const float nought[4];

static json_t* keys_of(const struct hair_key* keys, uint32_t count)
{
    json_t* array = json_array();
    for (uint32_t i = 0; i < count; ++i) {
        json_t* key = json_object();
        json_object_set_new(key, "time", number_of(keys[i].time));
        put(key, "rotation", keys[i].rotation, nought, 3);
        put(key, "position", keys[i].position, nought, 3);
        json_array_append_new(array, key);
    }
    return array;
}

static bool is_motion(const char* tool, const char* name, const struct hair_motion* motion)
{
    struct hair_scene* scene = calloc(1, sizeof *scene);
    bool equal = scene && hair_scene_set_motion(tool, name, scene) && scene->motion.count == motion->count &&
                 !memcmp(scene->motion.key, motion->key, motion->count * sizeof *motion->key);
    free(scene);
    return equal;
}

static void put_motion(const char* tool, json_t* root, const struct hair_motion* motion)
{
    const struct hair_builtin* builtin = hair_builtin_motions;
    while (builtin->name && !is_motion(tool, builtin->name, motion)) ++builtin;
    if (motion->count)
        json_object_set_new(root, "motion",
                            builtin->name ? json_string(builtin->name) : keys_of(motion->key, motion->count));
    json_t* pose = json_object();
    put(pose, "rotation", motion->pose.rotation, nought, 3);
    put(pose, "position", motion->pose.position, nought, 3);
    put_object(root, "pose", pose);
}

static json_t* collider_of(const struct hair_scene_collider* from)
{
    static const float size[3] = {0.1f, 0.1f, 0.1f};
    const hair_collider usual = hair_collider_default(), *collider = &from->collider;
    json_t* out = json_pack("{s:s}", "shape", hair_scene_shapes[collider->shape]);
    put(out, "position", collider->position, usual.position, 3);
    put(out, "rotation", collider->rotation, usual.rotation, 4);
    put(out, "size", collider->size, size, 3);
    put(out, "rounding", &collider->rounding, &usual.rounding, 1);
    put(out, "friction", &collider->friction, &usual.friction, 1);
    put(out, "velocity", from->velocity, nought, 3);
    put(out, "spin", from->spin, nought, 3);
    if (from->key_count) json_object_set_new(out, "motion", keys_of(from->key, from->key_count));
    if (from->stays) json_object_set_new(out, "stays", json_true());
    return out;
}

static void put_colliders(json_t* root, const struct hair_scene* scene)
{
    if (scene->collider_count) {
        json_t* array = json_array();
        for (uint32_t i = 0; i < scene->collider_count; ++i)
            json_array_append_new(array, collider_of(&scene->colliders[i]));
        json_object_set_new(root, "colliders", array);
    }
    if (scene->bullet.text) json_object_set_new(root, "bullet", json_loads(scene->bullet.text, 0, NULL));
}

static json_t* light_of(const struct hair_scene_light* from)
{
    static const char* const kinds[] = {"directional", "point", "spot"};
    const hair_light usual = hair_light_default(), *light = &from->light;
    json_t* out = json_pack("{s:s}", "kind", kinds[light->kind]);
    put(out, "direction", light->direction, usual.direction, 3);
    put(out, "position", light->position, usual.position, 3);
    put(out, "color", light->color, usual.color, 3);
    put(out, "range", &light->range, &usual.range, 1);
    put(out, "source_radius", &light->source_radius, &usual.source_radius, 1);
    put(out, "inner_angle", &light->inner_angle, &usual.inner_angle, 1);
    put(out, "outer_angle", &light->outer_angle, &usual.outer_angle, 1);
    if (from->shadow) json_object_set_new(out, "shadow", json_true());
    return out;
}

static void put_lights(json_t* root, const struct hair_scene* scene)
{
    if (!scene->shadow) json_object_set_new(root, "light", json_pack("{s:b}", "shadow", 0));
    if (!scene->lights.count) return;
    json_t* array = json_array();
    for (uint32_t i = 0; i < scene->lights.count; ++i)
        json_array_append_new(array, light_of(&scene->lights.at[i]));
    json_object_set_new(root, "lights", array);
}

static void put_cuts(json_t* root, const struct hair_scene_cuts* cuts)
{
    const hair_cut_desc usual = hair_cut_desc_default();
    json_t* array = cuts->count ? json_array() : NULL;
    for (uint32_t i = 0; i < cuts->count; ++i) {
        const hair_cut_desc* desc = &cuts->at[i].desc;
        json_t* out = json_pack("{s:i, s:s, s:b, s:i}", "frame", (int)cuts->at[i].frame, "shape",
                                hair_scene_cut_shape((int)desc->shape), "pieces", cuts->at[i].pieces,
                                "groups", (int)desc->groups);
        put(out, "start", desc->start, usual.start, 3);
        put(out, "end", desc->end, usual.end, 3);
        put(out, "normal", desc->normal, usual.normal, 3);
        put(out, "radius", &desc->radius, &usual.radius, 1);
        put(out, "last_start", desc->last_start, usual.last_start, 3);
        put(out, "last_end", desc->last_end, usual.last_end, 3);
        json_array_append_new(array, out);
    }
    if (array) json_object_set_new(root, "cuts", array);
}

static void put_wind(json_t* root, const struct hair_scene_wind* wind)
{
    if (!wind->count) return;
    json_t* sources = json_array();
    for (uint32_t i = 0; i < wind->count; ++i) {
        const hair_wind_source* from = &wind->source[i];
        json_array_append_new(sources,
                              json_pack("{s:o, s:o, s:o, s:o}", "position", numbers_of(from->position, 3),
                                        "direction", numbers_of(from->direction, 3), "speed",
                                        number_of(from->speed), "radius", number_of(from->radius)));
    }
    json_object_set_new(root, "wind", json_pack("{s:o}", "sources", sources));
}

// Picture and settings ----------------------------------------------------------------------------

static void put_picture(json_t* root, const struct hair_scene* scene, const struct hair_scene* usual)
{
    json_t* camera = json_object();
    if (scene->framed) {
        json_object_set_new(camera, "eye", numbers_of(scene->eye, 3));
        json_object_set_new(camera, "target", numbers_of(scene->target, 3));
    }
    put(camera, "fov", &scene->field_of_view, &usual->field_of_view, 1);
    put_object(root, "camera", camera);
    json_t* background = json_object();
    put(background, "centre", scene->background[0], usual->background[0], 3);
    put(background, "edge", scene->background[1], usual->background[1], 3);
    put_object(root, "background", background);
    put(root, "exposure", &scene->exposure, &usual->exposure, 1);
    put(root, "settle", &scene->settle, &usual->settle, 1);
    put(root, "fps", &scene->fps, &usual->fps, 1);
    if (scene->frames != usual->frames) json_object_set_new(root, "frames", json_integer(scene->frames));
    if (scene->picture != usual->picture) json_object_set_new(root, "picture", json_integer(scene->picture));
    if (scene->width != usual->width || scene->height != usual->height)
        json_object_set_new(root, "size", json_pack("[i, i]", (int)scene->width, (int)scene->height));
    if (scene->show == usual->show) return;
    char show[128] = "";
    size_t length = 0;
    for (int i = 0; hair_scene_part(i) && length < sizeof show; ++i)
        if (scene->show & 1u << i)
            length += (size_t)snprintf(show + length, sizeof show - length, "%s%s", length ? "," : "",
                                       hair_scene_part(i));
    json_object_set_new(root, "show", json_string(show));
}

static void put_switch(json_t* settings, const char* key, bool is_on, bool usual)
{
    if (is_on != usual) json_object_set_new(settings, key, json_string(is_on ? "on" : "off"));
}

// Add all settings that differ from those of a new scene with the same style.
static void put_settings(json_t* root, const struct hair_scene* scene, struct hair_scene* usual)
{
    json_t* settings = json_object();
    struct hair_settings values = scene->settings;
    struct hair_setting setting;
    size_t size;
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        const void* bytes = hair_setting_bytes(&setting, &values, &size);
        char text[256];
        if (!memcmp(bytes, hair_setting_bytes(&setting, &usual->settings, &size), size)) continue;
        hair_setting_read(&setting, &values, text);
        json_object_set_new(settings, setting.key, json_string(text));
    }
    put_switch(settings, "lod", values.has_lod, usual->settings.has_lod);
    put_switch(settings, "hide", values.hides, usual->settings.hides);
    put_switch(settings, "every_strand", values.simulates_all, usual->settings.simulates_all);
    put_object(root, "settings", settings);
}

static json_t* scene_of(const char* tool, const struct hair_scene* scene, struct hair_scene* usual)
{
    json_t* root = json_object();
    hair_scene_default(usual);
    if (scene->subject == HAIR_SUBJECT_STYLE &&
        !hair_scene_set_style(tool, hair_style_name(scene->settings.style.style), usual)) {
        json_decref(root);
        return NULL;
    }
    put_subject(root, scene);
    if (*scene->character.file)
        json_object_set_new(root, "character", hair_scene_write_character(&scene->character));
    put_maps(root, &scene->maps);
    put_attributes(root, &scene->attributes);
    put_motion(tool, root, &scene->motion);
    if (scene->breath > 0) json_object_set_new(root, "breath", json_real((double)scene->breath));
    if (scene->pivot_is_said) json_object_set_new(root, "pivot", numbers_of(scene->motion.pivot, 3));
    put_colliders(root, scene);
    put_lights(root, scene);
    put_cuts(root, &scene->cuts);
    put_wind(root, &scene->wind);
    put_picture(root, scene, usual);
    put_settings(root, scene, usual);
    return root;
}

bool hair_scene_write(const char* tool, const char* path, const struct hair_scene* scene)
{
    struct hair_scene* usual = malloc(sizeof *usual);
    json_t* root = usual ? scene_of(tool, scene, usual) : NULL;
    struct hair_output output;
    bool ok = root && hair_output_open(tool, path, &output);
    if (ok) {
        json_dumpf(root, output.file, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
        fputc('\n', output.file);
        ok = hair_output_commit(&output);
    }
    if (!usual) hair_complain(tool, "out of memory for the scene");
    json_decref(root);
    free(usual);
    return ok;
}
