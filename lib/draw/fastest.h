// fastest.h - the fastest render path of each use on a driver, from a table or measured.
#ifndef HAIR_DRAW_FASTEST_H
#define HAIR_DRAW_FASTEST_H

#include "lib/draw/render_path.h"
#include "lib/gl/commands.h"

#include <stdbool.h>

// Uses of a path, in the order of the columns of paths.inl. HAIR_USE_UNCACHED is for vertices that
// no memory holds.
enum hair_path_use {
    HAIR_USE_RIBBONS,
    HAIR_USE_LINES,
    HAIR_USE_LOD_RIBBONS,
    HAIR_USE_LOD_LINES,
    HAIR_USE_DEPTH,
    HAIR_USE_UNCACHED,
    HAIR_PATH_USES
};

struct hair_fastest {
    uint8_t path[HAIR_PATH_USES]; // hair_render_path by use. Never HAIR_RENDER_PATH_AUTO.
};

// Return whether a use may have a path. Vertices that no memory holds are not cached, and compute
// rasterisation has no lines.
bool hair_fastest_allows(enum hair_path_use use, hair_render_path path);
// Find the paths of paths.inl for the driver.
void hair_fastest_find(const struct hair_gl* gl, struct hair_fastest* out);
// Write the paths as text of less than HAIR_TUNING_SIZE bytes, with a key of the driver.
void hair_fastest_write(struct hair_gl* gl, const struct hair_fastest* fastest, char* out, size_t capacity);
// Read the text of hair_fastest_write(). Any other text and that of another driver are refused.
hair_result hair_fastest_read(struct hair_gl* gl, const char* text, struct hair_fastest* out);

#endif
