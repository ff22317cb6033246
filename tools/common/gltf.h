// gltf.h - Skinned meshes with their joints and animations, from glTF 2.0 files.
#ifndef HAIR_TOOLS_COMMON_GLTF_H
#define HAIR_TOOLS_COMMON_GLTF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define HAIR_GLTF_NAME 64 // bytes of a name, with the 0 at its end
#define HAIR_GLTF_NONE UINT32_MAX // index of nothing

// A node. Its own transform is translation, rotation and scale, or a matrix.
struct hair_gltf_node {
    char name[HAIR_GLTF_NAME];
    uint32_t parent, mesh, skin; // HAIR_GLTF_NONE if there is none
    float translation[3];
    float rotation[4]; // unit quaternion, xyzw
    float scale[3];
    float matrix[16]; // column-major
    bool has_matrix;
    bool is_drawn; // part of the scene of the file
};

// Triangles of one material.
struct hair_gltf_primitive {
    float* positions; // xyz
    float* normals; // xyz, unit. Computed if the file has none.
    uint16_t* joints; // four per vertex. NULL if there are none
    float* weights; // four per vertex, with the sum 1. NULL if there are none
    uint32_t* triangles; // three vertices each
    uint32_t vertex_count, triangle_count;
    uint32_t joint_end; // number of joints that the skin must have
    float color[3]; // linear base colour
};

struct hair_gltf_mesh {
    struct hair_gltf_primitive* primitives;
    uint32_t primitive_count;
};

struct hair_gltf_skin {
    uint32_t* joints; // nodes
    float* inverse_binds; // column-major matrix per joint
    uint32_t joint_count;
};

enum hair_gltf_path { HAIR_GLTF_TRANSLATION, HAIR_GLTF_ROTATION, HAIR_GLTF_SCALE, HAIR_GLTF_PATHS };
enum hair_gltf_interpolation { HAIR_GLTF_LINEAR, HAIR_GLTF_STEP, HAIR_GLTF_CUBICSPLINE };

// Keys of one property of a node.
struct hair_gltf_channel {
    uint32_t node;
    enum hair_gltf_path path;
    enum hair_gltf_interpolation interpolation;
    float* times; // s, increasing
    // Three or four numbers per key. A key of HAIR_GLTF_CUBICSPLINE has an in-tangent, a value
    // and an out-tangent.
    float* values;
    uint32_t key_count;
};

struct hair_gltf_animation {
    char name[HAIR_GLTF_NAME];
    struct hair_gltf_channel* channels; // in order of nodes
    uint32_t channel_count;
    float duration; // time of the last key, s
};

struct hair_gltf {
    struct hair_gltf_node* nodes;
    uint32_t* order; // nodes, each after its parent
    struct hair_gltf_mesh* meshes;
    struct hair_gltf_skin* skins;
    struct hair_gltf_animation* animations;
    uint32_t node_count, mesh_count, skin_count, animation_count;
};

// Read a .glb or .gltf file of at most 1 GiB, with the files beside it that it names. Return false
// after printing an error that names the member of the file. Release with hair_gltf_free().
bool hair_gltf_read(const char* tool, const char* path, struct hair_gltf* out);
// Read a file from `size` bytes. `path` names the file in messages. Names of other files start at
// its folder.
bool hair_gltf_parse(const char* tool, const char* path, const unsigned char* bytes, size_t size,
                     struct hair_gltf* out);
void hair_gltf_free(struct hair_gltf* gltf);

// Write three or four numbers of a channel at a time, in s. Rotations are unit quaternions. The
// first key holds before its time, the last key after its time.
void hair_gltf_sample(const struct hair_gltf_channel* channel, float time, float out[4]);

// Compute the matrix from each node to the world, column-major, at a time of an animation, in s.
// HAIR_GLTF_NONE selects the nodes at rest. `world` has 16 numbers per node.
void hair_gltf_pose(const struct hair_gltf* gltf, uint32_t animation, float time, float* world);

#endif
