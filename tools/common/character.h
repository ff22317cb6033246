// character.h - A skinned character that hair grows on: its mesh in every pose, the body that hair
// collides with, and the scalp.
#ifndef HAIR_TOOLS_COMMON_CHARACTER_H
#define HAIR_TOOLS_COMMON_CHARACTER_H

#include "tools/common/camera.h"
#include "tools/common/gltf.h"
#include "tools/common/head.h"

// The space of the groom is that of the character at rest, in m. The transform of the head takes
// the space of the groom to the world.
struct hair_character {
    const char* tool;
    const char* path;
    struct hair_gltf gltf;
    uint32_t animation; // HAIR_GLTF_NONE if the character has none
    uint32_t head; // node
    float scale; // metres per unit of the file
    float duration; // of the animation, s
    float travel[3]; // way of the head over the whole animation, along x and z, m

    // Skin. Joints are those of all skins, and the nodes of meshes without a skin.
    uint32_t joint_count;
    uint32_t* joint_nodes;
    float* inverse_binds; // matrix per joint
    float* rest_inverses; // inverse of each joint's matrix at rest
    float* matrices; // from the bind pose to the world, matrix per joint
    float* nodes; // matrix per node
    uint16_t* joints; // four per vertex
    float* weights; // four per vertex
    float* bind_positions;
    float* bind_normals;
    float* rest_positions; // in the space of the groom, xyz per vertex
    struct head_mesh mesh; // in the space of the groom, at the present pose
    float transform[16]; // of the head
    float head_at_rest[16]; // matrix of the head's joint

    // Scalp of the groom. The count is 0 if the groom has none.
    uint16_t* scalp_joints; // four per vertex
    float* scalp_weights;
    float* scalp_matrices; // from the groom's space to the world, matrix per joint
    uint32_t scalp_count;

    hair_body* body;
    float box[2][3]; // lower and upper corner of the body
    float* clamped; // positions of the mesh within the box
};

// Read the character of a scene. Return an exit status, after printing any error. A scene without a
// character gives NULL. Destroy the character with hair_character_destroy().
int hair_character_create(const char* tool, const struct hair_scene* scene, struct hair_character** out);
// Return an exit status for a scene whose solver knows no bodies that deform, after printing the
// error. A scene without a character is accepted.
int hair_character_check_solver(const char* tool, const struct hair_scene* scene);
// Destroy a character. NULL is allowed. OpenGL is required if there is a body.
void hair_character_destroy(struct hair_character* character);

// Compute the mesh and the transform of the head at a time, in s. The animation repeats. Return
// false after printing an error, if the pose is not finite.
bool hair_character_pose(struct hair_character* character, float time);
// Compute the transform of the head at a time, in s, by hair_character_pose(). Without a character
// it is that of the motion.
bool hair_character_pose_head(struct hair_character* character, const struct hair_motion* motion, float time,
                              float transform[16]);
// Compute the way of a camera that follows the character, in m.
void hair_character_way(const struct hair_character* character, float time, float out[3]);
// Compute bounds of hair and head in the world from the bounds of the groom.
void hair_character_bounds(const struct hair_character* character, struct hair_bounds* bounds);

// Return whether a vertex moves with the head, or with a joint below.
bool hair_character_is_of_head(const struct hair_character* character, uint32_t vertex);

// Change the haircut such that its roots lie on the head, and bind the scalp to the joints. The
// caller frees *changed after creating the groom. Return an exit status, after printing any error.
int hair_character_fit(struct hair_character* character, const struct hair_scene* scene,
                       hair_groom_desc* desc, float** changed);

// Create the body that hair within `reach` of `pivot` collides with. Afterwards the character has
// the pose of time 0.
hair_result hair_character_create_body(struct hair_character* character, hair_context* context,
                                       const float pivot[3], float reach);
// Bind an instance to the joints, and put its hair at rest in the present pose.
hair_result hair_character_attach(struct hair_character* character, hair_instance* hair);
// Move an instance and its scalp to the pose of hair_character_pose().
hair_result hair_character_move_hair(struct hair_character* character, hair_instance* hair);
// Move an instance, its scalp and the body to the pose of hair_character_pose().
hair_result hair_character_move(struct hair_character* character, hair_instance* hair);
// Return the collider of the body.
hair_collider hair_character_collider(const struct hair_character* character);

#endif
