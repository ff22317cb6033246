// image.c - PNG and OpenEXR output of a picture.
#include "tools/common/image.h"

#include <openexr.h>
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

static void fail_silently(png_structp png, png_const_charp sentence)
{
    (void)sentence;
    png_longjmp(png, 1);
}

static void ignore(png_structp png, png_const_charp sentence)
{
    (void)png;
    (void)sentence;
}

// Write with compression level 1 and no filters, which is much faster than the default for slightly
// larger files of drawn hair.
static void write_png(png_structp png, png_infop info, const struct hair_image* image, FILE* file)
{
    png_init_io(png, file);
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_IHDR(png, info, image->width, image->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (uint32_t y = 0; y < image->height; ++y)
        png_write_row(png, image->encoded + (size_t)3 * image->width * y);
    png_write_end(png, info);
}

bool hair_image_write_png(const struct hair_image* image, FILE* file)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, fail_silently, ignore);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    write_png(png, info, image, file);
    png_destroy_write_struct(&png, &info);
    return !ferror(file);
}

// Memory that an OpenEXR file is written to. OpenEXR writes its table of offsets last but stores it
// first. A pipe cannot seek back, therefore the whole file is made in memory.
struct memory {
    char* bytes;
    size_t size, room;
};

static int64_t write_memory(exr_const_context_t context, void* user, const void* bytes, uint64_t size,
                            uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    struct memory* memory = user;
    uint64_t end = offset + size;
    if (end > memory->room) {
        size_t room = end > 2 * memory->room ? end : 2 * memory->room;
        char* more = realloc(memory->bytes, room);
        if (!more) {
            fail(context, EXR_ERR_OUT_OF_MEMORY, "out of memory");
            return -1;
        }
        memset(more + memory->room, 0, room - memory->room);
        memory->bytes = more;
        memory->room = room;
    }
    memcpy(memory->bytes + offset, bytes, size);
    if (end > memory->size) memory->size = end;
    return (int64_t)size;
}

static void say_nothing(exr_const_context_t context, exr_result_t code, const char* sentence)
{
    (void)context;
    (void)code;
    (void)sentence;
}

static bool describe(exr_context_t context, const struct hair_image* image)
{
    // OpenEXR files store channels in the order of their names.
    static const char* const channels[] = {"B", "G", "R"};
    int part;
    if (exr_add_part(context, "rgb", EXR_STORAGE_SCANLINE, &part)) return false;
    if (exr_initialize_required_attr_simple(context, part, (int32_t)image->width, (int32_t)image->height,
                                            EXR_COMPRESSION_ZIP))
        return false;
    for (int i = 0; i < 3; ++i)
        if (exr_add_channel(context, part, channels[i], EXR_PIXEL_HALF, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1))
            return false;
    return !exr_write_header(context);
}

static bool encode(exr_context_t context, const struct hair_image* image, int y, int rows)
{
    exr_chunk_info_t chunk;
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    if (exr_write_scanline_chunk_info(context, 0, y, &chunk)) return false;
    if (exr_encoding_initialize(context, 0, &chunk, &pipeline)) return false;
    static const char order[] = "RGB";
    const unsigned short* from = image->linear + (size_t)3 * image->width * (size_t)y;
    for (int i = 0; i < 3; ++i) {
        exr_coding_channel_info_t* channel = &pipeline.channels[i];
        channel->encode_from_ptr = (const uint8_t*)(from + (strchr(order, *channel->channel_name) - order));
        channel->user_pixel_stride = 6;
        channel->user_line_stride = (int32_t)(6 * image->width);
        channel->height = rows;
    }
    bool ok = !exr_encoding_choose_default_routines(context, 0, &pipeline) &&
              !exr_encoding_run(context, 0, &pipeline);
    exr_encoding_destroy(context, &pipeline);
    return ok;
}

static bool write_exr(exr_context_t context, const struct hair_image* image)
{
    int32_t rows;
    if (!describe(context, image) || exr_get_scanlines_per_chunk(context, 0, &rows)) return false;
    int height = (int)image->height;
    for (int y = 0; y < height; y += rows)
        if (!encode(context, image, y, y + rows < height ? rows : height - y)) return false;
    return true;
}

bool hair_image_write_exr(const struct hair_image* image, FILE* file)
{
    struct memory memory = {0};
    exr_context_t context;
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.write_fn = write_memory;
    initializer.user_data = &memory;
    initializer.error_handler_fn = say_nothing;
    if (exr_start_write(&context, "a picture", EXR_WRITE_FILE_DIRECTLY, &initializer)) return false;
    bool ok = write_exr(context, image);
    ok = !exr_finish(&context) && ok;
    ok = ok && fwrite(memory.bytes, 1, memory.size, file) == memory.size;
    free(memory.bytes);
    return ok;
}
