// headers.c - the members and enumerators of the public headers, read from their text.
#include "tests/support/headers.h"
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CAPITALS "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"

static char headers[1 << 18]; // text of all headers
static struct hair_test_member members[640];
static size_t member_count;

static void read_files(void)
{
    static const char* const names[] = {"base",      "groom", "context",  "look", "physics",
                                        "colliders", "wind",  "instance", "view", "diagnostics",
                                        "buffers",   "asset", "targets",  "body", "cut"};
    size_t size = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        char name[64];
        snprintf(name, sizeof name, "include/hair/hair_%s.h", names[i]);
        FILE* file = fopen(name, "rb");
        if (!file) fail_msg("%s is not there: run this where the Makefile is", name);
        size += fread(headers + size, 1, sizeof headers - 1 - size, file);
        fclose(file);
    }
    if (size == sizeof headers - 1) fail_msg("the headers are longer than %zu bytes", size);
}

// Read a member from a line such as "    float scale; ///< Metres. [1e-6, 1e6]. Default 1."
static void read_member(const char* line, const char* owner, const char* above)
{
    struct hair_test_member member = {.count = 1};
    const char *end = strchr(line, ';'), *about = strstr(line, "///<"), *function = strstr(line, "(*");
    if (!end || (about && about < end) || sscanf(line, " %39s", member.type) != 1) return;
    const char* name = function && function < end ? function + 2 : end;
    while (name <= end && name > line && name[-1] != ' ' && name[-1] != '*') --name;
    snprintf(member.owner, sizeof member.owner, "%s", owner);
    snprintf(member.name, sizeof member.name, "%.*s", (int)strcspn(name, "[;)"), name);
    snprintf(member.above, sizeof member.above, "%s", above);
    const char *star = strchr(line, '*'), *bracket = strchr(line, '[');
    member.is_pointer = star && star < end;
    if (bracket && bracket < end) member.count = (unsigned)atoi(bracket + 1);
    if (about)
        snprintf(member.comment, sizeof member.comment, "%.*s", (int)strcspn(about + 5, "\n"), about + 5);
    if (member_count == sizeof members / sizeof *members) fail_msg("the headers have too many members");
    members[member_count++] = member;
}

// Put the name of a group, which follows its members, before the names of its members.
static void close_group(const char* text, size_t first)
{
    for (size_t i = first; i < member_count; ++i) {
        char name[40];
        snprintf(name, sizeof name, "%.39s", members[i].name);
        snprintf(members[i].name, sizeof members[i].name, "%.*s.%s", (int)strcspn(text, ";"), text, name);
    }
}

// Append a line of a comment to the comment above, or clear that if the line is none.
static void read_above(const char* text, char above[512])
{
    const char* at = text + strspn(text, " ");
    size_t used = strlen(above);
    if (strncmp(at, "///", 3) || at[3] == '<')
        *above = 0;
    else
        snprintf(above + used, 512 - used, "%s%s", used ? " " : "", at + 3 + (at[3] == ' '));
}

int hair_test_read_headers(void** state)
{
    (void)state;
    char owner[40] = "", above[512] = "";
    size_t group = 0; // first member of the current group
    read_files();
    for (char* line = headers; *line; line += strcspn(line, "\n") + 1) {
        char text[512];
        snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
        bool is_struct = sscanf(text, "typedef struct %39s {", owner) == 1 && strchr(text, '{');
        if (*text == '}') *owner = 0;
        if (strcmp(text, "    struct {") == 0) group = member_count;
        if (strncmp(text, "    } ", 6) == 0)
            close_group(text + 6, group);
        else if (!is_struct && *owner && *text == ' ')
            read_member(text, owner, above);
        read_above(text, above);
        if (line[strcspn(line, "\n")] == 0) break;
    }
    return 0;
}

const struct hair_test_member* hair_test_member_at(size_t i)
{
    return i < member_count ? &members[i] : NULL;
}

const struct hair_test_member* hair_test_find_member(const char* owner, const char* name)
{
    for (size_t i = 0; i < member_count; ++i)
        if (strcmp(members[i].owner, owner) == 0 && strcmp(members[i].name, name) == 0) return &members[i];
    const char* dot = strchr(name, '.');
    bool has_maps = strcmp(owner, "hair_map_set") == 0 || strcmp(owner, "hair_strand_attribute") == 0;
    return dot && has_maps ? hair_test_find_member("hair_map", dot + 1) : NULL;
}

// Find the next enumerator before `end`, and its length. Comments are skipped.
static const char* next_enumerator(const char* at, const char* end, size_t* length)
{
    for (; at < end; ++at) {
        if (strncmp(at, "//", 2) == 0) at += strcspn(at, "\n");
        if (strncmp(at, "HAIR_", 5)) continue;
        *length = strspn(at, CAPITALS);
        return at;
    }
    return NULL;
}

int hair_test_enumerators(const char* type, char out[HAIR_TEST_ENUMERATORS][64])
{
    char head[64];
    size_t length = 0;
    int count = 0;
    snprintf(head, sizeof head, "typedef enum %s {", type);
    const char* at = strstr(headers, head);
    if (!at) return 0;
    const char* end = strchr(at, '}');
    for (at = strchr(at, '{'); (at = next_enumerator(at, end, &length)); at += length) {
        if (length > 6 && strncmp(at + length - 6, "_COUNT", 6) == 0) continue;
        if (count == HAIR_TEST_ENUMERATORS) fail_msg("%s has too many enumerators", type);
        snprintf(out[count++], 64, "%.*s", (int)length, at);
    }
    return count;
}

double hair_test_enumerator(const char* name, size_t length)
{
    if (length == strlen("HAIR_AUTO") && strncmp(name, "HAIR_AUTO", length) == 0) return HAIR_AUTO;
    for (const char* at = strstr(headers, "typedef enum"); at; at = strstr(at + 1, "typedef enum")) {
        const char* end = strchr(at, '}');
        size_t own = 0;
        double value = 0;
        for (const char* p = strchr(at, '{'); (p = next_enumerator(p, end, &own)); p += own, ++value)
            if (own == length && strncmp(p, name, length) == 0) return value;
    }
    return -1;
}

void hair_test_enum_comment(const char* type, char out[512])
{
    char head[64];
    *out = 0;
    snprintf(head, sizeof head, "typedef enum %s {", type);
    for (const char* line = headers; *line; line += strcspn(line, "\n") + 1) {
        char text[512];
        if (strncmp(line, head, strlen(head)) == 0) return;
        snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
        read_above(text, out);
    }
    *out = 0;
}
