// sim.h - simulation of the guides in substeps of a fixed length. The pose of the head is
// interpolated to the end of every substep of a step.
#ifndef HAIR_SIM_SIM_H
#define HAIR_SIM_SIM_H

#include "lib/base/pose.h"
#include "lib/collide/grid.h"
#include "lib/field/sdf_pool.h"
#include "lib/gl/commands.h"
#include "lib/groom/groom.h"
#include "lib/sim/wind_coupling.h"
#include "lib/sim/hair_grid.h"
#include "lib/sim/feedback.h"
#include "lib/sim/impulses.h"
#include "lib/sim/guide_level.h"
#include "lib/sim/lengths.h"
#include "lib/sim/snapshot.h"
#include "lib/sim/solver_stats.h"
#include "lib/rod/prepared.h"
#include "lib/sim/scalp_motion.h"
#include "lib/sim/sleep.h"
#include "lib/sim/pins.h"
#include "lib/sim/targets.h"
#include "lib/wind/wind_params.h"

#include <stdbool.h>

#define HAIR_SIM_LOOSE 1.05f // Multiple of the reach that stretched hair may have.
#define HAIR_MIN_SUBSTEP_RATE 0.0625f // Minimum of hair_physics.substep_rate.
#define HAIR_CONTACT_SLACK 0.1f // Maximum of half the way of a vertex in a substep, m.

// Collision data of instances with collision meshes or with more than HAIR_FEW_COLLIDERS colliders.
// All 0 until an instance first has them.
struct hair_contacts {
    int any; // 1 if the current step uses this data.
    int listed; // 1 if the current step looks up colliders in lists of cells.
    struct hair_sdf_pool* sdf_pool; // Collision meshes of the context.
    struct hair_collider_grid grid;
    // Buffers of the colliders and of the grid's cells, and their textures for shaders.
    GLuint collider, collider_texture, cell, cell_texture;
    uint32_t* held; // Places in `sdf_pool` of the collision meshes in use.
    uint32_t holds; // Length of `held`.
};

// Physics of groups of strands, kept by group_physics.c.
struct hair_group_physics {
    hair_physics* physics; // Physics of all groups. NULL until one is set.
    uint32_t own; // Bit g is 1 if group g has been set.
    // Number of changes so far. 0 while all groups have the physics of the instance.
    uint32_t version;
    uint32_t last_version;
};

// Rods of the guides, made by rods.c.
struct hair_rods {
    // Guides at rest. A reference, because the application may destroy the groom before the physics
    // change.
    struct hair_groom* groom;
    const struct hair_rod_borne* borne; // Gravity preload for `borne_for`, own or of the groom.
    const float* sags; // Sags of the guides, see struct hair_rods_preload.
    struct hair_rod_borne* own_borne; // NULL unless the groom has no preload for the physics.
    float* own_sags;
    float* borne_fractions; // Fractions of the guides' lengths for `borne`. NULL if all are 1.
    hair_physics made_for, borne_for;
    // Values of sim->groups.version that the rods and the gravity preload were made for.
    uint32_t made_for_groups, borne_for_groups;
    // Values of sim->lengths.version that the rods and the gravity preload were made for.
    uint32_t made_for_lengths, borne_for_lengths;
    struct hair_rods_report report;
    int mixed; // 1 if the mixed scheme solves the guides. See glsl/sim/mixed.glsl.
    int stiff; // 1 if some guides are too stiff for SHAKE.
    int had_contact; // Value of sim->had_contact that the rods were made for.
    uint32_t pinned; // Value of sim->pins.vertex_hash that the rods were made for.
    // Multiple of the solver's own substep length that the rods were made for.
    uint32_t substep_scale;
};

// Rods for one length of substep, and everything that depends on them. hair_sim and its hair_rods
// have values of the same names.
struct hair_rod_set {
    GLuint rod, reduction, bend; // `rod` is 0 in an empty set.
    uint32_t rounds;
    int mixed, stiff, had_contact;
    hair_physics made_for;
    uint32_t made_for_groups, made_for_lengths;
    struct hair_rods_softened softened;
    uint32_t pinned, substep_scale;
    uint32_t last_scale; // Value of hair_sim.substep_scale. Loading sets it apart from the rods.
    double substep;
};

