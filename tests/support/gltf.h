// gltf.h - a small .glb file with all types of accessors and all interpolations, made in memory.
#ifndef HAIR_TESTS_SUPPORT_GLTF_H
#define HAIR_TESTS_SUPPORT_GLTF_H

#include "tests/support/files.h"

// Bytes of the binary chunk, and offsets of its parts.
#define HAIR_TEST_GLTF_BYTES 668
#define HAIR_TEST_GLTF_INDICES 48 // u8
#define HAIR_TEST_GLTF_WEIGHTS 188 // float
#define HAIR_TEST_GLTF_TIMES 380
#define HAIR_TEST_GLTF_ROTATIONS 500

// JSON of the file, with ' in place of ". It has two triangles in each of three primitives, two
// joints and three animations: linear, by steps and by cubic splines.
extern const char hair_test_gltf_text[];

// Write the binary chunk.
void hair_test_gltf_binary(unsigned char bytes[HAIR_TEST_GLTF_BYTES]);
// Return a .glb file of a text, in which the first `from` is replaced by `to`. NULL replaces
// nothing.
struct hair_test_file hair_test_glb(const char* text, const char* from, const char* to,
                                    const unsigned char* binary, size_t binary_size);

#endif
