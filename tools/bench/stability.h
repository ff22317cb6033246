// stability.h - Observation of hair under stress, which the files of the suite `stability` share.
#ifndef HAIR_TOOLS_BENCH_STABILITY_H
#define HAIR_TOOLS_BENCH_STABILITY_H

#include "tools/bench/live_scene.h"
#include "tools/bench/rest.h"

#define BENCH_MAX_STRETCH 0.02 // limit under any stress, for rod solvers
#define BENCH_MAX_COLLIDERS 128

struct bench_watch {
    struct bench_live_scene* living;
    hair_physics calm; // physics after the stress, initially the scene's own
    struct hair_reference_rod_pose head;
    hair_collider colliders[BENCH_MAX_COLLIDERS];
    uint32_t collider_count;
    bool had_colliders;
    double spared; // time in s during which depth in colliders is ignored

    bool finite;
    double stretch, speed, penetration; // maxima so far
    double time; // simulated time, s
    double before[3 * BENCH_MAX_VERTICES];
};

// Start observing. Return false if the library refused.
bool bench_watch(struct bench_live_scene* live, struct bench_watch* out);

// Simulate `dt` with the head at watch->head and the colliders of `watch` at its end. Return false
// if the library refused.
bool bench_watch_step(struct bench_watch* watch, double dt);

// Run the random scenes. Defined in stability_fuzz.c.
void bench_fuzz(struct bench* bench);

// Run the haircuts that should come to rest. Defined in stability_rest.c.
void bench_rest_haircuts(struct bench* bench);
// Run the coils that should come to rest. Defined in stability_curl.c.
void bench_rest_curls(struct bench* bench);
// Run the strands that should come to rest on a collider. Defined in stability_contact.c.
void bench_rest_contacts(struct bench* bench);

// Set the speed of the hair and whether it fell asleep, and whether both pass.
void bench_set_rest(json_t* row, hair_solver solver, const struct bench_rest* rest);
// Set the counters of hair_get_solver_stats().
void bench_set_solver_stats(json_t* row, const hair_solver_stats* solver_stats);
// Return the maximum vertex speed that counts as rest, m/s.
double bench_rest_limit(hair_solver solver);
// Return whether hair of this solver must fall asleep.
bool bench_rest_must_sleep(hair_solver solver);

struct bench_stress {
    const char* name;
    void (*prepare)(struct bench_scene* scene); // NULL leaves the scene unchanged
    bool (*run)(struct bench_watch* watch); // applies the stress
    bool rods; // for rod solvers only, redblack lacks the setting
};
// Stresses of stability_stresses.c, terminated by a name of NULL.
extern const struct bench_stress bench_stresses[];

json_t* bench_stability_row(struct bench_live_scene* live, const char* name, const struct bench_watch* watch);

#endif
