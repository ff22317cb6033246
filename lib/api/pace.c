// pace.c - small hair that is stepped in some frames only, and follows the head in the others.
#include "lib/api/api.h"

#include <math.h>

#define MAX_INTERVAL 4 // Maximum number of frames from one step to the next.
#define LAG 1.2f // Relative size that hair must exceed before a shorter interval is restored.

uint32_t hair_find_interval(float limit, float pixels)
{
    return (uint32_t)fminf(1 + floorf(limit / fmaxf(pixels, 1)), MAX_INTERVAL);
}

void hair_pace_note(hair_instance* hair, const hair_lod* lod, float pixels)
{
    struct hair_pace* pace = &hair->pace;
    uint32_t wanted = lod ? hair_find_interval(lod->motion_pixels, pixels) : 1, now = hair->sim.interval;
    if (lod && wanted < now) {
        uint32_t lagging = hair_find_interval(LAG * lod->motion_pixels, pixels);
        wanted = lagging < now ? lagging : now;
    }
    if (!pace->wanted || wanted < pace->wanted) pace->wanted = wanted;
}

bool hair_pace_wait(hair_instance* hair, double time)
{
    struct hair_pace* pace = &hair->pace;
    // Without its own step, hair can only follow the head.
    bool may_wait = hair_sim_has_attached_strands(&hair->sim) && !hair_impulses_are_on(&hair->sim);
    uint32_t interval = !may_wait ? 1 : pace->wanted ? pace->wanted : hair->sim.interval;
    pace->wanted = 0;
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
