// gltf_node.c - Nodes and skins of a glTF file.
#include "tools/common/gltf_reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAR 1e6 // maximum of any coordinate, m
#define MAX_SCALE 1e3
#define MAX_NODES 65536u

// Nodes -------------------------------------------------------------------------------------------

static bool read_matrix(const struct hair_json* at, const json_t* object, struct hair_gltf_node* out)
{
    static const float last[4] = {0, 0, 0, 1};
    out->has_matrix = true;
    if (!hair_json_floats(at, object, "matrix", 16, -FAR, FAR, out->matrix)) return false;
    for (int column = 0; column < 4; ++column)
        if (fabsf(out->matrix[4 * column + 3] - last[column]) > 1e-5f)
            return hair_json_refuse(at, "matrix", json_object_get(object, "matrix"),
                                    "a matrix with the last row 0, 0, 0, 1");
    return true;
}

static bool read_rotation(const struct hair_json* at, const json_t* object, struct hair_gltf_node* out)
{
    float *r = out->rotation, square = 0;
    if (!hair_json_floats(at, object, "rotation", 4, -2, 2, r)) return false;
    for (int k = 0; k < 4; ++k) square += r[k] * r[k];
    if (square < 0.9f || square > 1.1f)
        return hair_json_refuse(at, "rotation", json_object_get(object, "rotation"), "a unit quaternion");
    for (int k = 0; k < 4; ++k) r[k] /= sqrtf(square);
    return true;
}

static bool read_index(const struct hair_json* at, const json_t* object, const char* key, uint32_t count,
                       uint32_t* out)
{
    const json_t* value = json_object_get(object, key);
    *out = HAIR_GLTF_NONE;
    if (!value) return true;
    return count ? hair_json_count(at, object, key, 0, count - 1, out)
                 : hair_json_refuse(at, key, value, "left out, because the file has none");
}

