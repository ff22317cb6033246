// members_json.c - public calls that write public structs as JSON, and read them.
#include "lib/api/members.h"

#include <stdio.h>
#include <string.h>

#define MAX_MEMBERS 128 // of a struct

// Writing -----------------------------------------------------------------------------------------

static void write_member(const hair_member* member, const void* desc, struct hair_text_out* out)
{
    struct hair_member_place place = {NULL, member, 0, member->count};
    hair_text_put(out, "  \"");
    hair_text_put(out, member->name);
    hair_text_put(out, member->count > 1 ? "\": [" : "\": ");
    hair_print_member(&place, desc, ", ", true, out);
    if (member->count > 1) hair_text_put(out, "]");
}

// Return whether a member is a number without a valid default that is not set.
static bool is_unset(const hair_member* member, const void* desc)
{
    static const char zeros[sizeof(uint64_t)];
    return member->defaults[0] < member->min &&
           memcmp((const char*)desc + member->offset, zeros, member->size) == 0;
}

hair_result hair_write_json(const hair_host* host, hair_struct kind, const void* desc, size_t size,
                            const void* base, char* text, size_t capacity, size_t* length)
{
    const hair_host own_host = hair_host_or_default(host);
    struct hair_text_out out = {text, text ? capacity : 0, 0};
    HAIR_TRY(hair_check_struct(&own_host, kind, desc, size));
    if (base) HAIR_TRY(hair_check_struct(&own_host, kind, base, size));
    if (!text && capacity) return hair_fail(&own_host, HAIR_ERROR_ARGUMENT, "text is NULL");
    struct hair_schema schema = hair_schema_of_kind(kind);
    bool is_first = true;
    hair_text_put(&out, "{");
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* member = &schema.member[i];
        size_t bytes = (size_t)member->count * member->size;
        if (!hair_member_is_text(member) || member->offset + bytes > size) continue;
        if (is_unset(member, desc)) continue;
        if (base && !memcmp((const char*)desc + member->offset, (const char*)base + member->offset, bytes))
            continue;
        HAIR_TRY(hair_schema_check_member(&own_host, schema.name, desc, member));
        hair_text_put(&out, is_first ? "\n" : ",\n");
        write_member(member, desc, &out);
        is_first = false;
    }
    hair_text_put(&out, is_first ? "}\n" : "\n}\n");
    return hair_text_end(&own_host, &out, length);
}

// Reading -----------------------------------------------------------------------------------------

struct json_reader {
    const hair_host* host;
    struct hair_schema schema;
    const char* text;
    size_t length, at;
    uint32_t seen[MAX_MEMBERS]; // elements of each member that have a value, as bits
};

static hair_result fail_at(const struct json_reader* reader, const char* wanted)
{
    return hair_fail(reader->host, HAIR_ERROR_FILE, "byte %zu of the JSON of %s: %s", reader->at,
                     reader->schema.name, wanted);
}

// Skip white space. Return the next byte, or 0 at the end.
static char peek(struct json_reader* reader)
{
    while (reader->at < reader->length && strchr(" \t\r\n", reader->text[reader->at]) &&
           reader->text[reader->at])
        ++reader->at;
    return reader->at < reader->length ? reader->text[reader->at] : 0;
}

static hair_result expect(struct json_reader* reader, char wanted)
{
    char sentence[] = "there is no ' '";
    sentence[sizeof sentence - 3] = wanted;
    if (peek(reader) != wanted) return fail_at(reader, sentence);
    ++reader->at;
    return HAIR_OK;
}

// Read a string without escapes, which no name or choice needs.
static hair_result read_string(struct json_reader* reader, struct hair_span* out)
{
    HAIR_TRY(expect(reader, '"'));
    size_t start = reader->at;
    while (reader->at < reader->length && reader->text[reader->at] != '"') {
        if (reader->text[reader->at] == '\\') return fail_at(reader, "an escape is in no name");
        if ((unsigned char)reader->text[reader->at] < ' ') return fail_at(reader, "a control character");
        ++reader->at;
    }
    *out = (struct hair_span){reader->text + start, reader->at - start};
    return expect(reader, '"');
}

static size_t skip_digits(struct json_reader* reader)
{
    size_t start = reader->at;
    while (reader->at < reader->length && reader->text[reader->at] >= '0' && reader->text[reader->at] <= '9')
        ++reader->at;
    return reader->at - start;
}

