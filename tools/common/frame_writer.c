// frame_writer.c - Output of frames as pictures, numbered pictures, or a video.
#define _POSIX_C_SOURCE 200809L
#include "tools/common/frame_writer.h"
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

static enum hair_frame_writer_kind kind_of(const char* path)
{
    if (ends_with(path, ".png")) return HAIR_FRAME_WRITER_PNG;
    if (ends_with(path, ".exr")) return HAIR_FRAME_WRITER_EXR;
    if (ends_with(path, ".mp4")) return HAIR_FRAME_WRITER_MP4;
    if (ends_with(path, ".y4m") || !strcmp(path, "-")) return HAIR_FRAME_WRITER_Y4M;
    struct stat status;
    bool in_place = !stat(path, &status) && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
    return in_place ? HAIR_FRAME_WRITER_Y4M : HAIR_FRAME_WRITER_NONE;
}

bool hair_frame_writer_is_picture(const char* path)
{
    enum hair_frame_writer_kind kind = kind_of(path);
    return (kind == HAIR_FRAME_WRITER_PNG || kind == HAIR_FRAME_WRITER_EXR) && !strchr(path, '%');
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

static int refuse(const struct hair_frame_writer* writer, const char* sentence)
{
    hair_complain(writer->tool, "%s %s", writer->path, sentence);
    return HAIR_EXIT_USAGE;
}

static int plan_video(const struct hair_frame_writer* writer)
{
    if (writer->kind == HAIR_FRAME_WRITER_Y4M || (writer->width % 2 == 0 && writer->height % 2 == 0))
        return HAIR_EXIT_OK;
    return refuse(writer, "needs an even width and height");
}

int hair_frame_writer_plan(const char* tool, const char* path, uint32_t width, uint32_t height,
                           uint32_t frames, struct hair_frame_writer* writer)
{
    *writer = (struct hair_frame_writer){.tool = tool, .path = path, .width = width, .height = height};
    if (!path) return HAIR_EXIT_OK;
    writer->kind = kind_of(path);
    if (writer->kind == HAIR_FRAME_WRITER_NONE) return refuse(writer, "ends in none of .png .exr .y4m .mp4");
    if (writer->kind == HAIR_FRAME_WRITER_Y4M || writer->kind == HAIR_FRAME_WRITER_MP4)
        return plan_video(writer);

    int digits;
    writer->number = strchr(path, '%');
    if (writer->number && (!pattern_length(writer->number, &digits) || strchr(writer->number + 1, '%')))
        return refuse(writer, "may hold one %d or %04d, for the frame's number, and no other %");
    if (writer->number || frames == 1) return HAIR_EXIT_OK;
    return refuse(writer, "is one file for several frames: give --frames A:A+1, or %04d in its name");
}

// Opening -----------------------------------------------------------------------------------------

static bool start_encoder(struct hair_frame_writer* writer)
{
    int descriptor = fileno(writer->output.file);
    writer->encoder =
        hair_encoder_start(writer->tool, writer->output.temporary, descriptor, &writer->process);
    return writer->encoder;
}

static bool broke(const struct hair_frame_writer* writer)
{
    hair_complain(writer->tool, "cannot write %s: %s", writer->path,
                  errno ? strerror(errno) : "no reason given");
    return false;
}

static bool open_video(struct hair_frame_writer* writer, double fps)
{
    writer->planes = malloc(hair_y4m_size(writer->width, writer->height));
    if (!writer->planes) {
        hair_complain(writer->tool, "out of memory for a video frame of %u x %u", writer->width,
                      writer->height);
        return false;
    }
    if (writer->kind == HAIR_FRAME_WRITER_MP4 && !start_encoder(writer)) return false;
    FILE* file = writer->encoder ? writer->encoder : writer->output.file;
    return hair_y4m_begin(file, writer->width, writer->height, fps) || broke(writer);
}

bool hair_frame_writer_open(struct hair_frame_writer* writer, double fps)
{
    if (writer->kind == HAIR_FRAME_WRITER_NONE || writer->number) return true;
    if (!hair_output_open(writer->tool, writer->path, &writer->output)) return false;
    if (writer->kind == HAIR_FRAME_WRITER_PNG || writer->kind == HAIR_FRAME_WRITER_EXR ||
        open_video(writer, fps))
        return true;
    hair_frame_writer_discard(writer);
    return false;
}

// Frames ------------------------------------------------------------------------------------------

static bool put_picture(struct hair_frame_writer* writer, const struct hair_image* image, FILE* file)
{
    errno = 0;
    bool ok = writer->kind == HAIR_FRAME_WRITER_PNG ? hair_image_write_png(image, file)
                                                    : hair_image_write_exr(image, file);
    return ok || broke(writer);
}

static bool put_numbered(struct hair_frame_writer* writer, const struct hair_image* image, uint32_t frame)
{
    struct hair_output output;
    char path[MAX_PATH];
    int digits, before = (int)(writer->number - writer->path);
    const char* after = writer->number + pattern_length(writer->number, &digits);
    int length = snprintf(path, sizeof path, "%.*s%0*u%s", before, writer->path, digits, frame, after);
    if (length >= (int)sizeof path) {
        hair_complain(writer->tool, "%s is too long a name", writer->path);
        return false;
    }
    if (!hair_output_open(writer->tool, path, &output)) return false;
    if (put_picture(writer, image, output.file)) return hair_output_commit(&output);
    hair_output_discard(&output);
    return false;
}

static bool put_video(struct hair_frame_writer* writer, const struct hair_image* image)
{
    errno = 0;
    if (!writer->encoder) return hair_y4m_frame(writer->output.file, image, writer->planes) || broke(writer);
    if (hair_y4m_frame(writer->encoder, image, writer->planes)) return true;
    hair_complain(writer->tool, "ffmpeg stopped before %s was whole", writer->path);
    return false;
}

bool hair_frame_writer_put(struct hair_frame_writer* writer, const struct hair_image* image, uint32_t frame)
{
    if (writer->kind == HAIR_FRAME_WRITER_NONE) return true;
    if (writer->number) return put_numbered(writer, image, frame);
    if (writer->kind == HAIR_FRAME_WRITER_PNG || writer->kind == HAIR_FRAME_WRITER_EXR)
        return put_picture(writer, image, writer->output.file);
    return put_video(writer, image);
}

// Ending ------------------------------------------------------------------------------------------

static bool end_encoder(struct hair_frame_writer* writer)
{
    if (!writer->encoder) return true;
    bool written = !fclose(writer->encoder);
    writer->encoder = NULL;
    int status = hair_encoder_wait(writer->process);
    if (status)
        hair_complain(writer->tool, "ffmpeg ended with status %d before %s was whole", status, writer->path);
    return written && !status;
}

bool hair_frame_writer_commit(struct hair_frame_writer* writer)
{
    if (!writer->output.file) return true;
    if (!end_encoder(writer)) {
        hair_frame_writer_discard(writer);
        return false;
    }
    bool ok = hair_output_commit(&writer->output);
    free(writer->planes);
    *writer = (struct hair_frame_writer){0};
    return ok;
}

void hair_frame_writer_discard(struct hair_frame_writer* writer)
{
    if (writer->encoder) {
        kill(writer->process, SIGKILL); // The partial video is discarded.
        fclose(writer->encoder);
        hair_encoder_wait(writer->process);
    }
    if (writer->output.file) hair_output_discard(&writer->output);
    free(writer->planes);
    *writer = (struct hair_frame_writer){0};
}
