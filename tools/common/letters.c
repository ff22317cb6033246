// letters.c - Text in a picture, in the font DejaVu Sans, whose outlines stb_truetype draws.
#include "tools/common/letters.h"
#include "tools/common/file.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MAX_BYTES ((size_t)16 << 20)

struct hair_letters {
    stbtt_fontinfo font;
    struct hair_bytes file;
};

static const char* const fonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                    "/usr/share/fonts/TTF/DejaVuSans.ttf"};

struct hair_letters* hair_letters_create(const char* tool)
{
    const char* path = fonts[0];
    for (size_t i = 0; i < sizeof fonts / sizeof *fonts; ++i)
        if (access(path, R_OK)) path = fonts[i];
    struct hair_letters* letters = calloc(1, sizeof *letters);
    if (!letters) {
        hair_complain(tool, "out of memory");
        return NULL;
    }
    if (!hair_file_read(tool, path, MAX_BYTES, &letters->file)) {
        free(letters);
        return NULL;
    }
    if (stbtt_InitFont(&letters->font, letters->file.data, 0)) return letters;
    hair_complain(tool, "%s: this is no font", path);
    hair_letters_destroy(letters);
    return NULL;
}

void hair_letters_destroy(struct hair_letters* letters)
{
    if (!letters) return;
    free(letters->file.data);
    free(letters);
}

uint32_t hair_letters_line(uint32_t size)
{
    return size + size / 3;
}

static int letter_of(char byte)
{
    return byte < ' ' || byte > '~' ? '?' : byte;
}

// Return the distance from a letter to the next, in units of the font.
static int advance_of(const struct hair_letters* letters, const char* text)
{
    int advance, bearing, first = letter_of(text[0]);
    stbtt_GetCodepointHMetrics(&letters->font, first, &advance, &bearing);
    return advance + (text[1] ? stbtt_GetCodepointKernAdvance(&letters->font, first, letter_of(text[1])) : 0);
}

// Return the length of text that fits into a line. A word wider than a line is cut.
static size_t fit_line(const struct hair_letters* letters, const char* text, float units)
{
    size_t fits = 0, blank = 0;
    for (float at = 0; text[fits]; ++fits) {
        at += (float)advance_of(letters, text + fits);
        if (at > units) break;
        if (text[fits] == ' ') blank = fits;
    }
    if (!text[fits] || text[fits] == ' ') return fits;
    return blank ? blank : fits + !fits;
}

// Blend a letter's coverage into the picture.
static void blend(struct hair_image* image, int x, int y, int width, int height,
                  const unsigned char* coverage, const unsigned char color[3])
{
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            int px = x + column, py = y + row, share = coverage[row * width + column];
            if (px < 0 || py < 0 || px >= (int)image->width || py >= (int)image->height) continue;
            unsigned char* pixel = image->encoded + 3 * ((size_t)py * image->width + (size_t)px);
            for (int k = 0; k < 3; ++k)
                pixel[k] = (unsigned char)((pixel[k] * (255 - share) + color[k] * share + 127) / 255);
        }
}

void hair_letters_write(const struct hair_letters* letters, struct hair_image* image, uint32_t x, uint32_t y,
                        uint32_t size, uint32_t width, uint32_t lines, const unsigned char color[3],
                        const char* text)
{
    const stbtt_fontinfo* font = &letters->font;
    float scale = stbtt_ScaleForPixelHeight(font, (float)size);
    int ascent, descent, gap;
    stbtt_GetFontVMetrics(font, &ascent, &descent, &gap);
    for (uint32_t line = 0; line < lines && *text; ++line) {
        size_t length = fit_line(letters, text, (float)width / scale);
        float at = (float)x,
              base = (float)y + (float)(line * hair_letters_line(size)) + scale * (float)ascent;
        for (size_t i = 0; i < length; ++i) {
            int w, h, left, top, whole = (int)at;
            unsigned char* coverage = stbtt_GetCodepointBitmapSubpixel(
                font, scale, scale, at - (float)whole, 0, letter_of(text[i]), &w, &h, &left, &top);
            if (coverage) blend(image, whole + left, (int)base + top, w, h, coverage, color);
            stbtt_FreeBitmap(coverage, NULL);
            at += scale * (float)advance_of(letters, text + i);
        }
        text += length;
        text += strspn(text, " ");
    }
}
