// debug_programs.h - Programs and shaders of the debug view.
#ifndef HAIR_TOOLS_VIEW_DEBUG_PROGRAMS_H
#define HAIR_TOOLS_VIEW_DEBUG_PROGRAMS_H

#include "tools/view/viewer.h"

enum view_debug_program {
    VIEW_DEBUG_BACKGROUND, // copies a picture, darkened
    VIEW_DEBUG_SEGMENTS, // draws view_debug_segment
    VIEW_DEBUG_COUNTS // colours pixels by their number of fragments
};
enum view_debug_shader {
    VIEW_DEBUG_PAINT, // colours strands by the colour of each
    VIEW_DEBUG_MARK, // marks strands that are drawn
    VIEW_DEBUG_COUNT // counts fragments of each pixel
};

constexpr unsigned view_debug_binding = 8; // of the storage buffer of a shader
constexpr uint32_t view_debug_most_fragments = 64; // end of the colours of overdraw

// Make all programs and shaders that do not exist yet. Return an exit status.
int view_debug_make_programs(view_debug& debug, hair_context* context);

#endif
