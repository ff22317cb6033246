// gltf_buffer.c - Buffers and accessors of a glTF file.
#include "tools/common/gltf_reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_BESIDE ((size_t)1 << 30) // bytes of a file beside
#define MAX_BUFFERS 256u
#define MAX_COUNT 67108864u // elements of an accessor
#define TEXT_CHUNK 0x4e4f534au
#define BINARY_CHUNK 0x004e4942u

static uint32_t word_at(const unsigned char* bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

// Parts of a .glb file ----------------------------------------------------------------------------

static bool refuse(const struct hair_json* json, const char* what, uint64_t value, uint64_t min, uint64_t max)
{
    hair_complain(json->tool, "%s: %s is %llu, not in [%llu, %llu]", json->path, what,
                  (unsigned long long)value, (unsigned long long)min, (unsigned long long)max);
    return false;
}

bool hair_gltf_split(const struct hair_json* json, const unsigned char* bytes, size_t size,
                     struct hair_bytes* text, struct hair_bytes* binary)
{
    *text = (struct hair_bytes){(unsigned char*)(uintptr_t)bytes, size};
    *binary = (struct hair_bytes){0};
    if (size < 4 || memcmp(bytes, "glTF", 4)) return true;
    if (size < 20) return refuse(json, "the size of the file", size, 20, UINT32_MAX);
    uint32_t version = word_at(bytes + 4), length = word_at(bytes + 8);
    if (version != 2) return refuse(json, "the version at byte 4", version, 2, 2);
    if (length < 20 || length > size) return refuse(json, "the length at byte 8", length, 20, size);
    uint32_t first = word_at(bytes + 12);
    if (first > length - 20) return refuse(json, "the length of the text at byte 12", first, 0, length - 20);
    if (word_at(bytes + 16) != TEXT_CHUNK)
        return refuse(json, "the type of the first chunk at byte 16", word_at(bytes + 16), TEXT_CHUNK,
                      TEXT_CHUNK);
    text->data += 20;
    text->size = first;
    size_t at = 20 + (size_t)first;
    if (length - at < 8 || word_at(bytes + at + 4) != BINARY_CHUNK) return true;
    uint32_t second = word_at(bytes + at);
    if (second > length - at - 8)
        return refuse(json, "the length of the binary chunk", second, 0, length - at - 8);
    binary->data = text->data + first + 8;
    binary->size = second;
    return true;
}

// Buffers -----------------------------------------------------------------------------------------

static int digit_of(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// Decode base64 (RFC 4648), of which the padding may be missing. Return false for other characters.
static bool decode_base64(const char* text, unsigned char* out, size_t* size)
{
    uint32_t bits = 0, count = 0;
    *size = 0;
    for (; *text && *text != '='; ++text) {
        int digit = digit_of(*text);
        if (digit < 0) return false;
        bits = bits << 6 | (uint32_t)digit;
        if (++count % 4 == 1) continue;
        uint32_t shift = 6 - 2 * ((count - 1) % 4);
        out[(*size)++] = (unsigned char)(bits >> shift);
    }
    return count % 4 != 1 && text[strspn(text, "=")] == 0;
}

static bool read_data(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* uri,
                      struct hair_bytes* out)
{
    const char *text = json_string_value(uri), *comma = strchr(text, ',');
    bool ok = comma && comma - text >= 7 && !strncmp(comma - 7, ";base64", 7);
    out->data = ok ? hair_gltf_alloc(reader, strlen(comma) / 4 * 3 + 3, 1) : NULL;
    if (ok && !out->data) return false;
    return (ok && decode_base64(comma + 1, out->data, &out->size)) ||
           hair_json_refuse(at, "uri", uri, "data in base64");
}

static int hex_of(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

// Decode the percent signs of a name in place (RFC 3986). Return false for a name that leaves the
// folder of the file, or names no file.
static bool decode_name(char* name)
{
    char* out = name;
    for (const char* from = name; *from; ++from) {
        int high = *from == '%' ? hex_of(from[1]) : -1, low = high >= 0 ? hex_of(from[2]) : -1;
        if (*from == '%' && low < 0) return false;
        *out++ = low < 0 ? *from : (char)(16 * high + low);
        if (low >= 0) from += 2;
        if (!out[-1]) return false;
    }
    *out = 0;
    for (const char* part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (!strncmp(part, "..", 2) && (!part[2] || part[2] == '/')) return false;
    }
    return *name && *name != '/' && !strchr(name, ':') && !strchr(name, '\\');
}

static bool read_beside(const struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* uri,
                        struct hair_bytes* out)
{
    char name[1024], path[4096];
    int length = snprintf(name, sizeof name, "%s", json_string_value(uri));
    if ((size_t)length >= sizeof name || !decode_name(name))
        return hair_json_refuse(at, "uri", uri, "data, or the name of a file in the same folder");
    const char* slash = strrchr(reader->json.path, '/');
    int folder = slash ? (int)(slash - reader->json.path) + 1 : 0;
    length = snprintf(path, sizeof path, "%.*s%s", folder, reader->json.path, name);
    if ((size_t)length >= sizeof path) return hair_json_refuse(at, "uri", uri, "a shorter name");
    return hair_file_read(reader->json.tool, path, MAX_BESIDE, out);
}

static bool read_buffer(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                        const struct hair_bytes* binary, uint32_t i)
{
    struct hair_bytes* buffer = &reader->buffers[i];
    const json_t* uri = json_object_get(object, "uri");
    const char* text = json_string_value(uri);
    uint32_t size;
    if (uri && !text)
        return hair_json_refuse(at, "uri", uri, "data, or the name of a file in the same folder");
    if (text && !strncmp(text, "data:", 5)) {
        if (!read_data(reader, at, uri, buffer)) return false;
    } else if (text) {
        if (!read_beside(reader, at, uri, buffer)) return false;
        reader->budget += 64 * (uint64_t)buffer->size;
    } else if (i == 0 && binary->data) {
        buffer->data = hair_gltf_alloc(reader, binary->size, 1);
        if (!buffer->data) return false;
        memcpy(buffer->data, binary->data, binary->size);
        buffer->size = binary->size;
    } else
        return hair_json_refuse(at, "uri", NULL,
                                "given, because the file has no binary chunk for this buffer");
    uint32_t max = buffer->size < UINT32_MAX ? (uint32_t)buffer->size : UINT32_MAX;
    if (!hair_json_count(at, object, "byteLength", 1, max, &size)) return false;
    buffer->size = size;
    return true;
}

bool hair_gltf_read_buffers(struct hair_gltf_reader* reader, const struct hair_bytes* binary)
{
    const json_t* array;
    uint32_t count;
    if (!hair_json_objects(&reader->json, reader->root, "buffers", &array, &count)) return false;
    if (count > MAX_BUFFERS) return refuse(&reader->json, "the number of buffers", count, 0, MAX_BUFFERS);
    reader->buffers = hair_gltf_alloc(reader, count, sizeof *reader->buffers);
    if (!reader->buffers) return false;
    reader->buffer_count = count;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json at = hair_gltf_at(&reader->json, place, "buffers", i);
        if (!read_buffer(reader, &at, json_array_get(array, i), binary, i)) return false;
    }
    return true;
}

void hair_gltf_free_buffers(struct hair_gltf_reader* reader)
{
    for (uint32_t i = 0; i < reader->buffer_count; ++i) free(reader->buffers[i].data);
    free(reader->buffers);
    reader->buffers = NULL;
    reader->buffer_count = 0;
}

// Accessors ---------------------------------------------------------------------------------------

static uint32_t component_size(enum hair_gltf_component component)
{
    switch (component) {
    case HAIR_GLTF_I8:
    case HAIR_GLTF_U8: return 1;
    case HAIR_GLTF_I16:
    case HAIR_GLTF_U16: return 2;
    case HAIR_GLTF_U32:
    case HAIR_GLTF_F32: break;
    }
    return 4;
}

static bool read_type(const struct hair_json* at, const json_t* object, struct hair_gltf_accessor* out)
{
    static const struct {
        const char* name;
        uint32_t components;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const json_t *value = json_object_get(object, "type"),
                 *normalized = json_object_get(object, "normalized");
    const char* name = json_string_value(value);
    uint32_t component;
    if (!hair_json_count(at, object, "componentType", HAIR_GLTF_I8, HAIR_GLTF_F32, &component)) return false;
    if (component == 5124)
        return hair_json_refuse(at, "componentType", json_object_get(object, "componentType"),
                                "5120 to 5123, 5125 or 5126");
    if (normalized && !json_is_boolean(normalized))
        return hair_json_refuse(at, "normalized", normalized, "true or false");
    out->component = (enum hair_gltf_component)component;
    out->normalized = json_is_true(normalized);
    for (size_t i = 0; name && i < sizeof types / sizeof *types; ++i)
        if (!strcmp(types[i].name, name)) {
            out->components = types[i].components;
            return true;
        }
    return hair_json_refuse(at, "type", value, "\"SCALAR\", \"VEC2\", \"VEC3\", \"VEC4\" or \"MAT4\"");
}

// Find the bytes of a view of a buffer. A stride of 0 means that elements are packed.
static bool find_view(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                      struct hair_bytes* out, uint32_t* stride)
{
    const json_t* array;
    uint32_t count, view, buffer, offset = 0, length;
    if (!hair_json_objects(&reader->json, reader->root, "bufferViews", &array, &count)) return false;
    if (!count)
        return hair_json_refuse(&reader->json, "bufferViews", array, "an array with the views of accessors");
    if (!hair_json_count(at, object, "bufferView", 0, count - 1, &view)) return false;
    char place[HAIR_GLTF_PLACE];
    struct hair_json inside = hair_gltf_at(&reader->json, place, "bufferViews", view);
    const json_t* from = json_array_get(array, view);
    if (!reader->buffer_count)
        return hair_json_refuse(&reader->json, "buffers", NULL, "given for the views of buffers");
    if (!hair_json_count(&inside, from, "buffer", 0, reader->buffer_count - 1, &buffer)) return false;
    uint32_t size = (uint32_t)reader->buffers[buffer].size;
    if (json_object_get(from, "byteOffset") &&
        !hair_json_count(&inside, from, "byteOffset", 0, size - 1, &offset))
        return false;
    if (!hair_json_count(&inside, from, "byteLength", 1, size - offset, &length)) return false;
    *stride = 0;
    if (json_object_get(from, "byteStride") && !hair_json_count(&inside, from, "byteStride", 4, 252, stride))
        return false;
    *out = (struct hair_bytes){reader->buffers[buffer].data + offset, length};
    return true;
}

bool hair_gltf_find(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                    const char* key, struct hair_gltf_accessor* out)
{
    const json_t* array;
    struct hair_bytes view = {0};
    uint32_t count, index, offset = 0;
    *out = (struct hair_gltf_accessor){0};
    if (!hair_json_objects(&reader->json, reader->root, "accessors", &array, &count)) return false;
    if (!count)
        return hair_json_refuse(&reader->json, "accessors", array, "an array that other members name");
    if (!hair_json_count(at, object, key, 0, count - 1, &index)) return false;
    char place[HAIR_GLTF_PLACE];
    struct hair_json inside = hair_gltf_at(&reader->json, place, "accessors", index);
    const json_t *from = json_array_get(array, index), *sparse = json_object_get(from, "sparse");
    if (sparse)
        return hair_json_refuse(&inside, "sparse", sparse, "left out; sparse accessors are not supported");
    if (!read_type(&inside, from, out)) return false;
    if (!find_view(reader, &inside, from, &view, &out->stride)) return false;
    uint32_t size = component_size(out->component), element = size * out->components;
    if (!out->stride) out->stride = element;
    if (out->stride < element || out->stride % size) {
        hair_complain(at->tool,
                      "%s: %sbufferView has a byteStride of %u, not a multiple of %u that is at least %u",
                      at->path, inside.place, out->stride, size, element);
        return false;
    }
    if (json_object_get(from, "byteOffset") &&
        !hair_json_count(&inside, from, "byteOffset", 0, (uint32_t)view.size - 1, &offset))
        return false;
    uint32_t room = (uint32_t)view.size - offset;
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): every type has components.
    uint32_t max = room < element ? 0 : (room - element) / out->stride + 1;
    if (max == 0 ||
        !hair_json_count(&inside, from, "count", 1, max < MAX_COUNT ? max : MAX_COUNT, &out->count))
        return max ? false
                   : hair_json_refuse(&inside, "byteOffset", json_object_get(from, "byteOffset"),
                                      "an offset with an element after it in the view");
    out->bytes = view.data + offset;
    return true;
}

uint32_t hair_gltf_whole(const struct hair_gltf_accessor* accessor, uint32_t i, uint32_t k)
{
    uint32_t size = component_size(accessor->component);
    const unsigned char* at = accessor->bytes + (size_t)accessor->stride * i + (size_t)size * k;
    return size == 1 ? at[0] : size == 2 ? at[0] | (uint32_t)at[1] << 8 : word_at(at);
}

static float number_at(const struct hair_gltf_accessor* accessor, uint32_t i, uint32_t k)
{
    uint32_t whole = hair_gltf_whole(accessor, i, k);
    float number;
    switch (accessor->component) {
    case HAIR_GLTF_I8:
        number = (float)(int8_t)whole;
        return accessor->normalized ? fmaxf(number / 127, -1) : number;
    case HAIR_GLTF_U8: return accessor->normalized ? (float)whole / 255 : (float)whole;
    case HAIR_GLTF_I16:
        number = (float)(int16_t)whole;
        return accessor->normalized ? fmaxf(number / 32767, -1) : number;
    case HAIR_GLTF_U16: return accessor->normalized ? (float)whole / 65535 : (float)whole;
    case HAIR_GLTF_U32: return (float)whole;
    case HAIR_GLTF_F32: break;
    }
    memcpy(&number, &whole, sizeof number);
    return number;
}

bool hair_gltf_floats(const struct hair_json* at, const char* key, const struct hair_gltf_accessor* accessor,
                      float max, float* out)
{
    for (uint32_t i = 0; i < accessor->count; ++i)
        for (uint32_t k = 0; k < accessor->components; ++k, ++out) {
            *out = number_at(accessor, i, k);
            if (fabsf(*out) <= max) continue;
            hair_complain(at->tool, "%s: %s%s has %g in element %u, not in [%g, %g]", at->path, at->place,
                          key, (double)*out, i, -(double)max, (double)max);
            return false;
        }
    return true;
}
