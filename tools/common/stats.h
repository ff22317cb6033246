// stats.h - Statistics of a capture and its timings, as JSON.
#ifndef HAIR_TOOLS_COMMON_STATS_H
#define HAIR_TOOLS_COMMON_STATS_H

#include <stdbool.h>

#include <hair/hair.h>

// Wall time of one part of the work, one value per frame.
struct hair_clock {
    float* ms;
    uint32_t count, room;
};

struct hair_stats {
    const char* name; // name of the scene
    const char* renderer;
    uint32_t width, height, first, end;
    hair_groom_info groom;
    hair_solver_stats solver_stats;
    // `draw` includes the shadow maps, the head and reading the picture.
    struct hair_clock step, draw;
};

// Return the time in ms, from an arbitrary origin.
double hair_now(void);
void hair_clock_add(struct hair_clock* clock, double ms);
bool hair_stats_write(const char* tool, const char* path, const struct hair_stats* stats,
                      hair_context* context, hair_instance* hair);
void hair_stats_free(struct hair_stats* stats);

#endif
