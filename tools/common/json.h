// json.h - JSON objects into structs, by tables of keys; what is wrong is said with its place.
#ifndef HAIR_TOOLS_COMMON_JSON_H
#define HAIR_TOOLS_COMMON_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

// Where the value at hand stands, for the sentences.
struct hair_json {
    const char* tool;
    const char* path; // of the file, or the name of the scene
    const char* place; // "camera." or ""
};

enum hair_json_kind {
    HAIR_JSON_NUMBERS,
    HAIR_JSON_COUNTS,
    HAIR_JSON_BOOLEAN,
    HAIR_JSON_OBJECT,
    HAIR_JSON_OTHER
};

// A key and where its value goes: `at` bytes into the struct. Arrays of `count` numbers; 1 is a lone number.
struct hair_json_entry {
    const char* key; // NULL ends a table
    enum hair_json_kind kind;
    size_t at;
    uint32_t count;
    double min, max;
    const struct hair_json_entry* object; // of HAIR_JSON_OBJECT; its offsets are from the same struct
    bool (*read)(const struct hair_json* json, const char* key, const json_t* value,
                 void* out); // of HAIR_JSON_OTHER
};

// Rows of such a table, and what ends it.
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

// False: something is wrong, and `tool` has complained. A key that is in no row is wrong.
bool hair_json_object(const struct hair_json* json, const char* name, const json_t* object,
                      const struct hair_json_entry* entries, void* out);

// An array of at most `most` objects into elements of `size` bytes. `begin` has set the elements.
bool hair_json_array(const struct hair_json* json, const char* name, const json_t* array,
                     const struct hair_json_entry* entries, void* out, size_t size, uint32_t most,
                     uint32_t* count);

// The path of a file that is named from the folder of the JSON's.
bool hair_json_path(const struct hair_json* json, const char* key, const json_t* value, char* path,
                    size_t size);

// "PATH: PLACE.KEY must be MUST". Returns false.
bool hair_json_wrong(const struct hair_json* json, const char* key, const char* must);

#endif
