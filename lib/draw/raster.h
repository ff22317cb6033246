// raster.h - buffers of compute rasterisation. They exist only while that path is used.
#ifndef HAIR_DRAW_RASTER_H
#define HAIR_DRAW_RASTER_H

#include "lib/gl/commands.h"

// Buffers of a head that is drawn alone, or of a batch of heads. 0 until needed.
struct hair_raster {
    GLuint params, tile;
    GLuint tile_texture; // Buffer texture of `tile`.
    size_t tile_room; // Capacity of `tile`, in numbers.
};

// Samples of the heads that are drawn next. Other heads overwrite them afterwards.
struct hair_samples {
    GLuint nearest; // Numbers, as in shared.h. 0 until needed.
    size_t room; // Capacity in numbers.
    size_t max; // Maximum numbers for several heads.
    uint32_t users; // Number of heads that were drawn alone of late.
};

// Make buffers with `params` bytes, which never grow, and `tile` numbers.
hair_result hair_raster_ensure(struct hair_gl* gl, hair_gl_category category, size_t params, size_t tile,
                               struct hair_raster* raster);
void hair_raster_free(struct hair_gl* gl, struct hair_raster* raster);
// Return whether the limit of memory allows room for a number of numbers.
bool hair_samples_fit(const struct hair_gl* gl, size_t numbers, const struct hair_samples* samples);
// Make room for a number of numbers. Samples are lost where the room grows.
hair_result hair_samples_ensure(struct hair_gl* gl, size_t numbers, struct hair_samples* samples);
void hair_samples_free(struct hair_gl* gl, struct hair_samples* samples);

// Depth test of the application, as a compute shader does it.
struct hair_depth_test {
    GLuint depth; // Texture that is attached. 0 if nothing is tested.
    uint32_t tests; // HAIR_TEST_NEARER, ... 0 if nothing is tested.
};

#endif
