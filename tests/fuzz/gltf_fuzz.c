// gltf_fuzz.c - fuzz target of the glTF files of the tools, with poses of what is accepted.
#include "tests/fuzz/fuzz.h"
#include "tools/common/gltf.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static void check_primitive(const struct hair_gltf_primitive* primitive, uint64_t* hash)
{
    size_t vertices = primitive->vertex_count;
    for (size_t i = 0; i < 3 * vertices; ++i) {
        HAIR_FUZZ_CHECK(fabsf(primitive->positions[i]) <= 1e6f);
        HAIR_FUZZ_CHECK(fabsf(primitive->normals[i]) <= 1.001f);
    }
    for (size_t i = 0; i < 3 * (size_t)primitive->triangle_count; ++i) {
        HAIR_FUZZ_CHECK(primitive->triangles[i] < vertices);
        hair_fuzz_add(hash, primitive->triangles[i]);
    }
    for (size_t i = 0; i < 4 * vertices && primitive->joints; ++i) {
        HAIR_FUZZ_CHECK(primitive->weights[i] >= 0 && primitive->weights[i] <= 1.001f);
        HAIR_FUZZ_CHECK(primitive->joints[i] < primitive->joint_end);
        hair_fuzz_add(hash, primitive->joints[i]);
    }
    hair_fuzz_add_floats(hash, primitive->positions, 3 * vertices);
}

// Check that each node comes after its parent, and that skins fit their meshes.
static void check_nodes(const struct hair_gltf* gltf)
{
    bool* seen = calloc(gltf->node_count + 1, sizeof *seen);
    HAIR_FUZZ_CHECK(seen);
    for (uint32_t i = 0; i < gltf->node_count; ++i) {
        uint32_t at = gltf->order[i];
        HAIR_FUZZ_CHECK(at < gltf->node_count && !seen[at]);
        const struct hair_gltf_node* node = &gltf->nodes[at];
        HAIR_FUZZ_CHECK(node->parent == HAIR_GLTF_NONE || seen[node->parent]);
        seen[at] = true;
        HAIR_FUZZ_CHECK(node->mesh == HAIR_GLTF_NONE || node->mesh < gltf->mesh_count);
        HAIR_FUZZ_CHECK(node->skin == HAIR_GLTF_NONE || node->skin < gltf->skin_count);
        if (node->mesh == HAIR_GLTF_NONE || node->skin == HAIR_GLTF_NONE) continue;
        const struct hair_gltf_mesh* mesh = &gltf->meshes[node->mesh];
        for (uint32_t k = 0; k < mesh->primitive_count; ++k)
            HAIR_FUZZ_CHECK(mesh->primitives[k].joints &&
                            mesh->primitives[k].joint_end <= gltf->skins[node->skin].joint_count);
    }
    for (uint32_t i = 0; i < gltf->skin_count; ++i)
        for (uint32_t k = 0; k < gltf->skins[i].joint_count; ++k)
            HAIR_FUZZ_CHECK(gltf->skins[i].joints[k] < gltf->node_count);
    free(seen);
}

// Check that rotations of every animation are unit quaternions at, between and beyond the keys.
static void check_animation(const struct hair_gltf* gltf, uint32_t i, float* world, uint64_t* hash)
{
    const struct hair_gltf_animation* animation = &gltf->animations[i];
    for (uint32_t k = 0; k < animation->channel_count; ++k) {
        const struct hair_gltf_channel* channel = &animation->channels[k];
        HAIR_FUZZ_CHECK(channel->node < gltf->node_count && channel->key_count >= 1);
        const float times[] = {-1, channel->times[0], 0.5f * animation->duration, animation->duration, 1e9f};
        for (int t = 0; t < 5; ++t) {
            float out[4] = {0}, square = 0;
            hair_gltf_sample(channel, times[t], out);
            for (int c = 0; c < 4; ++c) square += out[c] * out[c];
            HAIR_FUZZ_CHECK(channel->path != HAIR_GLTF_ROTATION || fabsf(square - 1) < 1e-3f);
        }
        hair_fuzz_add_floats(hash, channel->times, channel->key_count);
    }
    hair_gltf_pose(gltf, i, 0.5f * animation->duration, world);
}

HAIR_FUZZ(gltf)
{
    struct hair_gltf gltf;
    json_set_alloc_funcs(hair_fuzz_alloc, free);
    size_t printed = hair_fuzz_printed();
    if (!hair_gltf_parse("hair-capture", "fuzz.glb", bytes, size, &gltf)) {
        HAIR_FUZZ_CHECK(hair_fuzz_printed() > printed); // A refusal comes with a message.
        HAIR_FUZZ_CHECK(!gltf.nodes && !gltf.meshes && !gltf.skins && !gltf.animations);
        return false;
    }
    hair_fuzz_end_refusals();
    check_nodes(&gltf);
    for (uint32_t i = 0; i < gltf.mesh_count; ++i)
        for (uint32_t k = 0; k < gltf.meshes[i].primitive_count; ++k)
            check_primitive(&gltf.meshes[i].primitives[k], hash);
    float* world = malloc((16 * (size_t)gltf.node_count + 1) * sizeof *world);
    HAIR_FUZZ_CHECK(world);
    hair_gltf_pose(&gltf, HAIR_GLTF_NONE, 0, world);
    for (uint32_t i = 0; i < gltf.animation_count; ++i) check_animation(&gltf, i, world, hash);
    free(world);
    hair_gltf_free(&gltf);
    return true;
}
