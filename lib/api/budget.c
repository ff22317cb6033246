// budget.c - the control loop of the frame budget.
//
// One number is controlled, the importance of all hair. Levels of detail follow from it by the size
// of each head on the screen, and so do substep rates. Far heads lose detail first. The number
// stays as it is while the GPU time is between SPARE and 1 of the budget.
#include "lib/api/budget.h"

#include "lib/sim/sim.h"

#include <math.h>

#define MIN_IMPORTANCE 0.05f
#define SPARE 0.8 // Fraction of the budget below which the importance may grow.
#define AIM 0.93 // Fraction of the budget that a decision aims at.
#define CALM_FRAMES 8 // Frames in sequence below SPARE before the importance grows.
#define MIN_FACTOR 0.1 // Minimum factor of the importance by one decision.
#define MAX_FACTOR 1.5 // Maximum factor of the importance by one decision.
#define FALL 1.4f // Maximum factor by which the importance falls in a frame.
#define RISE 1.1f // Maximum factor by which the importance grows in a frame.
#define MIN_ELASTICITY 0.25
#define SMALL_PIXELS 64.0f // Diameter of hair that has the full substep rate at an importance of 1.
#define MIN_PIXELS 4.0f // Diameter that unseen hair is taken for.
#define RATE_CHANGES 2 // Instances that may change in a frame, because their rods are made again.
// Importances below which one half and one quarter of the samples are computed.
#define HALF_SAMPLES 0.35f
#define QUARTER_SAMPLES 0.12f
#define HYSTERESIS 1.3f

void hair_budget_start(struct hair_budget* budget, float ms)
{
    HAIR_ASSERT(ms >= 0);
    bool was_enabled = budget->ms > 0;
    budget->ms = ms;
    budget->measured_count = budget->calm = 0;
    budget->last_ms = 0;
    budget->settled = budget->timer.number;
    budget->elasticity = 1;
    if (was_enabled && ms > 0) return;
    budget->importance = budget->target = budget->max_importance = HAIR_BUDGET_MAX_IMPORTANCE;
    budget->wanted = 1;
    budget->sample_divisor = 1;
    budget->frame_ms = 0;
}

// Let the importance of hair that gives up nothing follow what new hair needs.
static void clamp_importance(struct hair_budget* budget)
{
    bool is_full = budget->target >= budget->max_importance && budget->target == budget->importance;
    budget->max_importance = budget->wanted;
    budget->wanted = 1;
    if (is_full || budget->importance > budget->max_importance) budget->importance = budget->max_importance;
    if (is_full || budget->target > budget->max_importance) budget->target = budget->max_importance;
}

static uint32_t find_divisor(float importance)
{
    return importance < QUARTER_SAMPLES ? 4 : importance < HALF_SAMPLES ? 2 : 1;
}

static void choose_samples(struct hair_budget* budget)
{
    uint32_t divisor = find_divisor(budget->importance);
    // Samples return only where some importance is to spare.
    if (divisor < budget->sample_divisor) divisor = find_divisor(budget->importance / HYSTERESIS);
    budget->sample_divisor = divisor;
}

void hair_budget_next_frame(struct hair_budget* budget)
{
    HAIR_ASSERT(budget->ms > 0);
    hair_gl_frame_timer_next(&budget->timer);
    if (budget->has_drawn) clamp_importance(budget);
    float before = budget->importance;
    budget->importance = fminf(fmaxf(budget->target, before / FALL), before * RISE);
    choose_samples(budget);
    if (budget->importance != before) {
        budget->settled = budget->timer.number;
        budget->measured_count = 0;
    }
    budget->has_drawn = false;
    budget->is_new = true;
    budget->rate_changes = 0;
}

// Return the second greatest time. One frame may be slow, but substeps may be due in every other.
static double find_time(const double ms[HAIR_BUDGET_MEASURED])
{
    double greatest = 0, second = 0;
    for (int i = 0; i < HAIR_BUDGET_MEASURED; ++i) {
        second = fmax(second, fmin(greatest, ms[i]));
        greatest = fmax(greatest, ms[i]);
    }
    return second;
}

// Estimate how the time depends on the importance, from the last two decisions.
static void learn(struct hair_budget* budget, double ms)
{
    double importance = (double)budget->importance;
    if (budget->last_ms > 0 && fabs(log(importance / budget->last_importance)) > 0.1) {
        double slope = log(ms / budget->last_ms) / log(importance / budget->last_importance);
        budget->elasticity = fmin(fmax(slope, MIN_ELASTICITY), 1);
    }
    budget->last_ms = ms;
    budget->last_importance = importance;
}

// Choose the importance for the time of the last frames.
static void decide(struct hair_budget* budget, double ms)
{
    double limit = (double)budget->ms;
    budget->calm = ms < SPARE * limit ? budget->calm + 1 : 0;
    bool may_rise = budget->calm >= CALM_FRAMES && budget->importance < budget->max_importance;
    if (!(ms > limit || may_rise) || budget->target != budget->importance) return;
    learn(budget, ms);
    double factor = pow(AIM * limit / ms, 1 / budget->elasticity);
    factor = fmin(fmax(factor, MIN_FACTOR), MAX_FACTOR);
    budget->target = fminf(fmaxf(budget->importance * (float)factor, MIN_IMPORTANCE), budget->max_importance);
    budget->calm = 0;
}

void hair_budget_update(struct hair_gl* gl, struct hair_budget* budget)
{
    uint32_t number;
    double ms;
    if (!budget->ms || !budget->is_new) return;
    budget->is_new = false;
    while (hair_gl_frame_timer_read(gl, &budget->timer, &number, &ms)) {
        budget->frame_ms = ms;
        if (number < budget->settled || ms <= 0) continue;
        budget->measured[budget->measured_count++ % HAIR_BUDGET_MEASURED] = ms;
        if (budget->measured_count >= HAIR_BUDGET_MEASURED) decide(budget, find_time(budget->measured));
    }
}

float hair_budget_find_rate(struct hair_budget* budget, float pixels, float rate)
{
    float importance = budget->importance;
    float wanted = fmaxf(pixels, MIN_PIXELS) * importance / SMALL_PIXELS;
    hair_budget_note(budget, SMALL_PIXELS / fmaxf(pixels, MIN_PIXELS));
    wanted = fminf(fmaxf(wanted, HAIR_MIN_SUBSTEP_RATE), 1);
    float next = wanted <= 0.5f * rate                               ? 0.5f * rate
                 : rate < 1 && wanted >= fminf(HYSTERESIS * rate, 1) ? 2 * rate
                                                                     : rate;
    if (next == rate || budget->rate_changes == RATE_CHANGES) return rate;
    ++budget->rate_changes;
    return next;
}

void hair_budget_note(struct hair_budget* budget, float importance)
{
    budget->wanted = fminf(fmaxf(budget->wanted, importance), HAIR_BUDGET_MAX_IMPORTANCE);
}
