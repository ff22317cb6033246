// scene.c - Content of a capture, from JSON.
#include "tools/common/scene.h"
#include "tools/common/builtin.h"
#include "tools/common/file.h"
#include "tools/common/json.h"

#include <stdlib.h>
#include <string.h>

#define MAX_BYTES ((size_t)16 << 20)

typedef struct hair_json place;
typedef struct hair_json_entry entry;

#define AT(member) offsetof(struct hair_scene, member)

void hair_scene_default(struct hair_scene* scene)
{
    static const struct hair_scene fresh = {.subject = HAIR_SUBJECT_STYLE,
                                            .head = true,
                                            .fur_strands = 50000,
                                            .fur_length = 0.03f,
                                            .fur_comb = {0, -0.5f, 0},
                                            .ball_radius = 0.1f,
                                            .field_of_view = 27,
                                            .background = {{0.085f, 0.09f, 0.1f}, {0.018f, 0.019f, 0.022f}},
                                            .exposure = 1,
                                            .shadow = true,
                                            .motion = {.pivot = {0, 1.50f, -0.01f}},
                                            .fps = 30,
                                            .frames = 120,
                                            .width = 1280,
                                            .height = 720,
                                            .show = HAIR_SHOW_HAIR | HAIR_SHOW_HEAD};
    *scene = fresh;
    scene->settings = hair_settings_default();
    scene->character = hair_scene_character_default();
}

void hair_scene_free(struct hair_scene* scene)
{
    hair_scene_free_bullet(&scene->bullet);
}

void hair_scene_set_groom(const char* path, struct hair_scene* scene)
{
    scene->subject = HAIR_SUBJECT_FILE;
    snprintf(scene->groom, sizeof scene->groom, "%s", path);
    if (!scene->head_is_said) scene->head = false;
}

const char* hair_scene_part(int i)
{
    // In the order of enum hair_show.
    static const char* const names[] = {"hair", "head", "guides", "colliders", "wind", NULL};
    return names[i];
}

bool hair_scene_set_show(const char* text, struct hair_scene* scene)
{
    uint32_t show = 0;
    for (const char* at = text;;) {
        size_t length = strcspn(at, ",");
        int i = 0;
        while (hair_scene_part(i) &&
               (strlen(hair_scene_part(i)) != length || strncmp(hair_scene_part(i), at, length)))
            ++i;
        if (!hair_scene_part(i)) return false;
        show |= 1u << i;
        if (!at[length]) break;
        at += length + 1;
    }
    scene->show = show;
    return true;
}

static hair_style style_named(const char* name) // HAIR_STYLE_COUNT if there is none
{
    int i = 0;
    while (i < HAIR_STYLE_COUNT && strcmp(hair_style_name((hair_style)i), name)) ++i;
    return (hair_style)i;
}

static bool read_style_settings(const char* tool, const char* name, struct hair_scene* scene);

bool hair_scene_set_style(const char* tool, const char* name, struct hair_scene* scene)
{
    hair_style style = style_named(name);
    if (style == HAIR_STYLE_COUNT) {
        hair_complain(tool, "there is no style %s; --help lists them", name);
        return false;
    }
    scene->subject = HAIR_SUBJECT_STYLE;
    scene->settings.style.style = style;
    if (!scene->head_is_said) scene->head = !*scene->character.file;
    return read_style_settings(tool, name, scene);
}

// Subject -----------------------------------------------------------------------------------------

static bool read_groom(const place* json, const char* key, const json_t* value, void* out)
{
    char path[HAIR_SCENE_PATH];
    if (!hair_json_path(json, key, value, path, sizeof path)) return false;
    hair_scene_set_groom(path, out);
    return true;
}

static bool read_style(const place* json, const char* key, const json_t* value, void* out)
{
    const char* name = json_string_value(value);
    return name ? hair_scene_set_style(json->tool, name, out)
                : hair_json_wrong(json, key, "the name of a style");
}

