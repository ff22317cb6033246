// gltf_mesh.c - Meshes of a glTF file, with their joints, weights and base colours.
#include "tools/common/gltf_reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAR 1e6f // maximum of any coordinate, m
#define MIN_WEIGHT 1e-3f // minimum sum of the weights of a vertex

static bool is_kind(const struct hair_json* at, const json_t* object, const char* key,
                    const struct hair_gltf_accessor* accessor, bool ok, const char* must)
{
    if (ok) return true;
    char text[160];
    snprintf(text, sizeof text, "an accessor of %s; this one has %u components of the type %d", must,
             accessor->components, (int)accessor->component);
    return hair_json_refuse(at, key, json_object_get(object, key), text);
}

// Positions, normals ------------------------------------------------------------------------------

static float* read_vectors(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                           const char* key, uint32_t* count)
{
    struct hair_gltf_accessor accessor;
    if (!hair_gltf_find(reader, at, object, key, &accessor)) return NULL;
    bool ok = accessor.components == 3 && accessor.component == HAIR_GLTF_F32;
    if (!is_kind(at, object, key, &accessor, ok, "3 floats")) return NULL;
    float* values = hair_gltf_take(reader, at, accessor.count, 3 * sizeof *values);
    if (values && !hair_gltf_floats(at, key, &accessor, FAR, values)) {
        free(values);
        return NULL;
    }
    *count = accessor.count;
    return values;
}

// Make normals unit vectors. A zero normal becomes +y.
static void normalize(float* normals, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) {
        float *n = normals + 3 * (size_t)i, size = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (size > 1e-20f)
            for (int k = 0; k < 3; ++k) n[k] /= size;
        else
            n[0] = 0, n[1] = 1, n[2] = 0;
    }
}

// Set normals to the mean of the triangles around each vertex, by area.
static void compute_normals(struct hair_gltf_primitive* out)
{
    for (uint32_t i = 0; i < out->triangle_count; ++i) {
        const uint32_t* corner = out->triangles + 3 * (size_t)i;
        const float* p[3];
        float a[3], b[3];
        for (int k = 0; k < 3; ++k) p[k] = out->positions + 3 * (size_t)corner[k];
        for (int k = 0; k < 3; ++k) a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k];
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < 3; ++k)
                out->normals[3 * (size_t)corner[c] + (size_t)k] +=
                    a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static bool read_normals(struct hair_gltf_reader* reader, const struct hair_json* at,
                         const json_t* attributes, struct hair_gltf_primitive* out)
{
    const json_t* value = json_object_get(attributes, "NORMAL");
    uint32_t count = out->vertex_count;
    out->normals = value ? read_vectors(reader, at, attributes, "NORMAL", &count)
                         : hair_gltf_take(reader, at, count, 3 * sizeof *out->normals);
    if (!out->normals) return false;
    if (count != out->vertex_count)
        return hair_json_refuse(at, "NORMAL", value, "an accessor with as many elements as POSITION");
    if (!value) compute_normals(out);
    normalize(out->normals, count);
    return true;
}

// Triangles ---------------------------------------------------------------------------------------

static bool check_indices(const struct hair_json* at, const struct hair_gltf_primitive* out)
{
    for (size_t i = 0; i < 3 * (size_t)out->triangle_count; ++i) {
        if (out->triangles[i] < out->vertex_count) continue;
        hair_complain(at->tool, "%s: %sindices has %u in element %zu, not in [0, %u]", at->path, at->place,
                      out->triangles[i], i, out->vertex_count - 1);
        return false;
    }
    return true;
}

