// targets.c - the list of all fuzz targets. With HAIR_FUZZ_PORTABLE it lacks those that need
// libjansson.
#include "tests/fuzz/fuzz.h"

const struct hair_fuzz_target hair_fuzz_targets[] = {{"hairfile", hair_fuzz_hairfile},
                                                     {"groomfile", hair_fuzz_groomfile},
                                                     {"tfx", hair_fuzz_tfx},
                                                     {"tfx_text", hair_fuzz_tfx_text},
                                                     {"obj", hair_fuzz_obj},
                                                     {"save", hair_fuzz_save},
                                                     {"members", hair_fuzz_members},
                                                     {"groom_arguments", hair_fuzz_groom_arguments},
#ifndef HAIR_FUZZ_PORTABLE
                                                     {"bench_arguments", hair_fuzz_bench_arguments},
                                                     {"scene", hair_fuzz_scene},
                                                     {"capture_arguments", hair_fuzz_capture_arguments},
                                                     {"gltf", hair_fuzz_gltf},
#endif
                                                     {0}};
