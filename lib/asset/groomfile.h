// groomfile.h - the chunks of .groom files, shared by their reader and writer.
//
//   byte  0  "GROOM", 13, 10, 26               chunk  0  four letters, below
//         8  u32 version, 1                           4  u64 bytes of the content
//        12  u32 chunks                              12  u32 CRC-32 of bytes 0 to 11 and content
//        16  u64 bytes of the file                   16  content
//        24  u32 CRC-32 of bytes 0 to 23
//        28  u32 0
//        32  chunks, in any order
//
//   STRD  u32 strands, u32 vertices of all, u32 set (0 all strands, 1 guides), and for each strand
//         u8 its vertices - 1. Strands have 2 to 256 vertices.
//   CURV  f32[3] root of each strand, u8 step of each, u32 widths of each, track (track.h) of each.
//         A step is 128 + the power of 2 of the unit of the track, m. A step of 0 means that the
//         track has the bits of f32 positions instead, axis by axis, and widths of 0.
//   RADI  f32 radius of each strand at its root, m.
//   GRUP  u8 group of each strand.
//   COLR  u16[3] colour of each strand at its root, u32 widths of each, tracks of each with 8
//         colours at even places. A number n is the linear reflectance (n / 65535)^2.
//   SCLP  u32 vertices, u32 triangles, f32[3] positions, u32[3] corners.
//   DENS  f32 density of followers at each vertex of the scalp.
//   TEXC  f32[2] texture coordinates of each vertex of the scalp.
//   SKIN  u32 joints, u16[4] joints of each vertex of the scalp, f32[4] weights of each.
//   JNTN  Names of the joints of SKIN in UTF-8, each followed by a byte 0.
//   GUID  u8 1 for each strand that is a guide, otherwise 0. Sets of guides do not have it.
//   ATTR  char[32] name, f32 factor of each strand. The name is that of a value of
//         hair_strand_attribute_kind, such as "stiffness", filled up with bytes 0.
//   MAPS  char[32] name, u32 index, u32 source, u32 width, u32 height, f32 values. The source is
//         that of hair_map. The name is "set_density" or "set_thickness", and the index that of a
//         map set, or the name is that of a kind, and the index is 0.
//
// STRD and CURV are required. ATTR and MAPS may stand again, ATTR with another name. Maps of one
// kind multiply each other. A map of source 0 has no values. A set with no other map has one for
// its density. Readers skip chunks of unknown letters or names.
//
#ifndef HAIR_ASSET_GROOMFILE_H
#define HAIR_ASSET_GROOMFILE_H

#include "lib/asset/formats.h"

#define HAIR_GROOMFILE_MAGIC "GROOM\r\n\x1a" // 8 bytes
#define HAIR_GROOMFILE_HEADER 32
#define HAIR_GROOMFILE_CHUNK 16 // bytes before the content of a chunk
#define HAIR_GROOMFILE_VERSION 1
#define HAIR_GROOMFILE_MAX_BYTES ((uint64_t)4 << 30)

enum hair_groom_letters {
    HAIR_CHUNK_STRANDS,
    HAIR_CHUNK_CURVES,
    HAIR_CHUNK_RADII,
    HAIR_CHUNK_GROUPS,
    HAIR_CHUNK_COLORS,
    HAIR_CHUNK_SCALP,
    HAIR_CHUNK_DENSITY,
    HAIR_CHUNK_UVS,
    HAIR_CHUNK_SKIN,
    HAIR_CHUNK_JOINT_NAMES,
    HAIR_CHUNK_GUIDES,
    HAIR_CHUNK_COUNT
};
extern const char hair_groom_letters[HAIR_CHUNK_COUNT][5];

// Letters of the chunks that may stand several times, with names.
#define HAIR_GROOM_FACTORS "ATTR"
#define HAIR_GROOM_MAP "MAPS"
// Maximum number of these chunks that an asset is written as.
#define HAIR_NAMED_CHUNKS (HAIR_ATTRIBUTE_KINDS + 2 * HAIR_MAP_SETS + HAIR_MAX_ATTRIBUTES)

// A chunk of a file being read.
struct hair_groom_chunk {
    const struct hair_source* source;
    const char* letters; // NULL if the file does not have the chunk
    size_t at; // byte of the letters
    size_t size; // of the content
    const unsigned char* content;
};

// Fail with a sentence about a chunk.
#define HAIR_FAIL_CHUNK(chunk, format, ...)                                                                  \
    hair_fail((chunk)->source->host, HAIR_ERROR_FILE, "the chunk \"%s\" at byte %zu " format,                \
              (chunk)->letters, (chunk)->at, __VA_ARGS__)

// Find the chunks of a file. Fail unless all are whole and those that are required are there.
hair_result hair_find_groom_chunks(const struct hair_source* source,
                                   struct hair_groom_chunk chunks[HAIR_CHUNK_COUNT]);

// Allocate floats and read them from byte `at` of the content. Fail unless they are in a range.
hair_result hair_read_groom_floats(const struct hair_groom_chunk* chunk, size_t at, size_t count,
                                   struct hair_attribute_range range, float** out);

// Fail unless the content of a chunk has exactly this size.
hair_result hair_check_chunk_size(const struct hair_groom_chunk* chunk, uint64_t size);

// Fail unless a chunk has the tracks of strands, `each` fixed bytes before the widths of a strand.
// `counts` are numbers of points per strand, minus 1. NULL stands for the number of colours.
hair_result hair_check_tracks(const struct hair_groom_chunk* chunk, uint32_t strands,
                              const unsigned char* counts, uint32_t each);

// Read chunks into an asset whose strands are allocated. Each function checks the chunk first.
hair_result hair_check_curves(const struct hair_groom_chunk* chunk, uint32_t strands,
                              const unsigned char* counts);
void hair_read_curves(const struct hair_groom_chunk* chunk, struct hair_strands* strands);
hair_result hair_read_groom_colors(const struct hair_groom_chunk* chunk, struct hair_strands* strands);
// Read the chunks of the scalp among all chunks.
hair_result hair_read_groom_scalp(const struct hair_groom_chunk chunks[HAIR_CHUNK_COUNT], hair_asset* asset);

// Read the chunks with names of a file whose chunks are whole, after strands and scalp.
hair_result hair_read_named_chunks(const struct hair_source* source, hair_asset* asset);

// Return the letters of a chunk with a name, of HAIR_NAMED_CHUNKS.
const char* hair_named_letters(uint32_t index);
// Write its content, as below. Return 0 if the asset has no such content.
uint64_t hair_write_named_chunk(const hair_asset* asset, uint32_t index, unsigned char* at);

// Write the content of a chunk. Return its size. `at` of NULL only measures.
uint64_t hair_write_curves(const struct hair_strands* strands, unsigned char* at);
uint64_t hair_write_groom_colors(const struct hair_strands* strands, unsigned char* at);
unsigned char* hair_write_floats(unsigned char* at, const float* values, size_t count);

#endif
