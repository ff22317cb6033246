// versus.c - lines a pixel wide against what is as wide as it should be, at equal run time.
#include "tools/bench/versus.h"

#include <math.h>
#include <stdlib.h>

// What a machine does beside moves times of rows, taken minutes apart, by a quarter; of two taken in turn it moves both.
#define CLOSE 0.3 // of the time of lines
#define MOST_ROUNDS 15 // odd: one of two has won more of them
#define DECISIVE 5 // rounds by which one leads
#define CLEAR 0.1 // A round in which they are farther apart
#define CLEARLY 3 // counts as so many.
#define WARM 50 // ms
#define SURE 1.05 // times the time of what was the slower one in turn

bool bench_versus_add(struct bench_versus* versus, const struct bench_contender* contender)
{
    if (versus->count == versus->room) {
        size_t room = versus->room ? 2 * versus->room : 64;
        struct bench_contender* of = realloc(versus->of, room * sizeof *of);
        if (!of) return false;
        versus->of = of;
        versus->room = room;
    }
    versus->of[versus->count++] = *contender;
    return true;
}

void bench_versus_free(struct bench_versus* versus)
{
    free(versus->of);
    *versus = (struct bench_versus){0};
}

static bool is_of_lines(const struct bench_contender* contender)
{
    return contender->shot.view.primitive == HAIR_LINES;
}

// Once: it is what is taken beside it, and how often, that makes it sure.
static bool take(struct bench_studio* studio, const struct bench_contender* contender, double* ms)
{
    return bench_studio_set(studio, &contender->shot) && bench_studio_warm_up(studio, WARM) &&
           bench_studio_draw(studio, ms);
}

// Which is the slower of two that are taken in turn, more often than not.
static bool takes_longer(struct bench_studio* studio, const struct bench_contender* one,
                         const struct bench_contender* other, bool* longer)
{
    int lead = 0;
    for (int i = 0; i < MOST_ROUNDS && abs(lead) < DECISIVE; ++i) {
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

// Those of least error come first, so the first that takes no longer is the best.
static bool settle(struct bench_versus* versus, struct bench_studio* studio,
                   const struct bench_contender* lines)
{
    double too_long = INFINITY;
    for (size_t i = 0; i < versus->count; ++i) {
        const struct bench_contender* ribbons = &versus->of[i];
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

bool bench_versus_settle(struct bench_versus* versus, struct bench_studio* studio)
{
    bool ok = true;
    if (versus->count) qsort(versus->of, versus->count, sizeof *versus->of, by_error);
    for (size_t i = 0; i < versus->count && ok; ++i)
        if (is_of_lines(&versus->of[i])) ok = settle(versus, studio, &versus->of[i]);
    return ok;
}
