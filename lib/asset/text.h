// text.h - lines, tokens and numbers of a text file, read equally in every locale. The text need
// not end in a 0.
#ifndef HAIR_ASSET_TEXT_H
#define HAIR_ASSET_TEXT_H

#include <stdbool.h>
#include <stddef.h>

struct hair_text {
    const unsigned char* bytes;
    size_t size, at; // `at` is the start of the next line.
};

struct hair_line {
    const unsigned char* bytes;
    size_t start, at, end; // `at` is the start of the search for the next token.
};

struct hair_token {
    const unsigned char* bytes;
    size_t at, size; // `at` is the byte in the file.
};

// Find the next line with a token. Lines end in \n, \r\n or \r. "#" and "//" begin a comment, which
// extends to the end of the line.
bool hair_text_next(struct hair_text* text, struct hair_line* out);

// Find the next token of a line. Spaces, tabs and commas separate tokens.
bool hair_line_next(struct hair_line* line, struct hair_token* out);

// Compare a token with a word, ignoring case.
bool hair_token_is(const struct hair_token* token, const char* word);

// Read a decimal number. The texts that C libraries print for invalid numbers ("nan", "-inf",
// "1.#IND") give NaN.
bool hair_token_number(const struct hair_token* token, double* out);
// Return whether a text is valid UTF-8.
bool hair_text_is_utf8(const void* text, size_t size);

#endif
