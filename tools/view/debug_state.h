// debug_state.h - State of the debug view, which shows numbers of the hair as colours.
#ifndef HAIR_TOOLS_VIEW_DEBUG_STATE_H
#define HAIR_TOOLS_VIEW_DEBUG_STATE_H

#include <hair/hair.h>

#include <vector>

enum view_debug_mode {
    VIEW_DEBUG_OFF,
    VIEW_DEBUG_STRETCH, // of guides
    VIEW_DEBUG_TENSION,
    VIEW_DEBUG_VELOCITY,
    VIEW_DEBUG_CONTACT,
    VIEW_DEBUG_PATCHES, // of followers
    VIEW_DEBUG_LOD,
    VIEW_DEBUG_OVERDRAW,
    VIEW_DEBUG_FIELD_X, // slices of the field, with the wind
    VIEW_DEBUG_FIELD_Y,
    VIEW_DEBUG_FIELD_Z,
    VIEW_DEBUG_MODES
};

// Part of a guide between two vertices, with the linear colours of both.
struct view_debug_segment {
    float from[3], from_color[3], to[3], to_color[3];
};

struct view_debug {
    int mode = VIEW_DEBUG_OFF;
    // Positions of the guides after the last three steps, the newest first, and the times between.
    std::vector<float> positions[3];
    double dt[2] = {0, 0};
    uint32_t steps = 0; // number of positions that are known, at most 3
    uint32_t generation = 0; // value of session.generation that the positions belong to
    std::vector<float> values; // of the mode, per guide vertex
    float low = 0, high = 0; // range of the colours
    uint32_t strands = 0, drawn = 0; // followers, and those of them that the last view has drawn
    float fragments = 0; // of strands per covered pixel
    // Objects of OpenGL, 0 before the first picture.
    int size[2] = {0, 0};
    unsigned framebuffer = 0, texture = 0, depth = 0;
    unsigned programs[3] = {0, 0, 0}, vertex_array = 0, segments = 0, storage[2] = {0, 0};
    hair_shader* shaders[3] = {nullptr, nullptr, nullptr};
};

#endif