static bool read_triangles(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                           struct hair_gltf_primitive* out)
{
    const json_t* value = json_object_get(object, "indices");
    struct hair_gltf_accessor accessor = {.count = out->vertex_count};
    if (value && !hair_gltf_find(reader, at, object, "indices", &accessor)) return false;
    bool whole = accessor.component == HAIR_GLTF_U8 || accessor.component == HAIR_GLTF_U16 ||
                 accessor.component == HAIR_GLTF_U32;
    if (value &&
        !is_kind(at, object, "indices", &accessor, accessor.components == 1 && whole, "whole numbers"))
        return false;
    if (accessor.count % 3) {
        hair_complain(at->tool, "%s: %s%s has %u elements, not a multiple of 3", at->path, at->place,
                      value ? "indices" : "attributes.POSITION", accessor.count);
        return false;
    }
    out->triangles = hair_gltf_take(reader, at, accessor.count, sizeof *out->triangles);
    if (!out->triangles) return false;
    out->triangle_count = accessor.count / 3;
    for (uint32_t i = 0; i < accessor.count; ++i)
        out->triangles[i] = value ? hair_gltf_whole(&accessor, i, 0) : i;
    return check_indices(at, out);
}

// Joints ------------------------------------------------------------------------------------------

// Divide weights by their sum. A joint without weight becomes joint 0.
static bool normalize_weights(const struct hair_json* at, struct hair_gltf_primitive* out)
{
    for (uint32_t i = 0; i < out->vertex_count; ++i) {
        float *weight = out->weights + 4 * (size_t)i, sum = 0;
        uint16_t* joint = out->joints + 4 * (size_t)i;
        for (int k = 0; k < 4; ++k) {
            if (!(weight[k] >= 0)) {
                hair_complain(at->tool, "%s: %sWEIGHTS_0 has %g in element %u, not in [0, 1]", at->path,
                              at->place, (double)weight[k], i);
                return false;
            }
            sum += weight[k];
        }
        if (sum < MIN_WEIGHT) {
            hair_complain(at->tool, "%s: %sWEIGHTS_0 has the sum %g in element %u, not 1", at->path,
                          at->place, (double)sum, i);
            return false;
        }
        for (int k = 0; k < 4; ++k) {
            weight[k] /= sum;
            if (weight[k] == 0) joint[k] = 0;
            if (joint[k] >= out->joint_end) out->joint_end = joint[k] + 1u;
        }
    }
    return true;
}

static bool read_joints(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* attributes,
                        struct hair_gltf_primitive* out)
{
    const json_t *joints = json_object_get(attributes, "JOINTS_0"),
                 *weights = json_object_get(attributes, "WEIGHTS_0");
    struct hair_gltf_accessor joint, weight;
    if (!joints && !weights) return true;
    if (!joints || !weights)
        return hair_json_refuse(at, joints ? "WEIGHTS_0" : "JOINTS_0", NULL,
                                "given with the other of the two");
    if (!hair_gltf_find(reader, at, attributes, "JOINTS_0", &joint) ||
        !hair_gltf_find(reader, at, attributes, "WEIGHTS_0", &weight))
        return false;
    bool ok = joint.components == 4 && (joint.component == HAIR_GLTF_U8 || joint.component == HAIR_GLTF_U16);
    if (!is_kind(at, attributes, "JOINTS_0", &joint, ok, "4 unsigned bytes or shorts")) return false;
    bool fraction =
        weight.component == HAIR_GLTF_F32 ||
        (weight.normalized && (weight.component == HAIR_GLTF_U8 || weight.component == HAIR_GLTF_U16));
    if (!is_kind(at, attributes, "WEIGHTS_0", &weight, weight.components == 4 && fraction,
                 "4 floats, or 4 normalized unsigned bytes or shorts"))
        return false;
    if (joint.count != out->vertex_count || weight.count != out->vertex_count)
        return hair_json_refuse(at, joint.count != out->vertex_count ? "JOINTS_0" : "WEIGHTS_0",
                                joint.count != out->vertex_count ? joints : weights,
                                "an accessor with as many elements as POSITION");
    out->joints = hair_gltf_take(reader, at, joint.count, 4 * sizeof *out->joints);
    out->weights = hair_gltf_take(reader, at, joint.count, 4 * sizeof *out->weights);
    if (!out->joints || !out->weights || !hair_gltf_floats(at, "WEIGHTS_0", &weight, 1.001f, out->weights))
        return false;
    for (uint32_t i = 0; i < joint.count; ++i)
        for (uint32_t k = 0; k < 4; ++k)
            out->joints[4 * (size_t)i + k] = (uint16_t)hair_gltf_whole(&joint, i, k);
    return normalize_weights(at, out);
}

