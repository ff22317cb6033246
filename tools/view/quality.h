// quality.h - Cost of a picture: full at rest, and by a budget of time while anything moves.
#ifndef HAIR_TOOLS_VIEW_QUALITY_H
#define HAIR_TOOLS_VIEW_QUALITY_H

#include <stdint.h>

// Cost of a picture.
struct view_quality {
    float resolution; // fraction of the pixels along each side
    uint32_t samples; // per pixel
    float strand_pixels, segment_pixels; // minimum level of detail, 0 for that of the scene
    bool shadows; // shadow maps, and followers that are pushed out of colliders
    bool self_shadows; // by the method of the scene
    bool blends; // strands by the fraction of a pixel, because one sample shows them as dots
    const char* about;
};

struct view_governor {
    uint32_t level = 0; // of moving pictures, 0 is full quality
    uint32_t fast = 0, slow = 0; // frames since the time was not below or not above the budget
};

constexpr uint32_t view_quality_levels = 5;

// Return the quality of a level below view_quality_levels.
const view_quality& view_quality_of(uint32_t level);

// Adjust the level to the time of a frame with a moving picture, ms.
void view_governor_add(view_governor& governor, double ms);

#endif
