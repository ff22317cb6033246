// scene_fuzz.c - fuzz target of the scene files of the tools, with their maps and settings.
#include "tests/fuzz/fuzz.h"
#include "tools/common/scene.h"
#include "tools/common/settings_keys.h"

#include <math.h>
#include <string.h>

// Parse into a scene that has been freed, or is all 0.
static bool parse(const char* text, size_t size, struct hair_scene* scene)
{
    size_t printed = hair_fuzz_printed();
    bool ok = hair_scene_parse("hair-capture", "fuzz.json", text, size, scene);
    HAIR_FUZZ_CHECK(ok || hair_fuzz_was_refused() || hair_fuzz_printed() > printed);
    if (!ok) hair_scene_free(scene);
    return ok;
}

// Check that values are finite, and add them to the hash.
static void add_floats(uint64_t* hash, const float* values, size_t count)
{
    for (size_t i = 0; i < count; ++i) HAIR_FUZZ_CHECK(isfinite(values[i]));
    hair_fuzz_add_floats(hash, values, count);
}

static void add_settings(uint64_t* hash, const struct hair_scene* scene)
{
    struct hair_settings copy = scene->settings, *settings = &copy;
    struct hair_setting setting;
    hair_fuzz_add(hash, settings->has_lod);
    hair_fuzz_add(hash, settings->hides);
    hair_fuzz_add(hash, settings->simulates_all);
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        size_t size;
        const char* value = hair_setting_bytes(&setting, settings, &size);
        float numbers[16];
        uint32_t count = 0;
        HAIR_FUZZ_CHECK(size <= sizeof numbers);
        memcpy(numbers, value, size);
        // The scale and the physics of groups may be unset. No other value is infinite.
        bool is_unset = (!strcmp(setting.key, "scale") && numbers[0] == HAIR_SCALE_GUESSED) ||
                        (setting.group >= 0 && numbers[0] == HAIR_GROUP_INHERITED);
        if (setting.member.type == HAIR_MEMBER_FLOAT) {
            if (!is_unset) add_floats(hash, numbers, size / sizeof *numbers);
        } else {
            memcpy(&count, value, size == 1 ? 1 : sizeof count);
            hair_fuzz_add(hash, size == 1 ? (unsigned char)*value : count);
        }
    }
}

static void add_keys(uint64_t* hash, const struct hair_key* keys, uint32_t count, uint32_t max)
{
    HAIR_FUZZ_CHECK(count <= max);
    for (uint32_t i = 0; i < count; ++i) {
        add_floats(hash, &keys[i].time, 1);
        add_floats(hash, keys[i].rotation, 3);
        add_floats(hash, keys[i].position, 3);
        HAIR_FUZZ_CHECK(i == 0 || keys[i].time > keys[i - 1].time);
    }
}

static void add_collider(uint64_t* hash, const struct hair_scene_collider* collider)
{
    const hair_collider* own = &collider->collider;
    HAIR_FUZZ_CHECK(own->shape <= HAIR_SHAPE_PLANE);
    hair_fuzz_add(hash, own->shape);
    add_floats(hash, own->position, 3);
    add_floats(hash, own->rotation, 4);
    add_floats(hash, own->size, 3);
    add_floats(hash, &own->rounding, 1);
    add_floats(hash, &own->friction, 1);
    add_floats(hash, collider->velocity, 3);
    add_floats(hash, collider->spin, 3);
    add_keys(hash, collider->key, collider->key_count, HAIR_SCENE_COLLIDER_KEYS);
}

static void add_table(uint64_t* hash, const struct hair_bullet_table* table)
{
    if (table->values) add_floats(hash, table->values, (size_t)table->rows * table->columns);
}