struct hair_sim {
    struct hair_gl* gl;
    hair_solver solver;
    hair_physics physics;
    struct hair_group_physics groups;
    hair_wind wind;
    double asked_substep; // Substep length set by the application, s. 0 selects the solver's own.
    double substep; // Substep length, s.
    GLuint guide, rest, state, solver_stats, step; // Buffers, as in shared.h.
    GLuint rod, history, material, reduction; // Buffers, as in shared.h. 0 under redblack.
    GLuint bend; // Forces and turns of segments. 0 without the mixed scheme.
    uint32_t rounds; // Rounds of the cyclic reduction before its last.
    struct hair_rods* rods; // NULL under redblack.
    int by_thread; // 1 prefers a thread per guide to a work group per guide.
    int two_pass; // 1 if guides may go through two programs. See main() of glsl/sim/rod.comp.
    uint32_t list; // Guide list of the last dispatch, 0 or 1. Dispatches alternate between them.
    // 1 once there were colliders. Impacts shorten the accurate solver's own substep.
    int had_contact;
    double last_substep; // Length of the last substep done, s. Displacements are over this time.
    double next_substep; // Length of the current substep, s. 0 if unknown, as after loading.
    // Multiple of the solver's own substep length. 0 until rods are first made.
    uint32_t substep_scale;
    float rate_factor; // Factor of hair_physics.substep_rate, a power of two. At most 1.
    uint32_t interval; // Number of frames from one step to the next.
    struct hair_guide_level guide_level;
    uint32_t guide_order; // Index in `solver_stats` of the order of guides.
    double unseen; // Time since a view last showed any of this hair, s.
    uint32_t guides, guide_vertices, smooth_vertices;
    uint32_t max_vertices; // Maximum number of vertices of a guide.
    uint32_t layout; // Hash of the vertex counts of all guides.
    double accumulator; // Time since the end of the last substep, s. Shorter than a substep.
    struct hair_pose last_before; // Head at the start of the last substep.
    struct hair_pose last_after; // Head at the end of the last substep.
    struct hair_pose head_at_last_step; // Head at the end of the last step.
    struct hair_pose head; // Head at the end of the next step.
    float reach; // Upper bound on the distance of guides from the head's origin, m.
    struct hair_colliders colliders;
    struct hair_contacts contacts;
    struct hair_grid hair_grid;
    struct hair_pins pins;
    struct hair_wind_state wind_state;
    struct hair_scalp_motion scalp_motion;
    struct hair_targets targets;
    struct hair_lengths lengths;
    struct hair_sleep sleep;
    struct hair_wind_coupling wind_coupling;
    struct hair_feedback feedback;
    struct hair_diagnosis diagnosis;
    struct hair_impulses impulses;
    struct hair_snapshots snapshots;
};

// Settings with which a simulation is created.
struct hair_sim_desc {
    hair_solver solver;
    double substep; // Substep length, s. 0 selects the solver's own.
    bool is_by_thread; // True prefers a thread per guide. Ignored under redblack.
    bool uses_feedback; // True runs redblack by transform feedback.
    bool is_diagnosed; // True watches the energy of guides.
    bool has_snapshots; // True keeps copies of the state for hair_sim_restore().
    hair_physics physics;
    hair_wind wind;
    struct hair_pose head;
    struct hair_sdf_pool* sdf_pool; // Collision meshes of the context.
    const struct hair_collider_field* field; // Field of the instance, which a fluid reads.
};

// Functions of create.c.

// Create a simulation. `*sim` is all 0. On failure hair_sim_destroy() frees what there is.
hair_result hair_sim_create(struct hair_sim* sim, struct hair_gl* gl, const struct hair_groom* groom,
                            const struct hair_sim_desc* desc);
void hair_sim_destroy(struct hair_sim* sim);

// Functions of sim.c.

// Run the substeps that fit into the time since the last one. Write the step buffer for
// smooth.comp.
hair_result hair_sim_step(struct hair_sim* sim, double dt);
// Advance the time by dt as a step of resting hair would.
void hair_sim_pass_time(struct hair_sim* sim, double dt);
// Reset the guides to their rest pose under sim->head.
void hair_sim_reset(struct hair_sim* sim);
// Move sim->head to a pose, and the hair rigidly with it.
hair_result hair_sim_teleport(struct hair_sim* sim, const struct hair_pose* to);