static bool read_fur(const place* json, const char* key, const json_t* value, void* out)
{
    static const entry entries[] = {HAIR_COUNTS("strands", AT(fur_strands), 1, 1, 4194304),
                                    HAIR_NUMBERS("length", AT(fur_length), 1, 1e-4, 10),
                                    HAIR_NUMBERS("comb", AT(fur_comb), 3, -10, 10),
                                    HAIR_NUMBERS("ball", AT(ball_radius), 1, 1e-3, 100), HAIR_END};
    struct hair_scene* scene = out;
    scene->subject = HAIR_SUBJECT_FUR;
    return hair_json_object(json, key, value, entries, out);
}

static bool read_colliders(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene* scene = out;
    return hair_scene_read_colliders(json, key, value, scene->colliders, HAIR_SCENE_COLLIDERS,
                                     &scene->collider_count);
}

static bool read_maps(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene* scene = out;
    return hair_scene_read_maps(json, key, value, &scene->maps);
}

static bool read_attributes(const place* json, const char* key, const json_t* value, void* out)
{
    return hair_scene_read_attributes(json, key, value, &((struct hair_scene*)out)->attributes);
}

static bool read_lights(const place* json, const char* key, const json_t* value, void* out)
{
    return hair_scene_read_lights(json, key, value, &((struct hair_scene*)out)->lights);
}

static bool read_wind(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene* scene = out;
    return hair_scene_read_wind(json, key, value, &scene->settings, &scene->wind);
}

static bool read_cuts(const place* json, const char* key, const json_t* value, void* out)
{
    return hair_scene_read_cuts(json, key, value, &((struct hair_scene*)out)->cuts);
}

static bool read_character(const place* json, const char* key, const json_t* value, void* out)
{
    return hair_scene_read_character(json, key, value, &((struct hair_scene*)out)->character);
}

static bool read_bullet(const place* json, const char* key, const json_t* value, void* out)
{
    return hair_scene_read_bullet(json, key, value, &((struct hair_scene*)out)->bullet);
}

static bool read_show(const place* json, const char* key, const json_t* value, void* out)
{
    const char* text = json_string_value(value);
    // An empty text draws the background only.
    if (text && !*text) ((struct hair_scene*)out)->show = 0;
    return text && (!*text || hair_scene_set_show(text, out)) ? true
                                                              : hair_json_wrong(json, key, HAIR_SCENE_SHOWN);
}

// Motion, camera, settings ------------------------------------------------------------------------

static bool read_motion(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene* scene = out;
    struct hair_motion* motion = &scene->motion;
    if (json_is_string(value)) return hair_scene_set_motion(json->tool, json_string_value(value), scene);
    memset(motion->key, 0, sizeof motion->key);
    return hair_scene_read_keys(json, key, value, motion->key, HAIR_MOTION_MAX_KEYS, &motion->count);
}

