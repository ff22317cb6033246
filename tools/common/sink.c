// sink.c - Output of frames as pictures, numbered pictures, or a video.
#define _POSIX_C_SOURCE 200809L
#include "tools/common/sink.h"
#include "tools/common/video.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define MAX_PATH 4096

static bool ends_with(const char* path, const char* end)
{
    size_t length = strlen(path), tail = strlen(end);
    return length > tail && !strcmp(path + length - tail, end);
}

static enum hair_sink_kind kind_of(const char* path)
{
    if (ends_with(path, ".png")) return HAIR_SINK_PNG;
    if (ends_with(path, ".exr")) return HAIR_SINK_EXR;
    if (ends_with(path, ".mp4")) return HAIR_SINK_MP4;
    if (ends_with(path, ".y4m") || !strcmp(path, "-")) return HAIR_SINK_Y4M;
    struct stat status;
    bool in_place = !stat(path, &status) && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
    return in_place ? HAIR_SINK_Y4M : HAIR_SINK_NONE;
}

bool hair_sink_is_picture(const char* path)
{
    enum hair_sink_kind kind = kind_of(path);
    return (kind == HAIR_SINK_PNG || kind == HAIR_SINK_EXR) && !strchr(path, '%');
}

// Return the length of "%d" or "%04d" at `at`, or 0 if it is neither. `digits` receives the
// requested number of digits.
static size_t pattern_length(const char* at, int* digits)
{
    *digits = 0;
    if (at[1] == 'd') return 2;
    if (at[1] != '0' || at[2] < '1' || at[2] > '9' || at[3] != 'd') return 0;
    *digits = at[2] - '0';
    return 4;
}

static int refuse(const struct hair_sink* sink, const char* sentence)
{
    hair_complain(sink->tool, "%s %s", sink->path, sentence);
    return HAIR_EXIT_USAGE;
}

static int plan_video(const struct hair_sink* sink)
{
    if (sink->kind == HAIR_SINK_Y4M || (sink->width % 2 == 0 && sink->height % 2 == 0)) return HAIR_EXIT_OK;
    return refuse(sink, "needs an even width and height");
}

int hair_sink_plan(const char* tool, const char* path, uint32_t width, uint32_t height, uint32_t frames,
                   struct hair_sink* sink)
{
    *sink = (struct hair_sink){.tool = tool, .path = path, .width = width, .height = height};
    if (!path) return HAIR_EXIT_OK;
    sink->kind = kind_of(path);
    if (sink->kind == HAIR_SINK_NONE) return refuse(sink, "ends in none of .png .exr .y4m .mp4");
    if (sink->kind == HAIR_SINK_Y4M || sink->kind == HAIR_SINK_MP4) return plan_video(sink);

    int digits;
    sink->number = strchr(path, '%');
    if (sink->number && (!pattern_length(sink->number, &digits) || strchr(sink->number + 1, '%')))
        return refuse(sink, "may hold one %d or %04d, for the frame's number, and no other %");
    if (sink->number || frames == 1) return HAIR_EXIT_OK;
    return refuse(sink, "is one file for several frames: give --frames A:A+1, or %04d in its name");
}

// Opening -----------------------------------------------------------------------------------------

static bool start_encoder(struct hair_sink* sink)
{
    int descriptor = fileno(sink->output.file);
    sink->encoder = hair_encoder_start(sink->tool, sink->output.temporary, descriptor, &sink->process);
    return sink->encoder;
}

static bool broke(const struct hair_sink* sink)
{
    hair_complain(sink->tool, "cannot write %s: %s", sink->path, errno ? strerror(errno) : "no reason given");
    return false;
}

static bool open_video(struct hair_sink* sink, double fps)
{
    sink->planes = malloc(hair_y4m_size(sink->width, sink->height));
    if (!sink->planes) {
        hair_complain(sink->tool, "out of memory for a video frame of %u x %u", sink->width, sink->height);
        return false;
    }
    if (sink->kind == HAIR_SINK_MP4 && !start_encoder(sink)) return false;
    FILE* file = sink->encoder ? sink->encoder : sink->output.file;
    return hair_y4m_begin(file, sink->width, sink->height, fps) || broke(sink);
}

bool hair_sink_open(struct hair_sink* sink, double fps)
{
    if (sink->kind == HAIR_SINK_NONE || sink->number) return true;
    if (!hair_output_open(sink->tool, sink->path, &sink->output)) return false;
    if (sink->kind == HAIR_SINK_PNG || sink->kind == HAIR_SINK_EXR || open_video(sink, fps)) return true;
    hair_sink_discard(sink);
    return false;
}

// Frames ------------------------------------------------------------------------------------------

static bool put_picture(struct hair_sink* sink, const struct hair_image* image, FILE* file)
{
    errno = 0;
    bool ok =
        sink->kind == HAIR_SINK_PNG ? hair_image_write_png(image, file) : hair_image_write_exr(image, file);
    return ok || broke(sink);
}

static bool put_numbered(struct hair_sink* sink, const struct hair_image* image, uint32_t frame)
{
    struct hair_output output;
    char path[MAX_PATH];
    int digits, before = (int)(sink->number - sink->path);
    const char* after = sink->number + pattern_length(sink->number, &digits);
    int length = snprintf(path, sizeof path, "%.*s%0*u%s", before, sink->path, digits, frame, after);
    if (length >= (int)sizeof path) {
        hair_complain(sink->tool, "%s is too long a name", sink->path);
        return false;
    }
    if (!hair_output_open(sink->tool, path, &output)) return false;
    if (put_picture(sink, image, output.file)) return hair_output_commit(&output);
    hair_output_discard(&output);
    return false;
}

static bool put_video(struct hair_sink* sink, const struct hair_image* image)
{
    errno = 0;
    if (!sink->encoder) return hair_y4m_frame(sink->output.file, image, sink->planes) || broke(sink);
    if (hair_y4m_frame(sink->encoder, image, sink->planes)) return true;
    hair_complain(sink->tool, "ffmpeg stopped before %s was whole", sink->path);
    return false;
}

bool hair_sink_put(struct hair_sink* sink, const struct hair_image* image, uint32_t frame)
{
    if (sink->kind == HAIR_SINK_NONE) return true;
    if (sink->number) return put_numbered(sink, image, frame);
    if (sink->kind == HAIR_SINK_PNG || sink->kind == HAIR_SINK_EXR)
        return put_picture(sink, image, sink->output.file);
    return put_video(sink, image);
}

// Ending ------------------------------------------------------------------------------------------

static bool end_encoder(struct hair_sink* sink)
{
    if (!sink->encoder) return true;
    bool written = !fclose(sink->encoder);
    sink->encoder = NULL;
    int status = hair_encoder_wait(sink->process);
    if (status)
        hair_complain(sink->tool, "ffmpeg ended with status %d before %s was whole", status, sink->path);
    return written && !status;
}

bool hair_sink_commit(struct hair_sink* sink)
{
    if (!sink->output.file) return true;
    if (!end_encoder(sink)) {
        hair_sink_discard(sink);
        return false;
    }
    bool ok = hair_output_commit(&sink->output);
    free(sink->planes);
    *sink = (struct hair_sink){0};
    return ok;
}

void hair_sink_discard(struct hair_sink* sink)
{
    if (sink->encoder) {
        kill(sink->process, SIGKILL); // The partial video is discarded.
        fclose(sink->encoder);
        hair_encoder_wait(sink->process);
    }
    if (sink->output.file) hair_output_discard(&sink->output);
    free(sink->planes);
    *sink = (struct hair_sink){0};
}
