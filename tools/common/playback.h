// playback.h - Playback of a dump of guides (dump.h) as target poses of an instance.
#ifndef HAIR_TOOLS_COMMON_PLAYBACK_H
#define HAIR_TOOLS_COMMON_PLAYBACK_H

#include "tools/common/file.h"

#include <hair/hair.h>

struct hair_playback {
    const char* tool;
    const char* path; // NULL if there is no cache
    struct hair_bytes bytes;
    uint32_t guides, samples, frames; // samples of each guide
    uint32_t vertices; // of all guides of the groom
    uint32_t* guide_vertices; // number of vertices of each guide
    float* place; // fraction of the guide's length at each vertex
    float* positions; // targets
    double first, fps; // number of the first frame, frames a second
    bool plays; // targets are set
};

// Read a cache for the guides of a groom. `path` NULL does nothing and succeeds. Return an exit
// status, after printing any error. Free the cache with hair_playback_free() in any case.
int hair_playback_open(const char* tool, const char* path, const hair_groom* groom,
                       struct hair_playback* cache);
// Set the targets of an instance for `time` in seconds, interpolated between frames. End them after
// the last frame.
hair_result hair_playback_play(struct hair_playback* cache, hair_instance* hair, double time);
void hair_playback_free(struct hair_playback* cache);

#endif
