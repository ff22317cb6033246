// json.c - JSON objects into structs, by tables of keys.
#include "tools/common/json.h"
#include "tools/common/file.h"

#include <stdlib.h>
#include <string.h>

bool hair_json_wrong(const struct hair_json* json, const char* key, const char* must)
{
    hair_complain(json->tool, "%s: %s%s must be %s", json->path, json->place, key, must);
    return false;
}

static bool is_within(const json_t* value, const struct hair_json_entry* entry)
{
    bool kind = entry->kind == HAIR_JSON_COUNTS ? json_is_integer(value) : json_is_number(value);
    double number = json_number_value(value);
    return kind && number >= entry->min && number <= entry->max;
}

static bool read_number(const struct hair_json* json, const char* key, const json_t* value,
                        const struct hair_json_entry* entry, void* out)
{
    if (!is_within(value, entry)) {
        char must[96];
        const char* kind = entry->kind == HAIR_JSON_COUNTS ? "a whole number" : "a number";
        snprintf(must, sizeof must, "%s in [%.10g, %.10g]", kind, entry->min, entry->max);
        return hair_json_wrong(json, key, must);
    }
    float number = (float)json_number_value(value);
    uint32_t count = (uint32_t)json_integer_value(value);
    memcpy(out, entry->kind == HAIR_JSON_COUNTS ? (const void*)&count : (const void*)&number, 4);
    return true;
}

static bool read_numbers(const struct hair_json* json, const json_t* value,
                         const struct hair_json_entry* entry, char* out)
{
    if (entry->count == 1) return read_number(json, entry->key, value, entry, out);
    if (!json_is_array(value) || json_array_size(value) != entry->count) {
        char must[32];
        snprintf(must, sizeof must, "%u numbers", entry->count);
        return hair_json_wrong(json, entry->key, must);
    }
    for (uint32_t i = 0; i < entry->count; ++i) {
        char key[64];
        snprintf(key, sizeof key, "%s[%u]", entry->key, i);
        if (!read_number(json, key, json_array_get(value, i), entry, out + 4 * i)) return false;
    }
    return true;
}

static bool read_entry(const struct hair_json* json, const json_t* value, const struct hair_json_entry* entry,
                       void* out)
{
    char* at = (char*)out + entry->at;
    switch (entry->kind) {
    case HAIR_JSON_NUMBERS:
    case HAIR_JSON_COUNTS: return read_numbers(json, value, entry, at);
    case HAIR_JSON_OBJECT: return hair_json_object(json, entry->key, value, entry->object, out);
    case HAIR_JSON_OTHER: return entry->read(json, entry->key, value, out);
    case HAIR_JSON_BOOLEAN: break;
    }
    if (!json_is_boolean(value)) return hair_json_wrong(json, entry->key, "true or false");
    *(bool*)at = json_is_true(value);
    return true;
}

static const struct hair_json_entry* find(const struct hair_json_entry* entries, const char* key)
{
    while (entries->key && strcmp(entries->key, key)) ++entries;
    return entries->key ? entries : NULL;
}

bool hair_json_object(const struct hair_json* json, const char* name, const json_t* object,
                      const struct hair_json_entry* entries, void* out)
{
    if (!json_is_object(object)) return hair_json_wrong(json, *name ? name : "the scene", "an object");
    char place[128];
    snprintf(place, sizeof place, "%s%s%s", json->place, name, *name ? "." : "");
    struct hair_json inside = {json->tool, json->path, place};
    const char* key;
    json_t* value;
    json_object_foreach((json_t*)(uintptr_t)object, key, value)
    {
        const struct hair_json_entry* entry = find(entries, key);
        if (!entry) {
            hair_complain(json->tool, "%s: there is no %s%s", json->path, place, key);
            return false;
        }
        if (!read_entry(&inside, value, entry, out)) return false;
    }
    return true;
}

bool hair_json_array(const struct hair_json* json, const char* name, const json_t* array,
                     const struct hair_json_entry* entries, void* out, size_t size, uint32_t max,
                     uint32_t* count)
{
    size_t length = json_array_size(array);
    if (!json_is_array(array) || length > max) {
        char must[64];
        snprintf(must, sizeof must, "an array of at most %u objects", max);
        return hair_json_wrong(json, name, must);
    }
    for (size_t i = 0; i < length; ++i) {
        char element[64];
        snprintf(element, sizeof element, "%s[%zu]", name, i);
        if (!hair_json_object(json, element, json_array_get(array, i), entries, (char*)out + i * size))
            return false;
    }
    *count = (uint32_t)length;
    return true;
}

bool hair_json_path(const struct hair_json* json, const char* key, const json_t* value, char* path,
                    size_t size)
{
    const char* name = json_string_value(value);
    if (!name || !*name) return hair_json_wrong(json, key, "the name of a file");
    const char* slash = strrchr(json->path, '/');
    int folder = slash && *name != '/' ? (int)(slash - json->path) + 1 : 0;
    int length = snprintf(path, size, "%.*s%s", folder, json->path, name);
    return (size_t)length < size || hair_json_wrong(json, key, "a shorter name");
}

bool hair_json_refuse(const struct hair_json* json, const char* key, const json_t* value, const char* must)
{
    char text[48] = "missing";
    char* all = value ? json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(7)) : NULL;
    size_t length = all ? strlen(all) : 0;
    if (all) snprintf(text, sizeof text, "%.40s%s", all, length > 40 ? "..." : "");
    free(all);
    hair_complain(json->tool, "%s: %s%s is %s, not %s", json->path, json->place, key, text, must);
    return false;
}

bool hair_json_count(const struct hair_json* json, const json_t* object, const char* key, uint32_t min,
                     uint32_t max, uint32_t* out)
{
    const json_t* value = json_object_get(object, key);
    json_int_t number = json_integer_value(value);
    if (json_is_integer(value) && number >= (json_int_t)min && number <= (json_int_t)max) {
        *out = (uint32_t)number;
        return true;
    }
    char must[64];
    snprintf(must, sizeof must, "a whole number in [%u, %u]", min, max);
    return hair_json_refuse(json, key, value, must);
}

bool hair_json_floats(const struct hair_json* json, const json_t* object, const char* key, uint32_t count,
                      double min, double max, float* out)
{
    const json_t* value = json_object_get(object, key);
    bool ok = json_is_array(value) && json_array_size(value) == count;
    for (uint32_t i = 0; ok && i < count; ++i) {
        const json_t* element = json_array_get(value, i);
        double number = json_number_value(element);
        ok = json_is_number(element) && number >= min && number <= max;
        out[i] = (float)number;
    }
    if (ok) return true;
    char must[64];
    snprintf(must, sizeof must, "%u numbers in [%g, %g]", count, min, max);
    return hair_json_refuse(json, key, value, must);
}

bool hair_json_objects(const struct hair_json* json, const json_t* object, const char* key,
                       const json_t** array, uint32_t* size)
{
    const json_t* value = json_object_get(object, key);
    bool ok = !value || (json_is_array(value) && json_array_size(value) <= UINT32_MAX);
    for (size_t i = 0; ok && i < json_array_size(value); ++i) ok = json_is_object(json_array_get(value, i));
    *array = value;
    *size = (uint32_t)json_array_size(value);
    return ok || hair_json_refuse(json, key, value, "an array of objects");
}
