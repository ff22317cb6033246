// render_paths.h - all render paths, with the private one.
#ifndef HAIR_TESTS_SUPPORT_RENDER_PATHS_H
#define HAIR_TESTS_SUPPORT_RENDER_PATHS_H

#include "lib/draw/render_path.h"

// Indices in hair_test_paths. The last of them is the number of paths.
enum { HAIR_TEST_TESSELLATION, HAIR_TEST_PROCEDURAL, HAIR_TEST_CACHED, HAIR_TEST_COMPUTE, HAIR_TEST_PATHS };

static const hair_render_path hair_test_paths[HAIR_TEST_PATHS] = {
    [HAIR_TEST_TESSELLATION] = HAIR_RENDER_PATH_TESSELLATION,
    [HAIR_TEST_PROCEDURAL] = HAIR_RENDER_PATH_PROCEDURAL,
    [HAIR_TEST_CACHED] = HAIR_RENDER_PATH_CACHED,
    [HAIR_TEST_COMPUTE] = HAIR_RENDER_PATH_COMPUTE,
};

#endif
