// gltf_parse.h - the reader of glTF files of the tools, and the sentence that it said last.
// Programs that use this link the reader.
#ifndef HAIR_TESTS_SUPPORT_GLTF_PARSE_H
#define HAIR_TESTS_SUPPORT_GLTF_PARSE_H

#include "tests/support/gltf.h"
#include "tools/common/gltf.h"

extern char hair_test_gltf_said[1024]; // last sentence

// Keep each later sentence in hair_test_gltf_said.
void hair_test_gltf_listen(void);
// Parse bytes without a line on stderr.
bool hair_test_gltf_parse_bytes(const unsigned char* bytes, size_t size, struct hair_gltf* out);
// Parse a file in the same way, and free its bytes.
bool hair_test_gltf_parse(struct hair_test_file file, struct hair_gltf* out);
// Return the small file with a replaced part.
struct hair_test_file hair_test_gltf_with(const char* from, const char* to);

#endif
