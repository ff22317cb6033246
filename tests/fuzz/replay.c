// replay.c - a program that replays the corpus of every parser and prints hashes of what was
// accepted, which are equal on all machines.
//
//   replay [FOLDER [PARSER]]
#include "tests/fuzz/corpus.h"

#include <stdio.h>
#include <string.h>

int main(int count, char** arguments)
{
    const char* folder = count > 1 ? arguments[1] : "tests/fuzz/corpus";
    int missing = 0;
    for (const struct hair_fuzz_target* target = hair_fuzz_targets; target->name; ++target) {
        struct hair_fuzz_replay replay;
        if (count > 2 && strcmp(arguments[2], target->name)) continue;
        if (!hair_fuzz_replay(target, folder, &replay)) {
            fprintf(stderr, "replay: there is no input in %s/%s\n", folder, target->name);
            missing = 1;
        }
        printf("%-18s %4u files, %4u whole accepted; %7u inputs, %7u accepted, hash %016llx\n", target->name,
               replay.files, replay.whole, replay.inputs, replay.accepted, (unsigned long long)replay.hash);
    }
    return missing;
}
