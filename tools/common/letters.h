// letters.h - Text in a picture, in letters of 5 by 7 dots.
#ifndef HAIR_TOOLS_COMMON_LETTERS_H
#define HAIR_TOOLS_COMMON_LETTERS_H

#include "tools/common/image.h"

#define HAIR_LETTER_WIDTH 6u // dots from one letter to the next
#define HAIR_LETTER_HEIGHT 9u

// Draw text from x, y on, with `scale` pixels per dot. Lines have at most `letters` letters and
// break at blanks. At most `lines` lines are drawn. Pixels outside the picture are skipped. A
// non-ASCII byte is drawn as '?'.
void hair_letters_write(struct hair_image* image, uint32_t x, uint32_t y, uint32_t scale, uint32_t letters,
                        uint32_t lines, const unsigned char color[3], const char* text);

#endif
