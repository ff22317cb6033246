// groomfile.h - a small .groom file with every chunk, and changes of chunks with valid checksums.
#ifndef HAIR_TESTS_SUPPORT_GROOMFILE_H
#define HAIR_TESTS_SUPPORT_GROOMFILE_H

#include "tests/support/files.h"

// Return a .groom file with every chunk. It has four strands with 3, 2, 4 and 3 vertices, in the
// groups 0, 7, 3 and 0, and a scalp of two triangles. The positions of the last strand are stored
// as floats. Map set 0 has no maps, and map set 1 both. Stiffness and length have factors of
// strands, length a map, and frizz two.
struct hair_test_file hair_test_groomfile(void);

// Return the same without guides, names of joints, attributes and maps.
struct hair_test_file hair_test_old_groomfile(void);

// Return the byte of the letters of a chunk, which the file must have. Letters such as "ATTR
// length" find a chunk by its name.
size_t hair_test_find_chunk(const struct hair_test_file* file, const char* letters);

// Insert `count` bytes before byte `at` of the content of a chunk, or remove -count bytes from
// there on. Checksums and sizes are valid afterwards.
void hair_test_resize_chunk(struct hair_test_file* file, const char* letters, size_t at, int count);

#endif
