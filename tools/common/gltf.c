// gltf.c - Whole glTF files, with their version, extensions and what is not used of them.
#include "tools/common/gltf_reader.h"

#include <stdlib.h>
#include <string.h>

#define MAX_BYTES ((size_t)1 << 30)
// Accessors take at most this multiple of the file's size. Indices of one byte become four, and
// primitives may share their vertices.
#define MAX_GROWTH 64

struct hair_json hair_gltf_at(const struct hair_json* json, char place[HAIR_GLTF_PLACE], const char* member,
                              uint32_t i)
{
    snprintf(place, HAIR_GLTF_PLACE, "%s%s[%u].", json->place, member, i);
    return (struct hair_json){json->tool, json->path, place};
}

void* hair_gltf_alloc(const struct hair_gltf_reader* reader, size_t count, size_t size)
{
    void* memory = calloc(count ? count : 1, size);
    if (!memory) hair_complain(reader->json.tool, "%s: out of memory", reader->json.path);
    return memory;
}

void* hair_gltf_take(struct hair_gltf_reader* reader, const struct hair_json* at, size_t count, size_t size)
{
    uint64_t bytes = (uint64_t)count * size;
    if (bytes > reader->budget) {
        hair_complain(at->tool,
                      "%s: %sneeds %llu bytes; all accessors may take %d times the size of the file",
                      at->path, at->place, (unsigned long long)bytes, MAX_GROWTH);
        return NULL;
    }
    reader->budget -= bytes;
    return hair_gltf_alloc(reader, count, size);
}

void hair_gltf_name(const json_t* object, char out[HAIR_GLTF_NAME])
{
    const char* name = json_string_value(json_object_get(object, "name"));
    snprintf(out, HAIR_GLTF_NAME, "%s", name ? name : "");
}

// Refuse files of another version, and files that need an extension. Extensions of materials change
// only what is not read.
static bool check_version(const struct hair_gltf_reader* reader)
{
    const json_t* asset = json_object_get(reader->root, "asset");
    const json_t* version = json_object_get(asset, "version");
    const json_t* needed = json_object_get(asset, "minVersion");
    const char *text = json_string_value(version), *least = json_string_value(needed);
    if (!text || strncmp(text, "2.", 2))
        return hair_json_refuse(&reader->json, "asset.version", version, "\"2.0\"");
    if (needed && (!least || strcmp(least, "2.0")))
        return hair_json_refuse(&reader->json, "asset.minVersion", needed, "\"2.0\"");
    const json_t* extensions = json_object_get(reader->root, "extensionsRequired");
    if (extensions && !json_is_array(extensions))
        return hair_json_refuse(&reader->json, "extensionsRequired", extensions, "an array of names");
    for (size_t i = 0; i < json_array_size(extensions); ++i) {
        const json_t* value = json_array_get(extensions, i);
        const char* name = json_string_value(value);
        char key[48];
        snprintf(key, sizeof key, "extensionsRequired[%zu]", i);
        if (!name || (strncmp(name, "KHR_materials_", 14) && strncmp(name, "KHR_texture_", 12)))
            return hair_json_refuse(&reader->json, key, value, "an extension that can be left out");
    }
    return true;
}

static void report_ignored(const struct hair_gltf_reader* reader)
{
    static const char* const names[] = {"morph targets", "textures", "cameras",
                                        "joints beyond four per vertex", "points, lines and strips"};
    char text[160] = "";
    size_t length = 0;
    uint32_t left = reader->ignored;
    for (uint32_t i = 0; i < sizeof names / sizeof *names; ++i) {
        if (!(left & 1u << i)) continue;
        left &= ~(1u << i);
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s",
                                   !length ? ""
                                   : left  ? ", "
                                           : " and ",
                                   names[i]);
    }
    if (length) hair_complain(reader->json.tool, "%s: %s are not used", reader->json.path, text);
}

static bool read_all(struct hair_gltf_reader* reader, const struct hair_bytes* binary)
{
    if (!json_is_object(reader->root)) return hair_json_wrong(&reader->json, "the file", "an object");
    if (!check_version(reader) || !hair_gltf_read_buffers(reader, binary)) return false;
    if (json_array_size(json_object_get(reader->root, "textures")))
        reader->ignored |= HAIR_GLTF_IGNORED_TEXTURES;
    if (json_array_size(json_object_get(reader->root, "cameras")))
        reader->ignored |= HAIR_GLTF_IGNORED_CAMERAS;
    return hair_gltf_read_meshes(reader) && hair_gltf_read_nodes(reader) && hair_gltf_read_skins(reader) &&
           hair_gltf_read_animations(reader);
}

bool hair_gltf_parse(const char* tool, const char* path, const unsigned char* bytes, size_t size,
                     struct hair_gltf* out)
{
    struct hair_gltf_reader reader = {
        .json = {tool, path, ""}, .budget = MAX_GROWTH * (uint64_t)size, .out = out};
    struct hair_bytes text, binary;
    json_error_t error;
    memset(out, 0, sizeof *out);
    if (!hair_gltf_split(&reader.json, bytes, size, &text, &binary)) return false;
    json_t* root = json_loadb((const char*)text.data, text.size, JSON_REJECT_DUPLICATES, &error);
    reader.root = root;
    if (!root) hair_complain(tool, "%s: line %d, column %d: %s", path, error.line, error.column, error.text);
    bool ok = root && read_all(&reader, &binary);
    if (ok)
        report_ignored(&reader);
    else
        hair_gltf_free(out);
    hair_gltf_free_buffers(&reader);
    json_decref(root);
    return ok;
}

bool hair_gltf_read(const char* tool, const char* path, struct hair_gltf* out)
{
    struct hair_bytes bytes;
    memset(out, 0, sizeof *out);
    if (!hair_file_read(tool, path, MAX_BYTES, &bytes)) return false;
    bool ok = hair_gltf_parse(tool, path, bytes.data, bytes.size, out);
    free(bytes.data);
    return ok;
}

static void free_mesh(struct hair_gltf_mesh* mesh)
{
    for (uint32_t i = 0; i < mesh->primitive_count; ++i) {
        free(mesh->primitives[i].positions);
        free(mesh->primitives[i].normals);
        free(mesh->primitives[i].joints);
        free(mesh->primitives[i].weights);
        free(mesh->primitives[i].triangles);
    }
    free(mesh->primitives);
}

static void free_animation(struct hair_gltf_animation* animation)
{
    for (uint32_t i = 0; i < animation->channel_count; ++i) {
        free(animation->channels[i].times);
        free(animation->channels[i].values);
    }
    free(animation->channels);
}

void hair_gltf_free(struct hair_gltf* gltf)
{
    for (uint32_t i = 0; i < gltf->mesh_count; ++i) free_mesh(&gltf->meshes[i]);
    for (uint32_t i = 0; i < gltf->animation_count; ++i) free_animation(&gltf->animations[i]);
    for (uint32_t i = 0; i < gltf->skin_count; ++i) {
        free(gltf->skins[i].joints);
        free(gltf->skins[i].inverse_binds);
    }
    free(gltf->nodes);
    free(gltf->order);
    free(gltf->meshes);
    free(gltf->skins);
    free(gltf->animations);
    memset(gltf, 0, sizeof *gltf);
}
