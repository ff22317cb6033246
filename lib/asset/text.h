// text.h - lines, tokens and numbers of a text file that need not end in a 0, the same in every locale.
#ifndef HAIR_ASSET_TEXT_H
#define HAIR_ASSET_TEXT_H

#include <stdbool.h>
#include <stddef.h>

struct hair_text {
    const unsigned char* bytes;
    size_t size, at; // at: where the next line begins
};

struct hair_line {
    const unsigned char* bytes;
    size_t start, at, end; // at: where the next token is looked for
};

struct hair_token {
    const unsigned char* bytes;
    size_t at, size; // at: byte in the file
};

// The next line with a token in it. Lines end in \n, \r\n or \r; "#" and "//" begin a comment, to the end of
// the line.
bool hair_text_next(struct hair_text* text, struct hair_line* out);

// The next token of a line. Spaces, tabs and commas lie between tokens.
bool hair_line_next(struct hair_line* line, struct hair_token* out);

// Upper and lower case are the same.
bool hair_token_is(const struct hair_token* token, const char* word);

// A decimal number. What C libraries print for numbers that are none ("nan", "-inf", "1.#IND") gives NaN.
bool hair_token_number(const struct hair_token* token, double* out);

#endif