static void add_shape(uint64_t* hash, const struct hair_bullet_shape* shape)
{
    HAIR_FUZZ_CHECK(shape->axis <= 2 && shape->kind <= HAIR_BULLET_COMPOUND);
    hair_fuzz_add(hash, shape->kind);
    add_floats(hash, &shape->radius, 1);
    add_floats(hash, &shape->half_length, 1);
    add_floats(hash, shape->size, 3);
    add_floats(hash, shape->normal, 3);
    add_floats(hash, &shape->distance, 1);
    add_floats(hash, shape->scale, 3);
    add_floats(hash, &shape->margin, 1);
    add_floats(hash, &shape->spacing, 1);
    add_floats(hash, shape->position, 3);
    add_floats(hash, shape->rotation, 4);
    add_table(hash, &shape->points);
    add_table(hash, &shape->spheres);
    add_table(hash, &shape->heights);
    hair_fuzz_add(hash, shape->mesh.triangle_count);
    for (uint32_t i = 0; i < shape->child_count; ++i) add_shape(hash, &shape->children[i]);
}

static void add_map(uint64_t* hash, const struct hair_scene_map* map)
{
    HAIR_FUZZ_CHECK(map->width <= HAIR_SCENE_MAP && map->height <= HAIR_SCENE_MAP);
    add_floats(hash, map->value, (size_t)map->width * map->height);
}

static void add_maps_and_lights(uint64_t* hash, const struct hair_scene* scene)
{
    HAIR_FUZZ_CHECK(scene->maps.count <= HAIR_SCENE_SETS && scene->wind.count <= HAIR_SCENE_SOURCES);
    HAIR_FUZZ_CHECK(scene->lights.count < HAIR_SCENE_LIGHTS);
    for (uint32_t i = 0; i < scene->maps.count; ++i) {
        add_map(hash, &scene->maps.set[i].density);
        add_map(hash, &scene->maps.set[i].thickness);
    }
    HAIR_FUZZ_CHECK(scene->attributes.count <= HAIR_SCENE_ATTRIBUTES);
    for (uint32_t i = 0; i < scene->attributes.count; ++i) {
        HAIR_FUZZ_CHECK(hair_strand_attribute_name(scene->attributes.at[i].kind));
        hair_fuzz_add(hash, scene->attributes.at[i].kind);
        add_floats(hash, scene->attributes.at[i].range, 2);
        add_map(hash, &scene->attributes.at[i].map);
    }
    for (uint32_t i = 0; i < scene->lights.count; ++i) {
        const hair_light* light = &scene->lights.at[i].light;
        hair_fuzz_add(hash, light->kind);
        add_floats(hash, light->direction, 3);
        add_floats(hash, light->position, 3);
        add_floats(hash, light->color, 3);
        add_floats(hash, &light->range, 1);
        struct hair_lit lit = hair_lit_of(light);
        add_floats(&(uint64_t){0}, lit.to, 4);
        add_floats(&(uint64_t){0}, lit.axis, 4);
    }
    for (uint32_t i = 0; i < scene->wind.count; ++i) {
        add_floats(hash, scene->wind.source[i].position, 3);
        add_floats(hash, scene->wind.source[i].direction, 3);
        add_floats(hash, &scene->wind.source[i].speed, 1);
        add_floats(hash, &scene->wind.source[i].radius, 1);
    }
}

// Check that the tools get finite values of the scene: its wind, its colliders over time, and its
// maps on a scalp.
static void check_use(const struct hair_scene* scene)
{
    static const float scalp[] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
    uint64_t unused = 0;
    hair_wind wind = hair_scene_wind_of(&scene->settings, &scene->wind);
    HAIR_FUZZ_CHECK(wind.source_count == scene->wind.count);
    for (uint32_t i = 0; i < scene->collider_count; ++i) {
        hair_collider collider = hair_scene_collider_at(&scene->colliders[i], 0.5f);
        add_floats(&unused, collider.position, 3);
        add_floats(&unused, collider.rotation, 4);
    }
    hair_groom_desc desc = hair_groom_desc_default();
    hair_map_set sets[HAIR_SCENE_SETS];
    float uvs[6];
    desc.scalp_positions = scalp;
    desc.scalp_vertex_count = 3;
    hair_scene_put_maps(&scene->maps, sets, uvs, &desc);
    add_floats(&unused, uvs, 6);
    hair_strand_attribute all[HAIR_SCENE_ALL_ATTRIBUTES];
    static float values[HAIR_SCENE_ATTRIBUTES * HAIR_SCENE_MAP * HAIR_SCENE_MAP];
    hair_scene_put_attributes(&scene->attributes, all, values, &desc);
    HAIR_FUZZ_CHECK(desc.strand_attribute_count == scene->attributes.count);
    for (uint32_t i = 0; i < desc.strand_attribute_count; ++i) {
        const hair_map* map = &all[i].map;
        add_floats(&unused, map->values, (size_t)map->width * map->height);
    }
}

