// gallery.c - hair-gallery, which makes one sheet of many pictures with captions. hair-capture
// makes each picture. gallery.inl lists them.
#define _GNU_SOURCE
#include "tools/common/file.h"
#include "tools/common/letters.h"

#include <errno.h>
#include <getopt.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define TOOL "hair-gallery"
#define COLUMNS 4u // pictures per row
#define MARGIN 16u // pixels around each picture
#define TITLE 30u // height of a title's letters, pixels
#define CAPTION 18u
#define CAPTION_LINES 2u
#define PICTURE_PATH 4128
#define SAMPLES "--supersample 4 " // default, a row of gallery.inl can override it

static const struct entry {
    const char* title; // title of a row, NULL for a picture
    const char* caption; // caption of a picture
    const char* arguments; // arguments of hair-capture
} entries[] = {
#define ROW(title) {title, NULL, NULL},
#define PICTURE(caption, arguments) {NULL, caption, SAMPLES arguments},
#include "tools/gallery.inl"
#undef ROW
#undef PICTURE
};
#define ENTRIES ((uint32_t)(sizeof entries / sizeof *entries))

struct gallery {
    const char* out;
    const char* only; // NULL shows every row
    uint32_t width, height, jobs;
    char capture[4096]; // path of hair-capture
    char folder[4096];
    struct {
        uint32_t x, y; // upper left corner
        bool is_shown;
        pid_t process; // process that makes the picture, 0 if none
    } place[ENTRIES];
    struct hair_image sheet;
};

static int print_help(void)
{
    printf(TOOL " - pictures with captions on one sheet, each made by hair-capture\n\n  " TOOL
                " [OPTION]... -o OUT.png\n\n"
                "  --only WORD   rows with this word in their title\n"
                "  --size WxH    of each picture, pixels; 400x400\n"
                "  --jobs N      pictures made at once; one a processor\n"
                "  --list        print captions and the arguments of hair-capture\n"
                "  --output OUT  (also -o) the sheet\n"
                "  --help        (also -h) this\n"
                "  --version     the version of the library\n\n"
                "It runs in the repository's root. A row is a line of tools/gallery.inl.\n"
                "Exit status: 0 done, 1 failed while running, 2 wrong use.\n");
    return hair_flush(TOOL);
}

// Layout ------------------------------------------------------------------------------------------

static void arrange(struct gallery* gallery)
{
    uint32_t y = MARGIN, column = 0, below = 0;
    bool is_shown = true;
    for (uint32_t i = 0; i < ENTRIES; ++i) {
        const struct entry* entry = &entries[i];
        if (entry->title) {
            is_shown = !gallery->only || strcasestr(entry->title, gallery->only);
            y += below;
            column = below = 0;
        }
        gallery->place[i].is_shown = is_shown;
        if (!is_shown) continue;
        if (column == COLUMNS) {
            y += below;
            column = below = 0;
        }
        gallery->place[i].x = MARGIN + column * (gallery->width + MARGIN);
        gallery->place[i].y = y;
        if (entry->title)
            y += hair_letters_line(TITLE) + MARGIN / 2;
        else {
            ++column;
            below = gallery->height + MARGIN / 2 + CAPTION_LINES * hair_letters_line(CAPTION) + 2 * MARGIN;
        }
    }
    gallery->sheet.width = MARGIN + COLUMNS * (gallery->width + MARGIN);
    gallery->sheet.height = y + below;
}

static bool make_ground(struct gallery* gallery)
{
    static const unsigned char ground[3] = {24, 25, 28};
    size_t pixels = (size_t)gallery->sheet.width * gallery->sheet.height;
    gallery->sheet.encoded = malloc(3 * pixels);
    if (!gallery->sheet.encoded) {
        hair_complain(TOOL, "out of memory for a sheet of %u x %u", gallery->sheet.width,
                      gallery->sheet.height);
        return false;
    }
    for (size_t i = 0; i < pixels; ++i) memcpy(gallery->sheet.encoded + 3 * i, ground, 3);
    return true;
}

