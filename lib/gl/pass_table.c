// pass_table.c - rows of passes.inl, which say what each pass is made from.
#include "lib/gl/gl.h"

#include <ctype.h>
#include <stdio.h>

static const struct {
    const char* label;
    hair_gl_category category;
    hair_gl_pass features;
    const char* stages;
} rows[] = {
#define PASS(name, label, category, features, stages) {label, HAIR_GL_CATEGORY_##category, features, stages},
#include "lib/gl/passes.inl"
};

static const char* const pass_features[] = {
#define FEATURE(name, define) #name,
#include "lib/gl/passes.inl"
};

_Static_assert(HAIR_GL_ROWS <= 1 << HAIR_GL_ROW_BITS, "a row is a number of HAIR_GL_ROW_BITS");
_Static_assert(HAIR_GL_ROW_BITS + 2 + HAIR_GL_FEATURES <= 64, "every feature is a bit of a pass");

static uint32_t row_of_pass(hair_gl_pass pass)
{
    HAIR_ASSERT((pass & ((1u << HAIR_GL_ROW_BITS) - 1)) < HAIR_GL_ROWS);
    return (uint32_t)pass & ((1u << HAIR_GL_ROW_BITS) - 1);
}

const char* hair_gl_row_label(hair_gl_pass pass)
{
    return rows[row_of_pass(pass)].label;
}

hair_gl_category hair_gl_row_category(hair_gl_pass pass)
{
    return rows[row_of_pass(pass)].category;
}

const char* hair_gl_row_stages(hair_gl_pass pass)
{
    return rows[row_of_pass(pass)].stages;
}

hair_gl_pass hair_gl_add_features(hair_gl_pass pass, hair_gl_pass wanted)
{
    return pass | (wanted & rows[row_of_pass(pass)].features);
}

hair_gl_pass hair_gl_pass_for(hair_gl_pass pass, uint32_t vertices)
{
    HAIR_ASSERT(0 < vertices && vertices <= HAIR_MAX_GUIDE_VERTICES);
    int size = (vertices > 32) + (vertices > 64) + (vertices > 128);
    return (pass & ~HAIR_GL_SIZES) | HAIR_GL_SIZE(size);
}

void hair_gl_write_label(hair_gl_pass pass, char* out, size_t size)
{
    // A feature that the row lacks would compile the same program twice.
    HAIR_ASSERT((pass & ~rows[row_of_pass(pass)].features) == row_of_pass(pass));
    size_t used = (size_t)snprintf(out, size, "%s", hair_gl_row_label(pass));
    for (uint32_t i = 0; i < HAIR_GL_FEATURES && used < size; ++i) {
        if (!(pass & HAIR_GL_BIT(i))) continue;
        size_t start = used + 1;
        used += (size_t)snprintf(out + used, size - used, "_%s", pass_features[i]);
        for (size_t k = start; k < used && k < size; ++k) out[k] = (char)tolower(out[k]);
    }
    if (rows[row_of_pass(pass)].features & HAIR_GL_SIZES && used < size)
        snprintf(out + used, size - used, "_%u", HAIR_GL_THREADS(pass));
}
