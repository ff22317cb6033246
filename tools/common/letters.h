// letters.h - text in a picture, by letters of 5 by 7 dots.
#ifndef HAIR_TOOLS_COMMON_LETTERS_H
#define HAIR_TOOLS_COMMON_LETTERS_H

#include "tools/common/image.h"

#define HAIR_LETTER_WIDTH 6u // dots from one letter to the next
#define HAIR_LETTER_HEIGHT 9u

// From x, y on, `scale` pixels for a dot, in lines of at most `letters` broken at blanks, at most `lines` of them. What
// is outside the picture is left out; what is no ASCII is '?'.
void hair_letters_write(struct hair_image* image, uint32_t x, uint32_t y, uint32_t scale, uint32_t letters,
                        uint32_t lines, const unsigned char color[3], const char* text);

#endif