static bool write_captions(struct gallery* gallery)
{
    static const unsigned char bright[3] = {235, 232, 225}, dim[3] = {178, 176, 170};
    struct hair_letters* letters = hair_letters_create(TOOL);
    if (!letters) return false;
    for (uint32_t i = 0; i < ENTRIES; ++i) {
        uint32_t x = gallery->place[i].x, y = gallery->place[i].y;
        if (!gallery->place[i].is_shown) continue;
        if (entries[i].title)
            hair_letters_write(letters, &gallery->sheet, x, y, TITLE, gallery->sheet.width - 2 * MARGIN, 1,
                               bright, entries[i].title);
        else
            hair_letters_write(letters, &gallery->sheet, x, y + gallery->height + MARGIN / 2, CAPTION,
                               gallery->width, CAPTION_LINES, dim, entries[i].caption);
    }
    hair_letters_destroy(letters);
    return true;
}

// Pictures ----------------------------------------------------------------------------------------

static void name_picture(const struct gallery* gallery, uint32_t i, char name[PICTURE_PATH])
{
    snprintf(name, PICTURE_PATH, "%s/%u.png", gallery->folder, i);
}

// Start hair-capture as a child process. The shell splits the arguments of the table.
static bool begin_picture(struct gallery* gallery, uint32_t i)
{
    char script[1024], size[32], name[PICTURE_PATH];
    name_picture(gallery, i, name);
    snprintf(size, sizeof size, "%ux%u", gallery->width, gallery->height);
    snprintf(script, sizeof script, "exec \"$0\" %s \"$@\"", entries[i].arguments);
    gallery->place[i].process = fork();
    if (gallery->place[i].process < 0) {
        gallery->place[i].process = 0;
        hair_complain(TOOL, "cannot start a process: %s", strerror(errno));
        return false;
    }
    if (gallery->place[i].process) return true;
    execl("/bin/sh", "sh", "-c", script, gallery->capture, "--size", size, "--quiet", "-o", name,
          (char*)NULL);
    _exit(127);
}

static bool read_picture(struct gallery* gallery, uint32_t i)
{
    char name[PICTURE_PATH];
    png_image image = {.version = PNG_IMAGE_VERSION};
    name_picture(gallery, i, name);
    size_t at = (size_t)gallery->place[i].y * gallery->sheet.width + gallery->place[i].x;
    bool ok = png_image_begin_read_from_file(&image, name) && image.width == gallery->width &&
              image.height == gallery->height;
    image.format = PNG_FORMAT_RGB;
    ok = ok && png_image_finish_read(&image, NULL, gallery->sheet.encoded + 3 * at,
                                     (png_int_32)(3 * gallery->sheet.width), NULL);
    png_image_free(&image);
    unlink(name);
    if (!ok) hair_complain(TOOL, "cannot read the picture \"%s\"", entries[i].caption);
    return ok;
}

// Wait for any picture. Return false if it failed, or if no picture is in progress.
static bool end_picture(struct gallery* gallery)
{
    int status;
    pid_t process = wait(&status);
    for (uint32_t i = 0; i < ENTRIES; ++i) {
        if (process <= 0 || gallery->place[i].process != process) continue;
        gallery->place[i].process = 0;
        if (!status) return read_picture(gallery, i);
        hair_complain(TOOL, "hair-capture failed to make \"%s\": %s", entries[i].caption,
                      entries[i].arguments);
    }
    return false;
}

static bool make_pictures(struct gallery* gallery)
{
    uint32_t running = 0;
    bool ok = true;
    for (uint32_t i = 0; i < ENTRIES && ok; ++i) {
        if (!gallery->place[i].is_shown || entries[i].title) continue;
        if (running == gallery->jobs) {
            ok = end_picture(gallery);
            --running;
        }
        ok = ok && begin_picture(gallery, i);
        running += ok;
    }
    for (; running; --running) ok = end_picture(gallery) && ok;
    return ok;
}

static bool make_sheet(struct gallery* gallery, FILE* file)
{
    // The captions come first, because a missing font shall not cost the time of the pictures.
    if (!make_ground(gallery) || !write_captions(gallery) || !make_pictures(gallery)) return false;
    if (hair_image_write_png(&gallery->sheet, file)) return true;
    hair_complain(TOOL, "cannot write %s", gallery->out);
    return false;
}

