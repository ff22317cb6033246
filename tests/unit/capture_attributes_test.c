// capture_attributes_test.c - attributes of strands in scenes and files of hair-capture.
#include "tests/support/groomfile.h"
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-capture"
#define SMALL "--frames 0:1 --size 64x36 --samples 1 --followers 300 --hash"
#define expect hair_test_shell_expect

// Write the hash of the first frame of a scene to a file of the name.
static void hash(const char* name, const char* scene)
{
    char command[512];
    snprintf(command, sizeof command, "echo '%s' >$D/s.json; $T $D/s.json " SMALL " >$D/%s", scene, name);
    expect(0, command, "");
}

static void attributes_of_a_scene_change_its_hair(void** state)
{
    (void)state;
    hash("none", "{\"style\": \"bob\"}");
    hash("one", "{\"style\": \"bob\", \"attributes\": [{\"kind\": \"length\"}, {\"kind\": \"radius\"}]}");
    hash("half", "{\"style\": \"bob\", \"attributes\": [{\"kind\": \"length\", \"range\": [0.2, 0.5]}]}");
    hash("map", "{\"style\": \"bob\", \"attributes\": [{\"kind\": \"length\", \"map\": [\"09\"]}]}");
    hash("nines", "{\"style\": \"bob\", \"attributes\": [{\"kind\": \"length\", \"map\": [\"99\"]}]}");
    // Factors of 1 change nothing.
    expect(0, "cmp $D/none $D/one && cmp $D/none $D/nines", "");
    expect(0, "! cmp -s $D/none $D/half && ! cmp -s $D/none $D/map && ! cmp -s $D/half $D/map", "");
}

static void attributes_of_a_groom_file_are_used(void** state)
{
    (void)state;
    expect(0, "cp tests/fuzz/corpus/groomfile/whole $D/whole.groom", "");
    expect(0, "cp tests/fuzz/corpus/groomfile/named $D/named.groom", "");
    expect(0, "$T --groom $D/whole.groom " SMALL " >$D/whole", "");
    expect(0, "$T --groom $D/named.groom " SMALL " >$D/named; ! cmp -s $D/whole $D/named", "");
}

// Write a groom with an image of lengths, whose texture coordinates are not those from above.
static void save_turned(void)
{
    struct hair_test_file file = hair_test_groomfile();
    size_t at = hair_test_find_chunk(&file, "TEXC") + 16;
    for (size_t i = 0; i < 4; ++i) hair_test_set_float(&file, at + 8 * i + 4, i < 2 ? 1 : 0);
    hair_test_resize_chunk(&file, "TEXC", 0, 0);
    FILE* out = hair_test_shell_create("turned", ".groom");
    assert_int_equal(fwrite(file.bytes, 1, file.size, out), file.size);
    fclose(out);
    free(file.bytes);
}

// Images of a groom keep its texture coordinates beside maps of a scene.
static void maps_of_a_scene_are_added_to_the_images_of_a_groom(void** state)
{
    (void)state;
    expect(0, "cp tests/fuzz/corpus/groomfile/named $D/named.groom", "");
    save_turned();
    hash("other", "{\"groom\": \"named.groom\"}");
    hash("alone", "{\"groom\": \"turned.groom\"}");
    hash("nines",
         "{\"groom\": \"turned.groom\", \"attributes\": [{\"kind\": \"length\", \"map\": [\"99\"]}]}");
    hash("half",
         "{\"groom\": \"turned.groom\", \"attributes\": [{\"kind\": \"length\", \"map\": [\"09\"]}]}");
    hash("dense", "{\"groom\": \"turned.groom\", \"maps\": [{\"density\": [\"99\"]}]}");
    hash("thin", "{\"groom\": \"turned.groom\", \"maps\": [{\"density\": [\"09\"]}]}");
    expect(0, "cmp $D/alone $D/nines && ! cmp -s $D/alone $D/other", "");
    expect(0, "! cmp -s $D/alone $D/half && ! cmp -s $D/dense $D/thin", "");
}

static void attributes_that_cannot_be_used_are_told(void** state)
{
    (void)state;
    static const char scene[] = "\"attributes\": [{\"kind\": \"frizz\", \"map\": [\"09\"]}]}";
    char command[512];
    snprintf(command, sizeof command, "echo '{\"groom\": \"bob.tfx\", %s' >$D/s.json", scene);
    expect(0, "$(dirname $T)/hair-groom generate bob $D/bob.tfx --vertices 16 --guides 64", "");
    expect(0, command, "");
    expect(0, "$T $D/s.json " SMALL, "are left out, because the groom has no scalp");
    snprintf(command, sizeof command, "echo '{\"fur\": {\"strands\": 100}, %s' >$D/s.json", scene);
    expect(0, command, "");
    expect(0, "$T $D/s.json " SMALL, "are left out, because the groom has no scalp");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attributes_of_a_scene_change_its_hair),
        cmocka_unit_test(attributes_of_a_groom_file_are_used),
        cmocka_unit_test(maps_of_a_scene_are_added_to_the_images_of_a_groom),
        cmocka_unit_test(attributes_that_cannot_be_used_are_told),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
