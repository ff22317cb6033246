// truth.h - what a picture would be with any number of samples: the mean of many that are shifted by parts of a pixel.
#ifndef HAIR_TOOLS_BENCH_TRUTH_H
#define HAIR_TOOLS_BENCH_TRUTH_H

#include "tools/bench/picture.h"
#include "tools/bench/studio.h"

// Each half of the pictures makes one too: what these differ by says how far it is from the truth.
struct bench_truth {
    struct bench_picture half[2], whole;
};

bool bench_truth_make(uint32_t size,
                      struct bench_truth* out); // False: out of memory, then it is to be freed as well.
void bench_truth_free(struct bench_truth* truth);

// Of at least so many samples a pixel. The shadow map is shifted along by parts of so many of its texels, 0: it is not.
bool bench_truth_take(struct bench_studio* studio, const struct bench_shot* shot, uint32_t samples,
                      float shadow_texels, struct bench_truth* out);

uint32_t bench_most_samples(void); // that OpenGL has of a pixel

#endif
