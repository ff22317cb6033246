// ribbons_vs_lines.c - Lines one pixel wide against ribbons of the correct width, at equal run
// time.
#include "tools/bench/ribbons_vs_lines.h"

#include <math.h>
#include <stdlib.h>

// Other load changes the times of rows that are measured minutes apart by about a quarter. It
// changes two alternating measurements equally.
#define CLOSE 0.3 // relative difference to the time of lines that counts as close
#define MAX_ROUNDS 15 // odd, so that one of the two wins
#define DECISIVE 5 // lead in rounds that decides
#define CLEAR 0.1 // relative difference that makes a round clear
#define CLEARLY 3 // weight of a clear round
#define WARM 50 // ms
#define SURE 1.05 // factor of the time of slower ribbons, beyond which others are skipped

bool bench_comparison_add(struct bench_comparison* comparison, const struct bench_contender* contender)
{
    if (comparison->count == comparison->room) {
        size_t room = comparison->room ? 2 * comparison->room : 64;
        struct bench_contender* of = realloc(comparison->of, room * sizeof *of);
        if (!of) return false;
        comparison->of = of;
        comparison->room = room;
    }
    comparison->of[comparison->count++] = *contender;
    return true;
}

void bench_comparison_free(struct bench_comparison* comparison)
{
    free(comparison->of);
    *comparison = (struct bench_comparison){0};
}

static bool is_of_lines(const struct bench_contender* contender)
{
    return contender->shot.view.primitive == HAIR_PRIMITIVE_LINES;
}

// Draw once. The alternation and the number of rounds make the comparison reliable.
static bool take(struct bench_studio* studio, const struct bench_contender* contender, double* ms)
{
    return bench_studio_set(studio, &contender->shot) && bench_studio_warm_up(studio, WARM) &&
           bench_studio_draw(studio, ms);
}

// Find out whether `one` is slower than `other` in most of the alternating rounds.
static bool takes_longer(struct bench_studio* studio, const struct bench_contender* one,
                         const struct bench_contender* other, bool* longer)
{
    int lead = 0;
    for (int i = 0; i < MAX_ROUNDS && abs(lead) < DECISIVE; ++i) {
        double first, second;
        if (!take(studio, one, &first) || !take(studio, other, &second)) return false;
        int counts = fabs(first / second - 1) > CLEAR ? CLEARLY : 1;
        lead += first > second ? counts : -counts;
    }
    *longer = lead > 0;
    return true;
}

static int by_error(const void* a, const void* b)
{
    const struct bench_contender *x = a, *y = b;
    return (x->flip > y->flip) - (x->flip < y->flip);
}

// Compare lines with the ribbons that take no longer. Contenders are sorted by error, therefore the
// first such ribbons are the best.
static bool settle(struct bench_comparison* comparison, struct bench_studio* studio,
                   const struct bench_contender* lines)
{
    double too_long = INFINITY;
    for (size_t i = 0; i < comparison->count; ++i) {
        const struct bench_contender* ribbons = &comparison->of[i];
        bool longer = ribbons->ms > lines->ms;
        if (is_of_lines(ribbons) || ribbons->ms > too_long) continue;
        if (fabs(ribbons->ms / lines->ms - 1) < CLOSE && !takes_longer(studio, ribbons, lines, &longer))
            return false;
        if (longer) {
            too_long = fmin(too_long, SURE * ribbons->ms);
            continue;
        }
        bench_set_number(lines->row, "to_ribbons", lines->flip / ribbons->flip);
        return true;
    }
    return true;
}

bool bench_comparison_finish(struct bench_comparison* comparison, struct bench_studio* studio)
{
    bool ok = true;
    if (comparison->count) qsort(comparison->of, comparison->count, sizeof *comparison->of, by_error);
    for (size_t i = 0; i < comparison->count && ok; ++i)
        if (is_of_lines(&comparison->of[i])) ok = settle(comparison, studio, &comparison->of[i]);
    return ok;
}
