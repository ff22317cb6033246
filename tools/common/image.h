// image.h - A picture in memory, and its PNG and OpenEXR output.
#ifndef HAIR_TOOLS_COMMON_IMAGE_H
#define HAIR_TOOLS_COMMON_IMAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

// RGB pixels in rows, the top row first.
struct hair_image {
    uint32_t width, height;
    unsigned char* encoded; // sRGB
    unsigned short* linear; // half floats, Rec. 709 primaries, NULL if not requested
};

// Write the picture. Return false if `file` cannot be written or memory runs out. Neither function
// prints an error message.
bool hair_image_write_png(const struct hair_image* image, FILE* file);
bool hair_image_write_exr(const struct hair_image* image, FILE* file);

#endif
