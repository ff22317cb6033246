// save_fields.h - the fields of a saved state, in order.
#ifndef HAIR_SIM_SAVE_FIELDS_H
#define HAIR_SIM_SAVE_FIELDS_H

#include "lib/sim/serializer.h"
#include "lib/sim/sim.h"

// Version of the fields and of their meaning. Raise it with any change of these.
#define HAIR_SAVE_VERSION 16

// Bytes before the fields of a saved state and after them.
#define HAIR_SAVE_HEADER 20
#define HAIR_SAVE_TRAILER 8

// Bits of the first field of a saved state.
#define HAIR_SAVE_SKINNED 1u // The scalp is skinned.
#define HAIR_SAVE_TARGETS 2u // Guides have targets.
#define HAIR_SAVE_LENGTHS 4u // Strands have been cut.
#define HAIR_SAVE_MARKS (HAIR_SAVE_SKINNED | HAIR_SAVE_TARGETS | HAIR_SAVE_LENGTHS)

// Loaded arrays, before they are checked and collision meshes are held.
struct hair_loaded {
    struct hair_loaded_colliders {
        hair_collider* collider;
        uint32_t count;
    } now, before;
    struct hair_resolved_pin* resolved_pin; // Pins.
    uint32_t pins;
    // Fractions of the lengths of guides and followers. NULL for whole strands.
    float *guide_fraction, *follower_fraction;
    uint32_t anchors; // Index of the serializer's buffer that hair_sim_load() creates.
    bool has_anchors;
};

// Serialize all fields in order. They identify the haircut, and hold all that the coming motion
// depends on. Arrays are read into `loaded`, which the caller frees.
void hair_sim_serialize(struct hair_serializer* s, struct hair_sim* sim, struct hair_loaded* loaded);

// Functions of save_check.c, which need no OpenGL.

// Check the header of a saved state, its size and its hash.
hair_result hair_save_check(const hair_host* host, const unsigned char* bytes, size_t size);
// Write the header and the hash around fields that end at `end`.
void hair_save_seal(unsigned char* bytes, size_t end);
// Read and check the fields. Fill in `sim`, which is a copy, and `loaded`, `colliders` and
// s->native.
hair_result hair_save_read(struct hair_serializer* s, struct hair_sim* sim, struct hair_loaded* loaded,
                           struct hair_colliders* colliders);

#endif
