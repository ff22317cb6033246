// ground_truth.h - Limit of a picture with many samples, the mean of many pictures that are shifted
// by fractions of a pixel.
#ifndef HAIR_TOOLS_BENCH_GROUND_TRUTH_H
#define HAIR_TOOLS_BENCH_GROUND_TRUTH_H

#include "tools/bench/picture.h"
#include "tools/bench/studio.h"

// Mean of many pictures, and the means of two halves. The difference of the halves estimates the
// error.
struct bench_ground_truth {
    struct bench_picture half[2], whole;
};

// Make black pictures. Return false if memory runs out. Free the truth in either case.
bool bench_ground_truth_create(uint32_t size, struct bench_ground_truth* out);
void bench_ground_truth_free(struct bench_ground_truth* ground_truth);

// Draw pictures with at least `samples` samples per pixel in total. The shadow map is shifted too,
// by fractions of `shadow_texels` texels. 0 disables the shift.
bool bench_ground_truth_render(struct bench_studio* studio, const struct bench_shot* shot, uint32_t samples,
                               float shadow_texels, struct bench_ground_truth* out);

// Return the maximum number of samples per pixel of OpenGL.
uint32_t bench_max_samples(void);

#endif
