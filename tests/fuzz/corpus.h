// corpus.h - replay of the committed inputs without libFuzzer.
#ifndef HAIR_TESTS_FUZZ_CORPUS_H
#define HAIR_TESTS_FUZZ_CORPUS_H

#include "tests/fuzz/fuzz.h"

struct hair_fuzz_replay {
    uint32_t files; // number of files of the corpus
    uint32_t whole; // number of files that the parser accepted as they are
    uint32_t inputs; // number of inputs, with those made of the files
    uint32_t accepted; // number of inputs that the parser accepted
    uint64_t hash; // of all accepted content, in the order of the names of the files
};

// Run a target on every file of FOLDER/NAME, on every beginning of each small file, and on each
// file of up to 64 KiB with every single bit of its header flipped. Return false if the folder
// cannot be read.
bool hair_fuzz_replay(const struct hair_fuzz_target* target, const char* folder,
                      struct hair_fuzz_replay* out);

#endif
