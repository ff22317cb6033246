// gltf_animation.c - Animations of a glTF file, and the pose of all nodes at a time.
#include "tools/common/gltf_reader.h"

#include <cglm/cglm.h>

#include <stdlib.h>
#include <string.h>

#define FAR 1e6f // maximum of any value
#define MAX_TIME 1e6f // s

// Reading -----------------------------------------------------------------------------------------

static bool read_times(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* sampler,
                       struct hair_gltf_channel* out)
{
    struct hair_gltf_accessor accessor;
    if (!hair_gltf_find(reader, at, sampler, "input", &accessor)) return false;
    if (accessor.components != 1 || accessor.component != HAIR_GLTF_F32)
        return hair_json_refuse(at, "input", json_object_get(sampler, "input"),
                                "an accessor of single floats");
    out->times = hair_gltf_take(reader, at, accessor.count, sizeof *out->times);
    if (!out->times || !hair_gltf_floats(at, "input", &accessor, MAX_TIME, out->times)) return false;
    out->key_count = accessor.count;
    for (uint32_t i = 0; i < accessor.count; ++i) {
        if (out->times[i] >= 0 && (i == 0 || out->times[i] > out->times[i - 1])) continue;
        hair_complain(at->tool, "%s: %sinput has %g in element %u, not a time above the one before", at->path,
                      at->place, (double)out->times[i], i);
        return false;
    }
    return true;
}

static bool read_values(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* sampler,
                        struct hair_gltf_channel* out)
{
    struct hair_gltf_accessor accessor;
    const json_t* value = json_object_get(sampler, "output");
    if (!hair_gltf_find(reader, at, sampler, "output", &accessor)) return false;
    bool is_rotation = out->path == HAIR_GLTF_ROTATION;
    uint64_t count = (uint64_t)out->key_count * (out->interpolation == HAIR_GLTF_CUBICSPLINE ? 3 : 1);
    bool packed = is_rotation && accessor.normalized && accessor.component != HAIR_GLTF_U32;
    if (accessor.components != (is_rotation ? 4u : 3u) || (accessor.component != HAIR_GLTF_F32 && !packed))
        return hair_json_refuse(at, "output", value,
                                is_rotation ? "an accessor of 4 floats or normalized whole numbers"
                                            : "an accessor of 3 floats");
    if (accessor.count != count) {
        hair_complain(at->tool, "%s: %soutput has %u elements, not the %llu of %u keys", at->path, at->place,
                      accessor.count, (unsigned long long)count, out->key_count);
        return false;
    }
    out->values = hair_gltf_take(reader, at, accessor.count, accessor.components * sizeof *out->values);
    return out->values && hair_gltf_floats(at, "output", &accessor, FAR, out->values);
}

// Check that the quaternions of rotations can be normalized.
static bool check_rotations(const struct hair_json* at, const struct hair_gltf_channel* channel)
{
    bool is_cubic = channel->interpolation == HAIR_GLTF_CUBICSPLINE;
    for (uint32_t i = 0; i < channel->key_count; ++i) {
        const float* q = channel->values + 4 * (size_t)(is_cubic ? 3 * i + 1 : i);
        float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if (square >= 0.8f && square <= 1.25f) continue;
        hair_complain(at->tool, "%s: %soutput has a quaternion of the length %g at key %u, not 1", at->path,
                      at->place, sqrt((double)square), i);
        return false;
    }
    return true;
}

// Return the index of a text among names, or -1 after an error.
static int read_choice(const struct hair_json* at, const json_t* object, const char* key,
                       const char* const* names, int count, const char* must)
{
    const json_t* value = json_object_get(object, key);
    const char* text = json_string_value(value);
    for (int i = 0; text && i < count; ++i)
        if (!strcmp(names[i], text)) return i;
    hair_json_refuse(at, key, value, must);
    return -1;
}

