// raster_buffers.c - buffers of compute rasterisation, and their sizes.
#include "lib/draw/raster.h"

static hair_result ensure_numbers(struct hair_gl* gl, hair_gl_category category, const char* label,
                                  size_t count, GLuint* buffer, size_t* room)
{
    size_t more = (count + count / 2 + 3) / 4 * 4;
    if (hair_gl_fits(gl, more * sizeof(uint32_t), sizeof(uint32_t))) count = more;
    hair_gl_free_buffer(gl, buffer);
    *room = 0;
    hair_result result = hair_gl_storage(gl, category, label, count * sizeof(uint32_t), NULL, buffer);
    if (!result) *room = count;
    return result;
}

hair_result hair_raster_ensure(struct hair_gl* gl, hair_gl_category category,
                               const struct hair_raster_sizes* sizes, struct hair_raster* raster)
{
    if (!raster->params)
        HAIR_TRY(hair_gl_uniform(gl, category, "hair raster", sizes->params, &raster->params));
    if (sizes->tile > raster->tile_room) {
        hair_gl_free_buffer_texture(gl, &raster->tile_texture);
        HAIR_TRY(ensure_numbers(gl, category, "hair tiles", sizes->tile, &raster->tile, &raster->tile_room));
    }
    // A texture whose creation failed is made again.
    if (!raster->tile_texture)
        HAIR_TRY(hair_gl_buffer_texture(gl, "hair tiles", GL_R32UI, raster->tile, &raster->tile_texture));
    if (sizes->nearest <= raster->room) return HAIR_OK;
    return ensure_numbers(gl, category, "hair nearest", sizes->nearest, &raster->nearest, &raster->room);
}

void hair_raster_free(struct hair_gl* gl, struct hair_raster* raster)
{
    hair_gl_free_buffer(gl, &raster->params);
    hair_gl_free_buffer(gl, &raster->nearest);
    hair_gl_free_array(gl, &raster->tile, &raster->tile_texture);
    raster->room = raster->tile_room = 0;
}
