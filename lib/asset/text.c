// text.c - lines, tokens and numbers of a text file, read equally in every locale.
#include "lib/asset/text.h"
#include "lib/base/assert.h"

#include <math.h>
#include <stdint.h>

static bool ends_line(unsigned char c)
{
    return c == '\n' || c == '\r';
}
static bool separates(unsigned char c)
{
    return c == ' ' || c == '\t' || c == ',';
}
static bool is_digit(unsigned char c)
{
    return c >= '0' && c <= '9';
}

static unsigned char lower(unsigned char c)
{
    return c >= 'A' && c <= 'Z' ? (unsigned char)(c - 'A' + 'a') : c;
}

static bool begins_comment(const unsigned char* bytes, size_t at, size_t end)
{
    return bytes[at] == '#' || (bytes[at] == '/' && at + 1 < end && bytes[at + 1] == '/');
}

bool hair_text_next(struct hair_text* text, struct hair_line* out)
{
    while (text->at < text->size) {
        size_t start = text->at, end = start;
        while (end < text->size && !ends_line(text->bytes[end])) ++end;
        text->at = end < text->size ? end + 1 : end;
        while (start < end && separates(text->bytes[start])) ++start;
        if (start == end || begins_comment(text->bytes, start, end)) continue;
        HAIR_ASSERT(start < end && end <= text->at && text->at <= text->size);
        *out = (struct hair_line){text->bytes, start, start, end};
        return true;
    }
    return false;
}

bool hair_line_next(struct hair_line* line, struct hair_token* out)
{
    HAIR_ASSERT(line->start <= line->at && line->at <= line->end);
    while (line->at < line->end && separates(line->bytes[line->at])) ++line->at;
    if (line->at == line->end || begins_comment(line->bytes, line->at, line->end)) return false;
    size_t start = line->at;
    // A "#" within a token belongs to it: "1.#INF".
    while (line->at < line->end && !separates(line->bytes[line->at])) ++line->at;
    *out = (struct hair_token){line->bytes + start, start, line->at - start};
    return true;
}

bool hair_token_is(const struct hair_token* token, const char* word)
{
    size_t i = 0;
    for (; i < token->size && word[i]; ++i)
        if (lower(token->bytes[i]) != lower((unsigned char)word[i])) return false;
    return i == token->size && !word[i];
}

// Return whether a text without its sign begins like "inf", "nan", "1.#INF" or a similar word.
static bool is_no_number(const unsigned char* at, const unsigned char* end)
{
    static const char* const beginnings[] = {"inf", "nan", "1.#"};
    for (int i = 0; i < 3; ++i) {
        const unsigned char* own = at;
        const char* word = beginnings[i];
        while (own < end && *word && lower(*own) == (unsigned char)*word) ++own, ++word;
        if (!*word) return true;
    }
    return false;
}

// Multiply a value by a power of ten. Powers up to 1e22 are exact in a double, so up to 19 digits
// of the usual numbers round at most twice.
static double scale_by_power(double value, int power)
{
    if (value == 0) return value;
    for (; power > 0 && value < HUGE_VAL; --power) {
        double factor = 10;
        while (power > 1 && factor < 1e22) factor *= 10, --power;
        value *= factor;
    }
    for (; power < 0 && value > 0; ++power) {
        double factor = 10;
        while (power < -1 && factor < 1e22) factor *= 10, ++power;
        value /= factor;
    }
    return value;
}

struct digits {
    uint64_t mantissa;
    int power; // The number is mantissa times ten to this power.
    bool any;
};

// Read digits. 64 bits hold 19 digits, and further digits only move the point.
static const unsigned char* read_digits(const unsigned char* at, const unsigned char* end, bool fraction,
                                        struct digits* digits)
{
    for (; at < end && is_digit(*at); ++at) {
        digits->any = true;
        bool room = digits->mantissa < UINT64_C(1000000000000000000);
        if (room) digits->mantissa = 10 * digits->mantissa + (uint64_t)(*at - '0');
        if (room && fraction && digits->power > -100000) --digits->power;
        if (!room && !fraction && digits->power < 100000) ++digits->power;
    }
    return at;
}

static const unsigned char* read_sign(const unsigned char* at, const unsigned char* end, bool* negative)
{
    *negative = at < end && *at == '-';
    return at < end && (*at == '-' || *at == '+') ? at + 1 : at;
}

// Read an optional exponent. Return NULL for an exponent without digits.
static const unsigned char* read_exponent(const unsigned char* at, const unsigned char* end, int* power)
{
    if (at == end || lower(*at) != 'e') return at;
    bool negative;
    at = read_sign(at + 1, end, &negative);
    if (at == end) return NULL;
    int exponent = 0;
    for (; at < end && is_digit(*at); ++at)
        if (exponent < 100000) exponent = 10 * exponent + (*at - '0');
    *power += negative ? -exponent : exponent;
    return at;
}

bool hair_token_number(const struct hair_token* token, double* out)
{
    const unsigned char *at = token->bytes, *end = at + token->size;
    bool negative;
    at = read_sign(at, end, &negative);
    if (is_no_number(at, end)) {
        *out = NAN;
        return true;
    }
    struct digits digits = {0};
    at = read_digits(at, end, false, &digits);
    if (at < end && *at == '.') at = read_digits(at + 1, end, true, &digits);
    if (!digits.any) return false;
    at = read_exponent(at, end, &digits.power);
    if (at != end) return false;
    double value = scale_by_power((double)digits.mantissa, digits.power);
    *out = negative ? -value : value;
    return true;
}

// Return the length of the character of UTF-8 at the beginning of bytes, or 0.
static size_t measure_utf8(const unsigned char* at, size_t size)
{
    static const uint32_t min[5] = {0, 0, 0x80, 0x800, 0x10000};
    size_t length = at[0] < 0x80 ? 1 : at[0] >> 5 == 6 ? 2 : at[0] >> 4 == 14 ? 3 : at[0] >> 3 == 30 ? 4 : 0;
    if (length <= 1) return length;
    uint32_t character = at[0] & (0x7fu >> length);
    if (length > size) return 0;
    for (size_t i = 1; i < length; ++i) {
        if (at[i] >> 6 != 2) return 0;
        character = character << 6 | (at[i] & 63u);
    }
    bool is_surrogate = character >> 11 == 0xd800 >> 11;
    return character >= min[length] && character <= 0x10ffff && !is_surrogate ? length : 0;
}

bool hair_text_is_utf8(const void* text, size_t size)
{
    for (size_t at = 0, length; at < size; at += length) {
        length = measure_utf8((const unsigned char*)text + at, size - at);
        if (!length) return false;
    }
    return true;
}
