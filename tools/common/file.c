// file.c - Reading of whole files, atomic output files, error messages and exit statuses of a tool.
#define _XOPEN_SOURCE 700
#include "tools/common/file.h"

#include <hair/hair_asset.h>

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

int hair_exit_for(hair_result result)
{
    switch (result) {
    case HAIR_OK: return HAIR_EXIT_OK;
    case HAIR_ERROR_ARGUMENT: return HAIR_EXIT_USAGE;
    case HAIR_ERROR_FILE: return HAIR_EXIT_INPUT;
    case HAIR_ERROR_CONTEXT_LOST:
    case HAIR_ERROR_OPENGL: return HAIR_EXIT_OPENGL;
    case HAIR_ERROR_MEMORY:
    case HAIR_ERROR_VERSION: break;
    }
    return HAIR_EXIT_RUNTIME;
}

// Earlier writes that overflowed the buffer may have failed already, therefore check ferror too.
int hair_flush(const char* tool)
{
    if (!fflush(stdout) && !ferror(stdout)) return HAIR_EXIT_OK;
    hair_complain(tool, "cannot write to the standard output: %s", strerror(errno));
    return HAIR_EXIT_RUNTIME;
}

// Return the length of the character of UTF-8 at `text`. Return 0 for a control character, and for
// bytes that are not UTF-8.
static size_t printable_length(const unsigned char* text)
{
    static const unsigned first[] = {0, 0, 0xc2, 0xe0, 0xf0};
    size_t length = text[0] < 0x80 ? 1 : text[0] < 0xe0 ? 2 : text[0] < 0xf0 ? 3 : text[0] < 0xf5 ? 4 : 0;
    if (length == 1) return text[0] >= 0x20 && text[0] != 0x7f;
    if (length == 0 || text[0] < first[length]) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((text[i] & 0xc0) != 0x80) return 0;
    if (length == 2 && text[0] == 0xc2 && text[1] < 0xa0) return 0; // ISO 6429
    // Longer forms than needed, and halves of pairs.
    if ((text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90)) return 0;
    if ((text[0] == 0xed && text[1] > 0x9f) || (text[0] == 0xf4 && text[1] > 0x8f)) return 0;
    return length;
}

void hair_escape(const char* text, char* out, size_t size)
{
    const unsigned char* from = (const unsigned char*)text;
    size_t used = 0;
    while (*from && used + 5 < size) {
        size_t length = printable_length(from);
        if (length == 0) used += (size_t)snprintf(out + used, size - used, "\\x%02x", *from);
        memcpy(out + used, from, length);
        used += length;
        from += length ? length : 1;
    }
    out[used] = 0;
}

// Function that hears every message, for programs with a window.
static void (*listener)(const char* sentence, void* user);
static void* listener_user;

void hair_complain_to(void (*hear)(const char* sentence, void* user), void* user)
{
    listener = hear;
    listener_user = user;
}

