// image_error.h - what two pictures differ by, over a part of them.
#ifndef HAIR_TOOLS_COMMON_IMAGE_ERROR_H
#define HAIR_TOOLS_COMMON_IMAGE_ERROR_H

#include <stdbool.h>
#include <stdint.h>

struct hair_image_error {
    double flip; // mean
    double psnr; // dB, of all three channels as encoded; infinite where they are the same
    uint32_t pixels; // that were looked at
};

// Of pictures of RGB, sRGB in [0, 1], where the mask, a byte per pixel, is not 0. False: out of memory, or nothing
// is set in the mask.
bool hair_image_error(const float* reference, const float* test, const unsigned char* mask, uint32_t width,
                      uint32_t height, struct hair_image_error* out);

// Set all of the mask within a square of `by` pixels to each side of what is set. False: out of memory.
bool hair_mask_dilate(unsigned char* mask, uint32_t width, uint32_t height, uint32_t by);

#endif
