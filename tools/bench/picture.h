// picture.h - a picture of hair, as light and as it is shown, and what two of them differ by.
#ifndef HAIR_TOOLS_BENCH_PICTURE_H
#define HAIR_TOOLS_BENCH_PICTURE_H

#include "tools/common/image_error.h"

struct bench_picture {
    uint32_t size;
    double* rgba; // light, and how much of the pixel is hair
    float* shown; // RGB, sRGB
    unsigned char* mask; // of pixels to compare; NULL: bench_picture_cover has not made it
    double coverage; // pixels' worth of hair
};

// Black. False: out of memory, then it is to be freed as well.
bool bench_picture_make(uint32_t size, struct bench_picture* out);
void bench_picture_free(struct bench_picture* picture);

// Of the sum of `count` pictures their mean, and what that looks like.
void bench_picture_finish(struct bench_picture* picture, uint32_t count, double exposure);

// Make the mask: all pixels with hair, and 8 around them. False: out of memory.
bool bench_picture_cover(struct bench_picture* picture);

// Within `where`'s mask. False: out of memory, or no hair.
bool bench_picture_compare(const struct bench_picture* where, const struct bench_picture* reference,
                           const struct bench_picture* test, struct hair_image_error* out);

#endif
