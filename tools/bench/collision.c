// collision.c - Suite `collision`, followers inside a head and shoulders that no guide is inside of
// (figure 6 of Tariq 2010). The suite measures the treatment of these followers, the time to find
// them, and the cost of many colliders to guides.
#include "tools/bench/bust.h"
#include "tools/bench/collider_count.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char* const columns[] = {"case",
                                      "method",
                                      "strands",
                                      "vertices",
                                      "frames",
                                      "voxel",
                                      "inside_before",
                                      "inside_after",
                                      "fraction_out",
                                      "max_depth_before",
                                      "max_depth",
                                      "moved",
                                      "mean_displacement",
                                      "max_displacement",
                                      "length_error",
                                      "turn",
                                      "turn_of_guides",
                                      "jump",
                                      "jump_of_strands",
                                      "dropped",
                                      "colliders",
                                      "objects",
                                      "ms",
                                      "ms_host",
                                      "runs",
                                      "ratio",
                                      "limit",
                                      "pass",
                                      NULL};

static const char* const names[] = {"push_out", "single_guide",
                                    "none"}; // in the order of hair_follower_collision

// Effects of the treatment on followers, summed over frames.
struct found {
    uint64_t inside_before, inside_after, moved, dropped, vertices_moved;
    double depth_before, depth, displacement, max_displacement, length_error, turn, turn_of_guides;
    double jump, jump_of_strands;
};

struct frame {
    float *before, *after; // all followers, without and with the treatment
    float *last_before, *last_after;
    float* guides;
};

static double distance(const float* a, const float* b)
{
    double x = (double)a[0] - (double)b[0], y = (double)a[1] - (double)b[1], z = (double)a[2] - (double)b[2];
    return sqrt(x * x + y * y + z * z);
}

// Return the maximum angle between successive segments, in degrees.
static double turn_of(const float* p, uint32_t segments)
{
    double max = 0;
    for (uint32_t k = 1; k < segments; ++k) {
        const float *a = p + 3 * (k - 1), *b = a + 3, *c = b + 3;
        double dot = 0, product = distance(a, b) * distance(b, c);
        for (int i = 0; i < 3; ++i) dot += ((double)b[i] - (double)a[i]) * ((double)c[i] - (double)b[i]);
        if (product > 0) max = fmax(max, acos(fmin(fmax(dot / product, -1), 1)));
    }
    return max * 180 / acos(-1);
}

static void look_at_strand(const struct bench_bust* bust, const struct frame* frame, size_t first,
                           double voxel, bool follows, struct found* found)
{
    const float *p = frame->before + first, *q = frame->after + first;
    uint32_t segments = bust->look.strand.segments;
    double before = 0, after = 0, max = 0, sum = 0;
    bool finite = true;
    for (uint32_t k = 0; k <= segments; ++k) {
        double away = distance(p + 3 * k, q + 3 * k);
        finite &= isfinite(away) != 0;
        max = fmax(max, away);
        sum += away;
        if (follows) {
            const float *a = frame->last_before + first + 3 * k, *b = frame->last_after + first + 3 * k;
            double square = 0;
            for (uint32_t i = 0; i < 3; ++i)
                square += pow((double)q[3 * k + i] - (double)p[3 * k + i] - ((double)b[i] - (double)a[i]), 2);
            found->jump = fmax(found->jump, sqrt(square));
            found->jump_of_strands = fmax(found->jump_of_strands, distance(p + 3 * k, a));
        }
        if (k == 0) continue; // The root does not move.
        before += distance(p + 3 * k, p + 3 * k - 3);
        after += distance(q + 3 * k, q + 3 * k - 3);
        double depth = -bench_bust_distance(bust, p + 3 * k), left = -bench_bust_distance(bust, q + 3 * k);
        found->inside_before += depth > voxel;
        found->inside_after += depth > voxel && left > 0;
        found->depth_before = fmax(found->depth_before, depth);
        found->depth = fmax(found->depth, left);
    }
    found->dropped += !finite || after == 0;
    found->turn = fmax(found->turn, turn_of(q, segments));
    if (max < 1e-6) return;
    ++found->moved;
    found->vertices_moved += segments + 1;
    found->displacement += sum;
    found->max_displacement = fmax(found->max_displacement, max);
    found->length_error = fmax(found->length_error, fabs(after / before - 1));
}

static bool look_at_frame(struct bench_bust* bust, hair_follower_collision collision, struct frame* frame,
                          double voxel, bool follows, struct found* found)
{
    size_t each = 3 * (size_t)(bust->look.strand.segments + 1);
    if (!bench_bust_read(bust, HAIR_FOLLOWER_COLLISION_NONE, frame->before)) return false;
    if (!bench_bust_read(bust, collision, frame->after)) return false;
    if (!bench_bust_read_guides(bust, frame->guides)) return false;
    for (size_t i = 0; i < bust->guides; ++i)
        found->turn_of_guides =
            fmax(found->turn_of_guides, turn_of(frame->guides + each * i, bust->look.strand.segments));
    for (size_t i = 0; i < bust->followers; ++i) look_at_strand(bust, frame, each * i, voxel, follows, found);
    float* swapped = frame->last_before;
    frame->last_before = frame->before;
    frame->before = swapped;
    swapped = frame->last_after;
    frame->last_after = frame->after;
    frame->after = swapped;
    return true;
}

