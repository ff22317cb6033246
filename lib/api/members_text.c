// members_text.c - public calls that set and get members of public structs as text.
#include "lib/api/members.h"
#include "lib/asset/text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// Parsing -----------------------------------------------------------------------------------------

static hair_result fail(const hair_host* host, const struct hair_member_place* place, struct hair_span text,
                        const char* wanted)
{
    char quoted[64];
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s.%s is %s, not %s", place->owner, place->member->name,
                     hair_quote(text, quoted), wanted);
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static struct hair_span trim(struct hair_span span)
{
    while (span.length && is_space(*span.text)) ++span.text, --span.length;
    while (span.length && is_space(span.text[span.length - 1])) --span.length;
    return span;
}

// Split a text at its commas. Return the number of parts, or one more than there is room for.
static uint32_t split(struct hair_span text, struct hair_span part[HAIR_MAX_ELEMENTS], uint32_t room)
{
    uint32_t count = 0;
    size_t start = 0;
    for (size_t i = 0; i <= text.length; ++i) {
        if (i < text.length && text.text[i] != ',') continue;
        if (count == room) return room + 1;
        part[count++] = trim((struct hair_span){text.text + start, i - start});
        start = i + 1;
    }
    return count;
}

static bool parse_number(struct hair_span text, double* out)
{
    struct hair_token token = {(const unsigned char*)text.text, 0, text.length};
    return hair_token_number(&token, out);
}

static bool is_word(struct hair_span text, const char* word)
{
    return text.length == strlen(word) && memcmp(text.text, word, text.length) == 0;
}

static hair_result parse_bool(const hair_host* host, const struct hair_member_place* place,
                              struct hair_span text, bool* out)
{
    *out = is_word(text, "true") || is_word(text, "on") || is_word(text, "1");
    if (*out || is_word(text, "false") || is_word(text, "off") || is_word(text, "0")) return HAIR_OK;
    return fail(host, place, text, "one of: off, on");
}

static hair_result parse_choice(const hair_host* host, const struct hair_member_place* place,
                                struct hair_span text, uint32_t* out)
{
    const hair_member* member = place->member;
    char list[256] = "one of: ";
    for (*out = 0; *out < member->choice_count; ++*out)
        if (is_word(text, member->choices[*out])) return HAIR_OK;
    for (uint32_t i = 0; i < member->choice_count; ++i) {
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", member->choices[i]);
    }
    return fail(host, place, text, list);
}

static hair_result parse_whole(const hair_host* host, const struct hair_member_place* place,
                               struct hair_span text, uint32_t* out)
{
    const hair_member* member = place->member;
    double value;
    char range[64];
    if (!parse_number(text, &value) || !isfinite(value) || value != floor(value))
        return fail(host, place, text, "a whole number");
    snprintf(range, sizeof range, "in [%.10g, %.10g]", member->min, member->max);
    if (value < member->min || value > member->max) return fail(host, place, text, range);
    *out = (uint32_t)value;
    return HAIR_OK;
}

static hair_result parse_key(const hair_host* host, const struct hair_member_place* place,
                             struct hair_span text, uint64_t* out)
{
    *out = 0;
    bool is_key = text.length > 0;
    for (size_t i = 0; i < text.length && is_key; ++i) {
        unsigned digit = (unsigned)(unsigned char)text.text[i] - '0';
        is_key = digit <= 9 && *out <= (UINT64_MAX - digit) / 10;
        if (is_key) *out = 10 * *out + digit;
    }
    return is_key ? HAIR_OK : fail(host, place, text, "a whole number in [0, 18446744073709551615]");
}

// Parse numbers of a float member. A whole curve may have fewer numbers, joined by lines.
static hair_result parse_floats(const hair_host* host, const struct hair_member_place* place,
                                struct hair_span text, float* out)
{
    struct hair_span part[HAIR_MAX_ELEMENTS];
    double value[HAIR_MAX_ELEMENTS];
    char wanted[64] = "a number";
    uint32_t wants = place->count, count = split(text, part, wants);
    bool is_curve = place->member->layout == HAIR_LAYOUT_CURVE;
    if (wants > 1)
        snprintf(wanted, sizeof wanted, "%s%u numbers with commas between", is_curve ? "1 to " : "", wants);
    if (count > wants || (count < wants && !is_curve)) return fail(host, place, text, wanted);
    for (uint32_t i = 0; i < count; ++i)
        if (!parse_number(part[i], &value[i])) return fail(host, place, text, wanted);
    for (uint32_t i = 0; i < wants; ++i) {
        float along = wants > 1 ? (float)(i * (count - 1)) / (float)(wants - 1) : 0;
        uint32_t k = (uint32_t)along, next = k + 1 < count ? k + 1 : k;
        double rest = (double)along - k;
        out[i] = (float)(rest > 0 ? value[k] + rest * (value[next] - value[k]) : value[k]);
    }
    return HAIR_OK;
}

hair_result hair_parse_member(const hair_host* host, const struct hair_member_place* place,
                              struct hair_span text, void* desc)
{
    const hair_member* member = place->member;
    unsigned char* at = (unsigned char*)desc + member->offset + place->first * member->size;
    union {
        float real[HAIR_MAX_ELEMENTS];
        uint32_t whole;
        uint64_t key;
        bool is_on;
    } value;
    hair_result result = HAIR_ERROR_ARGUMENT;
    text = trim(text);
    switch (member->type) {
    case HAIR_MEMBER_FLOAT: result = parse_floats(host, place, text, value.real); break;
    case HAIR_MEMBER_UINT: result = parse_whole(host, place, text, &value.whole); break;
    case HAIR_MEMBER_UINT64: result = parse_key(host, place, text, &value.key); break;
    case HAIR_MEMBER_BOOL: result = parse_bool(host, place, text, &value.is_on); break;
    case HAIR_MEMBER_ENUM: result = parse_choice(host, place, text, &value.whole); break;
    case HAIR_MEMBER_TEXTURE:
    case HAIR_MEMBER_POINTER: break; // hair_find_member() has refused them.
    }
    HAIR_TRY(result);
    memcpy(at, &value, (size_t)place->count * member->size);
    return hair_schema_check_member(host, place->owner, desc, member);
}

