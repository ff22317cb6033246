// raster.h - buffers of compute rasterisation. They exist only while that path is used.
#ifndef HAIR_DRAW_RASTER_H
#define HAIR_DRAW_RASTER_H

#include "lib/gl/commands.h"

// Buffers of a head that is drawn alone, or of a batch of heads.
struct hair_raster {
    GLuint params, nearest, tile; // Numbers, as in shared.h. 0 until needed.
    GLuint tile_texture; // Buffer texture of `tile`.
    size_t room, tile_room; // Capacities of `nearest` and `tile`, in numbers.
};

// Sizes of the buffers: bytes of `params`, numbers of `nearest` and of `tile`.
struct hair_raster_sizes {
    size_t params, nearest, tile;
};

// Make buffers of at least these sizes. `params` never grows. Leave some slack in the others, so
// that hair that comes nearer does not reallocate them each time.
hair_result hair_raster_ensure(struct hair_gl* gl, hair_gl_category category,
                               const struct hair_raster_sizes* sizes, struct hair_raster* raster);
void hair_raster_free(struct hair_gl* gl, struct hair_raster* raster);

// Depth test of the application, as a compute shader does it.
struct hair_depth_test {
    GLuint depth; // Texture that is attached. 0 if nothing is tested.
    uint32_t tests; // HAIR_TEST_NEARER, ... 0 if nothing is tested.
};

#endif
