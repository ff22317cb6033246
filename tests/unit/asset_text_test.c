// asset_text_test.c - text .tfx in the variants that exporters write.
#include "tests/support/files.h"

#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "lib/asset/text.h"

static struct hair_test_host test;

static hair_asset* read_text(const char* text)
{
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    assert_int_equal(hair_test_read(&test, &import, text, strlen(text), &asset), HAIR_OK);
    assert_int_equal(asset->format, HAIR_FORMAT_TFX2);
    assert_int_equal(asset->strand_set, HAIR_STRAND_SET_GUIDES);
    return asset;
}

static void refuse_text(const char* text, const char* why)
{
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    assert_int_equal(hair_test_read(&test, &import, text, strlen(text), &asset), HAIR_ERROR_FILE);
    if (!strstr(test.sentence, why)) fail_msg("\"%s\" does not say \"%s\"", test.sentence, why);
}

static void assert_vertex(const hair_asset* asset, uint32_t vertex, float x, float y, float z)
{
    const float* p = asset->strands.positions + 3 * vertex;
    assert_float_equal(p[0], x, 1e-6);
    assert_float_equal(p[1], y, 1e-6);
    assert_float_equal(p[2], z, 1e-6);
}

static void tfx_text_holds_guides(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_tfx2();
    hair_test_put(&file, "", 1);
    hair_asset* asset = read_text((const char*)file.bytes);
    assert_int_equal(asset->strands.strand_count, 3);
    for (uint32_t i = 0; i < 12; ++i) {
        assert_int_equal(asset->strands.vertices[i / 4], 4);
        const float want[3] = {(float)(i / 4), (float)(i % 4), 0.125f * (float)(i % 4)};
        for (int j = 0; j < 3; ++j) assert_true(asset->strands.positions[3 * i + (uint32_t)j] == want[j]);
    }
    assert_int_equal(test.warnings, 0);
    hair_asset_free(asset);
    free(file.bytes);
}

static void every_kind_of_line_end_is_read(void** state)
{
    (void)state;
    const char* ends[] = {"\n", "\r\n", "\r", "\n\n", " \t\n", "\n# a comment\n", " // a comment\r\n"};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i)
        for (int last = 0; last < 2; ++last) {
            char text[256];
            snprintf(text, sizeof text, "version 2.0%sstrand 0 numVerts 2%s1 2 3%s4 5 6%s", ends[i], ends[i],
                     ends[i], last ? ends[i] : "");
            hair_asset* asset = read_text(text);
            assert_int_equal(asset->strands.vertex_count, 2);
            assert_vertex(asset, 1, 4, 5, 6);
            hair_asset_free(asset);
        }
}

static void optional_lines_may_be_missing_or_different(void** state)
{
    (void)state;
    const char* texts[] = {
        "numStrands 1\nis sorted 1\nstrand 0 numVerts 2 texcoord 0.0 0.5\n1 2 3\n4 5 6\n",
        "version 2.0\nstrand 0 numVerts 2\n1 2 3\n4 5 6\n",
        "VERSION 2.0\nnumstrands 1\nSTRAND numverts 2\n1,2,3\n4, 5, 6\n",
        "version 2.0\nisSorted 1\nstrand 0 texcoord 0 0 numVerts 2\n\t1\t2\t3\n4 5 6",
        "\xef\xbb\xbfversion 2.0\r\nstrand 0 numVerts 2\r\n1 2 3\r\n4 5 6\r\n",
        "# exported\n\nversion 2.0\nstrand 7 numVerts 2 # first\n1 2 3 # root\n4 5 6\n\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        hair_asset* asset = read_text(texts[i]);
        assert_int_equal(asset->strands.strand_count, 1);
        assert_vertex(asset, 0, 1, 2, 3);
        assert_vertex(asset, 1, 4, 5, 6);
        hair_asset_free(asset);
    }
    assert_int_equal(test.warnings, 0);
    hair_asset_free(read_text("version 2.0\nshininess 3\ngloss 4\nstrand 0 numVerts 2\n1 2 3\n4 5 6\n"));
    assert_int_equal(test.warnings, 1);
}

