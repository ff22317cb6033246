// source_test.c - shader text with its includes inserted, and line numbers that refer to the files.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lib/gl/gl.h"

static struct hair_test_host test;
static char folder[64];

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    snprintf(folder, sizeof folder, "/tmp/hair-source-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int finish(void** state)
{
    (void)state;
    static const char names[][8] = {"a.comp", "b.glsl", "c.glsl"};
    char path[128];
    for (int i = 0; i < 3; ++i) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    for (int i = 0; i <= HAIR_GL_MAX_SOURCES; ++i) {
        snprintf(path, sizeof path, "%s/%d.glsl", folder, i);
        unlink(path);
    }
    rmdir(folder);
    return (int)test.blocks;
}

static void put(const char* name, const char* text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE* file = fopen(path, "wb");
    fputs(text, file);
    fclose(file);
}

static hair_result resolve(const char* name, struct hair_gl_source* out)
{
    return hair_gl_read_source(&test.host, folder, name, "PREFIX\n", out);
}

static void expect(const char* name, const char* text)
{
    struct hair_gl_source source;
    assert_int_equal(resolve(name, &source), HAIR_OK);
    assert_string_equal(source.text, text);
    hair_free(&test.host, source.text);
}

static void a_file_without_includes_is_itself(void** state)
{
    (void)state;
    put("a.comp", "one\ntwo");
    expect("a.comp", "one\ntwo\n");
}

static void the_prefix_follows_the_version(void** state)
{
    (void)state;
    put("a.comp", "// head\n#version 450 core\nvoid main() {}\n");
    expect("a.comp", "// head\n#version 450 core\nPREFIX\n#line 3 0\nvoid main() {}\n");
}

static void includes_are_inserted_once(void** state)
{
    (void)state;
    put("a.comp", "a1\n#include \"b.glsl\"\n  #include \"c.glsl\"\na4\n");
    put("b.glsl", "b1\n#include \"c.glsl\"\nb3\n");
    put("c.glsl", "c1\n#include \"a.comp\"\n");
    expect("a.comp",
           "a1\n#line 1 1\nb1\n#line 1 2\nc1\n#line 3 2\n#line 3 1\nb3\n#line 3 0\n#line 4 0\na4\n");
}

static void missing_file_is_named(void** state)
{
    (void)state;
    struct hair_gl_source source = {0};
    put("a.comp", "#include \"nowhere.glsl\"\n");
    assert_int_equal(resolve("a.comp", &source), HAIR_ERROR_OPENGL);
    assert_string_equal(test.sentence, "shader text glsl/nowhere.glsl is not there");
    assert_int_equal(hair_gl_read_source(&test.host, NULL, "nowhere.comp", "", &source), HAIR_ERROR_OPENGL);
    assert_string_equal(test.sentence, "shader text glsl/nowhere.comp is not there");
    assert_int_equal(test.errors, 2);
}

static void too_many_files_and_too_long_names_are_refused(void** state)
{
    (void)state;
    struct hair_gl_source source;
    for (int i = 0; i <= HAIR_GL_MAX_SOURCES; ++i) {
        char name[32], text[64];
        snprintf(name, sizeof name, "%d.glsl", i);
        snprintf(text, sizeof text, "#include \"%d.glsl\"\n", i + 1);
        put(name, i < HAIR_GL_MAX_SOURCES ? text : "last\n");
    }
    assert_int_equal(resolve("0.glsl", &source), HAIR_ERROR_OPENGL);
    assert_string_equal(test.sentence, "shader 0.glsl includes too much");
    assert_int_equal(resolve("1.glsl", &source), HAIR_OK);
    hair_free(&test.host, source.text);
    put("a.comp", "#include \"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\"\n");
    assert_int_equal(resolve("a.comp", &source), HAIR_ERROR_OPENGL);
    assert_int_equal(test.errors, 2);
}

static void lines_that_only_look_like_includes_stay(void** state)
{
    (void)state;
    put("a.comp", "#include\n#include nothing\n#include \"half\n// #include \"b.glsl\"\n#includes\n");
    expect("a.comp", "#include\n#include nothing\n#include \"half\n// #include \"b.glsl\"\n#includes\n");
}

static void refused_memory_leaks_nothing(void** state)
{
    (void)state;
    struct hair_gl_source source;
    for (uint32_t n = 1;; ++n) {
        test.allocations = 0;
        test.refuse = n;
        hair_result result = hair_gl_read_source(&test.host, "glsl", "draw/strand.tese", "", &source);
        if (!result) break;
        assert_int_equal(result, HAIR_ERROR_MEMORY);
        assert_int_equal(test.blocks, 0);
        assert_string_equal(test.sentence, "out of memory for shader text");
    }
    assert_true(test.allocations > 3);
    hair_free(&test.host, source.text);
}

// The passes --------------------------------------------------------------------------------------

static const char* const stages[] = {
#define PASS(name, label, category, features, stages) stages,
#include "lib/gl/passes.inl"
};

// Read line `number` (from 1) of glsl/`name`.
static void read_line(const char* name, int number, char* out, int size)
{
    char path[128];
    snprintf(path, sizeof path, "glsl/%s", name);
    FILE* file = fopen(path, "rb");
    assert_non_null(file);
    *out = 0;
    for (int i = 0; i < number; ++i)
        if (!fgets(out, size, file)) fail_msg("%s has no line %d", path, number);
    out[strcspn(out, "\n")] = 0;
    fclose(file);
}

// Check every line against the file and number of the #line directives.
static void check_lines(const struct hair_gl_source* source)
{
    int line = 1;
    unsigned file = 0;
    for (char* at = source->text; *at;) {
        char* end = strchr(at, '\n');
        char expected[512];
        *end = 0;
        int prefix = strncmp(at, "#define HAIR_TEST_PREFIX", 24) == 0;
        if (!prefix && sscanf(at, "#line %d %u", &line, &file) != 2) {
            assert_in_range(file, 0, source->files - 1);
            read_line(source->file[file], line, expected, sizeof expected);
            assert_string_equal(at, expected);
            ++line;
        }
        at = end + 1;
    }
}

// Check every file that a pass consists of, once.
static void for_every_shader(void (*check)(const char* name))
{
    static char seen[128][48];
    size_t count = 0;
    for (size_t i = 0; i < sizeof stages / sizeof *stages; ++i) {
        char list[256];
        snprintf(list, sizeof list, "%s", stages[i]);
        for (char* name = strtok(list, " "); name; name = strtok(NULL, " ")) {
            if (strchr(name, '=')) continue; // A definition.
            if (strchr(name, '?')) name = strchr(name, '?') + 1; // Skips the condition of the file.
            size_t k = 0;
            while (k < count && strcmp(seen[k], name)) ++k;
            if (k < count) continue;
            assert_true(count < sizeof seen / sizeof *seen && strlen(name) < sizeof *seen);
            strcpy(seen[count++], name);
            check(name);
        }
    }
}

static void check_lines_of(const char* name)
{
    struct hair_gl_source source;
    assert_int_equal(hair_gl_read_source(&test.host, "glsl", name, "#define HAIR_TEST_PREFIX\n", &source),
                     HAIR_OK);
    check_lines(&source);
    hair_free(&test.host, source.text);
}

static void every_shader_line_maps_back_to_its_file(void** state)
{
    (void)state;
    for_every_shader(check_lines_of);
}

// Files that a shader includes, and whether the inclusion is within an #if.
struct included {
    char file[64][48];
    int on_condition[64];
    uint32_t count;
};

static int is_guard(const char* line)
{
    size_t length = strcspn(line, "\n");
    return strncmp(line, "#ifndef HAIR_", 13) == 0 &&
           (strncmp(line + length - 5, "_GLSL", 5) == 0 || strncmp(line + length - 2, "_H", 2) == 0);
}

// Collect included files. The reader inserts a file only at its first inclusion. If that is not
// compiled, the file is missing everywhere.
static void walk(const char* name, int on_condition, struct included* all)
{
    char path[128], line[512], file[48];
    int depth = 0;
    snprintf(path, sizeof path, "glsl/%s", name);
    FILE* text = fopen(path, "rb");
    assert_non_null(text);
    while (fgets(line, sizeof line, text)) {
        depth += strncmp(line, "#if", 3) == 0 && !is_guard(line);
        depth -= strncmp(line, "#endif", 6) == 0 && depth > 0;
        if (sscanf(line, "#include \"%47[^\"]\"", file) != 1 || strcmp(file, HAIR_GL_USER_SHADER) == 0)
            continue;
        uint32_t k = 0;
        while (k < all->count && strcmp(all->file[k], file)) ++k;
        if (k < all->count) {
            if (all->on_condition[k]) fail_msg("%s, included by %s too, is there on a condition", file, name);
            continue;
        }
        assert_in_range(k, 0, 63);
        strcpy(all->file[k], file);
        all->on_condition[k] = on_condition || depth > 0;
        ++all->count;
        walk(file, on_condition || depth > 0, all);
    }
    fclose(text);
}

static void check_includes_of(const char* name)
{
    struct included all = {.count = 0};
    walk(name, 0, &all);
}

static void conditional_includes_are_inserted_once(void** state)
{
    (void)state;
    for_every_shader(check_includes_of);
}

static void compare(const char* name)
{
    struct hair_gl_source built_in, file;
    assert_int_equal(hair_gl_read_source(&test.host, NULL, name, "", &built_in), HAIR_OK);
    assert_int_equal(hair_gl_read_source(&test.host, "glsl", name, "", &file), HAIR_OK);
    assert_string_equal(built_in.text, file.text);
    hair_free(&test.host, built_in.text);
    hair_free(&test.host, file.text);
}

static void embedded_text_equals_the_files(void** state)
{
    (void)state;
    for_every_shader(compare);
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, start, finish)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_file_without_includes_is_itself),
        TEST(the_prefix_follows_the_version),
        TEST(includes_are_inserted_once),
        TEST(missing_file_is_named),
        TEST(too_many_files_and_too_long_names_are_refused),
        TEST(lines_that_only_look_like_includes_stay),
        TEST(refused_memory_leaks_nothing),
        TEST(every_shader_line_maps_back_to_its_file),
        TEST(conditional_includes_are_inserted_once),
        TEST(embedded_text_equals_the_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
