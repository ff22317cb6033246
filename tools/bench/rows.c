// rows.c - Flat rows, and their output in three formats.
#include "tools/bench/rows.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#define DIGITS 7 // precision of a float
#define MAX_TEXT 96

void bench_rows_create(struct bench_rows* rows, const char* const* columns)
{
    *rows = (struct bench_rows){columns, json_array()};
}

void bench_rows_free(struct bench_rows* rows)
{
    json_decref(rows->rows);
}

json_t* bench_rows_add(struct bench_rows* rows)
{
    json_t* row = json_object();
    for (const char* const* column = rows->columns; *column; ++column)
        json_object_set_new(row, *column, json_null());
    json_array_append_new(rows->rows, row);
    return row;
}

static void set(json_t* row, const char* key, json_t* value)
{
    assert(json_object_get(row, key));
    if (value) json_object_set_new(row, key, value);
}

void bench_set_text(json_t* row, const char* key, const char* text)
{
    set(row, key, json_string(text));
}
void bench_set_number(json_t* row, const char* key, double number)
{
    set(row, key, json_real(number)); // json_real() returns NULL for a number that is not finite
}
void bench_set_count(json_t* row, const char* key, uint64_t count)
{
    set(row, key, json_integer((json_int_t)count));
}
void bench_set_flag(json_t* row, const char* key, bool flag)
{
    set(row, key, json_boolean(flag));
}

void bench_set_null(json_t* row, const char* key)
{
    set(row, key, json_null());
}

// The front ---------------------------------------------------------------------------------------

static bool takes_part(const json_t* row, const char* cost, const char* error)
{
    const json_t* by = json_object_get(row, "measured_by");
    return (!by || (json_is_string(by) && !strcmp(json_string_value(by), "here"))) &&
           json_is_number(json_object_get(row, cost)) && json_is_number(json_object_get(row, error));
}

static double number(const json_t* row, const char* key)
{
    return json_number_value(json_object_get(row, key));
}

static bool beats(const json_t* a, const json_t* b, const char* cost, const char* error)
{
    double ac = number(a, cost), bc = number(b, cost), ae = number(a, error), be = number(b, error);
    return ac <= bc && ae <= be && (ac < bc || ae < be);
}

static bool is_of_one_kind(const json_t* a, const json_t* b)
{
    return json_equal(json_object_get(a, "case"), json_object_get(b, "case")) &&
           (!json_object_get(a, "vertices") ||
            json_equal(json_object_get(a, "vertices"), json_object_get(b, "vertices")));
}

void bench_mark_front(json_t* rows, const char* cost, const char* error)
{
    size_t i, j;
    json_t *row, *other;
    json_array_foreach(rows, i, row)
    {
        if (!takes_part(row, cost, error)) continue;
        bool front = true;
        json_array_foreach(rows, j, other) if (takes_part(other, cost, error) && is_of_one_kind(row, other))
            front = front && !beats(other, row, cost, error);
        bench_set_flag(row, "front", front);
    }
}

// Writing -----------------------------------------------------------------------------------------

void bench_write_json(const struct bench_rows* rows, const struct bench_about* about, FILE* file)
{
    json_t* root = json_pack("{s:s, s:s, s:s, s:s, s:i, s:f, s:O}", "suite", about->suite, "version",
                             about->version, "renderer", about->renderer, "processor", about->processor,
                             "cores", (int)about->cores, "seconds", about->seconds, "rows", rows->rows);
    json_dumpf(root, file, JSON_INDENT(2) | JSON_REAL_PRECISION(DIGITS));
    fputc('\n', file);
    json_decref(root);
}

// Return the text of a value, empty for null.
static const char* print(const json_t* value, char text[MAX_TEXT])
{
    text[0] = 0;
    if (json_is_string(value)) return json_string_value(value);
    if (json_is_integer(value)) snprintf(text, MAX_TEXT, "%lld", (long long)json_integer_value(value));
    if (json_is_real(value)) snprintf(text, MAX_TEXT, "%.*g", DIGITS, json_real_value(value));
    if (json_is_boolean(value)) return json_is_true(value) ? "true" : "false";
    return text;
}

// Write a field as in RFC 4180, quoted if needed, with quotes doubled.
static void write_field(const char* text, FILE* file)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; ++text) {
        if (*text == '"') fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

void bench_write_csv(const struct bench_rows* rows, FILE* file)
{
    char text[MAX_TEXT];
    for (const char* const* column = rows->columns; *column; ++column)
        fprintf(file, "%s%s", column == rows->columns ? "" : ",", *column);
    fputs("\r\n", file);
    size_t i;
    json_t* row;
    json_array_foreach(rows->rows, i, row)
    {
        for (const char* const* column = rows->columns; *column; ++column) {
            if (column != rows->columns) fputc(',', file);
            write_field(print(json_object_get(row, *column), text), file);
        }
        fputs("\r\n", file);
    }
}

// Return the number of characters of a UTF-8 text, all bytes except continuation bytes.
static int width_of(const char* text)
{
    int width = 0;
    for (; *text; ++text) width += (*text & 0xc0) != 0x80;
    return width;
}

static int column_width(const struct bench_rows* rows, const char* column)
{
    char text[MAX_TEXT];
    int width = width_of(column);
    size_t i;
    json_t* row;
    json_array_foreach(rows->rows, i, row)
    {
        int own = width_of(print(json_object_get(row, column), text));
        if (own > width) width = own;
    }
    return width;
}

static bool is_same_in_all(const struct bench_rows* rows, const char* column)
{
    size_t i;
    json_t* row;
    const json_t* first = json_object_get(json_array_get(rows->rows, 0), column);
    json_array_foreach(rows->rows, i, row) if (!json_equal(json_object_get(row, column), first)) return false;
    return true;
}

static void write_cell(const char* text, int width, bool left, FILE* file)
{
    int room = width - width_of(text);
    fprintf(file, "%*s%s%*s  ", left ? 0 : room, "", text, left ? room : 0, "");
}

// Write the values that are equal in all rows on one line.
static void write_shared(const struct bench_rows* rows, FILE* file)
{
    char text[MAX_TEXT];
    const char* comma = "";
    for (const char* const* column = rows->columns; *column; ++column) {
        const json_t* value = json_object_get(json_array_get(rows->rows, 0), *column);
        if (!is_same_in_all(rows, *column) || json_is_null(value)) continue;
        fprintf(file, "%s%s %s", comma, *column, print(value, text));
        comma = ", ";
    }
    if (*comma) fputs("\n\n", file);
}

void bench_write_table(const struct bench_rows* rows, FILE* file)
{
    char text[MAX_TEXT];
    write_shared(rows, file);
    for (size_t line = 0; line <= json_array_size(rows->rows); ++line) {
        const json_t* row = line ? json_array_get(rows->rows, line - 1) : NULL;
        for (const char* const* column = rows->columns; *column; ++column) {
            if (is_same_in_all(rows, *column)) continue;
            const json_t* value = json_object_get(row, *column);
            int width = column_width(rows, *column);
            write_cell(row ? print(value, text) : *column, width, row && !json_is_number(value), file);
        }
        fputc('\n', file);
    }
}
