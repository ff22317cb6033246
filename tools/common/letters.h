// letters.h - Text in a picture, in the font DejaVu Sans.
#ifndef HAIR_TOOLS_COMMON_LETTERS_H
#define HAIR_TOOLS_COMMON_LETTERS_H

#include "tools/common/image.h"

struct hair_letters;

// Read the font. Return NULL after printing an error.
struct hair_letters* hair_letters_create(const char* tool);
void hair_letters_destroy(struct hair_letters* letters);

// Return the distance of two lines of text whose letters are `size` pixels high.
uint32_t hair_letters_line(uint32_t size);

// Draw text from x, y on. Lines have at most `width` pixels and break at blanks. At most `lines`
// lines are drawn. Pixels outside the picture are skipped. A non-ASCII byte is drawn as '?'.
void hair_letters_write(const struct hair_letters* letters, struct hair_image* image, uint32_t x, uint32_t y,
                        uint32_t size, uint32_t width, uint32_t lines, const unsigned char color[3],
                        const char* text);

#endif
