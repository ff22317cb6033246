// capture_arguments_fuzz.c - fuzz target of the command line of hair-capture, with the built-in
// scenes and the settings. An input has one argument a line. Scene files cannot be read.
#include "tests/fuzz/fuzz.h"
#include "tools/common/capture_options.h"
#include "tools/common/file.h"

#include <string.h>

// Say that an output is one picture by its name, because the tool's own function asks the file
// system.
bool __wrap_hair_frame_writer_is_picture(const char* path);
bool __wrap_hair_frame_writer_is_picture(const char* path)
{
    return strstr(path, ".png");
}

static void check(const struct hair_capture_options* options)
{
    const struct hair_scene* scene = &options->scene;
    HAIR_FUZZ_CHECK(options->name && (options->out || options->stats || options->hash));
    HAIR_FUZZ_CHECK(options->first < options->end && options->end <= 1000000);
    HAIR_FUZZ_CHECK(options->samples - 1 < 64 && options->supersample - 1 < 8);
    HAIR_FUZZ_CHECK(options->device >= -1 && options->device <= 1000);
    HAIR_FUZZ_CHECK(scene->width - 1 < 16384 && scene->height - 1 < 16384);
    HAIR_FUZZ_CHECK(scene->fps >= 1 && scene->fps <= 1000 && scene->show < 32);
    HAIR_FUZZ_CHECK(!options->is_of_file); // No scene file could be read.
}

HAIR_FUZZ(capture_arguments)
{
    static struct hair_capture_options options;
    char* arguments[24];
    json_set_alloc_funcs(hair_fuzz_alloc, free);
    int count;
    char* text = hair_fuzz_split("hair-capture", bytes, size, &count, arguments, 24);
    size_t printed = hair_fuzz_printed();
    int code = hair_capture_parse("hair-capture", count, arguments, &options);
    bool refused = hair_fuzz_was_refused();
    hair_fuzz_end_refusals();
    HAIR_FUZZ_CHECK(code == -1 || code == HAIR_EXIT_OK || code == HAIR_EXIT_USAGE || code == HAIR_EXIT_INPUT);
    HAIR_FUZZ_CHECK(refused || (code <= HAIR_EXIT_OK) == (hair_fuzz_printed() == printed));
    if (code == -1) {
        check(&options);
        hair_fuzz_add_text(hash, options.name);
        hair_fuzz_add_text(hash, options.out);
        hair_fuzz_add_text(hash, options.stats);
        hair_fuzz_add(hash, options.first);
        hair_fuzz_add(hash, options.end);
        hair_fuzz_add(hash, options.scene.width);
        hair_fuzz_add(hash, options.scene.show);
        hair_fuzz_add_floats(hash, &options.scene.fps, 1);
    }
    hair_scene_free(&options.scene);
    free(text);
    return code == -1;
}
