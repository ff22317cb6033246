// obj_fuzz.c - fuzz target of the .obj meshes of the tools.
#include "tests/fuzz/fuzz.h"
#include "tools/common/obj.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LINE 64 // Maximum length of a written line.

static bool parse(const void* bytes, size_t size, struct hair_obj* out)
{
    size_t printed = hair_fuzz_printed();
    char* text = malloc(size + 1);
    if (!text) return false;
    memcpy(text, bytes, size);
    text[size] = 0;
    bool ok = hair_obj_parse("hair-capture", "fuzz.obj", text, size, out);
    HAIR_FUZZ_CHECK(ok == (hair_fuzz_printed() == printed)); // A refusal comes with a message.
    HAIR_FUZZ_CHECK(ok || (!out->positions && !out->triangles));
    free(text);
    return ok;
}

static void check(const struct hair_obj* mesh)
{
    HAIR_FUZZ_CHECK(mesh->vertex_count >= 1 && mesh->vertex_count <= 16777216);
    HAIR_FUZZ_CHECK(mesh->triangle_count <= 16777216);
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; ++i)
        HAIR_FUZZ_CHECK(fabsf(mesh->positions[i]) <= 1e6f);
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; ++i)
        HAIR_FUZZ_CHECK(mesh->triangles[i] < mesh->vertex_count);
}

// Write the mesh as text, and check that it is read as the same mesh.
static void check_round_trip(const struct hair_obj* mesh)
{
    size_t room = LINE * ((size_t)mesh->vertex_count + mesh->triangle_count) + 1, size = 0;
    char* text = malloc(room);
    HAIR_FUZZ_CHECK(text);
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        const float* p = mesh->positions + 3 * i;
        size += (size_t)snprintf(text + size, room - size, "v %.9g %.9g %.9g\n", (double)p[0], (double)p[1],
                                 (double)p[2]);
    }
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t* t = mesh->triangles + 3 * i;
        size += (size_t)snprintf(text + size, room - size, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    struct hair_obj again;
    HAIR_FUZZ_CHECK(parse(text, size, &again));
    HAIR_FUZZ_CHECK(again.vertex_count == mesh->vertex_count);
    HAIR_FUZZ_CHECK(again.triangle_count == mesh->triangle_count);
    HAIR_FUZZ_CHECK(!memcmp(again.positions, mesh->positions, 12 * (size_t)mesh->vertex_count));
    if (mesh->triangle_count)
        HAIR_FUZZ_CHECK(!memcmp(again.triangles, mesh->triangles, 12 * (size_t)mesh->triangle_count));
    hair_obj_free(&again);
    free(text);
}

HAIR_FUZZ(obj)
{
    struct hair_obj mesh;
    if (!parse(bytes, size, &mesh)) return false;
    hair_fuzz_end_refusals();
    check(&mesh);
    check_round_trip(&mesh);
    hair_fuzz_add_floats(hash, mesh.positions, 3 * (size_t)mesh.vertex_count);
    for (size_t i = 0; i < 3 * (size_t)mesh.triangle_count; ++i) hair_fuzz_add(hash, mesh.triangles[i]);
    hair_obj_free(&mesh);
    return true;
}
