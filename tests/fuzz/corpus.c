// corpus.c - replay of the committed inputs without libFuzzer.
#define _GNU_SOURCE
#include "tests/fuzz/corpus.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

#define MAX_FILE (4u << 20) // bytes
#define MAX_FLIPPED 65536 // Maximum size of a file whose bits are flipped.
#define MAX_CUT 400 // Maximum size of a file that is cut off at every byte.
#define HEADER 168 // Number of bytes whose bits are flipped. The longest header in use ends here.

// Run a target on a copy of exactly this size, so that a sanitizer sees any read beyond it.
static void run(const struct hair_fuzz_target* target, const uint8_t* bytes, size_t size,
                struct hair_fuzz_replay* out)
{
    uint8_t* copy = malloc(size ? size : 1);
    HAIR_FUZZ_CHECK(copy);
    memcpy(copy, bytes, size);
    out->accepted += hair_fuzz_run(target->function, copy, size, &out->hash);
    ++out->inputs;
    free(copy);
}

static void run_file(const struct hair_fuzz_target* target, uint8_t* bytes, size_t size,
                     struct hair_fuzz_replay* out)
{
    uint32_t accepted = out->accepted;
    run(target, bytes, size, out);
    out->whole += out->accepted - accepted;
    ++out->files;
    for (size_t cut = 0; cut < size && size <= MAX_CUT; ++cut) run(target, bytes, cut, out);
    for (size_t bit = 0; size <= MAX_FLIPPED && bit < 8 * size && bit < 8 * HEADER; ++bit) {
        bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
        run(target, bytes, size, out);
        bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
}

static int is_file(const struct dirent* entry)
{
    return *entry->d_name != '.';
}

// Compare names by their bytes, which no locale changes.
static int compare(const struct dirent** a, const struct dirent** b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

bool hair_fuzz_replay(const struct hair_fuzz_target* target, const char* folder, struct hair_fuzz_replay* out)
{
    char path[4096];
    struct dirent** entries = NULL;
    static uint8_t bytes[MAX_FILE];
    *out = (struct hair_fuzz_replay){0};
    snprintf(path, sizeof path, "%s/%s", folder, target->name);
    int count = scandir(path, &entries, is_file, compare);
    for (int i = 0; i < count; ++i) {
        snprintf(path, sizeof path, "%s/%s/%s", folder, target->name, entries[i]->d_name);
        FILE* file = fopen(path, "rb");
        HAIR_FUZZ_CHECK(file);
        size_t size = fread(bytes, 1, sizeof bytes, file);
        HAIR_FUZZ_CHECK(size < sizeof bytes);
        run_file(target, bytes, size, out);
        fclose(file);
        free(entries[i]);
    }
    free(entries);
    hair_fuzz_unmute();
    return count > 0;
}
