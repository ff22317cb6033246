// motion.h - where a head is over time: keyframes and the smooth curve through them.
#ifndef HAIR_TOOLS_COMMON_MOTION_H
#define HAIR_TOOLS_COMMON_MOTION_H

#include <stdint.h>

#define HAIR_MOTION_MAX_KEYS 256

// A pose of the head: turned about the scene's pivot, then moved.
struct hair_key {
    float time; // s; keys are in order of it
    float rotation[3]; // degrees: to its left (yaw), nodding (pitch), to its right shoulder (roll)
    float position[3]; // m
};

struct hair_motion {
    struct hair_key key[HAIR_MOTION_MAX_KEYS];
    uint32_t count; // 0: still
    float pivot[3];
};

// Column-major, rigid. Before the first key and after the last the head keeps their pose.
void hair_motion_at(const struct hair_motion* motion, float time, float transform[16]);

#endif
