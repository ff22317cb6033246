// files.h - small haircut files of every format, made in memory, and a checked read of them.
#ifndef HAIR_TESTS_SUPPORT_FILES_H
#define HAIR_TESTS_SUPPORT_FILES_H

#include "lib/asset/asset.h"
#include "lib/asset/strands.h"
#include "tests/support/host.h"

struct hair_test_file {
    unsigned char* bytes; // to be freed by free()
    size_t size, room;
};

void hair_test_put(struct hair_test_file* file, const void* bytes, size_t size);
void hair_test_put_text(struct hair_test_file* file, const char* text);
void hair_test_put_u32(struct hair_test_file* file, uint32_t value);
void hair_test_put_float(struct hair_test_file* file, float value);
void hair_test_set_u32(struct hair_test_file* file, size_t at, uint32_t value);
void hair_test_set_float(struct hair_test_file* file, size_t at, float value);

// All files have three strands and every part of their format. Strand i is at x = i. Vertex j is at
// y = j.

// Return a .hair file with the arrays of `arrays`. Strands have 3, 2 and 4 vertices, or 3 each
// without segments.
struct hair_test_file hair_test_hair(uint32_t arrays);
// Return a .tfx file with 4 vertices per strand.
struct hair_test_file hair_test_tfx4(void);
struct hair_test_file hair_test_tfx3(void);
struct hair_test_file hair_test_tfx2(void);

hair_import hair_test_import(void); // Return the defaults.

// Make straight strands along x with segments of 1 cm, as an import reads them. Strand i is at
// z = i.
struct hair_strands hair_test_import_strands(const struct hair_test_host* test, uint32_t count,
                                             uint32_t each);
// Check the guarantees of lib/asset/strands.h for every strand.
void hair_test_assert_fit(const struct hair_strands* strands);

// Decode a file and check what the library promises of every input. HAIR_ERROR_FILE comes with one
// sentence with the byte offset and without an asset. HAIR_OK comes with a valid haircut. Memory
// stays within the promised bound. The caller frees the asset.
hair_result hair_test_read(struct hair_test_host* test, const hair_import* import, const void* bytes,
                           size_t size, hair_asset** out);

// Check that `survives` accepts a file, and none of its beginnings. Free its bytes.
void hair_test_refuse_beginnings(struct hair_test_file file, bool (*survives)(const void*, size_t));

// Read a file that must be valid by hair_test_read(), and free its bytes.
hair_asset* hair_test_read_file(struct hair_test_host* test, const hair_import* import,
                                struct hair_test_file file);
// Write a haircut. Check that nothing is written with too little capacity, or beyond the file.
struct hair_test_file hair_test_write_file(const hair_asset* asset, hair_format format);

#endif
