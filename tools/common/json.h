// json.h - JSON objects into structs, by tables of keys. Error messages name the place of the wrong
// value.
#ifndef HAIR_TOOLS_COMMON_JSON_H
#define HAIR_TOOLS_COMMON_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

// Place of the current value, for error messages.
struct hair_json {
    const char* tool;
    const char* path; // path of the file, or name of the scene
    const char* place; // prefix such as "camera.", or ""
};

enum hair_json_kind {
    HAIR_JSON_NUMBERS,
    HAIR_JSON_COUNTS,
    HAIR_JSON_BOOLEAN,
    HAIR_JSON_OBJECT,
    HAIR_JSON_OTHER
};

// Key and destination of its value, `at` bytes into the struct. `count` is the length of an array
// of numbers, 1 for a single number.
struct hair_json_entry {
    const char* key; // NULL ends a table
    enum hair_json_kind kind;
    size_t at;
    uint32_t count;
    double min, max;
    // Table of a HAIR_JSON_OBJECT, with offsets from the same struct.
    const struct hair_json_entry* object;
    // Reader of a HAIR_JSON_OTHER.
    bool (*read)(const struct hair_json* json, const char* key, const json_t* value, void* out);
};

// Rows of a table of entries, and its end.
#define HAIR_NUMBERS(key, at, count, min, max)                                                               \
    {                                                                                                        \
        key, HAIR_JSON_NUMBERS, at, count, min, max, NULL, NULL                                              \
    }
#define HAIR_COUNTS(key, at, count, min, max)                                                                \
    {                                                                                                        \
        key, HAIR_JSON_COUNTS, at, count, min, max, NULL, NULL                                               \
    }
#define HAIR_BOOLEAN(key, at)                                                                                \
    {                                                                                                        \
        key, HAIR_JSON_BOOLEAN, at, 1, 0, 0, NULL, NULL                                                      \
    }
#define HAIR_OBJECT(key, entries)                                                                            \
    {                                                                                                        \
        key, HAIR_JSON_OBJECT, 0, 1, 0, 0, entries, NULL                                                     \
    }
#define HAIR_OTHER(key, read)                                                                                \
    {                                                                                                        \
        key, HAIR_JSON_OTHER, 0, 1, 0, 0, NULL, read                                                         \
    }
#define HAIR_END                                                                                             \
    {                                                                                                        \
        NULL, HAIR_JSON_OTHER, 0, 0, 0, 0, NULL, NULL                                                        \
    }

// Read an object. Return false after an error, which has been printed. A key without an entry is an
// error.
bool hair_json_object(const struct hair_json* json, const char* name, const json_t* object,
                      const struct hair_json_entry* entries, void* out);

// Read an array of at most `max` objects into elements of `size` bytes. The caller has set the
// elements to their defaults.
bool hair_json_array(const struct hair_json* json, const char* name, const json_t* array,
                     const struct hair_json_entry* entries, void* out, size_t size, uint32_t max,
                     uint32_t* count);

// Compute the path of a file whose name is relative to the folder of the JSON file.
bool hair_json_path(const struct hair_json* json, const char* key, const json_t* value, char* path,
                    size_t size);

// Print "PATH: PLACE.KEY must be MUST". Return false.
bool hair_json_wrong(const struct hair_json* json, const char* key, const char* must);

// Members of objects that have other members too, which tables do not list. A member that is
// missing or wrong is an error, which names its value.

// Print "PATH: PLACE.KEY is VALUE, not MUST". Return false. A `value` of NULL is missing.
bool hair_json_refuse(const struct hair_json* json, const char* key, const json_t* value, const char* must);
// Read a whole number in [min, max].
bool hair_json_count(const struct hair_json* json, const json_t* object, const char* key, uint32_t min,
                     uint32_t max, uint32_t* out);
// Read an array of `count` numbers in [min, max].
bool hair_json_floats(const struct hair_json* json, const json_t* object, const char* key, uint32_t count,
                      double min, double max, float* out);
// Read an array of objects. A missing array has the size 0.
bool hair_json_objects(const struct hair_json* json, const json_t* object, const char* key,
                       const json_t** array, uint32_t* size);

#endif