static bool read_sampler(struct hair_gltf_reader* reader, const struct hair_json* animation,
                         const json_t* samplers, uint32_t index, struct hair_gltf_channel* out)
{
    static const char* const names[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    char place[HAIR_GLTF_PLACE];
    struct hair_json at = hair_gltf_at(animation, place, "samplers", index);
    const json_t* sampler = json_array_get(samplers, index);
    if (json_object_get(sampler, "interpolation")) {
        int found =
            read_choice(&at, sampler, "interpolation", names, 3, "\"LINEAR\", \"STEP\" or \"CUBICSPLINE\"");
        if (found < 0) return false;
        out->interpolation = (enum hair_gltf_interpolation)found;
    }
    return read_times(reader, &at, sampler, out) && read_values(reader, &at, sampler, out) &&
           (out->path != HAIR_GLTF_ROTATION || check_rotations(&at, out));
}

// Read a channel. Channels of morph targets and of extensions leave out->key_count at 0.
static bool read_channel(struct hair_gltf_reader* reader, const struct hair_json* animation,
                         const struct hair_json* at, const json_t* object, const json_t* samplers,
                         struct hair_gltf_channel* out)
{
    static const char* const names[] = {"translation", "rotation", "scale", "weights"};
    const json_t* target = json_object_get(object, "target");
    uint32_t sampler, count = (uint32_t)json_array_size(samplers);
    if (!json_is_object(target)) return hair_json_refuse(at, "target", target, "an object");
    char place[HAIR_GLTF_PLACE];
    struct hair_json inside = {at->tool, at->path, place};
    snprintf(place, sizeof place, "%starget.", at->place);
    int path = read_choice(&inside, target, "path", names, 4,
                           "\"translation\", \"rotation\", \"scale\" or \"weights\"");
    if (path < 0) return false;
    if (path == HAIR_GLTF_PATHS) reader->ignored |= HAIR_GLTF_IGNORED_MORPHS;
    if (path == HAIR_GLTF_PATHS || !json_object_get(target, "node")) return true;
    out->path = (enum hair_gltf_path)path;
    if (!reader->out->node_count || !count)
        return hair_json_refuse(at, "sampler", json_object_get(object, "sampler"),
                                "given in a file with nodes and samplers");
    if (!hair_json_count(&inside, target, "node", 0, reader->out->node_count - 1, &out->node)) return false;
    if (reader->out->nodes[out->node].has_matrix)
        return hair_json_refuse(&inside, "node", json_object_get(target, "node"), "a node without a matrix");
    return hair_json_count(at, object, "sampler", 0, count - 1, &sampler) &&
           read_sampler(reader, animation, samplers, sampler, out);
}

static int compare_nodes(const void* a, const void* b)
{
    const struct hair_gltf_channel *one = a, *other = b;
    if (one->node != other->node) return one->node < other->node ? -1 : 1;
    return (int)one->path - (int)other->path;
}

static bool read_animation(struct hair_gltf_reader* reader, const struct hair_json* at, const json_t* object,
                           struct hair_gltf_animation* out)
{
    const json_t *channels, *samplers;
    uint32_t count, sampler_count;
    hair_gltf_name(object, out->name);
    if (!hair_json_objects(at, object, "channels", &channels, &count)) return false;
    if (!hair_json_objects(at, object, "samplers", &samplers, &sampler_count)) return false;
    out->channels = hair_gltf_alloc(reader, count, sizeof *out->channels);
    if (!out->channels) return false;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json inside = hair_gltf_at(at, place, "channels", i);
        struct hair_gltf_channel* channel = &out->channels[out->channel_count++];
        if (!read_channel(reader, at, &inside, json_array_get(channels, i), samplers, channel)) return false;
        if (channel->key_count)
            out->duration = fmaxf(out->duration, channel->times[channel->key_count - 1]);
        else
            --out->channel_count;
    }
    qsort(out->channels, out->channel_count, sizeof *out->channels, compare_nodes);
    return true;
}

bool hair_gltf_read_animations(struct hair_gltf_reader* reader)
{
    const json_t* array;
    uint32_t count;
    if (!hair_json_objects(&reader->json, reader->root, "animations", &array, &count)) return false;
    reader->out->animations = hair_gltf_alloc(reader, count, sizeof *reader->out->animations);
    if (!reader->out->animations) return false;
    reader->out->animation_count = count;
    for (uint32_t i = 0; i < count; ++i) {
        char place[HAIR_GLTF_PLACE];
        struct hair_json at = hair_gltf_at(&reader->json, place, "animations", i);
        if (!read_animation(reader, &at, json_array_get(array, i), &reader->out->animations[i])) return false;
    }
    return true;
}

// Poses -------------------------------------------------------------------------------------------

static void copy_quaternion(const float* from, versor to)
{
    memcpy(to, from, sizeof(versor));
    glm_quat_normalize(to);
}

// Interpolate between keys a and b of cubic splines, h apart in time (glTF 2.0, appendix C).
static void sample_cubic(const float* a, const float* b, uint32_t count, float h, float t, float out[4])
{
    float t2 = t * t, t3 = t2 * t;
    for (uint32_t k = 0; k < count; ++k)
        out[k] = (2 * t3 - 3 * t2 + 1) * a[count + k] + h * (t3 - 2 * t2 + t) * a[2 * count + k] +
                 (3 * t2 - 2 * t3) * b[count + k] + h * (t3 - t2) * b[k];
}

