// video.h - Frames as YUV4MPEG2, which ffmpeg encodes to .mp4.
#ifndef HAIR_TOOLS_COMMON_VIDEO_H
#define HAIR_TOOLS_COMMON_VIDEO_H

#include <sys/types.h>

#include "tools/common/image.h"

// Return the bytes of the planes of one frame, with luma at full and chroma at half resolution in
// both directions.
size_t hair_y4m_size(uint32_t width, uint32_t height);
bool hair_y4m_begin(FILE* file, uint32_t width, uint32_t height, double fps);
bool hair_y4m_frame(FILE* file, const struct hair_image* image, unsigned char* planes);

// Start ffmpeg and return the stream that it reads YUV4MPEG2 from. It writes .mp4 to `path`, or to
// `descriptor` if `path` is NULL. Return NULL after printing an error.
FILE* hair_encoder_start(const char* tool, const char* path, int descriptor, pid_t* process);

// Wait for the encoder's end and return its exit status. A status of 128 or more means a signal.
int hair_encoder_wait(pid_t process);

#endif
