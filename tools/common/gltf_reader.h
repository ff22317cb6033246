// gltf_reader.h - State of reading one glTF file, shared by gltf*.c.
#ifndef HAIR_TOOLS_COMMON_GLTF_READER_H
#define HAIR_TOOLS_COMMON_GLTF_READER_H

#include "tools/common/file.h"
#include "tools/common/gltf.h"
#include "tools/common/json.h"

// Component types of accessors, by their numbers in files.
enum hair_gltf_component {
    HAIR_GLTF_I8 = 5120,
    HAIR_GLTF_U8 = 5121,
    HAIR_GLTF_I16 = 5122,
    HAIR_GLTF_U16 = 5123,
    HAIR_GLTF_U32 = 5125,
    HAIR_GLTF_F32 = 5126
};

// Bit mask of parts of a file that are not used.
enum hair_gltf_ignored {
    HAIR_GLTF_IGNORED_MORPHS = 1,
    HAIR_GLTF_IGNORED_TEXTURES = 2,
    HAIR_GLTF_IGNORED_CAMERAS = 4,
    HAIR_GLTF_IGNORED_JOINTS = 8,
    HAIR_GLTF_IGNORED_MODES = 16
};

struct hair_gltf_reader {
    struct hair_json json; // of the whole file
    const json_t* root;
    struct hair_bytes* buffers;
    uint32_t buffer_count;
    uint64_t budget; // bytes that may still be allocated for accessors
    uint32_t ignored; // bit mask of enum hair_gltf_ignored
    struct hair_gltf* out;
};

// Elements of an accessor, all within its buffer.
struct hair_gltf_accessor {
    const unsigned char* bytes;
    uint32_t count, stride;
    uint32_t components; // 1 to 4, or 16
    enum hair_gltf_component component;
    bool normalized;
};

// Write the place of a member's element, such as "meshes[2].primitives[0].", and return json with
// this place.
#define HAIR_GLTF_PLACE 128
struct hair_json hair_gltf_at(const struct hair_json* json, char place[HAIR_GLTF_PLACE], const char* member,
                              uint32_t i);
// Allocate zeros. Return NULL after printing an error.
void* hair_gltf_alloc(const struct hair_gltf_reader* reader, size_t count, size_t size);
// Allocate for the content of accessors. The size of the file limits the sum.
void* hair_gltf_take(struct hair_gltf_reader* reader, const struct hair_json* at, size_t count, size_t size);
// Copy a name. A missing name is empty.
void hair_gltf_name(const json_t* object, char out[HAIR_GLTF_NAME]);

// Find the parts of a .glb file. `json` and `binary` point into `bytes`.
bool hair_gltf_split(const struct hair_json* json, const unsigned char* bytes, size_t size,
                     struct hair_bytes* text, struct hair_bytes* binary);
// Read all buffers. A buffer without a uri is `binary`.
bool hair_gltf_read_buffers(struct hair_gltf_reader* reader, const struct hair_bytes* binary);
void hair_gltf_free_buffers(struct hair_gltf_reader* reader);

// Find the accessor that a member names.
bool hair_gltf_find(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                    const char* key, struct hair_gltf_accessor* out);
// Return whole number k of element i.
uint32_t hair_gltf_whole(const struct hair_gltf_accessor* accessor, uint32_t i, uint32_t k);
// Read all elements as numbers in [-max, max]. Normalized integers become numbers in [-1, 1].
bool hair_gltf_floats(const struct hair_json* at, const char* key, const struct hair_gltf_accessor* accessor,
                      float max, float* out);

bool hair_gltf_read_nodes(struct hair_gltf_reader* reader);
bool hair_gltf_read_skins(struct hair_gltf_reader* reader);
bool hair_gltf_read_meshes(struct hair_gltf_reader* reader);
bool hair_gltf_read_animations(struct hair_gltf_reader* reader);

#endif