static void sample_linear(const float* a, const float* b, uint32_t count, float t, float out[4])
{
    if (count == 4) {
        versor from, to, turn;
        copy_quaternion(a, from);
        copy_quaternion(b, to);
        glm_quat_slerp(from, to, t, turn);
        memcpy(out, turn, sizeof turn);
        return;
    }
    for (uint32_t k = 0; k < count; ++k) out[k] = a[k] + t * (b[k] - a[k]);
}

void hair_gltf_sample(const struct hair_gltf_channel* channel, float time, float out[4])
{
    uint32_t count = channel->path == HAIR_GLTF_ROTATION ? 4 : 3, low = 0, high = channel->key_count - 1;
    bool is_cubic = channel->interpolation == HAIR_GLTF_CUBICSPLINE;
    size_t size = (size_t)count * (is_cubic ? 3 : 1);
    while (low < high) { // The last key that is not after the time.
        uint32_t middle = low + (high - low + 1) / 2;
        if (channel->times[middle] <= time)
            low = middle;
        else
            high = middle - 1;
    }
    const float *a = channel->values + size * low, *b = a + size;
    bool holds = low + 1 == channel->key_count || time <= channel->times[low] ||
                 channel->interpolation == HAIR_GLTF_STEP;
    if (holds) {
        memcpy(out, is_cubic ? a + count : a, count * sizeof *out);
    } else {
        float h = channel->times[low + 1] - channel->times[low], t = (time - channel->times[low]) / h;
        if (is_cubic)
            sample_cubic(a, b, count, h, t, out);
        else
            sample_linear(a, b, count, t, out);
    }
    if (count == 3) return;
    versor turn;
    copy_quaternion(out, turn);
    memcpy(out, turn, sizeof turn);
}

static void local_matrix(const struct hair_gltf_node* node, mat4 out)
{
    memcpy(out, node->matrix, sizeof(mat4));
    if (node->has_matrix) return;
    versor turn;
    mat4 rotation;
    copy_quaternion(node->rotation, turn);
    glm_translate_make(out, (vec3){node->translation[0], node->translation[1], node->translation[2]});
    glm_quat_mat4(turn, rotation);
    glm_mat4_mul(out, rotation, out);
    glm_scale(out, (vec3){node->scale[0], node->scale[1], node->scale[2]});
}

void hair_gltf_pose(const struct hair_gltf* gltf, uint32_t animation, float time, float* world)
{
    for (uint32_t i = 0; i < gltf->node_count; ++i) {
        mat4 local;
        local_matrix(&gltf->nodes[i], local);
        memcpy(world + 16 * (size_t)i, local, sizeof local);
    }
    if (animation != HAIR_GLTF_NONE) {
        const struct hair_gltf_animation* from = &gltf->animations[animation];
        for (uint32_t i = 0; i < from->channel_count;) {
            // Channels of one node replace the parts of the transform that the node has at rest.
            uint32_t at = from->channels[i].node;
            struct hair_gltf_node node = gltf->nodes[at];
            for (; i < from->channel_count && from->channels[i].node == at; ++i) {
                const struct hair_gltf_channel* channel = &from->channels[i];
                float value[4];
                hair_gltf_sample(channel, time, value);
                if (channel->path == HAIR_GLTF_ROTATION) memcpy(node.rotation, value, sizeof node.rotation);
                if (channel->path == HAIR_GLTF_TRANSLATION)
                    memcpy(node.translation, value, sizeof node.translation);
                if (channel->path == HAIR_GLTF_SCALE) memcpy(node.scale, value, sizeof node.scale);
            }
            mat4 local;
            local_matrix(&node, local);
            memcpy(world + 16 * (size_t)at, local, sizeof local);
        }
    }
    for (uint32_t i = 0; i < gltf->node_count; ++i) {
        uint32_t at = gltf->order[i], parent = gltf->nodes[at].parent;
        if (parent == HAIR_GLTF_NONE) continue;
        mat4 above, own;
        memcpy(above, world + 16 * (size_t)parent, sizeof above);
        memcpy(own, world + 16 * (size_t)at, sizeof own);
        glm_mat4_mul(above, own, own);
        memcpy(world + 16 * (size_t)at, own, sizeof own);
    }
}
