// capture_options.h - Command line of hair-capture.
#ifndef HAIR_TOOLS_COMMON_CAPTURE_OPTIONS_H
#define HAIR_TOOLS_COMMON_CAPTURE_OPTIONS_H

#include "tools/common/scene.h"

struct hair_capture_options {
    struct hair_scene scene; // with all changes of the command line applied
    const char* name; // name of the scene, for messages
    bool is_of_file; // all settings that the library can refuse are of a scene file
    const char* out; // NULL disables it
    const char* stats; // NULL disables it
    const char* dump_guides; // file of the guides of each frame, NULL disables it
    const char* dump_followers; // file of the followers of each frame, NULL disables it
    const char* cache; // dump of guides to play back, NULL disables it
    const char* shader; // file with a pixel shader for strands, NULL disables it
    uint32_t first, end; // frames to draw, in the half-open range [first, end)
    uint32_t samples, supersample;
    int device; // EGL device index, -1 selects any
    bool hash, quiet, verbose;
};

// Parse the command line. Return an exit status if the tool must exit at once, after printing the
// reason. Return -1 to continue.
int hair_capture_parse(const char* tool, int count, char** arguments, struct hair_capture_options* out);

#endif
