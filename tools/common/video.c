// video.c - Frames as YUV4MPEG2, which ffmpeg encodes to .mp4.
#define _POSIX_C_SOURCE 200809L
#include "tools/common/video.h"
#include "tools/common/file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

size_t hair_y4m_size(uint32_t width, uint32_t height)
{
    return (size_t)width * height + 2 * (size_t)((width + 1) / 2) * ((height + 1) / 2);
}

// Write the header. C420jpeg places chroma in the middle of its four pixels, as the average below
// does.
bool hair_y4m_begin(FILE* file, uint32_t width, uint32_t height, double fps)
{
    return fprintf(file, "YUV4MPEG2 W%u H%u F%ld:1000 Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n", width, height,
                   lround(1000 * fps)) > 0;
}

// Compute luma of BT.709, 8 bits, limited range, in 16.16 fixed point (ITU-R BT.709-6, items 3.2 to
// 3.5). Luma is 16 to 235, chroma 16 to 240. Each row of weights sums to 219/255 or to 0.
static unsigned char brightness(const int rgb[3])
{
    return (unsigned char)((11966 * rgb[0] + 40254 * rgb[1] + 4064 * rgb[2] + (16 << 16) + (1 << 15)) >> 16);
}

// Compute chroma from the sum of four pixels, with 18 fractional bits.
static void colour(const int sum[3], unsigned char* blue, unsigned char* red)
{
    *blue =
        (unsigned char)((-6596 * sum[0] - 22189 * sum[1] + 28785 * sum[2] + (128 << 18) + (1 << 17)) >> 18);
    *red = (unsigned char)((28785 * sum[0] - 26145 * sum[1] - 2640 * sum[2] + (128 << 18) + (1 << 17)) >> 18);
}

static void pixel(const struct hair_image* image, uint32_t x, uint32_t y, int rgb[3])
{
    // Repeat the last row or column at an odd edge.
    if (x >= image->width) x = image->width - 1;
    if (y >= image->height) y = image->height - 1;
    const unsigned char* from = image->encoded + 3 * ((size_t)y * image->width + x);
    for (int i = 0; i < 3; ++i) rgb[i] = from[i];
}

static void fill_planes(const struct hair_image* image, unsigned char* planes)
{
    uint32_t width = image->width, height = image->height, columns = (width + 1) / 2, rows = (height + 1) / 2;
    unsigned char* blue = planes + (size_t)width * height;
    unsigned char* red = blue + (size_t)columns * rows;
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            int sum[3] = {0};
            for (uint32_t k = 0; k < 4; ++k) {
                int rgb[3];
                uint32_t px = 2 * x + k % 2, py = 2 * y + k / 2;
                pixel(image, px, py, rgb);
                for (int i = 0; i < 3; ++i) sum[i] += rgb[i];
                if (px < width && py < height) planes[(size_t)py * width + px] = brightness(rgb);
            }
            colour(sum, blue++, red++);
        }
}

bool hair_y4m_frame(FILE* file, const struct hair_image* image, unsigned char* planes)
{
    size_t size = hair_y4m_size(image->width, image->height);
    fill_planes(image, planes);
    return fputs("FRAME\n", file) >= 0 && fwrite(planes, 1, size, file) == size;
}

// Encoder -----------------------------------------------------------------------------------------

// Start a process that reads `input`. Its own process group leaves the terminal's Ctrl-C to the
// parent.
static int spawn(const char* const* arguments, int input, int output, pid_t* process)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t signals;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    if (output >= 0)
        posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    else
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    int error =
        posix_spawnp(process, *arguments, &actions, &attributes, (char* const*)(uintptr_t)arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

FILE* hair_encoder_start(const char* tool, const char* path, int descriptor, pid_t* process)
{
    // A file is rearranged so that playback can start before all of it is loaded. A pipe cannot be
    // rearranged.
    const char* layout = path ? "+faststart" : "+frag_keyframe+empty_moov";
    const char* const arguments[] = {
        "ffmpeg", "-loglevel", "error", "-y", "-f", "yuv4mpegpipe", "-i", "pipe:0",
        // The tags describe the planes. Nothing is converted.
        "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
        "tv", "-pix_fmt", "yuv420p", "-c:v", "libx264", "-crf", "18", "-movflags", layout, "-f", "mp4",
        path ? path : "pipe:1", NULL};
    int pipes[2];
    if (pipe(pipes)) {
        hair_complain(tool, "cannot make a pipe: %s", strerror(errno));
        return NULL;
    }
    fcntl(pipes[0], F_SETFD, FD_CLOEXEC);
    fcntl(pipes[1], F_SETFD, FD_CLOEXEC);
    int error = spawn(arguments, pipes[0], path ? -1 : descriptor, process);
    close(pipes[0]);
    if (!error) {
        FILE* encoder = fdopen(pipes[1], "wb");
        if (encoder) return encoder;
        error = errno;
        close(pipes[1]);
        hair_encoder_wait(*process);
    } else
        close(pipes[1]);
    hair_complain(tool, "cannot start ffmpeg, which makes .mp4: %s", strerror(error));
    return NULL;
}

int hair_encoder_wait(pid_t process)
{
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
