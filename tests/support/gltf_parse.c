// gltf_parse.c - the reader of glTF files of the tools, and the sentence that it said last.
#include "tests/support/gltf_parse.h"
#include "tools/common/file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

char hair_test_gltf_said[1024];

static void hear(const char* sentence, void* user)
{
    (void)user;
    snprintf(hair_test_gltf_said, sizeof hair_test_gltf_said, "%s", sentence);
}

void hair_test_gltf_listen(void)
{
    hair_complain_to(hear, NULL);
}

bool hair_test_gltf_parse_bytes(const unsigned char* bytes, size_t size, struct hair_gltf* out)
{
    *hair_test_gltf_said = 0;
    fflush(stderr);
    int kept = dup(STDERR_FILENO), sink = open("/dev/null", O_WRONLY);
    assert_true(kept >= 0 && sink >= 0 && dup2(sink, STDERR_FILENO) >= 0);
    bool ok = hair_gltf_parse("test", "a.glb", bytes, size, out);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    close(sink);
    return ok;
}

bool hair_test_gltf_parse(struct hair_test_file file, struct hair_gltf* out)
{
    bool ok = hair_test_gltf_parse_bytes(file.bytes, file.size, out);
    free(file.bytes);
    return ok;
}

struct hair_test_file hair_test_gltf_with(const char* from, const char* to)
{
    unsigned char binary[HAIR_TEST_GLTF_BYTES];
    hair_test_gltf_binary(binary);
    return hair_test_glb(hair_test_gltf_text, from, to, binary, sizeof binary);
}
