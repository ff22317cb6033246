// bust.h - long hair on a head and shoulders in motion: what the suite `collision` looks at.
#ifndef HAIR_TOOLS_BENCH_BUST_H
#define HAIR_TOOLS_BENCH_BUST_H

#include "tools/bench/bench.h"
#include "tools/common/rig.h"

#define BUST_FPS 240

struct bench_bust {
    struct bench* bench;
    struct hair_scene scene;
    hair_groom* groom;
    hair_instance* hair;
    hair_look look;
    hair_solid solids[HAIR_RIG_SOLIDS]; // where they are
    uint32_t solid_count;
    uint32_t followers, guides, smooth; // smooth: vertices of a smoothed guide
    uint32_t frame;
    bool turn; // of what is changed so that it is looked at again
    unsigned target[2]; // a framebuffer and its colour
};

// Hung for half a second. Followers and their segments, 0: as the scene has them. False: bench->sentence says why not.
bool bench_bust_make(struct bench* bench, uint32_t followers, uint32_t segments, hair_first_hit first_hit,
                     struct bench_bust* out);
void bench_bust_free(struct bench_bust* bust);
bool bench_bust_step(struct bench_bust* bust); // to the next frame

// Vertices of all followers, look.segments + 1 each, and of guides at as many places.
bool bench_bust_read(struct bench_bust* bust, hair_collision collision, float* followers);
bool bench_bust_read_guides(struct bench_bust* bust, float* guides);

// Of finding hits, and leading followers round solids if that is asked for: ms, the median of some runs.
bool bench_bust_time(struct bench_bust* bust, hair_collision collision, double* ms, uint32_t* runs);

// world.c: rows of a Bullet world among whose many objects the hair is.
void bench_measure_world(struct bench* bench);

// From the nearest solid to a point, m, below 0 inside.
double bench_bust_distance(const struct bench_bust* bust, const float at[3]);

#endif