static void add_row(struct bench_bust* bust, hair_follower_collision collision, uint32_t frames, double voxel,
                    const struct found* found, double ms, uint32_t runs)
{
    json_t* row = bench_rows_add(&bust->bench->rows);
    bench_set_text(row, "case", "shoulders");
    bench_set_text(row, "method", names[collision]);
    bench_set_count(row, "strands", bust->followers);
    bench_set_count(row, "vertices", bust->look.strand.segments + 1);
    bench_set_count(row, "frames", frames);
    bench_set_number(row, "voxel", voxel);
    bench_set_count(row, "inside_before", found->inside_before);
    bench_set_count(row, "inside_after", found->inside_after);
    bench_set_number(row, "fraction_out", 1 - (double)found->inside_after / (double)found->inside_before);
    bench_set_number(row, "max_depth_before", found->depth_before);
    bench_set_number(row, "max_depth", found->depth);
    bench_set_count(row, "moved", found->moved);
    if (found->moved)
        bench_set_number(row, "mean_displacement", found->displacement / (double)found->vertices_moved);
    bench_set_number(row, "max_displacement", found->max_displacement);
    bench_set_number(row, "length_error", found->length_error);
    bench_set_number(row, "turn", found->turn);
    bench_set_number(row, "turn_of_guides", found->turn_of_guides);
    bench_set_number(row, "jump", found->jump);
    bench_set_number(row, "jump_of_strands", found->jump_of_strands);
    bench_set_count(row, "dropped", found->dropped);
    bench_set_number(row, "ms", ms);
    bench_set_count(row, "runs", runs);
}

// Examine the followers three times a second, and again 1/240 s later to detect jumps.
static bool run_frames(struct bench_bust* bust, hair_follower_collision collision, struct frame* frame)
{
    enum { EVERY = BUST_FPS / 3 };
    uint32_t frames = bust->bench->options.quick ? EVERY + 1 : 11 * EVERY + 1, looked_at = 0, runs = 0;
    struct found found = {0};
    hair_field_info field = hair_field_info_default();
    double ms = 0;
    if (hair_get_field(bust->hair, &field)) return false;
    for (uint32_t i = 1; i <= frames; ++i) {
        if (!bench_bust_step(bust) || bench_was_interrupted()) return false;
        if (i % EVERY > 1 || i == 1) continue;
        if (!look_at_frame(bust, collision, frame, (double)field.voxel, i % EVERY == 1, &found)) return false;
        ++looked_at;
    }
    if (collision != HAIR_FOLLOWER_COLLISION_NONE && !bench_bust_time(bust, collision, &ms, &runs))
        return false;
    add_row(bust, collision, looked_at, (double)field.voxel, &found, ms, runs);
    return true;
}

static void measure_shoulders(struct bench* bench, hair_follower_collision collision)
{
    struct bench_bust bust;
    if (!bench_begin(bench, "shoulders", names[collision])) return;
    if (!bench_bust_make(bench, bench->options.quick ? 4000 : 0, 0, HAIR_HIT_METHOD_AUTO, &bust)) {
        bench_refuse(bench, "shoulders", names[collision]);
        return;
    }
    size_t size = 3 * sizeof(float) * bust.followers * (bust.look.strand.segments + 1);
    struct frame frame = {malloc(size), malloc(size), malloc(size), malloc(size),
                          malloc(3 * sizeof(float) * bust.guides * (bust.look.strand.segments + 1))};
    bool room = frame.before && frame.after && frame.last_before && frame.last_after && frame.guides;
    if (!room || !run_frames(&bust, collision, &frame)) bench_refuse(bench, "shoulders", names[collision]);
    free(frame.before);
    free(frame.after);
    free(frame.last_before);
    free(frame.last_after);
    free(frame.guides);
    bench_bust_free(&bust);
}

// Time one method on the scene that all methods use. Return the time in ms, or 0.
static double measure_first_hit(struct bench* bench, hair_hit_method way, double compute)
{
    static const char* const ways[] = {"auto", "compute", "prepass"};
    struct bench_bust bust;
    double ms = 0;
    uint32_t runs = 0;
    if (!bench_begin(bench, "first hit", ways[way])) return 0;
    if (!bench_bust_make(bench, bench->options.quick ? 4096 : 32768, 64, way, &bust)) {
        bench_refuse(bench, "first hit", ways[way]);
        return 0;
    }
    if (bench_bust_time(&bust, HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE, &ms, &runs)) {
        json_t* row = bench_rows_add(&bench->rows);
        bench_set_text(row, "case", "first hit");
        bench_set_text(row, "method", ways[way]);
        bench_set_count(row, "strands", bust.followers);
        bench_set_count(row, "vertices", bust.look.strand.segments + 1);
        bench_set_number(row, "ms", ms);
        bench_set_count(row, "runs", runs);
        if (compute > 0) bench_set_number(row, "ratio", ms / compute);
    } else
        bench_refuse(bench, "first hit", ways[way]);
    bench_bust_free(&bust);
    return ms;
}

static void run_suite(struct bench* bench)
{
    measure_shoulders(bench, HAIR_FOLLOWER_COLLISION_NONE);
    measure_shoulders(bench, HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE);
    measure_shoulders(bench, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    double compute = measure_first_hit(bench, HAIR_HIT_METHOD_COMPUTE, 0);
    measure_first_hit(bench, HAIR_HIT_METHOD_PREPASS, compute);
    bench_measure_world(bench);
    bench_collider_count(bench);
}

const struct bench_suite bench_collision = {
    "collision", "followers inside a head and shoulders, and what is done about it", columns, run_suite};
