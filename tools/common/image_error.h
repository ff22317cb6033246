// image_error.h - Difference of two pictures over a part of them.
#ifndef HAIR_TOOLS_COMMON_IMAGE_ERROR_H
#define HAIR_TOOLS_COMMON_IMAGE_ERROR_H

#include <stdbool.h>
#include <stdint.h>

struct hair_image_error {
    double flip; // mean
    double psnr; // dB over all three channels, sRGB-encoded, infinite for equal pictures
    uint32_t pixels; // number of compared pixels
};

// Compare two RGB pictures, sRGB-encoded in [0, 1], where the mask is not 0. The mask has one byte
// per pixel. Return false if memory runs out or the mask is empty.
bool hair_image_error(const float* reference, const float* test, const unsigned char* mask, uint32_t width,
                      uint32_t height, struct hair_image_error* out);

// Set all mask pixels within a square that reaches `by` pixels to each side of a set pixel. Return
// false if memory runs out.
bool hair_mask_dilate(unsigned char* mask, uint32_t width, uint32_t height, uint32_t by);

#endif
