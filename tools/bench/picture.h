// picture.h - A picture of hair in linear light and as shown, and the difference of two pictures.
#ifndef HAIR_TOOLS_BENCH_PICTURE_H
#define HAIR_TOOLS_BENCH_PICTURE_H

#include "tools/common/image_error.h"

struct bench_picture {
    uint32_t size;
    double* rgba; // linear light, and the fraction of the pixel that hair covers
    float* shown; // sRGB-encoded RGB
    unsigned char* mask; // pixels to compare, NULL until bench_picture_cover()
    double coverage; // area of hair in pixels
};

// Make a black picture. Return false if memory runs out. Free the picture in either case.
bool bench_picture_make(uint32_t size, struct bench_picture* out);
void bench_picture_free(struct bench_picture* picture);

// Divide the sum of `count` pictures by `count`, and compute its appearance.
void bench_picture_finish(struct bench_picture* picture, uint32_t count, double exposure);

// Make the mask of all pixels with hair and 8 pixels around them. Return false if memory runs out.
bool bench_picture_cover(struct bench_picture* picture);

// Compare two pictures within the mask of `where`. Return false if memory runs out or there is no
// hair.
bool bench_picture_compare(const struct bench_picture* where, const struct bench_picture* reference,
                           const struct bench_picture* test, struct hair_image_error* out);

#endif
