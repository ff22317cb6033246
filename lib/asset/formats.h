// formats.h - declarations shared by the readers and writers of the formats.
#ifndef HAIR_ASSET_FORMATS_H
#define HAIR_ASSET_FORMATS_H

#include "lib/asset/asset.h"
#include "lib/base/bytes.h"

#include <stdbool.h>
#include <string.h>

// Maximum counts that a file may claim, and the maximum size of a text. hair_asset.h states them.
#define HAIR_FILE_MAX_STRANDS 16777216u
#define HAIR_FILE_MAX_VERTICES 67108864u
#define HAIR_TEXT_MAX_BYTES ((size_t)256 << 20)

// A file being read.
struct hair_source {
    const hair_host* host;
    const hair_import* import;
    const unsigned char* bytes;
    size_t size;
};

// Return whether the first bytes belong to the format.
bool hair_is_hairfile(const unsigned char* bytes, size_t size);
bool hair_is_groomfile(const unsigned char* bytes, size_t size);
bool hair_is_tfx3(const unsigned char* bytes, size_t size);
bool hair_is_tfx4(const unsigned char* bytes, size_t size);
bool hair_is_tfx_text(const unsigned char* bytes, size_t size);

// Return the number of bytes that the reader of the format can need, by the header. If the header
// is refused, that is the size of the header.
uint64_t hair_max_size_of_hairfile(const unsigned char* bytes, size_t size);
uint64_t hair_max_size_of_groomfile(const unsigned char* bytes, size_t size);
uint64_t hair_max_size_of_tfx3(const unsigned char* bytes, size_t size);
uint64_t hair_max_size_of_tfx4(const unsigned char* bytes, size_t size);
uint64_t hair_max_size_of_tfx_text(const unsigned char* bytes, size_t size);

// Fill the asset's strands as the file has them. On failure the caller frees what they contain.
hair_result hair_decode_hairfile(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_groomfile(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_tfx3(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_tfx4(const struct hair_source* source, hair_asset* asset);
hair_result hair_decode_tfx_text(const struct hair_source* source, hair_asset* asset);

// Compute the number of bytes needed. Return HAIR_ERROR_ARGUMENT if the format cannot hold the
// asset.
hair_result hair_size_hairfile(const hair_asset* asset, size_t* size);
hair_result hair_size_groomfile(const hair_asset* asset, size_t* size);
hair_result hair_size_tfx4(const hair_asset* asset, size_t* size);
void hair_encode_hairfile(const hair_asset* asset, unsigned char* bytes);
void hair_encode_groomfile(const hair_asset* asset, unsigned char* bytes);
void hair_encode_tfx4(const hair_asset* asset, unsigned char* bytes);

// Return whether a file may claim these counts.
bool hair_counts_are_allowed(uint64_t strands, uint64_t vertices);
// Fail unless the file may claim these counts, which its header has from byte 4 on.
hair_result hair_check_counts(const struct hair_source* source, uint64_t strands, uint64_t vertices);

// Fail, naming `what`, unless `count` items of `size` bytes each lie within the file from `offset`
// on.
hair_result hair_check_section(const struct hair_source* source, const char* what, uint64_t offset,
                               uint64_t count, uint32_t size);

// Read the colours of strands that have their positions. Colours are sRGB per vertex, `size` bytes
// apart, and lie within the file. If a value is not in [0, 1], a warning is logged and no colours
// are used.
hair_result hair_read_colors(const struct hair_source* source, size_t at, size_t size,
                             struct hair_strands* strands);

// Write the colours as sRGB per vertex, with a fourth channel of 1 if `channels` is 4. Return the
// end.
unsigned char* hair_write_colors(const struct hair_strands* strands, int channels, unsigned char* at);

// Allocate the strands of a file whose size has been checked to hold them.
hair_result hair_strands_allocate(const hair_host* host, struct hair_strands* strands, uint32_t strand_count,
                                  uint32_t vertex_count);

#endif