// Meshes ------------------------------------------------------------------------------------------

static bool read_color(const struct hair_gltf_reader* reader, const struct hair_json* at,
                       const json_t* object, float color[3])
{
    const json_t* array;
    uint32_t count, index;
    float rgba[4] = {1, 1, 1, 1};
    for (int k = 0; k < 3; ++k) color[k] = 0.8f; // Paper white shows no shape.
    if (!json_object_get(object, "material")) return true;
    if (!hair_json_objects(&reader->json, reader->root, "materials", &array, &count)) return false;
    if (!count)
        return hair_json_refuse(&reader->json, "materials", array, "an array with the materials of meshes");
    if (!hair_json_count(at, object, "material", 0, count - 1, &index)) return false;
    char place[HAIR_GLTF_PLACE];
    struct hair_json inside = hair_gltf_at(&reader->json, place, "materials", index);
    const json_t* metal = json_object_get(json_array_get(array, index), "pbrMetallicRoughness");
    if (!json_object_get(metal, "baseColorFactor")) return true;
    if (!hair_json_floats(&inside, metal, "baseColorFactor", 4, 0, 1, rgba)) return false;
    memcpy(color, rgba, 3 * sizeof *color);
    return true;
}

static bool read_primitive(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                           struct hair_gltf_primitive* out)
{
    char place[HAIR_GLTF_PLACE];
    const json_t* attributes = json_object_get(object, "attributes");
    struct hair_json inside = {at->tool, at->path, place};
    snprintf(place, sizeof place, "%sattributes.", at->place);
    if (!json_is_object(attributes)) return hair_json_refuse(at, "attributes", attributes, "an object");
    if (json_object_get(object, "targets")) reader->ignored |= HAIR_GLTF_IGNORED_MORPHS;
    if (json_object_get(attributes, "JOINTS_1")) reader->ignored |= HAIR_GLTF_IGNORED_JOINTS;
    out->positions = read_vectors(reader, &inside, attributes, "POSITION", &out->vertex_count);
    return out->positions && read_triangles(reader, at, object, out) &&
           read_normals(reader, &inside, attributes, out) && read_joints(reader, &inside, attributes, out) &&
           read_color(reader, at, object, out->color);
}

static bool read_mesh(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                      struct hair_gltf_mesh* out)
{
    const json_t* array;
    uint32_t count, mode;
    if (!hair_json_objects(at, object, "primitives", &array, &count)) return false;
    if (!count) return hair_json_refuse(at, "primitives", array, "an array of at least 1 object");
    out->primitives = hair_gltf_alloc(reader, count, sizeof *out->primitives);
    if (!out->primitives) return false;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json inside = hair_gltf_at(at, place, "primitives", i);
        const json_t* primitive = json_array_get(array, i);
        mode = 4;
        if (json_object_get(primitive, "mode") && !hair_json_count(&inside, primitive, "mode", 0, 6, &mode))
            return false;
        if (mode != 4) {
            reader->ignored |= HAIR_GLTF_IGNORED_MODES;
            continue;
        }
        if (!read_primitive(reader, &inside, primitive, &out->primitives[out->primitive_count++]))
            return false;
    }
    return true;
}

bool hair_gltf_read_meshes(struct hair_gltf_reader* reader)
{
    const json_t* array;
    uint32_t count;
    if (!hair_json_objects(&reader->json, reader->root, "meshes", &array, &count)) return false;
    reader->out->meshes = hair_gltf_alloc(reader, count, sizeof *reader->out->meshes);
    if (!reader->out->meshes) return false;
    reader->out->mesh_count = count;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json at = hair_gltf_at(&reader->json, place, "meshes", i);
        if (!read_mesh(reader, &at, json_array_get(array, i), &reader->out->meshes[i])) return false;
    }
    return true;
}
