// shader_log.c - messages of the driver's compiler, with the names of files. The first line of a
// message is an error, and further lines are information.
#include "lib/gl/gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A line of a message.
struct line {
    char where[128]; // Place in a file, or empty.
    const char* text; // Text after the place.
    int length;
    bool is_own; // True if the place is in the application's text.
};

// Find the place in a line. Drivers begin it with the number of the file, as in "2:50(7): error"
// (Mesa) or "2(50) : error" (NVIDIA).
static struct line parse_place(const struct hair_gl_source* source, bool has_own, const char* message)
{
    struct line out = {.text = message, .length = (int)strcspn(message, "\n")};
    const char* at = strncmp(message, "ERROR: ", 7) == 0 ? message + 7 : message;
    char *rest = NULL, *after = NULL;
    long file = strtol(at, &rest, 10);
    bool is_own = has_own && file == 0;
    if (has_own && file == HAIR_GL_MAX_SOURCES) file = 0; // See called() in source.c.
    if (rest == at || (*rest != ':' && *rest != '(') || file < 0 || file >= (long)source->files) return out;
    long number = strtol(rest + 1, &after, 10);
    while (*after && strchr("(): 0123456789", *after)) ++after;
    snprintf(out.where, sizeof out.where, is_own ? "%.0s%ld: " : "glsl/%s:%ld: ", source->file[file], number);
    out.text = after;
    out.length = (int)strcspn(after, "\n");
    out.is_own = is_own;
    return out;
}

// Return the start of the next line, or the end of the message.
static const char* next_line(const char* line)
{
    line += strcspn(line, "\n");
    return *line ? line + 1 : line;
}

// Log the lines after the first. The host's sentences of one failure have one error each.
static void log_rest(struct hair_gl* gl, const struct hair_gl_source* source, const char* own,
                     const char* message)
{
    for (const char* at = next_line(message); *at; at = next_line(at)) {
        struct line line = {.text = at, .length = (int)strcspn(at, "\n")};
        if (source) line = parse_place(source, own != NULL, at);
        if (line.length > 0)
            hair_log(&gl->host, HAIR_LOG_INFO, "%s%s%s%.*s", own ? own : "",
                     !own          ? ""
                     : line.is_own ? ":"
                                   : ": ",
                     line.where, line.length, line.text);
    }
}

hair_result hair_gl_report_compile(struct hair_gl* gl, const struct hair_gl_source* source, const char* own,
                                   const char* name, const char* message)
{
    struct line first = parse_place(source, own != NULL, message);
    if (!*first.where) snprintf(first.where, sizeof first.where, "glsl/%s: ", source->file[0]);
    if (own) {
        hair_result result = hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s:%s%s%.*s", own,
                                       first.is_own ? "" : " ", first.where, first.length, first.text);
        log_rest(gl, source, own, message);
        return result;
    }
    hair_log(&gl->host, HAIR_LOG_ERROR, "%s%.*s", first.where, first.length, first.text);
    log_rest(gl, source, NULL, message);
    return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "shader glsl/%s does not compile", name);
}

hair_result hair_gl_report_link(struct hair_gl* gl, const char* own, const char* label, const char* message)
{
    hair_result result =
        hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s%sprogram %s does not link: %.*s", own ? own : "",
                  own ? ": " : "", label, (int)strcspn(message, "\n"), message);
    log_rest(gl, NULL, own, message);
    return result;
}
