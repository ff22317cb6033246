// followers.c - Suite `followers`, the error of strands that are interpolated between guides. The
// same haircut with every strand simulated is the truth.
#include "tools/bench/crowd_space.h"

#include <math.h>
#include <stdlib.h>

#define DEEP 1e-3 // depth from which on a strand counts as inside a collider, m
#define COPIES 16 // copies of each strand whose vertices are timed on a GPU
#define BEYOND 5e-3 // distance from which on a strand counts as beyond the middle of the head, m

static const char* const columns[] = {"case",
                                      "method",
                                      "strands",
                                      "guides",
                                      "guide_fraction",
                                      "vertices",
                                      "length",
                                      "rms_error",
                                      "rms_mm",
                                      "max_error",
                                      "rest_error",
                                      "motion",
                                      "length_error",
                                      "inside",
                                      "inside_truth",
                                      "crossed",
                                      "crossed_truth",
                                      "volume",
                                      "volume_truth",
                                      "ms",
                                      "ms_step",
                                      "ms_followers",
                                      "ms_many",
                                      "ms_many_linear",
                                      "runs",
                                      "front",
                                      NULL};

static const struct crowd_style styles[] = {
    {"straight", HAIR_STYLE_BOB, 32},
    {"wavy", HAIR_STYLE_LONG, 32},
    {"curly", HAIR_STYLE_CURLY, 64},
    {"coily", HAIR_STYLE_AFRO, 64},
};
#define STYLES (sizeof styles / sizeof *styles)

// Denominators of the fraction of the strands that are guides.
static const uint32_t fractions[] = {400, 100, 30, 10, 1};
#define MANY 100 // fraction for which many strands are timed, in a shake
#define FRACTIONS (sizeof fractions / sizeof *fractions)

// Every strand simulated, frame after frame. The first frame is at rest.
struct truth {
    float* strands;
    double* length; // of each strand at rest, m
    double mean_length;
    double motion; // rms distance of the strands from hair that is rigid, over the length
    uint32_t inside; // strands inside colliders, over all frames
    uint32_t crossed; // strands beyond the middle of the head, over all frames
    double rest_volume; // m^3
    double volume; // sum over all frames, m^3
};

struct error {
    double squares, squares_mm, max, rest, longer;
    uint64_t vertices;
    uint32_t inside, crossed;
    double volume; // sum over all frames, m^3
};

static double distance(const float* a, const float* b)
{
    double x = (double)a[0] - (double)b[0], y = (double)a[1] - (double)b[1], z = (double)a[2] - (double)b[2];
    return sqrt(x * x + y * y + z * z);
}

static double length_of(const float* strand, uint32_t vertices)
{
    double sum = 0;
    for (uint32_t k = 1; k < vertices; ++k) sum += distance(strand + 3 * k, strand + 3 * k - 3);
    return sum;
}

static uint32_t count_strands(const struct bench* bench)
{
    if (bench->options.strands) return bench->options.strands < 4096 ? bench->options.strands : 4096;
    return bench->options.quick ? 400 : bench->software ? 1200 : 4096;
}

static void free_truth(struct truth* truth)
{
    free(truth->strands);
    free(truth->length);
    *truth = (struct truth){0};
}

// Return the sum of squares of the distances from hair that moves with the head rigidly, over the
// lengths.
static double compare_to_rigid(const struct crowd* crowd, const struct truth* truth, const float* strands)
{
    double squares = 0;
    const float* m = crowd->transform;
    for (size_t i = 0; i < (size_t)crowd->strands * crowd->vertices; ++i) {
        const float* rest = truth->strands + 3 * i;
        float rigid[3];
        for (int k = 0; k < 3; ++k)
            rigid[k] = m[k] * rest[0] + m[4 + k] * rest[1] + m[8 + k] * rest[2] + m[12 + k];
        squares += pow(distance(rigid, strands + 3 * i) / truth->length[i / crowd->vertices], 2);
    }
    return squares;
}

