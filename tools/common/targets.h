// targets.h - what a capture draws into: the samples, the picture.
#ifndef HAIR_TOOLS_COMMON_TARGETS_H
#define HAIR_TOOLS_COMMON_TARGETS_H

#include <stdbool.h>
#include <stdint.h>

enum hair_target {
    HAIR_TARGET_DRAWN, // many samples a pixel
    HAIR_TARGET_RESOLVED, // one
    HAIR_TARGET_ENCODED, // supersampling undone: 8 bits, and the light they come from
    HAIR_TARGET_COUNT
};

// OpenGL names.
struct hair_targets {
    unsigned framebuffer[HAIR_TARGET_COUNT];
    unsigned color_samples; // 0: one a pixel, drawn into what else is resolved into
    unsigned depth_samples;
    unsigned resolved, encoded, linear;
    unsigned depth; // of one sample a pixel, of the second
};

// False: OpenGL has no memory for them. Delete them also then.
bool hair_targets_make(struct hair_targets* targets, uint32_t width, uint32_t height, uint32_t supersample,
                       uint32_t samples);
// Average the samples of the pixels from `lower` up to, not including, `upper`.
void hair_targets_resolve(const struct hair_targets* targets, const int lower[2], const int upper[2]);
void hair_targets_delete(struct hair_targets* targets);

#endif
