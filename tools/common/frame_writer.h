// frame_writer.h - Output of frames as pictures, numbered pictures, or a video.
#ifndef HAIR_TOOLS_COMMON_FRAME_WRITER_H
#define HAIR_TOOLS_COMMON_FRAME_WRITER_H

#include <sys/types.h>

#include "tools/common/file.h"
#include "tools/common/image.h"

enum hair_frame_writer_kind {
    HAIR_FRAME_WRITER_NONE,
    HAIR_FRAME_WRITER_PNG,
    HAIR_FRAME_WRITER_EXR,
    HAIR_FRAME_WRITER_Y4M,
    HAIR_FRAME_WRITER_MP4
};

struct hair_frame_writer {
    const char* tool;
    const char* path;
    enum hair_frame_writer_kind kind;
    const char* number; // position of the frame number in the path, NULL for a single file
    struct hair_output output; // used for a single file
    uint32_t width, height;
    unsigned char* planes; // planes of one video frame
    FILE* encoder; // standard input of the encoder
    pid_t process;
};

// Return whether the name is that of one picture, which can hold one frame only.
bool hair_frame_writer_is_picture(const char* path);

// Choose the output by the end of the name, .png, .exr, .y4m or .mp4. A pipe or device with another
// name and "-" get .y4m. A picture's name may contain one %d or %04d for the frame number. `path`
// NULL disables output. Return an exit status for the tool, after printing any error.
int hair_frame_writer_plan(const char* tool, const char* path, uint32_t width, uint32_t height,
                           uint32_t frames, struct hair_frame_writer* writer);

// Open the output. Call hair_frame_writer_put() for each frame, then exactly one of
// hair_frame_writer_commit() and hair_frame_writer_discard(). Return false after printing an error.
bool hair_frame_writer_open(struct hair_frame_writer* writer, double fps);
bool hair_frame_writer_put(struct hair_frame_writer* writer, const struct hair_image* image, uint32_t frame);
bool hair_frame_writer_commit(struct hair_frame_writer* writer);
void hair_frame_writer_discard(struct hair_frame_writer* writer);

#endif