// Simulate every strand with the most accurate solver.
static bool find_truth(struct bench* bench, const struct crowd_desc* scene, struct truth* out)
{
    struct crowd crowd;
    struct crowd_desc desc = *scene;
    desc.solver = HAIR_SOLVER_ACCURATE;
    desc.guides = desc.strands;
    if (!bench_crowd_make(bench, &desc, &crowd)) return false;
    size_t each = 3 * (size_t)crowd.vertices, size = each * crowd.strands;
    out->strands = malloc((CROWD_FRAMES + 1) * size * sizeof *out->strands);
    out->length = calloc(crowd.strands, sizeof *out->length);
    bool whole = out->strands && out->length && bench_crowd_read(&crowd, out->strands);
    for (uint32_t i = 0; i < crowd.strands && whole; ++i)
        out->mean_length += (out->length[i] = length_of(out->strands + each * i, crowd.vertices));
    out->mean_length /= crowd.strands;
    if (whole) out->rest_volume = bench_crowd_measure_volume(&crowd, out->strands);
    for (uint32_t k = 1; k <= CROWD_FRAMES && whole; ++k) {
        float* strands = out->strands + size * k;
        whole = !bench_was_interrupted() && bench_crowd_step(&crowd) && bench_crowd_read(&crowd, strands);
        if (!whole) break;
        out->inside += bench_crowd_count_inside(&crowd, strands, DEEP);
        out->crossed += bench_crowd_count_crossed(&crowd, strands, BEYOND);
        out->volume += bench_crowd_measure_volume(&crowd, strands);
        out->motion += compare_to_rigid(&crowd, out, strands);
    }
    out->motion = sqrt(out->motion / ((double)CROWD_FRAMES * crowd.strands * crowd.vertices));
    bench_crowd_free(&crowd);
    if (!whole) free_truth(out);
    return whole;
}

// Add the errors of one frame. Return their sum of squares over the lengths.
static double compare_frame(const struct crowd* crowd, const struct truth* truth, const float* strands,
                            const float* right, struct error* out)
{
    double squares = 0;
    size_t each = 3 * (size_t)crowd->vertices;
    for (uint32_t i = 0; i < crowd->strands; ++i) {
        const float *strand = strands + each * i, *own = right + each * i;
        for (uint32_t k = 0; k < crowd->vertices; ++k) {
            double away = distance(strand + 3 * k, own + 3 * k), fraction = away / truth->length[i];
            squares += fraction * fraction;
            out->squares_mm += 1e6 * away * away;
            if (!(fraction <= out->max)) out->max = fraction;
        }
        double longer = fabs(length_of(strand, crowd->vertices) / length_of(own, crowd->vertices) - 1);
        if (!(longer <= out->longer)) out->longer = longer;
    }
    out->squares += squares;
    out->vertices += (uint64_t)crowd->strands * crowd->vertices;
    return squares;
}

static bool find_error(struct crowd* crowd, const struct truth* truth, struct error* out)
{
    size_t size = 3 * (size_t)crowd->vertices * crowd->strands;
    float* strands = malloc(size * sizeof *strands);
    bool whole = strands && bench_crowd_read(crowd, strands);
    struct error rest = {0};
    *out = (struct error){0};
    if (whole)
        out->rest = sqrt(compare_frame(crowd, truth, strands, truth->strands, &rest) / (double)rest.vertices);
    for (uint32_t k = 1; k <= CROWD_FRAMES && whole; ++k) {
        whole = !bench_was_interrupted() && bench_crowd_step(crowd) && bench_crowd_read(crowd, strands);
        if (!whole) break;
        compare_frame(crowd, truth, strands, truth->strands + size * k, out);
        out->inside += bench_crowd_count_inside(crowd, strands, DEEP);
        out->crossed += bench_crowd_count_crossed(crowd, strands, BEYOND);
        out->volume += bench_crowd_measure_volume(crowd, strands);
    }
    free(strands);
    return whole;
}

struct cost {
    struct bench_times step, followers, all;
};

// Times of the vertices of many strands, ms: of their own shape, and of strands that interpolate
// the positions of guides.
struct many_cost {
    double own, linear;
};

// Measure the time of a frame: of simulating the guides, and of computing the vertices of all
// strands.
static bool find_cost(struct crowd* crowd, struct cost* out)
{
    double step[CROWD_FRAMES], followers[CROWD_FRAMES], all[CROWD_FRAMES];
    struct bench_timer timer;
    bool whole = bench_crowd_restart(crowd);
    bench_timer_make(&timer, crowd->bench->software);
    for (uint32_t k = 0; k < CROWD_FRAMES && whole; ++k) {
        bench_timer_start(&timer);
        whole = bench_crowd_step(crowd);
        bench_timer_stop(&timer);
        step[k] = bench_timer_take(&timer);
        bench_timer_start(&timer);
        whole = whole && bench_crowd_expand(crowd) && !bench_was_interrupted();
        bench_timer_stop(&timer);
        followers[k] = bench_timer_take(&timer);
        all[k] = step[k] + followers[k];
    }
    bench_timer_free(&timer);
    if (!whole) return false;
    out->step = bench_times_of(step, CROWD_FRAMES);
    out->followers = bench_times_of(followers, CROWD_FRAMES);
    out->all = bench_times_of(all, CROWD_FRAMES);
    return true;
}

