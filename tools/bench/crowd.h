// crowd.h - A haircut in motion, with every strand simulated or with strands that are interpolated
// between guides, for the suite `followers`.
#ifndef HAIR_TOOLS_BENCH_CROWD_H
#define HAIR_TOOLS_BENCH_CROWD_H

#include <hair/hair_asset.h>

#include "tools/bench/bench.h"
#include "tools/bench/timer.h"
#include "tools/common/head_rig.h"

#define CROWD_FRAME (1.0 / 60) // s
#define CROWD_FRAMES 60

// A built-in haircut, all of whose strands are given.
struct crowd_style {
    const char* name;
    hair_style style;
    uint32_t segments; // of a strand as simulated and as drawn
};

enum crowd_motion { CROWD_SHAKE, CROWD_CONTACT, CROWD_WIND, CROWD_MOTIONS };
extern const char* const crowd_motion_names[CROWD_MOTIONS];

struct crowd_desc {
    const struct crowd_style* style;
    enum crowd_motion motion;
    uint32_t strands;
    uint32_t guides; // at most the number of strands
    // Strands are grown around guides, whose positions they interpolate, and are not those of the
    // haircut.
    bool grown;
    uint32_t copies; // times that each strand is given, 0 for once
    hair_solver solver;
};

struct crowd {
    struct bench* bench;
    struct crowd_desc desc;
    struct hair_scene scene; // head and shoulders
    hair_groom* groom;
    hair_instance* hair;
    uint32_t strands, guides; // as the groom has them
    uint32_t vertices; // of a strand as drawn
    uint32_t frame;
    float transform[16]; // of the head, groom to world
    uint32_t* place; // follower of each strand
    float* read; // vertices of all followers, in the order of followers
    hair_collider colliders[HAIR_HEAD_RIG_COLLIDERS]; // in world space
    uint32_t collider_count;
};

// Make the haircut at rest. Return false after writing the reason to bench->sentence.
bool bench_crowd_make(struct bench* bench, const struct crowd_desc* desc, struct crowd* out);
void bench_crowd_free(struct crowd* crowd);

// Return to rest.
bool bench_crowd_restart(struct crowd* crowd);
// Advance to the next frame.
bool bench_crowd_step(struct crowd* crowd);
// Compute the vertices of all strands on the GPU, as the cached render path does.
bool bench_crowd_expand(struct crowd* crowd);
// Read the vertices of all strands in the order of strands, xyz each.
bool bench_crowd_read(struct crowd* crowd, float* strands);
// Return the number of strands with a vertex that is deeper than `depth` in a collider.
uint32_t bench_crowd_count_inside(const struct crowd* crowd, const float* strands, double depth);

#endif
