// image.h - a picture in memory, and as PNG and OpenEXR.
#ifndef HAIR_TOOLS_COMMON_IMAGE_H
#define HAIR_TOOLS_COMMON_IMAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

// RGB, the upper row first.
struct hair_image {
    uint32_t width, height;
    unsigned char* encoded; // sRGB
    unsigned short* linear; // half floats, Rec. 709 primaries; NULL: not wanted
};

// False: `file` could not be written, or memory ran out. No one has complained.
bool hair_image_write_png(const struct hair_image* image, FILE* file);
bool hair_image_write_exr(const struct hair_image* image, FILE* file);

#endif
