// obj.h - triangle meshes from Wavefront .obj files: vertices and faces; all else in them is left out.
#ifndef HAIR_TOOLS_COMMON_OBJ_H
#define HAIR_TOOLS_COMMON_OBJ_H

#include <stdbool.h>
#include <stdint.h>

struct hair_obj {
    float* positions; // xyz
    uint32_t* triangles; // three vertices each
    uint32_t vertex_count, triangle_count;
};

// Faces of more than three corners become fans. False: `tool` has complained, naming the line. hair_obj_free undoes it.
bool hair_obj_read(const char* tool, const char* path, struct hair_obj* out);
void hair_obj_free(struct hair_obj* obj);

#endif
