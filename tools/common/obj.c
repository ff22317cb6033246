// obj.c - Triangle meshes from Wavefront .obj files.
#include "tools/common/obj.h"
#include "tools/common/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_BYTES ((size_t)256 << 20)
#define MAX 16777216u // maximum number of vertices and of triangles

// State of the parser.
struct place {
    const char* tool;
    const char* path;
    uint32_t line;
    struct hair_obj* out;
    size_t vertex_room, triangle_room;
};

static bool wrong(const struct place* place, const char* what)
{
    hair_complain(place->tool, "%s: line %u %s", place->path, place->line, what);
    return false;
}

static bool reserve(const struct place* place, void** array, size_t* room, size_t count, size_t size)
{
    if (count < *room) return true;
    if (count >= MAX) return wrong(place, "is one more than 16777216 vertices or triangles");
    size_t more = count < 512 ? 1024 : 2 * count;
    void* grown = realloc(*array, more * size);
    if (!grown) return wrong(place, "is one too many for the memory there is");
    *array = grown;
    *room = more;
    return true;
}

static bool read_vertex(struct place* place, char* at)
{
    struct hair_obj* out = place->out;
    void* memory = out->positions;
    if (!reserve(place, &memory, &place->vertex_room, out->vertex_count, 3 * sizeof(float))) return false;
    out->positions = memory;
    for (uint32_t k = 0; k < 3; ++k) {
        char* end;
        double value = strtod(at, &end);
        if (end == at || !(fabs(value) <= 1e6))
            return wrong(place, "has a vertex that is not 3 numbers in [-1e6, 1e6]");
        out->positions[3 * (size_t)out->vertex_count + k] = (float)value;
        at = end;
    }
    ++out->vertex_count;
    return true;
}

// Read a vertex index, the number before any '/'. Positive indices count from 1. Negative indices
// count back from the last vertex.
static bool read_corner(const struct place* place, char** at, uint32_t* corner)
{
    char* end;
    long long value = strtoll(*at, &end, 10), count = place->out->vertex_count;
    if (end == *at) return wrong(place, "has a face with a corner that is no number");
    if (value < 0) value += count + 1;
    if (value < 1 || value > count)
        return wrong(place, "has a face with a vertex that is not among those before it");
    *corner = (uint32_t)(value - 1);
    *at = end + strcspn(end, " \t\r");
    return true;
}

static bool read_face(struct place* place, char* at)
{
    struct hair_obj* out = place->out;
    uint32_t first = 0, last = 0, next = 0, corners = 0;
    for (at += strspn(at, " \t\r"); *at; at += strspn(at, " \t\r"), ++corners) {
        if (!read_corner(place, &at, &next)) return false;
        if (corners == 0) first = next;
        if (corners > 1) {
            void* memory = out->triangles;
            if (!reserve(place, &memory, &place->triangle_room, out->triangle_count, 3 * sizeof(uint32_t)))
                return false;
            out->triangles = memory;
            uint32_t* three = out->triangles + 3 * (size_t)out->triangle_count++;
            three[0] = first, three[1] = last, three[2] = next;
        }
        last = next;
    }
    return corners >= 3 || wrong(place, "has a face of fewer than 3 corners");
}

// Read all lines up to `end`. Line ends in `text` are replaced by 0.
static bool read_lines(struct place* place, char* text, const char* end)
{
    for (char* next; text < end; text = next) {
        size_t length = strcspn(text, "\n");
        next = text + length + 1;
        ++place->line;
        if (text + length < end && !text[length]) return wrong(place, "has a byte 0, and is no text");
        text[length] = 0;
        text += strspn(text, " \t");
        bool blank = text[0] && strchr(" \t", text[1]);
        if (text[0] == 'v' && blank && !read_vertex(place, text + 1)) return false;
        if (text[0] == 'f' && blank && !read_face(place, text + 1)) return false;
    }
    return true;
}

bool hair_obj_parse(const char* tool, const char* path, char* text, size_t size, struct hair_obj* out)
{
    struct place place = {.tool = tool, .path = path, .out = out};
    memset(out, 0, sizeof *out);
    bool ok = read_lines(&place, text, text + size);
    if (ok && !out->vertex_count) {
        hair_complain(tool, "%s: there is no vertex in it", path);
        ok = false;
    }
    if (!ok) hair_obj_free(out);
    return ok;
}

bool hair_obj_read(const char* tool, const char* path, struct hair_obj* out)
{
    struct hair_bytes bytes;
    memset(out, 0, sizeof *out);
    if (!hair_file_read(tool, path, MAX_BYTES, &bytes)) return false;
    char* text = realloc(bytes.data, bytes.size + 1);
    if (!text) {
        hair_complain(tool, "%s: out of memory", path);
        free(bytes.data);
        return false;
    }
    text[bytes.size] = 0;
    bool ok = hair_obj_parse(tool, path, text, bytes.size, out);
    free(text);
    return ok;
}

void hair_obj_free(struct hair_obj* obj)
{
    free(obj->positions);
    free(obj->triangles);
    memset(obj, 0, sizeof *obj);
}
