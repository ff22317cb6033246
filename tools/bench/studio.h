// studio.h - a haircut on its head before a plain background, drawn as often as is wanted: only hair makes one picture
// differ from another. What is drawn beside it has no light, so that no noise of shadows gets in.
#ifndef HAIR_TOOLS_BENCH_STUDIO_H
#define HAIR_TOOLS_BENCH_STUDIO_H

#include "tools/bench/bench.h"
#include "tools/bench/timer.h"
#include "tools/common/rig.h"
#include "tools/common/shadow_map.h"
#include "tools/common/targets.h"

#define STUDIO_FPS 60

struct bench_rectangle {
    int lower[2], upper[2]; // pixels, without the upper ones
};

// How a picture is taken.
struct bench_shot {
    hair_look look;
    hair_view view; // its path and primitive; matrices, lights and level of detail are set elsewhere
    bool unmapped; // its light has no shadow map
    bool map_apart; // else it is drawn by the path of the view,
    hair_path map_path; // not by this one
    bool map_fits; // it is as coarse as strands are wide, and of lines, which are a texel wide
    bool has_lod; // else all is drawn
    hair_lod lod;
    uint32_t samples; // of a pixel, as OpenGL has them
    uint32_t supersample; // pixels for one of the picture, in each direction
    float jitter[2]; // pixels by which the picture moves
    float shadow_jitter[2]; // texels by which its shadow map does
    float away; // from what the scene's camera looks at, in its distance
};

struct bench_studio {
    struct bench* bench;
    struct hair_scene scene;
    hair_groom* groom;
    hair_groom_info info;
    float fewer; // times: than the scene's followers
    hair_instance* hair;
    uint32_t size; // of a picture, pixels to each side
    float transform[16], reach;
    uint32_t frame;
    bool bare; // the head is not drawn: what no hair is or was before stays as it is,
    bool goes_on; // while pictures are taken as the last one,
    struct bench_rectangle drawn; // which may have hair here
    bool timed; // what is under way is
    bool counts; // and
    uint64_t primitives; // that the last picture has of hair, two to a ribbon's segment
    struct bench_shot shot; // the last that was set
    struct bench_timer timer;
    struct hair_targets targets;
    struct hair_shadow_map map;
    unsigned programs[3], arrays[2], buffers[2], query;
    uint32_t indices;
};

// What differs from the scene; 0: nothing.
struct bench_studio_desc {
    const char* scene; // one that is built in
    uint32_t size, guides, followers, segments;
    hair_solver solver;
    hair_mapping mapping;
    double substep;
};

// Hung for as long as the scene says. False: bench->sentence says why not.
bool bench_studio_make(struct bench* bench, const struct bench_studio_desc* desc, struct bench_studio* out);
void bench_studio_free(struct bench_studio* studio);

struct bench_shot bench_studio_shot(const struct bench_studio* studio); // as the scene has it: one sample

// To the next frame. `ms`, which may be NULL: of the simulation. False: the library refused.
bool bench_studio_step(struct bench_studio* studio, double* ms);

// What is drawn next. False: refused, or OpenGL has no memory for it.
bool bench_studio_set(struct bench_studio* studio, const struct bench_shot* shot);

// All of a picture. `ms`, which may be NULL: of the hair, its shadow map, and what makes pixels of samples.
bool bench_studio_draw(struct bench_studio* studio, double* ms);

// A GPU that has had nothing to do, as while pictures are compared or programs compiled, is slow at first: draw for that long, ms.
bool bench_studio_warm_up(struct bench_studio* studio, double enough);

// The median of some draws.
bool bench_studio_time(struct bench_studio* studio, double enough, struct bench_times* out);

// Add the picture, the lower row first: linear light and how much of the pixel is hair.
bool bench_studio_add(struct bench_studio* studio, double* rgba);

#endif