static void placement_of_the_file_is_applied(void** state)
{
    (void)state;
    hair_asset* asset =
        read_text("version 2.0\nscale 2\ntranslation 10 20 30\nstrand 0 numVerts 2\n1 2 3\n4 5 6\n");
    assert_vertex(asset, 0, 12, 24, 36);
    assert_vertex(asset, 1, 18, 30, 42);
    hair_asset_free(asset);

    // Rotations by 90 degrees about x, y and z. The last one is about z and then x, which moves the
    // y axis to -x and leaves it there.
    const struct {
        const char* rotation;
        float y[3];
    } turns[] = {{"1.5707963 0 0", {0, 0, 1}},
                 {"0 1.5707963 0", {0, 1, 0}},
                 {"0 0 1.5707963", {-1, 0, 0}},
                 {"1.5707963 0 1.5707963", {-1, 0, 0}},
                 {"0 1.5707963 1.5707963", {0, 0, 1}}};
    for (size_t i = 0; i < sizeof turns / sizeof *turns; ++i) {
        char text[200];
        snprintf(text, sizeof text, "version 2.0\nrotation %s\nstrand 0 numVerts 2\n0 0 0\n0 1 0\n",
                 turns[i].rotation);
        asset = read_text(text);
        assert_vertex(asset, 1, turns[i].y[0], turns[i].y[1], turns[i].y[2]);
        hair_asset_free(asset);
    }
}

static void nonfinite_vertices_are_removed(void** state)
{
    (void)state;
    hair_asset* asset =
        read_text("version 2.0\nstrand 0 numVerts 10\n0 0 0\n-1.#INF -1.#INF -1.#INF\n0 1.#QNAN 0\n"
                  "nan 0 0\nNaN(ind) 0 0\n-inf 0 0\n0 Infinity 0\n0 0 1e39\n0 0 1e999999999999\n"
                  "0 1 0\n");
    assert_int_equal(asset->repairs.removed_nonfinite, 8);
    assert_int_equal(asset->strands.vertex_count, 2);
    hair_asset_free(asset);
}

static void malformed_text_is_refused_with_its_byte_offset(void** state)
{
    (void)state;
    refuse_text("version 2.0\n", "byte 12 without a strand");
    refuse_text("version 2.0\nnumStrands 2\nstrand 0 numVerts 2\n0 0 0\n0 1 0\n", "byte 57 after 1 strands");
    refuse_text("version 2.0\nnumStrands 0\nstrand 0 numVerts 2\n0 0 0\n0 1 0\n", "numStrands is 0");
    refuse_text("version 2.0\nnumStrands -1\n", "byte 23 stands no count");
    refuse_text("version 2.0\nnumStrands 1.5\n", "byte 23 stands no count");
    refuse_text("version 2.0\nnumStrands nan\n", "byte 23 stands no count");
    refuse_text("version 2.0\nnumStrands\n", "byte 22 the line ends");
    refuse_text("version 2.0\nstrand 0 numVerts 4294967296\n", "byte 30 stands no count");
    refuse_text("version 2.0\nstrand 0 numVerts 4294967295\n0 0 0\n", "within the strand at byte 12");
    refuse_text("version 2.0\nstrand 0\n0 0 0\n", "byte 12 the strand does not say");
    refuse_text("version 2.0\nstrand 0 numVerts 3\n0 0 0\n0 1 0\nstrand 1 numVerts 0\n",
                "byte 44 stands no number");
    refuse_text("version 2.0\nstrand 0 numVerts 2\n0 0 0\n0 1 0\n0 2 0\n", "outside of any strand");
    refuse_text("version 2.0\nstrand 0 numVerts 2\n0 0\n0 1 0\n", "byte 35 the line ends");
    refuse_text("version 2.0\nstrand 0 numVerts 2\n0 0 0\n0,0 1,5 0,0\n", "byte 44 stands more");
    refuse_text("version 2.0\nscale nan\nstrand 0 numVerts 2\n0 0 0\n0 1 0\n",
                "byte 12 a number of the line");
    refuse_text("version 2.0\ntranslation 0 1e39 0\n", "byte 12 a number of the line");
    refuse_text("version 2.0\nrotation 0 0\n", "byte 24 the line ends");
    refuse_text("version 2.0\nscale 0\nstrand 0 numVerts 2\n0 0 0\n0 1 0\n", "shorter than 10 micrometres");
    refuse_text("versions 2.0\n", "byte 0");
    refuse_text("", "byte 0");
}

