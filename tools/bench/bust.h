// bust.h - Long hair on a moving head and shoulders, for the suite `collision`.
#ifndef HAIR_TOOLS_BENCH_BUST_H
#define HAIR_TOOLS_BENCH_BUST_H

#include "tools/bench/bench.h"
#include "tools/common/head_rig.h"

#define BUST_FPS 240

struct bench_bust {
    struct bench* bench;
    struct hair_scene scene;
    hair_groom* groom;
    hair_instance* hair;
    hair_look look;
    hair_collider colliders[HAIR_HEAD_RIG_COLLIDERS]; // in world space
    uint32_t collider_count;
    uint32_t followers, guides, smooth; // `smooth` is the number of vertices of a smoothed guide
    uint32_t frame;
    bool turn; // alternates to change the look
    unsigned target[2]; // framebuffer and its colour buffer
};

// Make the scene and simulate half a second of hanging. 0 followers or segments uses the scene's
// numbers. Return false after writing the reason to bench->sentence.
bool bench_bust_make(struct bench* bench, uint32_t followers, uint32_t segments, hair_hit_method hit_method,
                     struct bench_bust* out);
void bench_bust_free(struct bench_bust* bust);
bool bench_bust_step(struct bench_bust* bust); // Advance to the next frame.

// Read the vertices of all followers, look.segments + 1 each.
bool bench_bust_read(struct bench_bust* bust, hair_follower_collision collision, float* followers);
// Read the guides, interpolated to look.segments + 1 vertices each.
bool bench_bust_read_guides(struct bench_bust* bust, float* guides);

// Measure the time of finding hits and, if requested, of pushing followers out of colliders. `ms`
// is the median over `runs` runs.
bool bench_bust_time(struct bench_bust* bust, hair_follower_collision collision, double* ms, uint32_t* runs);

// Make the rows of a Bullet world with many objects around the hair. Defined in world.c.
void bench_measure_world(struct bench* bench);

// Return the distance from the nearest collider to a point, in m, negative inside.
double bench_bust_distance(const struct bench_bust* bust, const float at[3]);

#endif
