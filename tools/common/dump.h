// dump.h - A file of the positions of all strands in every frame, for hair-convert.
//
//   byte  0  "HAIRDUMP"
//         8  u32 version, 1
//        12  u32 strands
//        16  u32 vertices of each strand
//        20  u32 frames
//        24  u32 number of the first frame
//        28  u32 0 for guides as drawn, 1 for followers
//        32  f64 frames a second
//        40  f32[3] positions in the world, m, +y up, frame after frame, strand after strand, from
//            root to tip
//
// All numbers are little-endian.
#ifndef HAIR_TOOLS_COMMON_DUMP_H
#define HAIR_TOOLS_COMMON_DUMP_H

#include "tools/common/file.h"

struct hair_dump {
    const char* tool;
    const char* path;
    hair_read_source source; // HAIR_READ_SMOOTH or HAIR_READ_FOLLOWERS
    struct hair_output output;
    float* positions; // positions of one frame
    uint32_t strands, vertices; // vertices of each strand
};

// Numbers of the frames of a dump.
struct hair_dump_frames {
    uint32_t first, count;
    double fps;
};

// Open a dump and write its header. `path` NULL does nothing and succeeds. Call hair_dump_put() for
// each frame, then exactly one of hair_dump_commit() and hair_dump_discard(). Return an exit status
// for the tool, after printing any error.
int hair_dump_open(const char* tool, const char* path, hair_read_source source, hair_instance* hair,
                   const struct hair_dump_frames* frames, struct hair_dump* dump);
int hair_dump_put(struct hair_dump* dump, hair_instance* hair);
int hair_dump_commit(struct hair_dump* dump);
void hair_dump_discard(struct hair_dump* dump);

#endif
