// frame_hash.h - Hashes of the guides and of the pixels of all frames.
#ifndef HAIR_TOOLS_COMMON_FRAME_HASH_H
#define HAIR_TOOLS_COMMON_FRAME_HASH_H

#include <hair/hair.h>
#include <xxhash.h>

#include "tools/common/image.h"

struct hair_frame_hash {
    float* positions; // positions of all guides
    uint32_t vertices; // number of their vertices
    XXH3_state_t* strands;
    XXH3_state_t* pixels;
};

// Return an exit status for the tool, after printing any error. Free the hash also after a failure.
int hair_frame_hash_create(const char* tool, uint32_t vertices, struct hair_frame_hash* hash);
// Add the guides and the pixels of a frame.
hair_result hair_frame_hash_add(struct hair_frame_hash* hash, hair_instance* hair,
                                const struct hair_image* image);
// Print both hashes to the standard output. Return an exit status.
int hair_frame_hash_print(const char* tool, const struct hair_frame_hash* hash);
void hair_frame_hash_free(struct hair_frame_hash* hash);

#endif
