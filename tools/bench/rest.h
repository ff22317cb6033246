// rest.h - Speed of hair that should be at rest. Tests use this file too, because it needs only the
// public interface.
#ifndef HAIR_TOOLS_BENCH_REST_H
#define HAIR_TOOLS_BENCH_REST_H

#include <hair/hair.h>

#include <stdbool.h>

struct bench_rest_desc {
    double seconds; // simulated time, s
    double window; // time at the end of `seconds` during which speed is measured, s
    double patience; // maximum time to fall asleep, s
    bool (*stop)(void); // Return true to stop. NULL disables it.
};

struct bench_rest {
    double max_speed; // m/s, of the fastest vertex within the window, 0 if asleep before
    double moving_fraction; // fraction of guides with a vertex faster than BENCH_REST_MOVING
    double seconds_asleep; // time until asleep, s, infinite if it stays awake
    bool finite;
};

#define BENCH_REST_MOVING 0.01 // m/s

// Return the defaults. The last half second of 10 s is measured, and hair has 15 s to fall asleep.
struct bench_rest_desc bench_rest_desc_default(void);

// Simulate the instance with its head and colliders at rest, and measure. Every guide has
// `vertices` vertices. Return false if the library refused or `stop` returned true.
bool bench_measure_rest(hair_instance* hair, uint32_t guides, uint32_t vertices,
                        const struct bench_rest_desc* desc, struct bench_rest* out);

// Return whether the last step skipped the solve because the hair is asleep. Waits for the GPU.
bool bench_is_asleep(hair_instance* hair);

#endif