static bool number_of(const char* text, double* out)
{
    struct hair_token token = {(const unsigned char*)text, 0, strlen(text)};
    return hair_token_number(&token, out);
}

static void numbers_are_parsed_like_the_c_library(void** state)
{
    (void)state;
    const char* numbers[] = {"0",
                             "-0",
                             "1",
                             "+1",
                             "-1.5",
                             ".5",
                             "5.",
                             "1e0",
                             "1E+3",
                             "1e-3",
                             "0.1",
                             "3.4028235e38",
                             "1e-45",
                             "1e-300",
                             "123456789012345678901234567890",
                             "0.000000000000000000000000000001",
                             "00001.50000000000000000000000000000000000",
                             "1e22",
                             "1e23",
                             "12345.678e-9",
                             "0.000123456789012345678901e30",
                             "9007199254740993",
                             "1e308"};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        double value, want = strtod(numbers[i], NULL);
        assert_true(number_of(numbers[i], &value));
        assert_true(fabs(value - want) <= 1e-15 * fabs(want));
        assert_true((float)value == (float)want);
        assert_int_equal(signbit(value), signbit(want));
    }
}

static void printed_floats_are_parsed_exactly(void** state)
{
    (void)state;
    uint32_t wrong = 0;
    srand(3);
    for (int i = 0; i < 200000; ++i) {
        uint32_t bits = (uint32_t)rand() * 2654435761u ^ (uint32_t)rand();
        float want;
        memcpy(&want, &bits, sizeof want);
        if (!isfinite(want)) continue;
        char text[64];
        double value;
        snprintf(text, sizeof text, "%.9g", (double)want);
        assert_true(number_of(text, &value));
        wrong += (float)value != want;
    }
    assert_int_equal(wrong, 0);
}

static void words_that_are_no_numbers_are_refused(void** state)
{
    (void)state;
    const char* words[] = {"",     "-",   "+",     ".",    "-.",  "e5",    "1e", "1e+", "1x", "0x10",
                           "1..2", "--1", "1e5.0", "1.5f", "one", "1_000", "in", "na",  "1 "};
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        double value;
        if (number_of(words[i], &value)) fail_msg("\"%s\" was read as %g", words[i], value);
    }
}

static void numbers_are_parsed_equally_in_any_locale(void** state)
{
    (void)state;
    // Use a locale with a decimal comma if the machine has one. Otherwise this test repeats the one
    // above.
    const char* locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C.UTF-8"};
    for (size_t i = 0; i < 4; ++i) {
        setlocale(LC_ALL, locales[i]);
        hair_asset* asset = read_text("version 2.0\nstrand 0 numVerts 2\n0.5 0.25 0.125\n4 5 6\n");
        assert_vertex(asset, 0, 0.5f, 0.25f, 0.125f);
        hair_asset_free(asset);
    }
    setlocale(LC_ALL, "C");
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(tfx_text_holds_guides),
        TEST(every_kind_of_line_end_is_read),
        TEST(optional_lines_may_be_missing_or_different),
        TEST(placement_of_the_file_is_applied),
        TEST(nonfinite_vertices_are_removed),
        TEST(malformed_text_is_refused_with_its_byte_offset),
        TEST(numbers_are_parsed_like_the_c_library),
        TEST(printed_floats_are_parsed_exactly),
        TEST(words_that_are_no_numbers_are_refused),
        TEST(numbers_are_parsed_equally_in_any_locale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
