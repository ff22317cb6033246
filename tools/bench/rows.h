// rows.h - what a suite found: flat rows under the suite's columns, written as JSON, as CSV and as a table.
//
// A row holds every column, null until it is set. Numbers that are not finite stay null.
#ifndef HAIR_TOOLS_BENCH_ROWS_H
#define HAIR_TOOLS_BENCH_ROWS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

struct bench_rows {
    const char* const* columns; // NULL ends them
    json_t* rows; // array of objects
};

void bench_rows_create(struct bench_rows* rows, const char* const* columns);
void bench_rows_free(struct bench_rows* rows);

// The row is held by `rows`. Keys are columns.
json_t* bench_rows_add(struct bench_rows* rows);
void bench_set_text(json_t* row, const char* key, const char* text);
void bench_set_number(json_t* row, const char* key, double number);
void bench_set_count(json_t* row, const char* key, uint64_t count);
void bench_set_flag(json_t* row, const char* key, bool flag);
void bench_set_null(json_t* row, const char* key);

// Set "front" of the rows that are measured here ("measured_by": "here", if there is such a column) and have both
// numbers `cost` and `error`: true where no other row of the same "case" and, if there are any, "vertices" is as good
// in both and better in one.
void bench_mark_front(json_t* rows, const char* cost, const char* error);

// What was measured, and on what.
struct bench_about {
    const char *suite, *version, *renderer, *processor;
    long cores;
    double seconds; // that it took
};

// All to `file`; its stream holds whether that failed.
void bench_write_json(const struct bench_rows* rows, const struct bench_about* about, FILE* file);
void bench_write_csv(const struct bench_rows* rows, FILE* file);
void bench_write_table(const struct bench_rows* rows,
                       FILE* file); // columns that are alike in all rows: once, above

#endif