// Measure the times of the vertices of many strands.
static bool find_many_cost(struct bench* bench, const struct crowd_desc* desc, struct many_cost* out)
{
    struct crowd_desc many = *desc;
    many.copies = bench->software ? 1 : COPIES;
    for (int grown = 0; grown < 2; ++grown) {
        struct crowd crowd;
        struct cost cost;
        many.grown = grown;
        if (!bench_crowd_make(bench, &many, &crowd)) return false;
        bool whole = find_cost(&crowd, &cost);
        bench_crowd_free(&crowd);
        if (!whole) return false;
        *(grown ? &out->linear : &out->own) = cost.followers.ms;
    }
    return true;
}

static void add_row(const char* name, const char* method, const struct crowd* crowd,
                    const struct truth* truth, const struct error* error, const struct cost* cost,
                    const struct many_cost* many)
{
    json_t* row = bench_rows_add(&crowd->bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", method);
    bench_set_count(row, "strands", crowd->strands);
    bench_set_count(row, "guides", crowd->guides);
    bench_set_number(row, "guide_fraction", (double)crowd->guides / crowd->strands);
    bench_set_count(row, "vertices", crowd->vertices);
    bench_set_number(row, "length", truth->mean_length);
    bench_set_number(row, "rms_error", sqrt(error->squares / (double)error->vertices));
    bench_set_number(row, "rms_mm", sqrt(error->squares_mm / (double)error->vertices));
    bench_set_number(row, "max_error", error->max);
    bench_set_number(row, "rest_error", error->rest);
    bench_set_number(row, "motion", truth->motion);
    bench_set_number(row, "length_error", error->longer);
    bench_set_count(row, "inside", error->inside);
    bench_set_count(row, "inside_truth", truth->inside);
    bench_set_count(row, "crossed", error->crossed);
    bench_set_count(row, "crossed_truth", truth->crossed);
    bench_set_number(row, "volume", error->volume / truth->volume);
    bench_set_number(row, "volume_truth", truth->volume / (CROWD_FRAMES * truth->rest_volume));
    bench_set_number(row, "ms", cost->all.ms);
    bench_set_number(row, "ms_step", cost->step.ms);
    bench_set_number(row, "ms_followers", cost->followers.ms);
    if (many->own > 0) {
        bench_set_number(row, "ms_many", many->own);
        bench_set_number(row, "ms_many_linear", many->linear);
    }
    bench_set_count(row, "runs", cost->all.runs);
}

// Measure guides that are `desc->guides` of the strands. The truth is found for the first of them.
static void measure(struct bench* bench, const char* name, const struct crowd_desc* desc, struct truth* truth)
{
    const char* method = desc->guides < desc->strands ? "followers" : "direct";
    struct crowd crowd;
    struct error error;
    struct cost cost;
    struct many_cost many = {0};
    bool is_timed = desc->motion == CROWD_SHAKE && desc->guides == desc->strands / MANY;
    if (!bench_begin(bench, name, method)) return;
    if ((!truth->strands && !find_truth(bench, desc, truth)) || !bench_crowd_make(bench, desc, &crowd)) {
        bench_refuse(bench, name, method);
        return;
    }
    if (find_error(&crowd, truth, &error) && find_cost(&crowd, &cost) &&
        (!is_timed || find_many_cost(bench, desc, &many)))
        add_row(name, method, &crowd, truth, &error, &cost, &many);
    else
        bench_refuse(bench, name, method);
    bench_crowd_free(&crowd);
}

static void measure_scene(struct bench* bench, const struct crowd_style* style, enum crowd_motion motion)
{
    char name[32];
    struct truth truth = {0};
    snprintf(name, sizeof name, "%s %s", crowd_motion_names[motion], style->name);
    for (size_t i = 0; i < FRACTIONS; ++i) {
        uint32_t strands = count_strands(bench), guides = strands / fractions[i];
        struct crowd_desc desc = {.style = style,
                                  .motion = motion,
                                  .strands = strands,
                                  .guides = guides > 1 ? guides : 1,
                                  .solver = HAIR_SOLVER_DIRECT};
        measure(bench, name, &desc, &truth);
    }
    free_truth(&truth);
}

static void run_suite(struct bench* bench)
{
    for (enum crowd_motion motion = 0; motion < CROWD_MOTIONS; ++motion)
        for (size_t i = 0; i < STYLES; ++i)
            if (!bench->options.quick || (motion == CROWD_SHAKE && i < 1))
                measure_scene(bench, &styles[i], motion);
    bench_mark_front(bench->rows.rows, "ms", "rms_error");
}

const struct bench_suite bench_followers = {
    "followers", "strands interpolated between guides against every strand simulated", columns, run_suite};
