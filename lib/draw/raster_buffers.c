// raster_buffers.c - buffers of compute rasterisation, and their sizes.
#include "lib/draw/raster.h"

// Make a buffer of `count` numbers. Leave some slack, so that hair that comes nearer does not
// reallocate it each time. Where `count` is at most `max`, the slack stays within `max`.
static hair_result ensure_numbers(struct hair_gl* gl, hair_gl_category category, const char* label,
                                  size_t count, size_t max, GLuint* buffer, size_t* room)
{
    size_t more = (count + count / 2 + 3) / 4 * 4;
    if (count <= max && more > max) more = max;
    if (hair_gl_fits(gl, more * sizeof(uint32_t), sizeof(uint32_t))) count = more;
    hair_gl_free_buffer(gl, buffer);
    *room = 0;
    hair_result result = hair_gl_storage(gl, category, label, count * sizeof(uint32_t), NULL, buffer);
    if (!result) *room = count;
    return result;
}

hair_result hair_raster_ensure(struct hair_gl* gl, hair_gl_category category, size_t params, size_t tile,
                               struct hair_raster* raster)
{
    if (!raster->params) HAIR_TRY(hair_gl_uniform(gl, category, "hair raster", params, &raster->params));
    if (tile > raster->tile_room) {
        hair_gl_free_buffer_texture(gl, &raster->tile_texture);
        HAIR_TRY(
            ensure_numbers(gl, category, "hair tiles", tile, SIZE_MAX, &raster->tile, &raster->tile_room));
    }
    // A texture whose creation failed is made again.
    if (raster->tile_texture) return HAIR_OK;
    return hair_gl_buffer_texture(gl, "hair tiles", GL_R32UI, raster->tile, &raster->tile_texture);
}

void hair_raster_free(struct hair_gl* gl, struct hair_raster* raster)
{
    hair_gl_free_buffer(gl, &raster->params);
    hair_gl_free_array(gl, &raster->tile, &raster->tile_texture);
    raster->tile_room = 0;
}

bool hair_samples_fit(const struct hair_gl* gl, size_t numbers, const struct hair_samples* samples)
{
    return numbers <= samples->room ||
           hair_gl_memory_allows(&gl->memory, (numbers - samples->room) * sizeof(uint32_t));
}

hair_result hair_samples_ensure(struct hair_gl* gl, size_t numbers, struct hair_samples* samples)
{
    if (numbers <= samples->room) return HAIR_OK;
    return ensure_numbers(gl, HAIR_GL_NO_CATEGORY, "hair nearest", numbers, samples->max, &samples->nearest,
                          &samples->room);
}

void hair_samples_free(struct hair_gl* gl, struct hair_samples* samples)
{
    hair_gl_free_buffer(gl, &samples->nearest);
    samples->room = 0;
}