static void add_character(uint64_t* hash, const struct hair_scene_character* character)
{
    HAIR_FUZZ_CHECK(memchr(character->head, 0, sizeof character->head) &&
                    memchr(character->animation_name, 0, sizeof character->animation_name));
    hair_fuzz_add_text(hash, character->file);
    hair_fuzz_add_text(hash, character->animation_name);
    hair_fuzz_add_text(hash, character->head);
    hair_fuzz_add(hash, character->animation);
    hair_fuzz_add(hash, character->fit);
    hair_fuzz_add(hash, character->follow);
    add_floats(hash, &character->scale, 1);
    add_floats(hash, &character->hair_scale, 1);
    add_floats(hash, character->hair_offset, 3);
}

static uint64_t check(const struct hair_scene* scene)
{
    uint64_t hash = 0;
    hair_fuzz_add(&hash, scene->subject);
    hair_fuzz_add_text(&hash, scene->subject == HAIR_SUBJECT_FILE ? scene->groom : NULL);
    HAIR_FUZZ_CHECK(scene->fur_strands >= 1 && scene->fur_strands <= 4194304);
    HAIR_FUZZ_CHECK(scene->width - 1 < 16384 && scene->height - 1 < 16384);
    HAIR_FUZZ_CHECK(scene->frames >= 1 && scene->frames <= 1000000);
    HAIR_FUZZ_CHECK(scene->fps >= 1 && scene->fps <= 1000 && scene->settle >= 0 && scene->settle <= 60);
    HAIR_FUZZ_CHECK(scene->collider_count <= HAIR_SCENE_COLLIDERS);
    hair_fuzz_add(&hash, scene->frames);
    hair_fuzz_add(&hash, scene->width);
    hair_fuzz_add(&hash, scene->height);
    add_floats(&hash, scene->eye, 3);
    add_floats(&hash, scene->target, 3);
    add_floats(&hash, &scene->exposure, 1);
    add_floats(&hash, *scene->background, 6);
    add_keys(&hash, scene->motion.key, scene->motion.count, HAIR_MOTION_MAX_KEYS);
    for (uint32_t i = 0; i < scene->collider_count; ++i) add_collider(&hash, &scene->colliders[i]);
    for (uint32_t i = 0; i < scene->bullet.count; ++i) {
        add_shape(&hash, &scene->bullet.object[i].shape);
        add_collider(&hash, &scene->bullet.object[i].body);
    }
    add_character(&hash, &scene->character);
    add_maps_and_lights(&hash, scene);
    add_settings(&hash, scene);
    return hash;
}

// Write the JSON again by its library, and check that it is read as the same scene.
static void check_round_trip(const uint8_t* bytes, size_t size, uint64_t hash)
{
    static struct hair_scene scene;
    json_t* root = json_loadb((const char*)bytes, size, JSON_REJECT_DUPLICATES, NULL);
    char* text = json_dumps(root, JSON_COMPACT);
    HAIR_FUZZ_CHECK(root && text);
    HAIR_FUZZ_CHECK(parse(text, strlen(text), &scene) && check(&scene) == hash);
    hair_scene_free(&scene);
    free(text);
    json_decref(root);
}

HAIR_FUZZ(scene)
{
    static struct hair_scene scene;
    json_set_alloc_funcs(hair_fuzz_alloc, free);
    if (!parse((const char*)bytes, size, &scene)) return false;
    hair_fuzz_end_refusals();
    uint64_t own = check(&scene);
    check_use(&scene);
    check_round_trip(bytes, size, own);
    hair_fuzz_add(hash, (uint32_t)own);
    hair_fuzz_add(hash, (uint32_t)(own >> 32));
    hair_scene_free(&scene);
    return true;
}