static bool read_node(const struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                      struct hair_gltf_node* out)
{
    uint32_t skins = (uint32_t)json_array_size(json_object_get(reader->root, "skins"));
    *out = (struct hair_gltf_node){.parent = HAIR_GLTF_NONE, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    hair_gltf_name(object, out->name);
    if (!read_index(at, object, "mesh", reader->out->mesh_count, &out->mesh)) return false;
    if (!read_index(at, object, "skin", skins, &out->skin)) return false;
    if (json_object_get(object, "matrix")) return read_matrix(at, object, out);
    if (json_object_get(object, "translation") &&
        !hair_json_floats(at, object, "translation", 3, -FAR, FAR, out->translation))
        return false;
    if (json_object_get(object, "scale") &&
        !hair_json_floats(at, object, "scale", 3, -MAX_SCALE, MAX_SCALE, out->scale))
        return false;
    return !json_object_get(object, "rotation") || read_rotation(at, object, out);
}

// Read an array of whole numbers below `end`. Return their number, or HAIR_GLTF_NONE for an error.
static uint32_t read_indices(const struct hair_json* at, const json_t* object, const char* key, uint32_t end,
                             uint32_t max, uint32_t* out)
{
    const json_t* array = json_object_get(object, key);
    size_t count = json_array_size(array);
    bool ok = json_is_array(array) && count >= 1 && count <= max && end > 0;
    for (size_t i = 0; ok && i < count; ++i) {
        const json_t* value = json_array_get(array, i);
        json_int_t number = json_integer_value(value);
        ok = json_is_integer(value) && number >= 0 && number < (json_int_t)end;
        out[i] = (uint32_t)number;
    }
    if (ok) return (uint32_t)count;
    char must[96];
    snprintf(must, sizeof must, "an array of 1 to %u whole numbers below %u", max, end);
    hair_json_refuse(at, key, array, must);
    return HAIR_GLTF_NONE;
}

static bool set_parents(const struct hair_gltf_reader* reader, const json_t* array)
{
    struct hair_gltf* out = reader->out;
    for (uint32_t i = 0; i < out->node_count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json at = hair_gltf_at(&reader->json, place, "nodes", i);
        const json_t* object = json_array_get(array, i);
        if (!json_object_get(object, "children")) continue;
        // `order` is not in use yet.
        uint32_t count = read_indices(&at, object, "children", out->node_count, out->node_count, out->order);
        if (count == HAIR_GLTF_NONE) return false;
        for (uint32_t c = 0; c < count; ++c) {
            uint32_t* parent = &out->nodes[out->order[c]].parent;
            if (*parent != HAIR_GLTF_NONE) {
                hair_complain(at.tool, "%s: %schildren has node %u, which is a child of node %u too", at.path,
                              at.place, out->order[c], *parent);
                return false;
            }
            *parent = i;
        }
    }
    return true;
}

// Put each node after its parent. A node that no root reaches is part of a circle.
static bool sort_nodes(const struct hair_gltf_reader* reader)
{
    struct hair_gltf* out = reader->out;
    uint32_t count = 0, *next = hair_gltf_alloc(reader, 2 * (size_t)out->node_count, sizeof *next);
    if (!next) return false;
    // Lists of children: the first child of each node, then the next child of the same parent.
    uint32_t* first = next + out->node_count;
    for (uint32_t i = 0; i < out->node_count; ++i) first[i] = HAIR_GLTF_NONE;
    for (uint32_t i = out->node_count; i-- > 0;) {
        uint32_t parent = out->nodes[i].parent;
        if (parent == HAIR_GLTF_NONE) continue;
        next[i] = first[parent];
        first[parent] = i;
    }
    for (uint32_t i = 0; i < out->node_count; ++i)
        if (out->nodes[i].parent == HAIR_GLTF_NONE) out->order[count++] = i;
    for (uint32_t at = 0; at < count; ++at)
        for (uint32_t i = first[out->order[at]]; i != HAIR_GLTF_NONE; i = next[i]) out->order[count++] = i;
    free(next);
    if (count == out->node_count) return true;
    hair_complain(reader->json.tool, "%s: nodes has %u nodes that are their own ancestors or below one",
                  reader->json.path, out->node_count - count);
    return false;
}

// Mark the nodes of the scene that the file shows. Without scenes the file shows all nodes.
static bool mark_drawn(const struct hair_gltf_reader* reader)
{
    struct hair_gltf* out = reader->out;
    const json_t* scenes;
    uint32_t count, index = 0;
    if (!hair_json_objects(&reader->json, reader->root, "scenes", &scenes, &count)) return false;
    for (uint32_t i = 0; i < out->node_count && !count; ++i) out->nodes[i].is_drawn = true;
    if (!count) return true;
    if (json_object_get(reader->root, "scene") &&
        !hair_json_count(&reader->json, reader->root, "scene", 0, count - 1, &index))
        return false;
    char place[HAIR_GLTF_PLACE];
    struct hair_json at = hair_gltf_at(&reader->json, place, "scenes", index);
    const json_t* scene = json_array_get(scenes, index);
    if (!json_object_get(scene, "nodes")) return true;
    uint32_t* roots = hair_gltf_alloc(reader, out->node_count, sizeof *roots);
    if (!roots) return false;
    uint32_t root_count = read_indices(&at, scene, "nodes", out->node_count, out->node_count, roots);
    for (uint32_t i = 0; i < root_count && root_count != HAIR_GLTF_NONE; ++i)
        out->nodes[roots[i]].is_drawn = true;
    free(roots);
    for (uint32_t i = 0; i < out->node_count; ++i) {
        struct hair_gltf_node* node = &out->nodes[out->order[i]];
        if (node->parent != HAIR_GLTF_NONE && out->nodes[node->parent].is_drawn) node->is_drawn = true;
    }
    return root_count != HAIR_GLTF_NONE;
}

bool hair_gltf_read_nodes(struct hair_gltf_reader* reader)
{
    const json_t* array;
    uint32_t count;
    struct hair_gltf* out = reader->out;
    if (!hair_json_objects(&reader->json, reader->root, "nodes", &array, &count)) return false;
    if (count > MAX_NODES) {
        hair_complain(reader->json.tool, "%s: nodes has %u nodes, not at most %u", reader->json.path, count,
                      MAX_NODES);
        return false;
    }
    out->nodes = hair_gltf_alloc(reader, count, sizeof *out->nodes);
    out->order = hair_gltf_alloc(reader, count, sizeof *out->order);
    if (!out->nodes || !out->order) return false;
    out->node_count = count;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json at = hair_gltf_at(&reader->json, place, "nodes", i);
        if (!read_node(reader, &at, json_array_get(array, i), &out->nodes[i])) return false;
    }
    return set_parents(reader, array) && sort_nodes(reader) && mark_drawn(reader);
}

