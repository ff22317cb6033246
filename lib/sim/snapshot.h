// snapshot.h - copies of the state of a simulation on the CPU. They survive the loss of the OpenGL
// context.
//
// A step begins with a copy of the state by the GPU, unless an earlier copy is not done yet. No
// step waits for a copy. The last complete snapshot is therefore a few steps old.
#ifndef HAIR_SIM_SNAPSHOT_H
#define HAIR_SIM_SNAPSHOT_H

#include "lib/sim/serializer.h"

#include <stdbool.h>

// Bytes of a saved state, without header and hash.
struct hair_snapshot {
    unsigned char* bytes;
    size_t size, room; // Used bytes. 0 if there is no state.
};

struct hair_snapshots {
    bool is_wanted;
    struct hair_snapshot last, next; // The last complete snapshot, and the one in progress.
    GLuint buffer; // Buffer that the GPU copies the buffers of `next` to. 0 until needed.
    const unsigned char* mapped; // Contents of `buffer`.
    size_t room; // Size of `buffer`.
    GLsync fence; // Fence behind the copy. NULL if no copy is in progress.
    uint32_t buffers;
    struct hair_serialized_buffer copied[HAIR_SERIALIZER_BUFFERS];
};

struct hair_sim;

// Complete the snapshot in progress if the GPU is done, and then begin the next one.
hair_result hair_snapshots_update(struct hair_sim* sim);
// Load the last complete snapshot of `from` into `sim`, which was created like it. Without a
// snapshot, hair stays at rest.
hair_result hair_snapshots_load(struct hair_sim* sim, struct hair_snapshots* from);
// Move the last complete snapshot of `from` to `to`, which has none.
void hair_snapshots_move(struct hair_snapshots* to, struct hair_snapshots* from);
void hair_snapshots_free(struct hair_sim* sim);

#endif
