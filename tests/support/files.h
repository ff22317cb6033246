// files.h - small haircut files of every format, made in memory, and reading them under watch.
#ifndef HAIR_TESTS_SUPPORT_FILES_H
#define HAIR_TESTS_SUPPORT_FILES_H

#include "lib/asset/asset.h"
#include "tests/support/host.h"

struct hair_test_file {
    unsigned char* bytes; // free() it
    size_t size, room;
};

void hair_test_put(struct hair_test_file* file, const void* bytes, size_t size);
void hair_test_put_text(struct hair_test_file* file, const char* text);
void hair_test_put_u32(struct hair_test_file* file, uint32_t value);
void hair_test_put_float(struct hair_test_file* file, float value);
void hair_test_set_u32(struct hair_test_file* file, size_t at, uint32_t value);
void hair_test_set_float(struct hair_test_file* file, size_t at, float value);

// Three strands, with every part that the format has; strand i stands at x = i, vertex j at y = j.
// .hair: of 3, 2 and 4 vertices with the arrays of `arrays`; without segments of 3 each.
struct hair_test_file hair_test_hair(uint32_t arrays);
// .tfx: of 4 vertices each.
struct hair_test_file hair_test_tfx4(void);
struct hair_test_file hair_test_tfx3(void);
struct hair_test_file hair_test_tfx2(void);

hair_import hair_test_import(void); // The defaults.

// Decode, and hold the library to what it promises of every input: one sentence with the byte offset and no
// asset on HAIR_ERROR_FILE; a fit haircut on HAIR_OK; no more memory than promised. The caller frees the asset.
hair_result hair_test_read(struct hair_test_host* test, const hair_import* import, const void* bytes,
                           size_t size, hair_asset** out);

#endif
