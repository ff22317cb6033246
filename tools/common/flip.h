// flip.h - Visible difference of two pictures to a viewer who flips between them. 0 is equal, 1 is
// the maximum.
//
// LDR-FLIP, from the equations of Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and
// Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph.
// Interact. Tech. 3(2), 2020.
#ifndef HAIR_TOOLS_COMMON_FLIP_H
#define HAIR_TOOLS_COMMON_FLIP_H

#include <stdbool.h>
#include <stdint.h>

// Pixels per degree of a display of 3,840 pixels over 0.7 m, seen from 0.7 m.
#define HAIR_FLIP_DISPLAY 67.0206433f

// Maximum distance, in pixels, at which a pixel affects another pixel's error, for that display.
#define HAIR_FLIP_REACH 10

// Compute one error in [0, 1] per pixel of two RGB pictures, sRGB-encoded in [0, 1]. The maximum is
// 1,800 pixels per degree. Return false if memory runs out.
bool hair_flip(const float* reference, const float* test, uint32_t width, uint32_t height,
               float pixels_per_degree, float* out);

#endif
