// view_cache.h - per-view vertices of the listed strands, for a level of detail. They take memory
// only while a view uses them.
#ifndef HAIR_DRAW_VIEW_CACHE_H
#define HAIR_DRAW_VIEW_CACHE_H

#include "lib/gl/commands.h"

#include <stdbool.h>

enum { HAIR_VIEW_CACHE_POSITION, HAIR_VIEW_CACHE_TANGENT, HAIR_VIEW_CACHE_SHADED, HAIR_VIEW_CACHE_PARTS };

// Blocks of vertices in the buffers of a batch, see batch.h.
struct hair_batch_place {
    uint32_t first, blocks; // First block and number of blocks. 0 without a place.
    uint32_t spare; // Number of views in sequence for which much less would do.
};

struct hair_view_cache {
    // Buffers, as at HAIR_BIND_CACHED_POSITION and the two bindings after it in shared.h. 0 until
    // needed.
    GLuint buffer[HAIR_VIEW_CACHE_PARTS];
    GLuint texture[HAIR_VIEW_CACHE_PARTS]; // Buffer textures of `buffer`.
    size_t size[HAIR_VIEW_CACHE_PARTS]; // Size of each buffer in bytes.
    uint32_t segments; // Segments of a strand.
    uint32_t room; // Capacity in strands.
    uint32_t spare; // Number of views in sequence for which much less would do.
    struct hair_batch_place place;
    bool is_in_place; // True if the vertices written last are in that place and not in `buffer`.
    bool is_complete; // True if all listed strands are written and shaded, for a computed view.
    float pixels_per_metre; // hair_renderer.pixels_per_metre of that view.
};

#endif