static bool read_camera(const place* json, const char* key, const json_t* value, void* out)
{
    static const entry entries[] = {HAIR_NUMBERS("eye", AT(eye), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
                                    HAIR_NUMBERS("target", AT(target), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
                                    HAIR_NUMBERS("fov", AT(field_of_view), 1, 1, 150), HAIR_END};
    struct hair_scene* scene = out;
    if (!hair_json_object(json, key, value, entries, out)) return false;
    bool eye = json_object_get(value, "eye"), target = json_object_get(value, "target");
    if (eye != target) return hair_json_wrong(json, key, "given with both eye and target, or neither");
    scene->framed = eye;
    if (!eye || memcmp(scene->eye, scene->target, sizeof scene->eye)) return true;
    return hair_json_wrong(json, key, "given with an eye that is not its target");
}

// Apply all settings. Numbers and strings become the text that --set takes.
static bool read_settings(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene* scene = out;
    const char* name;
    json_t* member;
    if (!json_is_object(value)) return hair_json_wrong(json, key, "an object");
    json_object_foreach((json_t*)(uintptr_t)value, name, member)
    {
        if (!hair_scene_set(json, "", name, member, &scene->settings)) return false;
    }
    return true;
}

// Whole scenes ------------------------------------------------------------------------------------

static const entry light[] = {
    HAIR_NUMBERS("direction", AT(settings.light.direction), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
    HAIR_NUMBERS("color", AT(settings.light.color), 3, 0, HAIR_SCENE_FAR),
    HAIR_NUMBERS("ambient", AT(settings.view.ambient), 3, 0, HAIR_SCENE_FAR),
    HAIR_BOOLEAN("shadow", AT(shadow)), HAIR_END};
static const entry pose[] = {
    HAIR_NUMBERS("rotation", AT(motion.pose.rotation), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
    HAIR_NUMBERS("position", AT(motion.pose.position), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR), HAIR_END};
static const entry background[] = {HAIR_NUMBERS("centre", AT(background[0]), 3, 0, 100),
                                   HAIR_NUMBERS("edge", AT(background[1]), 3, 0, 100), HAIR_END};
static const entry whole[] = {HAIR_OTHER("style", read_style),
                              HAIR_OTHER("groom", read_groom),
                              HAIR_OTHER("fur", read_fur),
                              HAIR_BOOLEAN("head", AT(head)),
                              HAIR_OTHER("character", read_character),
                              HAIR_OTHER("colliders", read_colliders),
                              HAIR_OTHER("bullet", read_bullet),
                              HAIR_OTHER("cuts", read_cuts),
                              HAIR_OTHER("maps", read_maps),
                              HAIR_OTHER("attributes", read_attributes),
                              HAIR_OTHER("motion", read_motion),
                              HAIR_NUMBERS("pivot", AT(motion.pivot), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
                              HAIR_OBJECT("pose", pose),
                              HAIR_NUMBERS("breath", AT(breath), 1, 0, 0.02),
                              HAIR_OTHER("camera", read_camera),
                              HAIR_OBJECT("light", light),
                              HAIR_OTHER("lights", read_lights),
                              HAIR_OTHER("wind", read_wind),
                              HAIR_OBJECT("background", background),
                              HAIR_NUMBERS("exposure", AT(exposure), 1, 1e-3, 1e3),
                              HAIR_NUMBERS("settle", AT(settle), 1, 0, 60),
                              HAIR_NUMBERS("fps", AT(fps), 1, 1, 1000),
                              HAIR_COUNTS("frames", AT(frames), 1, 1, 1000000),
                              HAIR_COUNTS("picture", AT(picture), 1, 0, 999999),
                              HAIR_COUNTS("size", AT(width), 2, 1, 16384),
                              HAIR_OTHER("show", read_show),
                              HAIR_OTHER("settings", read_settings),
                              HAIR_END};

static json_t* load(const char* tool, const char* path, const char* text, size_t size)
{
    json_error_t error;
    json_t* root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (!root) hair_complain(tool, "%s: line %d, column %d: %s", path, error.line, error.column, error.text);
    return root;
}

// A character replaces the built-in head and moves by its own animation.
static bool check_character(const struct hair_json* json, const json_t* root, const struct hair_scene* scene)
{
    if (!*scene->character.file) return true;
    if (scene->head) return hair_json_wrong(json, "head", "false or left out beside a character");
    if (scene->subject == HAIR_SUBJECT_FUR)
        return hair_json_wrong(json, "fur", "left out beside a character");
    const char* moves = json_object_get(root, "pose")     ? "pose"
                        : json_object_get(root, "motion") ? "motion"
                                                          : NULL;
    return !moves ||
           hair_json_wrong(json, moves, "left out beside a character, which moves by its animation");
}

static bool read_scene(const char* tool, const char* path, const json_t* root, struct hair_scene* scene)
{
    hair_scene_default(scene);
    struct hair_json json = {tool, path, ""};
    if (!hair_json_object(&json, "", root, whole, scene)) return false;
    uint32_t shadows = scene->shadow;
    for (uint32_t i = 0; i < scene->lights.count; ++i) shadows += scene->lights.at[i].shadow;
    if (shadows > HAIR_SCENE_SHADOWS)
        return hair_json_wrong(&json, "lights",
                               "given with at most 4 lights, the first among them, that have a shadow");
    scene->head_is_said = json_object_get(root, "head");
    scene->pivot_is_said = json_object_get(root, "pivot");
    if (!scene->head_is_said) scene->head = scene->subject == HAIR_SUBJECT_STYLE && !*scene->character.file;
    return check_character(&json, root, scene);
}

bool hair_scene_parse(const char* tool, const char* path, const char* text, size_t size,
                      struct hair_scene* scene)
{
    json_t* root = load(tool, path, text, size);
    bool ok = root && read_scene(tool, path, root, scene);
    json_decref(root);
    return ok;
}

bool hair_scene_read(const char* tool, const char* path, struct hair_scene* scene)
{
    struct hair_bytes bytes;
    if (!hair_file_read(tool, path, MAX_BYTES, &bytes)) return false;
    bool ok = hair_scene_parse(tool, path, (const char*)bytes.data, bytes.size, scene);
    free(bytes.data);
    return ok;
}

// Built-in scenes ---------------------------------------------------------------------------------

static const char* text_of(const struct hair_builtin* builtin, const char* name)
{
    while (builtin->name && strcmp(builtin->name, name)) ++builtin;
    return builtin->text;
}

// Parse a text whose quotes are written as '.
static json_t* load_builtin(const char* tool, const char* name, const char* text)
{
    char quoted[2048];
    size_t size = 0;
    for (; size < sizeof quoted && text[size]; ++size) quoted[size] = text[size];
    for (size_t i = 0; i < size; ++i)
        if (quoted[i] == '\'') quoted[i] = '"';
    return load(tool, name, quoted, size);
}

// Read a built-in text into the scene with the reader of its key in scene files.
static bool read_builtin(const char* tool, const char* name, const char* text, const char* key,
                         bool (*read)(const place*, const char*, const json_t*, void*),
                         struct hair_scene* scene)
{
    json_t* value = load_builtin(tool, name, text);
    if (!value) return false;
    struct hair_json json = {tool, name, ""};
    bool ok = read(&json, key, value, scene);
    json_decref(value);
    return ok;
}

static bool read_style_settings(const char* tool, const char* name, struct hair_scene* scene)
{
    return read_builtin(tool, name, text_of(hair_builtin_styles, name), "settings", read_settings, scene);
}

bool hair_scene_set_motion(const char* tool, const char* name, struct hair_scene* scene)
{
    const char* text = text_of(hair_builtin_motions, name);
    if (!text) hair_complain(tool, "there is no motion %s; --help lists them", name);
    return text && read_builtin(tool, name, text, "motion", read_motion, scene);
}

// Load a built-in scene or style. A style is shown in the first built-in scene.
bool hair_scene_named(const char* tool, const char* name, struct hair_scene* scene)
{
    const char* text = text_of(hair_builtin_scenes, name);
    bool style = !text && style_named(name) != HAIR_STYLE_COUNT;
    if (style) text = hair_builtin_scenes[0].text;
    if (!text) {
        hair_complain(tool, "there is no scene %s; --help lists them", name);
        return false;
    }
    json_t* root = load_builtin(tool, name, text);
    if (!root) return false;
    bool ok = read_scene(tool, name, root, scene);
    json_decref(root);
    return ok && (!style || hair_scene_set_style(tool, name, scene));
}

void hair_scene_print_names(FILE* file)
{
    fprintf(file, "Scenes:");
    for (const struct hair_builtin* scene = hair_builtin_scenes; scene->name; ++scene)
        fprintf(file, " %s", scene->name);
    fprintf(file, "\nStyles, each a scene as well:");
    for (int i = 0; i < HAIR_STYLE_COUNT; ++i) fprintf(file, " %s", hair_style_name((hair_style)i));
    fprintf(file, "\nMotions:");
    for (const struct hair_builtin* motion = hair_builtin_motions; motion->name; ++motion)
        fprintf(file, " %s", motion->name);
    fprintf(file, "\n");
}
