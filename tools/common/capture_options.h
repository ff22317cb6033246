// capture_options.h - the command line of hair-capture.
#ifndef HAIR_TOOLS_COMMON_CAPTURE_OPTIONS_H
#define HAIR_TOOLS_COMMON_CAPTURE_OPTIONS_H

#include "tools/common/scene.h"

struct hair_capture_options {
    struct hair_scene scene; // with everything that the command line changes in it
    const char* name; // of the scene, for people
    const char* out; // NULL: none
    const char* stats; // NULL: none
    const char* shader; // file of the strands' own shading; NULL: none
    uint32_t first, end; // frames to draw: from first up to, not including, end
    uint32_t samples, supersample;
    int device; // -1: any
    bool hash, quiet, verbose;
};

// Returns what to exit with at once, having printed, or -1 to go on.
int hair_capture_parse(const char* tool, int count, char** arguments, struct hair_capture_options* out);

#endif