static int make(struct gallery* gallery)
{
    const char* temporary = getenv("TMPDIR");
    struct hair_output output;
    if (!hair_output_open(TOOL, gallery->out, &output)) return HAIR_EXIT_RUNTIME;
    snprintf(gallery->folder, sizeof gallery->folder, "%s/hair-gallery-XXXXXX",
             temporary ? temporary : "/tmp");
    bool ok = mkdtemp(gallery->folder);
    if (!ok) hair_complain(TOOL, "cannot make the folder %s: %s", gallery->folder, strerror(errno));
    ok = ok && make_sheet(gallery, output.file);
    rmdir(gallery->folder);
    free(gallery->sheet.encoded);
    if (!ok) hair_output_discard(&output);
    return ok && hair_output_commit(&output) ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}

// The command line --------------------------------------------------------------------------------

static int print_list(const struct gallery* gallery)
{
    for (uint32_t i = 0; i < ENTRIES; ++i) {
        if (!gallery->place[i].is_shown) continue;
        if (entries[i].title)
            printf("%s\n", entries[i].title);
        else
            printf("  %s: %s\n", entries[i].caption, entries[i].arguments);
    }
    return hair_flush(TOOL);
}

static bool wrong(const char* option, const char* text, const char* must)
{
    hair_complain(TOOL, "--%s is %s, not %s", option, text, must);
    return false;
}

static bool take(struct gallery* gallery, int option, const char* text)
{
    int end = 0, read = 0;
    switch (option) {
    case 'o': gallery->out = text; return hair_output_has_ending(TOOL, text, ".png");
    case 'r': gallery->only = text; return true;
    case 's':
        // NOLINTNEXTLINE(cert-err34-c): the width keeps the number in its range.
        read = sscanf(text, "%5ux%5u%n", &gallery->width, &gallery->height, &end);
        if (read == 2 && !text[end] && gallery->width - 1 < 4096 && gallery->height - 1 < 4096) return true;
        return wrong("size", text, "WxH with both in [1, 4096]");
    case 'j':
        // NOLINTNEXTLINE(cert-err34-c): the width keeps the number in its range.
        read = sscanf(text, "%4u%n", &gallery->jobs, &end);
        return (read == 1 && !text[end] && gallery->jobs - 1 < 256) ||
               wrong("jobs", text, "a whole number in [1, 256]");
    default: return false;
    }
}

static int run(struct gallery* gallery, bool lists)
{
    bool any = false;
    arrange(gallery);
    for (uint32_t i = 0; i < ENTRIES; ++i) any |= gallery->place[i].is_shown;
    if (!any)
        hair_complain(TOOL, "--only is %s, a word of no row's title; --list prints them", gallery->only);
    if (any && lists) return print_list(gallery);
    if (any && !gallery->out) hair_complain(TOOL, "nothing to do: give -o OUT.png or --list");
    return any && gallery->out ? make(gallery) : HAIR_EXIT_USAGE;
}

int main(int count, char** arguments)
{
    static const struct option table[] = {
        {"only", 1, NULL, 'r'}, {"size", 1, NULL, 's'}, {"jobs", 1, NULL, 'j'},    {"output", 1, NULL, 'o'},
        {"list", 0, NULL, 'l'}, {"help", 0, NULL, 'h'}, {"version", 0, NULL, 'v'}, {NULL, 0, NULL, 0}};
    struct gallery gallery = {.width = 400, .height = 400};
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const char* slash = strrchr(arguments[0], '/');
    bool lists = false;
    gallery.jobs = cores > 0 && cores < 256 ? (uint32_t)cores : 1;
    snprintf(gallery.capture, sizeof gallery.capture, "%.*shair-capture",
             slash ? (int)(slash - arguments[0]) + 1 : 0, arguments[0]);
    opterr = 0;
    for (int found; (found = getopt_long(count, arguments, "ho:", table, NULL)) != -1;) {
        if (found == '?') {
            hair_complain_option(TOOL, arguments[optind - 1]);
            return HAIR_EXIT_USAGE;
        }
        if (found == 'h') return print_help();
        if (found == 'v') {
            printf(TOOL " %d.%d.%d\n", HAIR_VERSION_MAJOR, HAIR_VERSION_MINOR, HAIR_VERSION_PATCH);
            return hair_flush(TOOL);
        }
        lists |= found == 'l';
        if (found != 'l' && !take(&gallery, found, optarg)) return HAIR_EXIT_USAGE;
    }
    if (optind == count) return run(&gallery, lists);
    hair_complain(TOOL, "%s is one argument too many", arguments[optind]);
    return HAIR_EXIT_USAGE;
}
