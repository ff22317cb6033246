// pace.c - small hair that is stepped in some frames only, and follows the head in the others, or
// that simulates some of its guides only.
#include "lib/api/api.h"

#include <math.h>

#define MAX_INTERVAL 4 // Maximum number of frames from one step to the next.
// Relative size that hair must exceed before a shorter interval or stride is restored.
#define LAG 1.2f

// Return for how many frames hair of a size in pixels keeps what is kept for two frames up to the
// size `limit`.
static uint32_t find_interval(float limit, float pixels)
{
    return (uint32_t)fminf(1 + floorf(limit / fmaxf(pixels, 1)), MAX_INTERVAL);
}

// Return the stride of simulated guides for hair of a size.
static uint32_t find_stride(float limit, float pixels)
{
    uint32_t stride = 1;
    while (stride < HAIR_MAX_GUIDE_STRIDE && limit >= (float)stride * fmaxf(pixels, 1)) stride *= 2;
    return stride;
}

// Return what a function finds for a size, or what was used last while hair is hardly larger.
static uint32_t choose(uint32_t (*find)(float limit, float pixels), float limit, float pixels, uint32_t last)
{
    uint32_t wanted = find(limit, pixels);
    if (wanted >= last) return wanted;
    uint32_t lagging = find(LAG * limit, pixels);
    return lagging < last ? lagging : last;
}

// Note the size of hair in a view in colour. NULL `lod` wants a step in every frame.
static void note_pace(hair_instance* hair, const hair_lod* lod, float pixels)
{
    struct hair_pace* pace = &hair->pace;
    uint32_t interval = 1, stride = 1;
    if (lod) {
        interval = choose(find_interval, lod->motion_pixels, pixels, hair->sim.interval);
        stride = choose(find_stride, lod->guide_pixels, pixels, hair->sim.guide_level.wanted);
    }
    if (!pace->wanted_interval || interval < pace->wanted_interval) pace->wanted_interval = interval;
    if (!pace->wanted_stride || stride < pace->wanted_stride) pace->wanted_stride = stride;
}

bool hair_pace_wait(hair_instance* hair, double time)
{
    struct hair_pace* pace = &hair->pace;
    // Without its own step, hair can only follow the head.
    bool may_wait = hair_sim_has_attached_strands(&hair->sim) && !hair_impulses_are_on(&hair->sim);
    uint32_t wanted = pace->wanted_interval ? pace->wanted_interval : hair->sim.interval;
    uint32_t interval = may_wait ? wanted : 1;
    if (pace->wanted_stride) hair_sim_set_guide_stride(&hair->sim, pace->wanted_stride);
    pace->wanted_interval = pace->wanted_stride = 0;
    hair_sim_set_interval(&hair->sim, interval);
    uint32_t frame = hair->profiler.number + 1;
    bool is_due = (frame + hair->renderer.light_age.turn) % interval == 0;
    if (is_due || pace->pending + time > hair->max_dt) return false;
    pace->pending += time;
    pace->head = hair->sim.head;
    hair_begin_frame(hair);
    return true;
}

const struct hair_pose* hair_shown_head(const hair_instance* hair)
{
    return hair->pace.pending > 0 ? &hair->pace.head : &hair->sim.head_at_last_step;
}

// Let the light of small hair be kept, and let it be stepped in some frames only. `scale` is in
// pixels per metre.
static void note_intervals(hair_instance* hair, const hair_lod* lod, float scale)
{
    const hair_vec3 size = hair->renderer.rest_size;
    float pixels = scale * fmaxf(size.x, fmaxf(size.y, size.z));
    float light_pixels = fmaxf(lod->light_pixels, pixels * (1 / hair->sim.rate_factor - 1));
    hair->renderer.light_age.interval = find_interval(light_pixels, pixels);
    hair->renderer.light_age.pace = hair->sim.interval;
    note_pace(hair, lod, pixels);
}

void hair_pace_note_size(hair_instance* hair, const struct hair_view_copy* copy)
{
    const hair_view* view = &copy->view;
    struct hair_budget* budget = &hair->context->budget;
    hair->renderer.sample_divisor = budget->ms > 0 ? budget->sample_divisor : 1;
    bool is_main = view->pass == HAIR_PASS_COLOR || view->pass == HAIR_PASS_MOTION;
    if (is_main && !view->lod) note_pace(hair, NULL, 0);
    if (!budget->ms && !view->lod) return;
    budget->has_drawn |= budget->ms > 0;
    if (!is_main) return;
    const struct hair_pose* head = hair_shown_head(hair);
    float scale = hair_draw_pixels_per_metre(&hair->renderer, head, view);
    if (view->lod) note_intervals(hair, view->lod, scale);
    if (!budget->ms) return;
    hair->budget.pixels = fmaxf(hair->budget.pixels, 2 * hair->renderer.reach.w * scale);
    if (!copy->has_lod) hair_budget_note(budget, hair_draw_full_importance(&hair->renderer, scale));
}
