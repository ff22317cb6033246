// peers.c - Rows of other libraries in the suite `accuracy`, measured elsewhere.
#include "tools/bench/peers.h"

#include <math.h>
#include <string.h>

#define LENGTH 0.3 // length of the strand of `swing`, m

static json_t* add_peer(struct bench* bench, const char* name, const char* method, double length)
{
    json_t* row = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", method);
    bench_set_count(row, "vertices", 32);
    bench_set_number(row, "length", length);
    bench_set_text(row, "measured_by", "elsewhere");
    return row;
}

void bench_add_peers(struct bench* bench)
{
    static const struct {
        const char* method;
        uint32_t substeps, iterations;
        double stretch, mm, us;
    } swings[] = {
#define PEER_SWING(...) {__VA_ARGS__},
#define PEER_STATIC(...)
#include "tools/bench/peers.inl"
#undef PEER_SWING
#undef PEER_STATIC
    };
    static const struct {
        const char* method;
        double error[3];
    } statics[] = {
#define PEER_SWING(...)
#define PEER_STATIC(method, a, b, c) {method, {a, b, c}},
#include "tools/bench/peers.inl"
    };
    static const double lengths[] = {0.05, 0.1, 0.3};
    const char* only = bench->options.only_case;
    for (size_t i = 0; i < sizeof swings / sizeof *swings && (!only || !strcmp(only, "swing")); ++i) {
        json_t* row = add_peer(bench, "swing", swings[i].method, LENGTH);
        bench_set_number(row, "substeps", swings[i].substeps);
        bench_set_count(row, "iterations", swings[i].iterations);
        bench_set_count(row, "strands", 1000);
        bench_set_number(row, "us_per_strand", swings[i].us);
        bench_set_number(row, "rms_error", swings[i].mm / 1000 / LENGTH);
        bench_set_number(row, "rms_mm", swings[i].mm);
        bench_set_number(row, "max_stretch", swings[i].stretch);
        bench_set_text(row, "reference", "its own chain, converged");
    }
    for (size_t i = 0; i < sizeof statics / sizeof *statics && (!only || !strcmp(only, "static")); ++i)
        for (int k = 0; k < 3; ++k) {
            json_t* row = add_peer(bench, "static", statics[i].method, lengths[k]);
            bench_set_number(row, "tip_error", statics[i].error[k]);
            bench_set_text(row, "reference", "elastica");
        }
}
