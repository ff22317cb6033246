// rest.h - how fast hair still moves when it should be at rest. Uses only the public interface, so
// tests use it too.
#ifndef HAIR_TOOLS_BENCH_REST_H
#define HAIR_TOOLS_BENCH_REST_H

#include <hair/hair.h>

#include <stdbool.h>

struct bench_rest_desc {
    double seconds; // s before the speed is measured
    double window; // s during which it is measured, the last part of `seconds`
    double patience; // s in all, to fall asleep
    bool (*stop)(void); // Returns true to give up. NULL: never.
};

struct bench_rest {
    double max_speed; // m/s, of the fastest vertex within the window; 0 when asleep by then
    double moving_fraction; // fraction of the guides with a vertex above BENCH_REST_MOVING
    double seconds_asleep; // s until it fell asleep; infinite when it did not
    bool finite;
};

#define BENCH_REST_MOVING 0.01 // m/s

// 10 s of which the last half is measured, 15 s to fall asleep.
struct bench_rest_desc bench_rest_desc_default(void);

// Step the instance, whose head and colliders stay, and measure. Every guide has `vertices`. Return
// false when the library refused or `stop` asked to give up.
bool bench_measure_rest(hair_instance* hair, uint32_t guides, uint32_t vertices,
                        const struct bench_rest_desc* desc, struct bench_rest* out);

// Return whether the solve of the last step was left out because the hair sleeps. Waits for the GPU.
bool bench_is_asleep(hair_instance* hair);

#endif