// Functions of settings.c and group_physics.c, for what applications set and ask between steps.

// Set the physics, from the next step on.
void hair_sim_set_physics(struct hair_sim* sim, const hair_physics* physics);
// Set the physics of a group of strands, from the next step on. NULL gives the group those of the
// instance. Only members that hair_sim_copy_group_members() copies count.
hair_result hair_sim_set_group_physics(struct hair_sim* sim, uint32_t group, const hair_physics* physics);
// Copy the members of physics that can differ by group.
void hair_sim_copy_group_members(const hair_physics* from, hair_physics* to);
// Return the physics of all groups. Return NULL if all groups have the physics of the instance.
const hair_physics* hair_sim_groups(const struct hair_sim* sim);
// Return the physics of the instance, with the largest frequencies and tip mass of any guide.
hair_physics hair_sim_max_physics(const struct hair_sim* sim);
// Return whether some guides have another damping than the instance, by group or by factor.
bool hair_sim_has_guide_damping(const struct hair_sim* sim);
// Return the minimum damping of all guides, in 1/s.
float hair_sim_min_damping(const struct hair_sim* sim);
// Apply changed physics of the instance to the groups.
void hair_sim_update_groups(struct hair_sim* sim);
// Set the wind, from the next step on. Copy the checked sources to which `wind` points. Other
// sources wake sleeping hair.
void hair_sim_set_wind(struct hair_sim* sim, const hair_wind* wind);
// Set the pose of the head at the end of the next step.
void hair_sim_set_head(struct hair_sim* sim, const struct hair_pose* head);
// Set the colliders at the end of the next step, as hair_colliders_set() does.
hair_result hair_sim_set_colliders(struct hair_sim* sim, const hair_collider* colliders, uint32_t count,
                                   size_t stride);
// Return the colliders that were set last.
const struct hair_collider_list* hair_sim_colliders(const struct hair_sim* sim);
// Return whether colliders have been set since the last step.
bool hair_sim_has_new_colliders(const struct hair_sim* sim);
// Set the time since a view last showed the hair, s. At most 1 s counts. Hair that no view shows
// may have longer substeps.
void hair_sim_set_unseen_time(struct hair_sim* sim, double seconds);
// Multiply hair_physics.substep_rate by a factor of at most 1.
void hair_sim_scale_substep_rate(struct hair_sim* sim, float factor);
// Set the number of frames from one step to the next. Substeps are longer by as much, up to a power
// of two.
void hair_sim_set_interval(struct hair_sim* sim, uint32_t frames);
// Simulate one guide of every `stride` from the next step on: 1, 2, 4 or HAIR_MAX_GUIDE_STRIDE.
void hair_sim_set_guide_stride(struct hair_sim* sim, uint32_t stride);
// Return whether no strand leaves the reach of its patch, because the scalp holds all roots where
// the groom has them.
bool hair_sim_has_fixed_roots(const struct hair_sim* sim);
// Return whether every strand stays within its length of its root. This needs a guide with a fixed
// root. The solver redblack stretches guides. Pins and scalp motion move guides elsewhere.
bool hair_sim_has_attached_strands(const struct hair_sim* sim);
// Return whether the last step had a wind.
bool hair_sim_has_wind(const struct hair_sim* sim);
// Return the fluid of the last step's wind, or NULL if it had none.
const struct hair_fluid* hair_sim_fluid(const struct hair_sim* sim);
// Return whether the energy of guides is watched.
bool hair_sim_is_diagnosed(const struct hair_sim* sim);

// Functions of step_params.c.

// Write the physics and the rods.
void hair_sim_write_physics(const struct hair_sim* sim, struct hair_step_params* params);
// Write the parameters by which smooth.comp interpolates strands within the last substep, under the
// current pose of the head.
void hair_sim_write_now(const struct hair_sim* sim, struct hair_step_params* params);
// Write the next `count` substeps. The first begins `from` seconds into a step of `dt`, which may
// be negative.
void hair_sim_write_substeps(struct hair_sim* sim, struct hair_step_params* params, uint32_t count,
                             double from, double dt);
