// frame_hash.c - Hashes of the guides and of the pixels of all frames.
#include "tools/common/frame_hash.h"
#include "tools/common/file.h"

#include <stdio.h>
#include <stdlib.h>

int hair_frame_hash_create(const char* tool, uint32_t vertices, struct hair_frame_hash* hash)
{
    hash->vertices = vertices;
    hash->positions = malloc(((size_t)vertices + 1) * 3 * sizeof(float));
    hash->strands = XXH3_createState();
    hash->pixels = XXH3_createState();
    if (!hash->positions || !hash->strands || !hash->pixels) {
        hair_complain(tool, "out of memory for hashes");
        return HAIR_EXIT_RUNTIME;
    }
    XXH3_64bits_reset(hash->strands);
    XXH3_64bits_reset(hash->pixels);
    return HAIR_EXIT_OK;
}

hair_result hair_frame_hash_add(struct hair_frame_hash* hash, hair_instance* hair,
                                const struct hair_image* image)
{
    uint32_t count;
    hair_result result = hair_read_positions(hair, HAIR_READ_GUIDES, hash->positions, hash->vertices, &count);
    if (result) return result;
    XXH3_64bits_update(hash->strands, hash->positions, (size_t)count * 3 * sizeof(float));
    XXH3_64bits_update(hash->pixels, image->encoded, (size_t)image->width * image->height * 3);
    return HAIR_OK;
}

int hair_frame_hash_print(const char* tool, const struct hair_frame_hash* hash)
{
    printf("strands %016llx\npixels %016llx\n", (unsigned long long)XXH3_64bits_digest(hash->strands),
           (unsigned long long)XXH3_64bits_digest(hash->pixels));
    return hair_flush(tool);
}

void hair_frame_hash_free(struct hair_frame_hash* hash)
{
    XXH3_freeState(hash->strands);
    XXH3_freeState(hash->pixels);
    free(hash->positions);
    *hash = (struct hair_frame_hash){0};
}