static bool skip(struct json_reader* reader, const char* characters)
{
    if (reader->at == reader->length || !reader->text[reader->at]) return false;
    if (!strchr(characters, reader->text[reader->at])) return false;
    ++reader->at;
    return true;
}

// Read a number by the grammar of JSON, which has no "+1", "01", ".5" or "5.".
static hair_result read_number(struct json_reader* reader)
{
    skip(reader, "-");
    bool zero = reader->at < reader->length && reader->text[reader->at] == '0';
    size_t digits = skip_digits(reader);
    if (!digits || (zero && digits > 1)) return fail_at(reader, "there is no number");
    if (skip(reader, ".") && !skip_digits(reader))
        return fail_at(reader, "there is no digit after the point");
    if (skip(reader, "eE")) {
        skip(reader, "+-");
        if (!skip_digits(reader)) return fail_at(reader, "there is no digit in the exponent");
    }
    return HAIR_OK;
}

static hair_result read_word(struct json_reader* reader)
{
    static const char* const words[] = {"true", "false"};
    for (int i = 0; i < 2; ++i) {
        size_t length = strlen(words[i]);
        if (reader->length - reader->at < length) continue;
        if (memcmp(reader->text + reader->at, words[i], length)) continue;
        reader->at += length;
        return HAIR_OK;
    }
    return fail_at(reader, "there is no true or false");
}

// Read the numbers of an array. The result lacks the brackets.
static hair_result read_array(struct json_reader* reader, struct hair_span* out)
{
    HAIR_TRY(expect(reader, '['));
    size_t start = reader->at;
    do {
        peek(reader);
        HAIR_TRY(read_number(reader));
    } while (peek(reader) == ',' && ++reader->at);
    *out = (struct hair_span){reader->text + start, reader->at - start};
    return expect(reader, ']');
}

static hair_result read_value(struct json_reader* reader, const struct hair_member_place* place,
                              struct hair_span* out)
{
    peek(reader);
    size_t start = reader->at;
    if (place->count > 1) return read_array(reader, out);
    if (place->member->type == HAIR_MEMBER_ENUM) return read_string(reader, out);
    HAIR_TRY(place->member->type == HAIR_MEMBER_BOOL ? read_word(reader) : read_number(reader));
    *out = (struct hair_span){reader->text + start, reader->at - start};
    return HAIR_OK;
}

static hair_result read_member(struct json_reader* reader, void* desc, size_t size)
{
    struct hair_span name = {0}, value = {0};
    struct hair_member_place place;
    HAIR_TRY(read_string(reader, &name));
    HAIR_TRY(hair_find_member(reader->host, reader->schema, size, name, &place));
    uint32_t* seen = &reader->seen[place.member - reader->schema.member];
    uint32_t elements = ((1u << place.count) - 1) << place.first;
    if (*seen & elements)
        return hair_fail(reader->host, HAIR_ERROR_ARGUMENT, "%s.%s is in the JSON twice", place.owner,
                         place.member->name);
    *seen |= elements;
    HAIR_TRY(expect(reader, ':'));
    HAIR_TRY(read_value(reader, &place, &value));
    return hair_parse_member(reader->host, &place, value, desc);
}

hair_result hair_read_json(const hair_host* host, hair_struct kind, void* desc, size_t size, const char* text,
                           size_t length)
{
    const hair_host own_host = hair_host_or_default(host);
    unsigned char own[HAIR_MAX_STRUCT];
    HAIR_TRY(hair_check_struct(&own_host, kind, desc, size));
    if (!text) return hair_fail(&own_host, HAIR_ERROR_ARGUMENT, "text is NULL");
    struct json_reader reader = {&own_host, hair_schema_of_kind(kind), text, length, 0, {0}};
    HAIR_ASSERT(reader.schema.count <= MAX_MEMBERS);
    memcpy(own, desc, size);
    HAIR_TRY(expect(&reader, '{'));
    if (peek(&reader) != '}') {
        do {
            HAIR_TRY(read_member(&reader, own, size));
        } while (peek(&reader) == ',' && ++reader.at);
    }
    HAIR_TRY(expect(&reader, '}'));
    peek(&reader);
    if (reader.at < length) return fail_at(&reader, "there is text after the object");
    memcpy(desc, own, size);
    return HAIR_OK;
}