// Write the colliders of the step, or the parameters of the grid that finds them.
void hair_sim_write_colliders(const struct hair_sim* sim, struct hair_step_params* params);
// Return the fraction of a step of dt that is done at the end of substep `i`. The first substep
// begins `from` seconds into the step, which may be negative.
double hair_sim_fraction_at_end(const struct hair_sim* sim, uint32_t i, double from, double dt);
// Upload the parameters to the step buffer.
void hair_sim_upload(struct hair_sim* sim, const struct hair_step_params* params);
// Write the step buffer for smooth.comp, with the head where the last step left it.
void hair_sim_upload_render_state(struct hair_sim* sim);

// Functions of state.c, which every file of this folder may use.

// Bind the buffers of passes that read guides.
void hair_sim_bind(struct hair_sim* sim);
// Bind the buffers of the solvers of rods.
void hair_sim_bind_rods(struct hair_sim* sim);
// Return the number of colliders that guides collide with.
uint32_t hair_sim_contacts(const struct hair_sim* sim);
// Return the guides. Set *rest to their vertices unless `rest` is NULL. Both are NULL under
// redblack.
const struct hair_guide* hair_sim_guides(const struct hair_sim* sim, const struct hair_rest** rest);
// Return whether the mixed scheme solves the guides.
bool hair_sim_is_mixed(const struct hair_sim* sim);
// Return whether the accurate solver solves some guides by BDF2.
bool hair_sim_is_stiff(const struct hair_sim* sim);
// Return the pass that resets the guides. `skinned` is 1 if roots move with a skinned scalp.
hair_gl_pass hair_sim_reset_pass(const struct hair_sim* sim, int skinned);
// Return the pass that turns the guides with a teleported head.
hair_gl_pass hair_sim_rotate_pass(const struct hair_sim* sim);
// Return the number of substeps of a block that lasts `time` seconds, at least 1. The hair grid and
// the fluid are updated once per block.
uint32_t hair_sim_block_length(const struct hair_sim* sim, double time);
// Return the number of substeps left of a block of `length`, `done` of which are done. If substeps
// have become longer, the block may be over already. The result is then `length`.
uint32_t hair_sim_block_left(uint32_t done, uint32_t length);
// Return whether roots move with a skinned scalp.
bool hair_scalp_motion_is_on(const struct hair_sim* sim);
// Bind the scalp motion for the passes that read it.
void hair_scalp_motion_bind(struct hair_sim* sim);
// Return whether there are targets of guides.
bool hair_targets_are_on(const struct hair_sim* sim);
// Bind targets for the passes that read them.
void hair_targets_bind(struct hair_sim* sim);
// Return the pass that smooths guides, with a skinned scalp and with targets.
hair_gl_pass hair_sim_smooth_pass(const struct hair_sim* sim, bool is_skinned, bool has_targets);
// Return whether something other than its own motion moves hair away from the rest pose of the
// head: a free root, pins, a skinned scalp or targets.
bool hair_sim_may_leave(const struct hair_sim* sim);
// Return whether the physics have cohesion or volume, and the solver supports them.
bool hair_grid_is_on(const struct hair_sim* sim);

// Functions of contacts.c, for collision meshes and for more than HAIR_FEW_COLLIDERS colliders.

// Return whether the instance has collision meshes or more than HAIR_FEW_COLLIDERS colliders.
bool hair_contacts_are_any(const struct hair_sim* sim);
// Return whether the instance has more than HAIR_FEW_COLLIDERS colliders.
bool hair_contacts_are_listed(const struct hair_sim* sim);
// Find the colliders in reach during a step of dt. `fraction_start` is the fraction of the step
// that has been done, and may be negative. No substep is longer than `longest`, s.
hair_result hair_contacts_find(struct hair_sim* sim, double dt, float fraction_start, double longest);
// Write the parameters that hair_contacts_find() found.
void hair_contacts_write(const struct hair_sim* sim, struct hair_step_params* params);
void hair_contacts_bind(const struct hair_sim* sim);
void hair_contacts_free(struct hair_sim* sim);

// Return the fraction of its length that a guide has.
static inline float hair_sim_length_fraction(const struct hair_sim* sim, uint32_t guide)
{
    return sim->lengths.guide_fraction ? sim->lengths.guide_fraction[guide] : 1;
}

