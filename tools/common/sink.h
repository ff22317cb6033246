// sink.h - Output of frames as pictures, numbered pictures, or a video.
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
    const char* number; // position of the frame number in the path, NULL for a single file
    struct hair_output output; // used for a single file
    uint32_t width, height;
    unsigned char* planes; // planes of one video frame
    FILE* encoder; // standard input of the encoder
    pid_t process;
};

// Return whether the name is that of one picture, which can hold one frame only.
bool hair_sink_is_picture(const char* path);

// Choose the output by the end of the name, .png, .exr, .y4m or .mp4. A pipe or device with another
// name and "-" get .y4m. A picture's name may contain one %d or %04d for the frame number. `path`
// NULL disables output. Return an exit status for the tool, after printing any error.
int hair_sink_plan(const char* tool, const char* path, uint32_t width, uint32_t height, uint32_t frames,
                   struct hair_sink* sink);

// Open the output. Call hair_sink_put() for each frame, then exactly one of hair_sink_commit() and
// hair_sink_discard(). Return false after printing an error.
bool hair_sink_open(struct hair_sink* sink, double fps);
bool hair_sink_put(struct hair_sink* sink, const struct hair_image* image, uint32_t frame);
bool hair_sink_commit(struct hair_sink* sink);
void hair_sink_discard(struct hair_sink* sink);

#endif
