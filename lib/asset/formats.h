// formats.h - what the readers and writers of the single formats share.
#ifndef HAIR_ASSET_FORMATS_H
#define HAIR_ASSET_FORMATS_H

#include "lib/asset/asset.h"
#include "lib/base/bytes.h"

#include <stdbool.h>
#include <string.h>

// A file being read.
struct hair_source {
    const hair_host* host;
    const hair_import* import;
    const unsigned char* bytes;
    size_t size;
};

// Whether the first bytes are of the format.
bool hair_is_hairfile(const unsigned char* bytes, size_t size);
bool hair_is_tfx3(const unsigned char* bytes, size_t size);
bool hair_is_tfx4(const unsigned char* bytes, size_t size);
bool hair_is_tfx_text(const unsigned char* bytes, size_t size);

// Fill the asset's strands as the file has them. What a failure leaves in them is freed by the caller.
hair_result hair_decode_hairfile(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_tfx3(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_tfx4(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_tfx_text(const struct hair_source* source, hair_asset* asset);

// Bytes needed; HAIR_ERROR_ARGUMENT where the format cannot hold the asset.
hair_result hair_size_hairfile(const hair_asset* asset, size_t* size);
hair_result hair_size_tfx4(const hair_asset* asset, size_t* size);
void hair_encode_hairfile(const hair_asset* asset, unsigned char* bytes);
void hair_encode_tfx4(const hair_asset* asset, unsigned char* bytes);

// Fails, naming `what`, unless `count` items of `size` bytes each lie within the file from `offset` on.
hair_result hair_check_section(const struct hair_source* source, const char* what, uint64_t offset,
                               uint64_t count, uint32_t size);

// rgb per vertex as sRGB, `size` bytes from one to the next, which lie within the file: of strands that have their positions.
// With one that is not in [0, 1] none is used, which a warning says.
hair_result hair_read_colors(const struct hair_source* source, size_t at, size_t size,
                             struct hair_strands* strands);

// The same for a file, with a channel of 1 after them where `channels` is 4.
unsigned char* hair_write_colors(const struct hair_strands* strands, int channels, unsigned char* at);

// Memory for the strands of a file whose size has been checked to hold them.
hair_result hair_strands_allocate(const hair_host* host, struct hair_strands* strands, uint32_t strand_count,
                                  uint32_t vertex_count);

#endif