// Skins -------------------------------------------------------------------------------------------

static bool read_binds(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                       struct hair_gltf_skin* out)
{
    const json_t* value = json_object_get(object, "inverseBindMatrices");
    struct hair_gltf_accessor accessor;
    out->inverse_binds = hair_gltf_alloc(reader, out->joint_count, 16 * sizeof *out->inverse_binds);
    if (!out->inverse_binds) return false;
    for (uint32_t i = 0; i < out->joint_count && !value; ++i)
        for (uint32_t k = 0; k < 4; ++k) out->inverse_binds[16 * (size_t)i + 5 * (size_t)k] = 1;
    if (!value) return true;
    if (!hair_gltf_find(reader, at, object, "inverseBindMatrices", &accessor)) return false;
    if (accessor.components != 16 || accessor.component != HAIR_GLTF_F32 || accessor.count < out->joint_count)
        return hair_json_refuse(at, "inverseBindMatrices", value,
                                "an accessor of a MAT4 of floats per joint");
    accessor.count = out->joint_count;
    return hair_gltf_floats(at, "inverseBindMatrices", &accessor, (float)FAR, out->inverse_binds);
}

// Check that nodes with a skin have meshes whose joints are in the skin.
static bool check_use(const struct hair_gltf_reader* reader)
{
    const struct hair_gltf* out = reader->out;
    for (uint32_t i = 0; i < out->node_count; ++i) {
        const struct hair_gltf_node* node = &out->nodes[i];
        if (node->skin == HAIR_GLTF_NONE || node->mesh == HAIR_GLTF_NONE) continue;
        const struct hair_gltf_mesh* mesh = &out->meshes[node->mesh];
        uint32_t joints = out->skins[node->skin].joint_count;
        for (uint32_t k = 0; k < mesh->primitive_count; ++k) {
            if (mesh->primitives[k].joints && mesh->primitives[k].joint_end <= joints) continue;
            hair_complain(reader->json.tool,
                          "%s: nodes[%u].skin is %u with %u joints, but meshes[%u].primitives[%u] has %u",
                          reader->json.path, i, node->skin, joints, node->mesh, k,
                          mesh->primitives[k].joint_end);
            return false;
        }
    }
    return true;
}

bool hair_gltf_read_skins(struct hair_gltf_reader* reader)
{
    const json_t* array;
    uint32_t count;
    struct hair_gltf* out = reader->out;
    if (!hair_json_objects(&reader->json, reader->root, "skins", &array, &count)) return false;
    out->skins = hair_gltf_alloc(reader, count, sizeof *out->skins);
    if (!out->skins) return false;
    out->skin_count = count;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json at = hair_gltf_at(&reader->json, place, "skins", i);
        const json_t* object = json_array_get(array, i);
        struct hair_gltf_skin* skin = &out->skins[i];
        size_t joints = json_array_size(json_object_get(object, "joints"));
        skin->joints = hair_gltf_alloc(reader, joints, sizeof *skin->joints);
        if (!skin->joints) return false;
        skin->joint_count = read_indices(&at, object, "joints", out->node_count, MAX_NODES, skin->joints);
        if (skin->joint_count == HAIR_GLTF_NONE) return false;
        if (!read_binds(reader, &at, object, skin)) return false;
    }
    return check_use(reader);
}
