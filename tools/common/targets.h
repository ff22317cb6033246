// targets.h - Render targets of a capture.
#ifndef HAIR_TOOLS_COMMON_TARGETS_H
#define HAIR_TOOLS_COMMON_TARGETS_H

#include <stdbool.h>
#include <stdint.h>

enum hair_target {
    HAIR_TARGET_DRAWN, // many samples per pixel
    HAIR_TARGET_RESOLVED, // one sample per pixel
    HAIR_TARGET_ENCODED, // 8 bits and the linear colour they come from, after downsampling
    HAIR_TARGET_COUNT
};

// OpenGL names.
struct hair_targets {
    unsigned framebuffer[HAIR_TARGET_COUNT];
    unsigned color_samples; // 0 if there is one sample per pixel, then `resolved` is drawn into
    unsigned depth_samples;
    unsigned resolved, encoded, linear;
    unsigned depth; // one sample per pixel, attached to HAIR_TARGET_RESOLVED
};

// Create the targets. Return false if OpenGL has no memory. Delete the targets in either case.
bool hair_targets_make(struct hair_targets* targets, uint32_t width, uint32_t height, uint32_t supersample,
                       uint32_t samples);
// Average the samples of the pixels from `lower` up to, but not including, `upper`.
void hair_targets_resolve(const struct hair_targets* targets, const int lower[2], const int upper[2]);
void hair_targets_delete(struct hair_targets* targets);

#endif
