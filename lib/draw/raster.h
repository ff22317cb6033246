// raster.h - what the samples of a picture see of segments, found by compute. Only while that path is asked for.
#ifndef HAIR_DRAW_RASTER_H
#define HAIR_DRAW_RASTER_H

#include "lib/gl/gl.h"

struct hair_raster {
    GLuint params, nearest, tile; // buffers, as in shared.h; 0 until they are needed
    GLuint tile_texture; // of the last
    size_t room, tile_room; // numbers that there is room for
};

#endif
