// obj.h - Triangle meshes from Wavefront .obj files. Only vertices and faces are read.
#ifndef HAIR_TOOLS_COMMON_OBJ_H
#define HAIR_TOOLS_COMMON_OBJ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct hair_obj {
    float* positions; // xyz
    uint32_t* triangles; // three vertices each
    uint32_t vertex_count, triangle_count;
};

// Read a mesh from a file of at most 256 MiB. Faces with more than three corners become fans.
// Return false after printing an error that names the line. Release the mesh with hair_obj_free().
bool hair_obj_read(const char* tool, const char* path, struct hair_obj* out);
// Read a mesh from `size` bytes at `text`, which the parser changes. A 0 follows them. `path` names
// the mesh in messages.
bool hair_obj_parse(const char* tool, const char* path, char* text, size_t size, struct hair_obj* out);
void hair_obj_free(struct hair_obj* obj);

#endif
