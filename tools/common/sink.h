// sink.h - where frames go: pictures, numbered pictures, or a video.
#ifndef HAIR_TOOLS_COMMON_SINK_H
#define HAIR_TOOLS_COMMON_SINK_H

#include <sys/types.h>

#include "tools/common/file.h"
#include "tools/common/image.h"

enum hair_sink_kind { HAIR_SINK_NONE, HAIR_SINK_PNG, HAIR_SINK_EXR, HAIR_SINK_Y4M, HAIR_SINK_MP4 };

struct hair_sink {
    const char* tool;
    const char* path;
    enum hair_sink_kind kind;
    const char* number; // where in path the frame's number goes; NULL: one file
    struct hair_output output; // of one file
    uint32_t width, height;
    unsigned char* planes; // of one video frame
    FILE* encoder; // its standard input
    pid_t process;
};

// Whether the name is that of one picture, and so can hold one frame only.
bool hair_sink_is_picture(const char* path);

// Told by the end of the name: .png .exr .y4m .mp4; a pipe or device of another name, and "-", get .y4m. A
// picture's name may hold one %d or %04d for the frame's number. `path` NULL takes nothing. Returns what the
// tool should exit with, having complained.
int hair_sink_plan(const char* tool, const char* path, uint32_t width, uint32_t height, uint32_t frames,
                   struct hair_sink* sink);

// Begin; put each frame; then exactly one of commit and discard. False: complained.
bool hair_sink_open(struct hair_sink* sink, double fps);
bool hair_sink_put(struct hair_sink* sink, const struct hair_image* image, uint32_t frame);
bool hair_sink_commit(struct hair_sink* sink);
void hair_sink_discard(struct hair_sink* sink);

#endif
