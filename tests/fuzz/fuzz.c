// fuzz.c - support of the fuzz programs.
#define _GNU_SOURCE
#include "tests/fuzz/fuzz.h"
#include "lib/base/bytes.h"
#include "tools/common/file.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

void hair_fuzz_fail(const char* condition, const char* file, int line)
{
    char sentence[512];
    int size = snprintf(sentence, sizeof sentence, "%s:%d: not true: %s\n", file, line, condition);
    if (write(STDERR_FILENO, sentence, (size_t)size) < 0) {} // Nobody is left to tell.
    abort();
}

// Options of the address sanitizer that make allocations fast. ASAN_OPTIONS overrides them.
const char* __asan_default_options(void);
const char* __asan_default_options(void)
{
    return "malloc_context_size=2:quarantine_size_mb=8:thread_local_quarantine_size_kb=64";
}

// Memory ------------------------------------------------------------------------------------------

static uint32_t refuse_after; // Number of allocations until one fails. 0 refuses none.
static bool was_refused;

static bool is_refused(void)
{
    if (!refuse_after || --refuse_after) return false;
    was_refused = true;
    return true;
}

bool hair_fuzz_was_refused(void)
{
    return was_refused;
}

void hair_fuzz_end_refusals(void)
{
    refuse_after = 0;
}

static void* take(size_t size, size_t align, void* user)
{
    struct hair_fuzz_host* host = user;
    if (is_refused()) return NULL;
    void* memory = aligned_alloc(align, (size + align - 1) / align * align);
    HAIR_FUZZ_CHECK(memory);
    host->live += size;
    if (host->live > host->peak) host->peak = host->live;
    ++host->blocks;
    return memory;
}

static void give_back(void* memory, size_t size, void* user)
{
    struct hair_fuzz_host* host = user;
    host->live -= size;
    --host->blocks;
    free(memory);
}

static void listen(hair_log_level level, const char* sentence, void* user)
{
    struct hair_fuzz_host* host = user;
    if (level != HAIR_LOG_ERROR) return;
    ++host->errors;
    snprintf(host->sentence, sizeof host->sentence, "%s", sentence);
}

void hair_fuzz_host_init(struct hair_fuzz_host* host)
{
    *host = (struct hair_fuzz_host){.host = {take, give_back, listen, host}};
}

// Allocations of the tools. The linker's option --wrap leads them here.
void *__real_malloc(size_t size), *__real_calloc(size_t count, size_t size),
    *__real_realloc(void*memory, size_t size);
void *__wrap_malloc(size_t size), *__wrap_calloc(size_t count, size_t size),
    *__wrap_realloc(void*memory, size_t size);
void* hair_fuzz_alloc(size_t size)
{
    return __real_malloc(size);
}
void* __wrap_malloc(size_t size)
{
    return is_refused() ? NULL : __real_malloc(size);
}
void* __wrap_calloc(size_t count, size_t size)
{
    return is_refused() ? NULL : __real_calloc(count, size);
}
void* __wrap_realloc(void* memory, size_t size)
{
    return is_refused() ? NULL : __real_realloc(memory, size);
}

bool hair_fuzz_run(hair_fuzz_function* function, const uint8_t* bytes, size_t size, uint64_t* hash)
{
    uint64_t own = hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size), unused = 0;
    hair_fuzz_mute();
    bool accepted = function(bytes, size, hash);
    if (own >> 32 & 7) return accepted;
    was_refused = false;
    refuse_after = 1 + (uint32_t)(own >> 40) % 24;
    function(bytes, size, &unused);
    was_refused = false;
    refuse_after = 0;
    return accepted;
}

// Text --------------------------------------------------------------------------------------------

static FILE* streams[2]; // stdout and stderr while they are replaced by `sinks`
static FILE* sinks[2];
static size_t printed;

