// raster.h - buffers of compute rasterisation. They exist only while that path is used.
#ifndef HAIR_DRAW_RASTER_H
#define HAIR_DRAW_RASTER_H

#include "lib/gl/commands.h"

struct hair_raster {
    GLuint params, nearest, tile; // Buffers, as in shared.h. 0 until needed.
    GLuint tile_texture; // Buffer texture of `tile`.
    size_t room, tile_room; // Capacities of `nearest` and `tile`, in numbers.
};

// Depth test of the application, as a compute shader does it.
struct hair_depth_test {
    GLuint depth; // Texture that is attached. 0 if nothing is tested.
    uint32_t tests; // HAIR_TEST_NEARER, ... 0 if nothing is tested.
};

#endif
