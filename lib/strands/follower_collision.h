// follower_collision.h - state of follower collision. Its passes, memory and program variants exist
// only while a collider is near the hair.
#ifndef HAIR_STRANDS_FOLLOWER_COLLISION_H
#define HAIR_STRANDS_FOLLOWER_COLLISION_H

#include "lib/field/field.h"
#include "lib/gl/commands.h"

struct hair_follower_collision_state {
    GLuint hit, repair, list; // Buffers, as in shared.h. 0 until needed.
    GLuint hit_texture, repair_texture; // Buffer textures of the first two, for drawing.
    GLuint image, frame; // Image with a texel per follower and its framebuffer, for a prepass.
    int prepass; // Nonzero if a prepass finds the hits.
    int active; // Nonzero if colliders are near.
    const struct hair_collider_field* field; // Field of the colliders. NULL if none are near.
    int valid; // Nonzero if the result is valid. Changes to followers or colliders clear it.
    uint32_t smooth_run; // Run of smooth.comp that the result is for.
    uint32_t generation; // Number of updates so far.
    uint32_t parity; // List counter in use, as in hair_draw_params.
};

#endif