// Printing ----------------------------------------------------------------------------------------

void hair_text_put(struct hair_text_out* out, const char* text)
{
    for (; *text; ++text, ++out->length)
        if (out->length < out->capacity) out->text[out->length] = *text;
}

hair_result hair_text_end(const hair_host* host, struct hair_text_out* out, size_t* length)
{
    HAIR_ASSERT(out->text || !out->capacity);
    if (length) *length = out->length;
    if (!out->text && !out->capacity) return HAIR_OK;
    if (out->length < out->capacity) {
        out->text[out->length] = 0;
        return HAIR_OK;
    }
    if (out->capacity) out->text[0] = 0;
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "capacity is %zu, not above the length %zu of the text",
                     out->capacity, out->length);
}

// Replace the decimal point of the locale, which may have several bytes.
static void unlocalize(char* text)
{
    char* to = text;
    bool in_point = false;
    for (const char* at = text; *at; ++at) {
        bool is_point = !strchr("0123456789+-e", *at);
        if (!is_point || !in_point) *to++ = is_point ? '.' : *at;
        in_point = is_point;
    }
    *to = 0;
}

static bool prints_as(float value, int digits, char out[32])
{
    double again;
    snprintf(out, 32, "%.*g", digits, (double)value);
    unlocalize(out);
    float parsed = parse_number((struct hair_span){out, strlen(out)}, &again) ? (float)again : 0;
    return memcmp(&parsed, &value, sizeof value) == 0;
}

// Print the fewest digits that parse to the same bits. Nine are always enough. Whole numbers
// have no exponent if nine digits suffice.
static void print_float(float value, char out[32])
{
    char plain[32];
    for (int digits = 1; digits <= 9; ++digits)
        if (prints_as(value, digits, out)) break;
    if (prints_as(value, 9, plain) && !strpbrk(plain, ".e")) memcpy(out, plain, 32);
}

static void print_element(const hair_member* member, const unsigned char* at, bool is_json,
                          struct hair_text_out* out)
{
    char text[32];
    float real;
    uint32_t whole = 0;
    uint64_t key;
    if (member->type == HAIR_MEMBER_FLOAT) {
        memcpy(&real, at, sizeof real);
        print_float(real, text);
    } else if (member->type == HAIR_MEMBER_BOOL) {
        snprintf(text, sizeof text, "%s", *at ? "true" : "false");
    } else if (member->type == HAIR_MEMBER_UINT64) {
        memcpy(&key, at, sizeof key);
        snprintf(text, sizeof text, "%" PRIu64, key);
    } else {
        memcpy(&whole, at, sizeof whole);
        snprintf(text, sizeof text, "%" PRIu32, whole);
    }
    bool is_choice = member->type == HAIR_MEMBER_ENUM;
    HAIR_ASSERT(!is_choice || whole < member->choice_count);
    if (is_choice && is_json) hair_text_put(out, "\"");
    hair_text_put(out, is_choice ? member->choices[whole] : text);
    if (is_choice && is_json) hair_text_put(out, "\"");
}

void hair_print_member(const struct hair_member_place* place, const void* desc, const char* separator,
                       bool is_json, struct hair_text_out* out)
{
    const hair_member* member = place->member;
    for (uint32_t i = 0; i < place->count; ++i) {
        if (i) hair_text_put(out, separator);
        print_element(member, (const unsigned char*)desc + member->offset + (place->first + i) * member->size,
                      is_json, out);
    }
}

// Calls -------------------------------------------------------------------------------------------

hair_result hair_set_member(const hair_host* host, hair_struct kind, void* desc, size_t size,
                            const char* name, const char* text)
{
    const hair_host own_host = hair_host_or_default(host);
    unsigned char own[HAIR_MAX_STRUCT];
    struct hair_member_place place;
    HAIR_TRY(hair_check_struct(&own_host, kind, desc, size));
    if (!name || !text)
        return hair_fail(&own_host, HAIR_ERROR_ARGUMENT, "%s is NULL", name ? "text" : "name");
    HAIR_TRY(hair_find_member(&own_host, hair_schema_of_kind(kind), size,
                              (struct hair_span){name, strlen(name)}, &place));
    memcpy(own, desc, size);
    HAIR_TRY(hair_parse_member(&own_host, &place, (struct hair_span){text, strlen(text)}, own));
    memcpy(desc, own, size);
    return HAIR_OK;
}

hair_result hair_get_member(const hair_host* host, hair_struct kind, const void* desc, size_t size,
                            const char* name, char* text, size_t capacity, size_t* length)
{
    const hair_host own_host = hair_host_or_default(host);
    struct hair_member_place place;
    struct hair_text_out out = {text, text ? capacity : 0, 0};
    HAIR_TRY(hair_check_struct(&own_host, kind, desc, size));
    if (!name || (!text && capacity))
        return hair_fail(&own_host, HAIR_ERROR_ARGUMENT, "%s is NULL", name ? "text" : "name");
    HAIR_TRY(hair_find_member(&own_host, hair_schema_of_kind(kind), size,
                              (struct hair_span){name, strlen(name)}, &place));
    HAIR_TRY(hair_schema_check_member(&own_host, place.owner, desc, place.member));
    hair_print_member(&place, desc, ",", false, &out);
    return hair_text_end(&own_host, &out, length);
}
