// save_fields.h - the fields of a saved state, in order.
#ifndef HAIR_SIM_SAVE_FIELDS_H
#define HAIR_SIM_SAVE_FIELDS_H

#include "lib/sim/serializer.h"
#include "lib/sim/sim.h"

// Version of the fields and of their meaning. Raise it with any change of these.
#define HAIR_SAVE_VERSION 15
#define HAIR_SAVE_HEADER 20 // Bytes before the fields.
#define HAIR_SAVE_TRAILER 8 // Bytes after the fields.

// Loaded arrays, before they are checked and collision meshes are held.
struct hair_loaded {
    struct hair_loaded_colliders {
        hair_collider* collider;
        uint32_t count;
    } now, before;
    struct hair_resolved_pin* resolved_pin; // Pins.
    uint32_t pins;
};

// Complete the bytes of a saved state, the fields of which have been written: the header and the
// hash. `size` counts all bytes.
void hair_sim_seal_state(unsigned char* bytes, size_t size);

// Serialize all fields in order. They identify the haircut, and hold all that the coming motion
// depends on. Arrays are read into `loaded`, which the caller frees.
void hair_sim_serialize(struct hair_serializer* s, struct hair_sim* sim, struct hair_loaded* loaded);

#endif
