// sim.h - guides in motion: fixed substeps, the head carried through them, one dispatch per step.
#ifndef HAIR_SIM_SIM_H
#define HAIR_SIM_SIM_H

#include "lib/base/pose.h"
#include "lib/collide/cells.h"
#include "lib/field/forms.h"
#include "lib/gl/gl.h"
#include "lib/groom/groom.h"
#include "lib/sim/blow.h"
#include "lib/sim/crowd.h"
#include "lib/sim/feedback.h"
#include "lib/sim/health.h"
#include "lib/sim/rod.h"
#include "lib/sim/skin.h"
#include "lib/sim/sleep.h"
#include "lib/sim/ties.h"
#include "lib/wind/air.h"

// What guides collide with where that may be anything: forms, any number of them. All 0 until then.
struct hair_contacts {
    int any; // whether it is so in this step
    struct hair_forms* forms; // of the context
    struct hair_cells cells;
    GLuint solid, solid_texture, cell, cell_texture; // buffers, and the same as shaders read them
    uint32_t* held; // places of forms
    uint32_t holds;
};

struct hair_sim {
    struct hair_gl* gl;
    hair_solver solver;
    hair_physics physics;
    hair_wind wind;
    double asked_substep; // s; 0: as the solver wants
    double substep; // s
    GLuint guide, rest, state, health, step; // buffers, as in shared.h
    GLuint rod, history, material, reduction; // the same; 0 under redblack
    GLuint bend; // Forces and turns of segments. 0 without the mixed scheme.
    uint32_t rounds; // of the reduction, before its last
    struct hair_rods* rods; // under redblack NULL
    int by_thread; // a thread per guide, not a work group
    int in_two; // programs: see main() of glsl/sim/rod.comp
    uint32_t list; // 0 or 1: between them, of the last dispatch
    int struck; // there have been solids: the accurate solver's own substep is for impacts
    double last_substep; // s: of the last substep done, which displacements are over
    double next_substep; // s: of the one under way; 0: not known, as of what was loaded
    uint32_t longer; // substeps, so many times as long as the solver wants them; 0: not yet
    double unseen; // s: since a view last showed any of it
    uint32_t guides, guide_vertices, smooth_vertices;
    uint32_t most_vertices; // of a guide
    uint32_t layout; // hash of how many vertices each guide has
    double left; // s: since the end of the last substep, less than a substep
    struct hair_pose last_before; // the head at the start of the last substep,
    struct hair_pose last_after; // at its end,
    struct hair_pose at_step; // at the last step, and
    struct hair_pose head; // where it is to be at the next
    float reach; // no guide is farther from the head's origin. m
    struct hair_solids solids;
    struct hair_contacts contacts;
    struct hair_crowd crowd;
    struct hair_ties ties;
    struct hair_air air;
    struct hair_skin skin;
    struct hair_sleep sleep;
    struct hair_blow blow;
    struct hair_feedback feedback;
    struct hair_diagnosis diagnosis;
};

uint32_t hair_sim_contacts(const struct hair_sim* sim); // solids that guides collide with
hair_result hair_sim_create(struct hair_sim* sim, struct hair_gl* gl, const struct hair_groom* groom);
void hair_sim_destroy(struct hair_sim* sim);

// Run the substeps that fit into the time since the last one, and leave in the step buffer what smooth.comp reads.
hair_result hair_sim_step(struct hair_sim* sim, double dt);
void hair_sim_pass_time(struct hair_sim* sim, double dt); // as if it had, at rest
void hair_sim_reset(struct hair_sim* sim); // rest pose under sim->head
// sim->head and the hair with it
hair_result hair_sim_teleport(struct hair_sim* sim, const struct hair_pose* to);
void hair_sim_show(struct hair_sim* sim); // what smooth.comp reads, where the last step left the head
void hair_sim_bind(struct hair_sim* sim); // buffers of passes that read the guides

// contacts.c: solids where they may be anything. `find` is for a step of dt that has been done up to a share of it, which
// may be below 0; `write` fills in what it found of the parameters.
int hair_contacts_are_any(const struct hair_sim* sim);
hair_result hair_contacts_find(struct hair_sim* sim, double dt, float share_start);
void hair_contacts_write(const struct hair_sim* sim, struct hair_step_params* params);
void hair_contacts_bind(const struct hair_sim* sim);
void hair_contacts_free(struct hair_sim* sim);

// rods.c: what the solvers of rods need beside the state. `write` fills in their share of the parameters.
hair_result hair_sim_make_rods(struct hair_sim* sim, const struct hair_groom* groom);
hair_result hair_sim_renew_rods(struct hair_sim* sim); // if physics or what ties hold have changed so
const struct hair_guide* hair_sim_guides(const struct hair_sim* sim, const struct hair_rest** rest);
int hair_sim_is_other_rate(const struct hair_sim* sim); // 1: of the physics nothing else has changed
hair_result hair_sim_need_crowd(struct hair_sim* sim); // what physics with cohesion or volume take
void hair_sim_free_rods(struct hair_sim* sim);
void hair_sim_bind_rods(struct hair_sim* sim);
void hair_sim_write_rods(const struct hair_sim* sim, struct hair_step_params* params);
int hair_sim_is_mixed(const struct hair_sim* sim); // Return whether the mixed scheme solves the guides.
int hair_sim_is_stiff(const struct hair_sim* sim); // 1: some guides of the accurate solver take BDF2
struct hair_rods_report hair_sim_held(const struct hair_sim* sim); // how guides hold their groom

// programs.c: passes compiled with what there is; all that a step with what is set now runs; and how many substeps a dispatch may have.
int hair_sim_may_go_in_two(const struct hair_sim* sim); // programs: see main() of glsl/sim/rod.comp
hair_result hair_sim_need_solver(struct hair_sim* sim);
uint32_t hair_sim_next_list(struct hair_sim* sim); // of the dispatch that comes, which empties the other
void hair_sim_run_solver(struct hair_sim* sim, struct hair_step_params* params); // uploaded already
hair_gl_pass hair_sim_reset_pass(const struct hair_sim* sim, int skinned);
hair_gl_pass hair_sim_turn_pass(const struct hair_sim* sim);
hair_result hair_sim_need_programs(struct hair_sim* sim);
int hair_sim_is_by_thread(const struct hair_sim* sim);
uint32_t hair_sim_substeps_at_once(const struct hair_sim* sim);
uint32_t hair_sim_part_rounds(const struct hair_sim* sim); // of loops, for parts of a substep

// rounds.c: how often a software rasteriser goes round loops in a substep, at most; with a thread per guide or a work group.
uint32_t hair_sim_rounds_of_substep(const struct hair_sim* sim, int by_thread);
// The same of a program that leaves to another what the solver's own method cannot do.
uint32_t hair_sim_rounds_of_first(const struct hair_sim* sim, int by_thread);

// save.c: what the coming motion depends on, as bytes. `bytes` holds hair_sim_save_size(sim).
size_t hair_sim_save_size(struct hair_sim* sim);
void hair_sim_save(struct hair_sim* sim, unsigned char* bytes);

// Any bytes may be given. On failure nothing has changed.
hair_result hair_sim_load(struct hair_sim* sim, const unsigned char* bytes, size_t size);

#endif
