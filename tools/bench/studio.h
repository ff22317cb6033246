// studio.h - A haircut on its head in front of a plain background, drawn repeatedly. Pictures
// differ only in the hair. The head is drawn unlit, so that its shadows add no noise.
#ifndef HAIR_TOOLS_BENCH_STUDIO_H
#define HAIR_TOOLS_BENCH_STUDIO_H

#include "tools/bench/bench.h"
#include "tools/bench/timer.h"
#include "tools/common/head_rig.h"
#include "tools/common/shadow_map.h"
#include "tools/common/targets.h"

#define STUDIO_FPS 60

struct bench_rectangle {
    int lower[2], upper[2]; // pixels, upper bounds excluded
};

// Parameters of a picture.
struct bench_shot {
    hair_look look;
    hair_view view; // path and primitive, other members are set elsewhere
    bool unmapped; // disables the light's shadow map
    bool map_apart; // draws the shadow map by map_path instead of the view's path
    hair_render_path map_path; // path of the shadow map if map_apart
    bool map_fits; // makes the shadow map as coarse as strands are wide, with one-texel lines
    bool map_whole; // draws the shadow map in full size, with `lod` as for the picture
    bool has_lod; // enables `lod`
    hair_lod lod;
    uint32_t samples; // OpenGL samples per pixel
    uint32_t supersample; // pixels drawn for one of the picture, in each direction
    float jitter[2]; // shift of the picture in pixels
    float shadow_jitter[2]; // shift of the shadow map in texels
    float away; // distance to the camera's target, as a multiple of the scene's
};

struct bench_studio {
    struct bench* bench;
    struct hair_scene scene;
    hair_groom* groom;
    hair_groom_info info;
    float fewer; // ratio of the scene's number of followers to this one
    hair_instance* hair;
    uint32_t size; // pixels per side of a picture
    float transform[16], reach;
    uint32_t frame;
    bool bare; // disables the head, then pixels without hair keep their content
    bool goes_on; // the shot has not changed since the last picture
    struct bench_rectangle drawn; // bounds of the hair in the last picture
    bool timed; // the current draw is timed
    bool counts; // enables counting of primitives
    uint64_t primitives; // triangles of hair in the last picture, two per ribbon segment
    struct bench_shot shot; // last shot that was set
    struct bench_timer timer;
    struct hair_targets targets;
    struct hair_shadow_map map;
    unsigned programs[3], arrays[2], buffers[2], query;
    uint32_t indices;
};

// Changes to a scene. 0 keeps the scene's value.
struct bench_studio_desc {
    const char* scene; // name of a built-in scene
    uint32_t size, guides, followers, segments;
    hair_solver solver;
    hair_thread_mapping mapping;
    double substep;
};

// Create the studio and simulate the scene's settling time. Return false after writing the reason
// to bench->sentence.
bool bench_studio_make(struct bench* bench, const struct bench_studio_desc* desc, struct bench_studio* out);
void bench_studio_free(struct bench_studio* studio);

// Return the scene's shot with one sample.
struct bench_shot bench_studio_shot(const struct bench_studio* studio);

// Simulate the next frame. `ms` receives the time of the simulation and may be NULL. Return false
// if the library refused.
bool bench_studio_step(struct bench_studio* studio, double* ms);

// Set the shot of the next draw. Return false if the library refused or OpenGL has no memory.
bool bench_studio_set(struct bench_studio* studio, const struct bench_shot* shot);

// Draw a whole picture. `ms` receives the time of the hair, its shadow map and the resolve of
// samples, and may be NULL.
bool bench_studio_draw(struct bench_studio* studio, double* ms);

// Draw for `enough` ms. A GPU that was idle, for example while programs were compiled, is slow at
// first.
bool bench_studio_warm_up(struct bench_studio* studio, double enough);

// Measure several draws.
bool bench_studio_time(struct bench_studio* studio, double enough, struct bench_times* out);

// Add the picture to `rgba`, bottom row first, as linear light and the fraction of the pixel that
// hair covers.
bool bench_studio_add(struct bench_studio* studio, double* rgba);

#endif
