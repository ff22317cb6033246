// video.h - frames as YUV4MPEG2, and ffmpeg to make .mp4 of it.
#ifndef HAIR_TOOLS_COMMON_VIDEO_H
#define HAIR_TOOLS_COMMON_VIDEO_H

#include <sys/types.h>

#include "tools/common/image.h"

// Bytes of the planes of one frame: full brightness, colour halved in both directions.
size_t hair_y4m_size(uint32_t width, uint32_t height);
bool hair_y4m_begin(FILE* file, uint32_t width, uint32_t height, double fps);
bool hair_y4m_frame(FILE* file, const struct hair_image* image, unsigned char* planes);

// Start ffmpeg reading YUV4MPEG2 from the stream returned, writing .mp4 to `path` or, when that is NULL, to
// `descriptor`. NULL: not started, and `tool` has complained.
FILE* hair_encoder_start(const char* tool, const char* path, int descriptor, pid_t* process);

// Wait for its end; what was its exit status, 128 and more for a signal.
int hair_encoder_wait(pid_t process);

#endif
