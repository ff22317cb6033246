// fastest.c - the table of the fastest render paths, and measured paths as text.
#include "lib/draw/fastest.h"

#include <hair/hair_context.h>
#include <stdio.h>
#include <string.h>

#define FORMAT "hair-paths 1" // First words of the text, with the version of its format.
#define SHOWN 24 // Maximum characters of a bad text in an error.

static const struct {
    const char* renderer; // Part of the renderer's name.
    struct hair_fastest fastest;
} drivers[] = {
#define FASTEST(renderer, ribbons, lines, lod_ribbons, lod_lines, depth, uncached)                           \
    {renderer,                                                                                               \
     {{HAIR_RENDER_PATH_##ribbons, HAIR_RENDER_PATH_##lines, HAIR_RENDER_PATH_##lod_ribbons,                 \
       HAIR_RENDER_PATH_##lod_lines, HAIR_RENDER_PATH_##depth, HAIR_RENDER_PATH_##uncached}}},
#include "lib/draw/paths.inl"
#undef FASTEST
};

static const char* const uses[HAIR_PATH_USES] = {"ribbons",   "lines", "lod_ribbons",
                                                 "lod_lines", "depth", "uncached"};
static const char* const paths[] = {
    [HAIR_RENDER_PATH_TESSELLATION] = "tessellation", [HAIR_RENDER_PATH_CACHED] = "cached",
    [HAIR_RENDER_PATH_COMPUTE] = "compute",           [HAIR_RENDER_PATH_AUTO] = NULL,
    [HAIR_RENDER_PATH_PROCEDURAL] = "procedural",
};
#define PATHS (sizeof paths / sizeof *paths)

bool hair_fastest_allows(enum hair_path_use use, hair_render_path path)
{
    bool is_of_lines = use == HAIR_USE_LINES || use == HAIR_USE_LOD_LINES;
    switch (path) {
    case HAIR_RENDER_PATH_TESSELLATION: return true;
    case HAIR_RENDER_PATH_CACHED: return use != HAIR_USE_UNCACHED;
    case HAIR_RENDER_PATH_COMPUTE: return use != HAIR_USE_UNCACHED && !is_of_lines;
    case HAIR_RENDER_PATH_AUTO: return false;
    default: return use == HAIR_USE_UNCACHED;
    }
}

void hair_fastest_find(const struct hair_gl* gl, struct hair_fastest* out)
{
    const char* name = (const char*)gl->GetString(GL_RENDERER);
    size_t row = 0;
    while (*drivers[row].renderer && !(name && strstr(name, drivers[row].renderer))) ++row;
    *out = drivers[row].fastest;
}

static uint64_t find_key(struct hair_gl* gl)
{
    struct hair_gl_key key = hair_gl_key_begin(gl);
    return key.hash;
}

void hair_fastest_write(struct hair_gl* gl, const struct hair_fastest* fastest, char* out, size_t capacity)
{
    size_t at = (size_t)snprintf(out, capacity, FORMAT " %016llx", (unsigned long long)find_key(gl));
    for (int use = 0; use < HAIR_PATH_USES && at < capacity; ++use) {
        HAIR_ASSERT(hair_fastest_allows((enum hair_path_use)use, (hair_render_path)fastest->path[use]));
        at += (size_t)snprintf(out + at, capacity - at, " %s=%s", uses[use], paths[fastest->path[use]]);
    }
    HAIR_ASSERT(at < capacity);
}

// Move `*text` behind `word`. Return false if the text does not begin with the word.
static bool skip_word(const char** text, const char* word)
{
    size_t size = strlen(word);
    if (strncmp(*text, word, size) != 0) return false;
    *text += size;
    return true;
}

static hair_result refuse_at(const struct hair_gl* gl, const char* text, const char* at, const char* expected)
{
    // The rest of the text may have anything in it.
    char shown[SHOWN + 1] = {0};
    for (int i = 0; i < SHOWN && at[i]; ++i) shown[i] = (char)(at[i] >= ' ' && at[i] <= '~' ? at[i] : '?');
    return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                     "the tuning is not of hair_context_tune(): character %zu, \"%s\", should be %s",
                     (size_t)(at - text), shown, expected);
}

// Read the path of a use. Move `*text` behind it.
static bool read_path(const char** text, enum hair_path_use use, uint8_t* out)
{
    for (size_t i = 0; i < PATHS; ++i) {
        if (!paths[i] || !skip_word(text, paths[i])) continue;
        *out = (uint8_t)i;
        return hair_fastest_allows(use, (hair_render_path)i);
    }
    return false;
}

hair_result hair_fastest_read(struct hair_gl* gl, const char* text, struct hair_fastest* out)
{
    const char* at = text;
    char key[32], word[32];
    struct hair_fastest read = {{0}};
    snprintf(key, sizeof key, "%016llx", (unsigned long long)find_key(gl));
    if (!skip_word(&at, FORMAT " ")) return refuse_at(gl, text, at, "\"" FORMAT "\"");
    if (!skip_word(&at, key)) {
        if (strspn(at, "0123456789abcdef") != strlen(key)) return refuse_at(gl, text, at, "16 digits");
        return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                         "the tuning is of another driver, whose key is %.16s, not %s", at, key);
    }
    for (int use = 0; use < HAIR_PATH_USES; ++use) {
        snprintf(word, sizeof word, " %s=", uses[use]);
        if (!skip_word(&at, word)) return refuse_at(gl, text, at, word);
        const char* value = at;
        if (!read_path(&at, (enum hair_path_use)use, &read.path[use]))
            return refuse_at(gl, text, value, "a path for this use");
    }
    if (*at) return refuse_at(gl, text, at, "the end");
    *out = read;
    return HAIR_OK;
}