// Functions of preload.c.

// Return the guides from which rods are computed.
struct hair_rod_source hair_sim_rod_source(const struct hair_sim* sim);
// Find the gravity preload for the physics and the lengths, or compute it.
hair_result hair_sim_preload(struct hair_sim* sim);
void hair_sim_free_preload(struct hair_sim* sim);
// Return the report on the gravity preload of the guides.
struct hair_rods_report hair_sim_preload_report(const struct hair_sim* sim);

// Functions of rods.c, for what the solvers of rods need beside the state.
hair_result hair_sim_create_rods(struct hair_sim* sim, const struct hair_groom* groom);
// Make other rods if the physics, the pinned vertices or the substep length need them. The
// simulation keeps its own. Otherwise the set is empty.
hair_result hair_sim_make_rods(struct hair_sim* sim, struct hair_rod_set* out);
// Exchange the rods of the simulation for those of a set. An empty set changes nothing.
void hair_sim_swap_rods(struct hair_sim* sim, struct hair_rod_set* set);
// Free what a set does not have in common with the simulation.
void hair_sim_free_rod_set(struct hair_sim* sim, const struct hair_rod_set* set);
// Note whether there have been colliders.
void hair_sim_note_contact(struct hair_sim* sim);
// Return whether the rods must be made again for a changed rate, and for nothing else.
bool hair_sim_is_other_rate(const struct hair_sim* sim);
void hair_sim_free_rods(struct hair_sim* sim);
// Write the parameters of the solvers of rods.
void hair_sim_write_rods(const struct hair_sim* sim, struct hair_step_params* params);

// Functions of programs.c, which selects the programs and the number of substeps of a dispatch.

// Return whether guides may go through two programs. See main() of glsl/sim/rod.comp.
bool hair_sim_may_use_two_passes(const struct hair_sim* sim);
// Compile the solver for the current settings.
hair_result hair_sim_ensure_solver(struct hair_sim* sim);
// Return the guide list of the next dispatch, which empties the other list.
uint32_t hair_sim_flip_work_list(struct hair_sim* sim);
// Run the solver with parameters that have been uploaded.
void hair_sim_run_solver(struct hair_sim* sim, struct hair_step_params* params);
// Compile all programs that a step with the current settings runs. `may_derive` is true if the
// step may simulate some guides only.
hair_result hair_sim_ensure_programs(struct hair_sim* sim, bool may_derive);
// Return whether a thread solves a guide, and not a work group.
bool hair_sim_is_by_thread(const struct hair_sim* sim);
// Return the maximum number of substeps of a dispatch.
uint32_t hair_sim_substeps_at_once(const struct hair_sim* sim);
// Return the maximum number of loop iterations for the parts of a substep.
uint32_t hair_sim_part_rounds(const struct hair_sim* sim);
// Return how many guides of its list a work group of the second program solves.
uint32_t hair_sim_guides_of_list_group(const struct hair_sim* sim);

// Functions of loop_budget.c.

// Return an upper bound on the loop iterations of a substep on a software rasteriser. `by_thread`
// is 1 for a thread per guide, and 0 for a work group per guide.
uint32_t hair_sim_rounds_of_substep(const struct hair_sim* sim, int by_thread);
// Return the bound for a program that tries only the solver's own method, and leaves the rest to
// another program.
uint32_t hair_sim_rounds_of_pass1(const struct hair_sim* sim, int by_thread);

// Functions of time_budget.c, for GPUs.

// Return how many substeps a dispatch can compute in its time.
uint32_t hair_sim_substeps_in_time(const struct hair_sim* sim);
// Return for how many guides a dispatch can compute so many substeps in its time.
uint32_t hair_sim_guides_in_time(const struct hair_sim* sim, uint32_t substeps);

// Functions of save.c, for the bytes of the state that the coming motion depends on.

// Return the size of the saved state in bytes.
size_t hair_sim_save_size(struct hair_sim* sim);
// Write the saved state. `bytes` has room for hair_sim_save_size(sim).
void hair_sim_save(struct hair_sim* sim, unsigned char* bytes);
// Load a saved state from any bytes, which need not be valid. On failure nothing has changed.
hair_result hair_sim_load(struct hair_sim* sim, const unsigned char* bytes, size_t size);

#endif
