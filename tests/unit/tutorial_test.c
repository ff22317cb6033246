// tutorial_test.c - "From Blender to the screen in ten minutes": the commands that need no Python
// package run, the function of the page is compiled, and all links have files.
#include "tests/support/files.h"
#include "tests/support/shell.h"

#include <hair/hair_asset.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#define FOLDER "tools/convert/tutorial/"

static hair_groom* read_groom(const void* bytes, size_t size)
{
    hair_asset* asset;
    hair_groom* groom = NULL;
    hair_asset_desc asset_desc = hair_asset_desc_default();
    hair_groom_desc desc = hair_groom_desc_default();
    if (hair_asset_read(&asset_desc, bytes, size, &asset)) return NULL;
    if (hair_asset_to_groom_desc(asset, &desc) == HAIR_OK) hair_groom_create(&desc, &groom);
    hair_asset_destroy(asset);
    return groom;
}

// Return the text or the bytes of a file, with a 0 behind. The caller frees them.
static char* load(const char* path, size_t* size)
{
    FILE* file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    long length = ftell(file);
    assert_true(length > 0);
    rewind(file);
    char* bytes = calloc((size_t)length + 1, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, (size_t)length, file), (size_t)length);
    fclose(file);
    if (size) *size = (size_t)length;
    return bytes;
}

static int make_folder(void** state)
{
    (void)state;
    return hair_test_shell_start(HAIR_BUILD_DIR);
}

static void commands_make_picture_film_and_motion(void** state)
{
    (void)state;
    hair_test_shell_expect(0, "sh " FOLDER "run.sh $T $D sh", "groups:    of every strand");
    hair_test_shell_expect(0, "ls $D", "blender_addon.zip");
    for (int i = 0; i < 3; ++i) {
        char path[256];
        snprintf(path, sizeof path, "%s/%s", hair_test_folder(),
                 (const char*[]){"head.png", "shake.mp4", "shake.dump"}[i]);
        assert_int_equal(access(path, R_OK), 0);
    }
}

static void function_of_the_page_reads_the_groom(void** state)
{
    (void)state;
    size_t size;
    char* page = load(FOLDER "README.md", NULL);
    char* source = load("tests/unit/tutorial_test.c", NULL);
    char* code = strstr(page, "```c\n");
    assert_non_null(code);
    code += strlen("```c\n");
    *strstr(code, "```") = 0;
    assert_non_null(strstr(source, code));
    free(source);
    free(page);
    char* bytes = load(FOLDER "head.groom", &size);
    hair_groom* groom = read_groom(bytes, size);
    assert_non_null(groom);
    hair_groom_info info = hair_groom_info_default();
    assert_int_equal(hair_groom_describe(groom, &info), HAIR_OK);
    assert_true(info.group_count == 2 && info.guide_count == 420 && info.follower_count == 18000);
    hair_groom_destroy(groom);
    assert_null(read_groom(bytes, size / 2));
    free(bytes);
}

static void links_of_the_page_have_files(void** state)
{
    (void)state;
    int count = 0;
    char* page = load(FOLDER "README.md", NULL);
    for (char* at = page; (at = strstr(at, "](")) != NULL; ++count) {
        char path[256];
        at += 2;
        snprintf(path, sizeof path, FOLDER "%.*s", (int)strcspn(at, "#)"), at);
        if (access(path, R_OK) != 0) fail_msg("%s is not there", path);
    }
    assert_true(count >= 8);
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commands_make_picture_film_and_motion),
        cmocka_unit_test(function_of_the_page_reads_the_groom),
        cmocka_unit_test(links_of_the_page_have_files),
    };
    return cmocka_run_group_tests_name("tutorial", tests, make_folder, hair_test_shell_finish);
}