// Check that text has no control characters but line ends.
static ssize_t check_text(void* cookie, const char* text, size_t size)
{
    for (size_t i = 0; i < size; ++i) HAIR_FUZZ_CHECK((unsigned char)text[i] >= 0x20 || text[i] == '\n');
    if (cookie) printed += size;
    return (ssize_t)size;
}

void hair_fuzz_mute(void)
{
    if (streams[0]) return;
    const cookie_io_functions_t functions = {.write = check_text};
    // MemorySanitizer does not see what the C library writes into a buffer of its own.
    static char buffer[2][4096];
    for (int i = 0; i < 2 && !sinks[i]; ++i) {
        sinks[i] = fopencookie(i ? &printed : NULL, "w", functions);
        HAIR_FUZZ_CHECK(sinks[i] && !setvbuf(sinks[i], buffer[i], _IOFBF, sizeof buffer[i]));
    }
    streams[0] = stdout, streams[1] = stderr;
    stdout = sinks[0], stderr = sinks[1];
    printed = 0;
}

void hair_fuzz_unmute(void)
{
    if (!streams[0]) return;
    stdout = streams[0], stderr = streams[1];
    streams[0] = NULL;
}

size_t hair_fuzz_printed(void)
{
    fflush(stderr);
    return printed;
}

// Files -------------------------------------------------------------------------------------------

// Small files that scenes and settings name. Any other name is that of no file, as the fuzzer must
// not read the machine's files.
static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
static const char points[] = "v 0 0 0\nv 1 0 0\n";
static const char tfx[] = "version 2\nnumStrands 1\nstrand 0 numVerts 5\n0 0 0\n.01 0 .01\n.02 0 0\n"
                          ".03 0 -.01\n.04 0 0\n";

// Read one of the small files.
static bool read_small(const char* tool, const char* path, struct hair_bytes* out)
{
    const char* name = strrchr(path, '/');
    name = name ? name + 1 : path;
    const char* text = !strcmp(name, "a.obj")   ? obj
                       : !strcmp(name, "b.obj") ? points
                       : !strcmp(name, "a.tfx") ? tfx
                                                : NULL;
    if (!text) {
        hair_complain(tool, "cannot read %s", path);
        return false;
    }
    *out = (struct hair_bytes){malloc(strlen(text)), strlen(text)};
    if (!out->data) {
        hair_complain(tool, "out of memory for %s", path);
        return false;
    }
    memcpy(out->data, text, out->size);
    return true;
}

bool __wrap_hair_file_read(const char* tool, const char* path, size_t limit, struct hair_bytes* out);
bool __wrap_hair_file_read(const char* tool, const char* path, size_t limit, struct hair_bytes* out)
{
    (void)limit;
    return read_small(tool, path, out);
}

char* hair_fuzz_split(const char* tool, const uint8_t* bytes, size_t size, int* count, char* arguments[],
                      int room)
{
    size_t used = strlen(tool) + 1;
    char* text = hair_fuzz_alloc(used + size + 1);
    HAIR_FUZZ_CHECK(text);
    memcpy(text, tool, used);
    memcpy(text + used, bytes, size);
    text[used + size] = 0;
    arguments[0] = text;
    *count = 1;
    for (char* at = text + used; *at && *count + 1 < room;) {
        arguments[(*count)++] = at;
        at += strcspn(at, "\n");
        if (*at) *at++ = 0;
    }
    arguments[*count] = NULL;
    return text;
}

// Hashes ------------------------------------------------------------------------------------------

void hair_fuzz_add(uint64_t* hash, uint32_t value)
{
    unsigned char bytes[4];
    hair_write_u32(bytes, value);
    *hash = hair_hash_bytes(*hash ? *hash : HAIR_HASH_BEGIN, bytes, sizeof bytes);
}

void hair_fuzz_add_floats(uint64_t* hash, const float* values, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        hair_fuzz_add(hash, bits);
    }
}

void hair_fuzz_add_text(uint64_t* hash, const char* text)
{
    for (; text && *text; ++text) hair_fuzz_add(hash, (unsigned char)*text);
    hair_fuzz_add(hash, 0);
}
