// motion.h - Pose of a head over time, by keyframes and a smooth curve through them.
#ifndef HAIR_TOOLS_COMMON_MOTION_H
#define HAIR_TOOLS_COMMON_MOTION_H

#include <stdint.h>

#define HAIR_MOTION_MAX_KEYS 256

// A pose of the head, a rotation about the scene's pivot followed by a translation.
struct hair_key {
    float time; // s, increasing from key to key
    // Degrees to its left (yaw), nodding (pitch), and to its right shoulder (roll).
    float rotation[3];
    float position[3]; // m
};

struct hair_motion {
    struct hair_key key[HAIR_MOTION_MAX_KEYS];
    uint32_t count; // 0 disables motion
    float pivot[3];
    struct hair_key pose; // added to the pose at every time, by hand. Its time is ignored.
};

// Compute the head's transform at a time, column-major and rigid. The head keeps the first pose
// before the first key and the last pose after the last key.
void hair_motion_at(const struct hair_motion* motion, float time, float transform[16]);

#endif
