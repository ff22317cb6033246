// rows.h - Results of a suite as flat rows under the suite's columns, written as JSON, CSV and a
// table.
//
// A row contains every column, initially null. Numbers that are not finite stay null.
#ifndef HAIR_TOOLS_BENCH_ROWS_H
#define HAIR_TOOLS_BENCH_ROWS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

struct bench_rows {
    const char* const* columns; // terminated by NULL
    json_t* rows; // array of objects
};

void bench_rows_create(struct bench_rows* rows, const char* const* columns);
void bench_rows_free(struct bench_rows* rows);

// Add a row, which `rows` owns. Keys are columns.
json_t* bench_rows_add(struct bench_rows* rows);
void bench_set_text(json_t* row, const char* key, const char* text);
void bench_set_number(json_t* row, const char* key, double number);
void bench_set_count(json_t* row, const char* key, uint64_t count);
void bench_set_flag(json_t* row, const char* key, bool flag);
void bench_set_null(json_t* row, const char* key);

// Set "front" of rows that were measured here and have both numbers `cost` and `error`. A row was
// measured here if "measured_by" is "here" or is not a column. "front" is true if no other row is
// as good in both numbers and better in one. Only rows of equal "case" and, if present, "vertices"
// are compared.
void bench_mark_front(json_t* rows, const char* cost, const char* error);

// Description of the suite and the machine.
struct bench_about {
    const char *suite, *version, *renderer, *processor;
    long cores;
    double seconds; // total time
};

// Write all rows to `file`. The stream's error flag reports failures.
void bench_write_json(const struct bench_rows* rows, const struct bench_about* about, FILE* file);
void bench_write_csv(const struct bench_rows* rows, FILE* file);
// Write a table. Columns that are equal in all rows are written once above it.
void bench_write_table(const struct bench_rows* rows, FILE* file);

#endif
