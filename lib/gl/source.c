// source.c - shader sources, built in or read from a folder, with includes inserted.
#include "lib/gl/gl.h"

#include <stdio.h>
#include <string.h>

// Names and texts, each ended by a 0. An empty name ends the array. tools/embed.c generates the
// array.
extern const unsigned char hair_sources[];

#define MAX_FILE (1u << 20)

struct text {
    const hair_host* host;
    char* bytes;
    size_t size, capacity;
    int failed;
};

static void append(struct text* text, const char* bytes, size_t size)
{
    if (text->failed) return;
    if (text->size + size + 1 > text->capacity) {
        size_t capacity = 2 * (text->size + size) + 4096;
        char* grown = hair_alloc(text->host, capacity, 1);
        if (!grown) {
            text->failed = 1;
            return;
        }
        if (text->bytes) memcpy(grown, text->bytes, text->size);
        hair_free(text->host, text->bytes);
        text->bytes = grown;
        text->capacity = capacity;
    }
    HAIR_ASSERT(text->size + size < text->capacity);
    memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
    text->bytes[text->size] = 0;
}

static const char* find_built_in(const char* name)
{
    for (const char* at = (const char*)hair_sources; *at;) {
        const char* text = at + strlen(at) + 1;
        if (strcmp(at, name) == 0) return text;
        at = text + strlen(text) + 1;
    }
    return NULL;
}

// Read a file. *out stays NULL if the file does not exist or is too long.
static hair_result read_file(const hair_host* host, const char* folder, const char* name, char** out)
{
    char path[1024];
    if ((size_t)snprintf(path, sizeof path, "%s/%s", folder, name) >= sizeof path) return HAIR_OK;
    FILE* file = fopen(path, "rb");
    if (!file) return HAIR_OK;
    // Zeroed, so that the text ends where the file does.
    char* text = hair_alloc(host, MAX_FILE + 1, 1);
    if (text && fread(text, 1, MAX_FILE, file) < MAX_FILE)
        *out = text;
    else
        hair_free(host, text);
    fclose(file);
    return text ? HAIR_OK : hair_fail_memory(host, "shader text");
}

// Find the name between quotes in an #include line. Return its length, or 0 if the line is none.
static size_t parse_include(const char* line, const char* end, const char** name)
{
    while (line < end && (*line == ' ' || *line == '\t')) ++line;
    if (end - line < 10 || strncmp(line, "#include", 8) != 0) return 0;
    const char* first = memchr(line, '"', (size_t)(end - line));
    const char* last = first ? memchr(first + 1, '"', (size_t)(end - first - 1)) : NULL;
    if (!last) return 0;
    *name = first + 1;
    return (size_t)(last - first - 1);
}

struct source_reader {
    const hair_host* host;
    const char* folder;
    const char* prefix;
    const char* own;
    struct text text;
    struct hair_gl_source* out;
};

static hair_result read_one(struct source_reader* reader, const char* name, size_t length);

// Return the number of a file in #line directives. One compiler reports some errors of any file in
// file 0. If the application has a text, that text is file 0.
static uint32_t called(const struct source_reader* reader, uint32_t number)
{
    HAIR_ASSERT(number < reader->out->files);
    if (!reader->own) return number;
    if (number == 0) return HAIR_GL_MAX_SOURCES;
    return strcmp(reader->out->file[number], HAIR_GL_USER_SHADER) == 0 ? 0 : number;
}

static hair_result put_lines(struct source_reader* reader, const char* text, uint32_t number)
{
    int line_number = 1;
    for (const char* line = text; *line; ++line_number) {
        const char* stop = strchr(line, '\n');
        const char* end = stop ? stop : line + strlen(line);
        const char* name;
        char directive[64];
        size_t length = parse_include(line, end, &name);
        if (length) {
            HAIR_TRY(read_one(reader, name, length));
            append(&reader->text, directive,
                   (size_t)snprintf(directive, sizeof directive, "#line %d %u\n", line_number + 1,
                                    called(reader, number)));
        } else {
            append(&reader->text, line, (size_t)(end - line));
            append(&reader->text, "\n", 1);
            if (number == 0 && strncmp(line, "#version", 8) == 0) {
                append(&reader->text, reader->prefix, strlen(reader->prefix));
                append(&reader->text, directive,
                       (size_t)snprintf(directive, sizeof directive, "#line %d %u\n", line_number + 1,
                                        called(reader, 0)));
            }
        }
        line = stop ? stop + 1 : end;
    }
    return HAIR_OK;
}

static hair_result read_one(struct source_reader* reader, const char* name, size_t length)
{
    struct hair_gl_source* out = reader->out;
    uint32_t number = out->files;
    for (uint32_t i = 0; i < number; ++i) // Include each file once.
        if (strlen(out->file[i]) == length && memcmp(out->file[i], name, length) == 0) return HAIR_OK;
    if (length >= sizeof out->file[0] || number == HAIR_GL_MAX_SOURCES)
        return hair_fail(reader->host, HAIR_ERROR_OPENGL, "shader %s includes too much", out->file[0]);
    char* own = out->file[number];
    memcpy(own, name, length);
    own[length] = 0;
    ++out->files;

    char* read = NULL;
    const char* given = strcmp(own, HAIR_GL_USER_SHADER) == 0 ? reader->own : NULL;
    int in_file = reader->folder && !given;
    if (in_file) HAIR_TRY(read_file(reader->host, reader->folder, own, &read));
    const char* text = given ? given : in_file ? read : find_built_in(own);
    if (!text) return hair_fail(reader->host, HAIR_ERROR_OPENGL, "shader text glsl/%s is not there", own);
    if (number > 0) {
        char directive[32];
        append(&reader->text, directive,
               (size_t)snprintf(directive, sizeof directive, "#line 1 %u\n", called(reader, number)));
    }
    hair_result result = put_lines(reader, text, number);
    hair_free(reader->host, read);
    return result;
}

hair_result hair_gl_read_source(const hair_host* host, const char* glsl_dir, const char* name,
                                const char* prefix, struct hair_gl_source* out)
{
    return hair_gl_read_source_with(host, glsl_dir, name, prefix, NULL, out);
}

hair_result hair_gl_read_source_with(const hair_host* host, const char* glsl_dir, const char* name,
                                     const char* prefix, const char* own, struct hair_gl_source* out)
{
    memset(out, 0, sizeof *out);
    struct source_reader reader = {
        .host = host, .folder = glsl_dir, .prefix = prefix, .own = own, .text = {.host = host}, .out = out};
    hair_result result = read_one(&reader, name, strlen(name));
    if (!result && reader.text.failed) result = hair_fail_memory(host, "shader text");
    if (result) {
        hair_free(host, reader.text.bytes);
        return result;
    }
    out->text = reader.text.bytes;
    return HAIR_OK;
}
