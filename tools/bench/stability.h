// stability.h - what the files of the suite `stability` share: hair under watch.
#ifndef HAIR_TOOLS_BENCH_STABILITY_H
#define HAIR_TOOLS_BENCH_STABILITY_H

#include "tools/bench/living.h"
#include "tools/bench/rest.h"

#define BENCH_MOST_STRETCH 0.02 // Under any stress, of the solvers of rods.
#define BENCH_MOST_SOLIDS 128

struct bench_watch {
    struct bench_living* living;
    hair_physics calm; // of the time after the stress; the scene's own to begin with
    struct hair_reference_rod_pose head;
    hair_solid solids[BENCH_MOST_SOLIDS];
    uint32_t solid_count;
    bool had_solids;
    double spared; // s from now: depth in solids does not count yet

    bool finite;
    double stretch, speed, penetration; // greatest so far
    double time; // s stepped
    double before[3 * BENCH_MOST_VERTICES];
};

// Watches from now on. False: the library refused.
bool bench_watch(struct bench_living* living, struct bench_watch* out);

// A step of `dt` with the head at watch->head and the solids of watch at its end. False: the library refused.
bool bench_watch_step(struct bench_watch* watch, double dt);

void bench_fuzz(struct bench* bench); // stability_fuzz.c

// Hair that should come to rest: stability_rest.c, stability_curl.c, stability_contact.c.
void bench_rest_haircuts(struct bench* bench);
void bench_rest_curls(struct bench* bench);
void bench_rest_contacts(struct bench* bench);

// Set how fast the hair moved and whether it fell asleep, and judge both.
void bench_set_rest(json_t* row, hair_solver solver, const struct bench_rest* rest);
// Set what hair_get_health tells.
void bench_set_health(json_t* row, const hair_health* health);
// Return the fastest vertex that counts as rest, m/s.
double bench_rest_limit(hair_solver solver);
// Return whether hair of this solver must fall asleep.
bool bench_rest_must_sleep(hair_solver solver);

struct bench_stress {
    const char* name;
    void (*prepare)(struct bench_scene* scene); // NULL: as it is
    bool (*run)(struct bench_watch* watch); // the stress
    bool rods; // redblack has nothing that it could be put on
};
extern const struct bench_stress bench_stresses[]; // stability_stresses.c; ends with a name of NULL

json_t* bench_stability_row(struct bench_living* living, const char* name, const struct bench_watch* watch);

#endif