void hair_complain(const char* tool, const char* format, ...)
{
    char sentence[1024], name[1024], escaped[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    hair_escape(tool, name, sizeof name);
    hair_escape(sentence, escaped, sizeof escaped);
    fprintf(stderr, "%s: %s\n", name, escaped); // One call keeps the lines of two threads apart.
    if (listener) listener(escaped, listener_user);
}

void hair_complain_option(const char* tool, const char* argument)
{
    hair_complain(tool, "%s is not an option, or its argument is missing or too many", argument);
}

void hair_print_log(hair_log_level level, const char* sentence, void* tool)
{
    if (level < HAIR_LOG_INFO) hair_complain(tool, "%s", sentence);
}

const char* hair_log_name(const char* tool, const char* path)
{
    static char name[1024];
    snprintf(name, sizeof name, "%s: %s", tool, path);
    return name;
}

static bool is_standard(const char* path)
{
    return strcmp(path, "-") == 0;
}

// Return an upper bound on the size of a file by its beginning.
typedef uint64_t max_size(const void* bytes, size_t size);

#define FIRST_ROOM ((size_t)1 << 16) // Bytes that are read before the size is known.

// Make room for more bytes, up to `max` of them and one more, which tells of a longer file.
static bool make_room(const char* tool, const char* path, size_t max, size_t* room, struct hair_bytes* bytes)
{
    size_t wider = *room ? (*room < max / 2 ? 2 * *room : max + 1) : FIRST_ROOM;
    void* more = realloc(bytes->data, wider);
    if (!more) {
        hair_complain(tool, "out of memory after %zu bytes of %s", bytes->size, path);
        return false;
    }
    bytes->data = more;
    *room = wider;
    return true;
}

// Read to the end of the file, or to what `find_max` allows, and double the buffer as needed,
// because the size of a pipe is unknown.
static bool read_all(const char* tool, const char* path, FILE* file, size_t limit, max_size* find_max,
                     struct hair_bytes* out)
{
    struct hair_bytes bytes = {0};
    size_t room = 0, max = limit;
    while (bytes.size <= max) {
        if (bytes.size == room && !make_room(tool, path, max, &room, &bytes)) break;
        size_t got = fread(bytes.data + bytes.size, 1, room - bytes.size, file);
        bytes.size += got;
        if (find_max && bytes.size == FIRST_ROOM) {
            uint64_t found = find_max(bytes.data, bytes.size);
            if (found < limit) max = (size_t)found;
        }
        if (bytes.size > limit) {
            hair_complain(tool, "%s has more than the %zu bytes allowed", path, limit);
            break;
        }
        if (ferror(file)) {
            hair_complain(tool, "cannot read %s: %s", path, strerror(errno));
            break;
        }
        if (bytes.size > max || (got == 0 && feof(file))) {
            *out = bytes;
            return true;
        }
    }
    free(bytes.data);
    return false;
}

static bool read_file(const char* tool, const char* path, size_t limit, max_size* find_max,
                      struct hair_bytes* out)
{
    if (is_standard(path)) return read_all(tool, "the standard input", stdin, limit, find_max, out);
    FILE* file = fopen(path, "rb");
    if (!file) {
        hair_complain(tool, "cannot read %s: %s", path, strerror(errno));
        return false;
    }
    bool ok = read_all(tool, path, file, limit, find_max, out);
    fclose(file);
    return ok;
}

bool hair_file_read(const char* tool, const char* path, size_t limit, struct hair_bytes* out)
{
    return read_file(tool, path, limit, NULL, out);
}

bool hair_file_read_haircut(const char* tool, const char* path, size_t limit, struct hair_bytes* out)
{
    return read_file(tool, path, limit, hair_asset_max_size, out);
}

bool hair_output_has_ending(const char* tool, const char* path, const char* ending)
{
    const char *slash = strrchr(path, '/'), *end = strrchr(slash ? slash : path, '.');
    if (!end || !strcasecmp(end, ending)) return true;
    hair_complain(tool, "%s ends in %s, but what is written is %s", path, end, ending);
    return false;
}

static bool cannot_write(const char* tool, const char* path)
{
    hair_complain(tool, "cannot write %s: %s", path, strerror(errno));
    return false;
}

// Return whether to write the file in place. Names under /dev and /proc are in place too, because
// /dev/fd/3 may be a regular file that other processes have open.
static bool is_in_place(const char* path, const struct stat* status)
{
    return !S_ISREG(status->st_mode) || strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0;
}

// /dev/stdout is the standard output even on a system that lacks this name.
static bool is_standard_output(const char* path)
{
    return is_standard(path) || strcmp(path, "/dev/stdout") == 0;
}

static bool open_in_place(struct hair_output* output)
{
    output->file = is_standard_output(output->path) ? stdout : fopen(output->path, "wb");
    return output->file || cannot_write(output->tool, output->path);
}

// Names of the temporary files that exist. A signal handler reads them.
static char* volatile temporaries[8];

static void replace_temporary(const char* old, char* now)
{
    for (size_t i = 0; i < sizeof temporaries / sizeof *temporaries; ++i)
        if (temporaries[i] == old) {
            temporaries[i] = now;
            return;
        }
}

static void remove_temporary(struct hair_output* output)
{
    unlink(output->temporary);
    replace_temporary(output->temporary, NULL);
}

void hair_output_remove_all(void)
{
    for (size_t i = 0; i < sizeof temporaries / sizeof *temporaries; ++i)
        if (temporaries[i]) unlink(temporaries[i]);
}

// Open a temporary file in the directory of the target, because a rename must stay within one file
// system. `mode` is the mode of the target.
static bool open_temporary(struct hair_output* output, mode_t mode)
{
    static const char suffix[] = ".XXXXXX";
    size_t length = strlen(output->path);
    output->temporary = malloc(length + sizeof suffix);
    if (!output->temporary) return cannot_write(output->tool, output->path);
    memcpy(output->temporary, output->path, length);
    memcpy(output->temporary + length, suffix, sizeof suffix);

    int descriptor = mkstemp(output->temporary);
    if (descriptor < 0) return cannot_write(output->tool, output->path);
    replace_temporary(NULL, output->temporary);
    output->file = fchmod(descriptor, mode) ? NULL : fdopen(descriptor, "wb");
    if (output->file) return true;
    cannot_write(output->tool, output->path);
    close(descriptor);
    remove_temporary(output);
    return false;
}

bool hair_output_open(const char* tool, const char* path, struct hair_output* out)
{
    struct hair_output output = {.tool = tool};
    struct stat status;
    bool exists = !is_standard_output(path) && stat(path, &status) == 0;
    // Replace the target of a symbolic link and keep the link.
    output.path = exists && S_ISREG(status.st_mode) ? realpath(path, NULL) : strdup(path);
    if (!output.path) return cannot_write(tool, path);

    bool in_place = is_standard_output(path) || (exists && is_in_place(path, &status));
    mode_t mask = umask(0);
    umask(mask);
    // A rename would ignore that the target is read-only.
    if (exists && !in_place && access(output.path, W_OK)) in_place = true;
    if (in_place ? open_in_place(&output)
                 : open_temporary(&output, exists ? status.st_mode & 0777 : 0666 & ~mask)) {
        *out = output;
        return true;
    }
    free(output.temporary);
    free(output.path);
    return false;
}

static void forget(struct hair_output* output)
{
    if (output->temporary) replace_temporary(output->temporary, NULL);
    free(output->temporary);
    free(output->path);
    *output = (struct hair_output){0};
}

// Flush and close the file. The standard output stays open for the rest of the program.
static bool close_file(struct hair_output* output)
{
    bool written = !fflush(output->file) && !ferror(output->file);
    if (output->file != stdout && fclose(output->file)) written = false;
    output->file = NULL;
    return written;
}

bool hair_output_commit(struct hair_output* output)
{
    bool ok = close_file(output) && (!output->temporary || !rename(output->temporary, output->path));
    if (!ok) cannot_write(output->tool, output->path);
    if (!ok && output->temporary) remove_temporary(output);
    forget(output);
    return ok;
}

void hair_output_discard(struct hair_output* output)
{
    close_file(output);
    if (output->temporary) remove_temporary(output);
    forget(output);
}
