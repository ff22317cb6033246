// prepared.h - the rods of all guides of a groom, computed on the application's threads.
#ifndef HAIR_ROD_PREPARED_H
#define HAIR_ROD_PREPARED_H

#include "lib/base/host.h"
#include "lib/rod/packed_rods.h"

// Guides, and the threads on which rods are computed from them.
struct hair_rod_source {
    const hair_host* host;
    const hair_tasks* tasks;
    const struct hair_guide* guides;
    const struct hair_rest* rest;
    // Physics of HAIR_MAX_STRAND_GROUPS groups, which replace those that are passed along with the
    // source. NULL if all groups have the physics that are passed along.
    const hair_physics* groups;
    // Factors of each guide, which multiply the physics. NULL if all are 1.
    const struct hair_guide_factors* factors;
    uint32_t count, vertices, max_vertices; // Guides, their vertices, and the maximum of a guide.
};

// Compute the gravity preload of all guides, or only of those that have `changed`. See struct
// hair_rod_preload. The results of the others are kept.
hair_result hair_rods_preload_all(const struct hair_rod_source* source, const hair_physics* physics,
                                  const bool* changed, struct hair_rod_borne* out, float* sags);

// Return the report of guides whose gravity preload has been computed.
struct hair_rods_report hair_rods_report_of(const struct hair_guide* guides, uint32_t count,
                                            const struct hair_rod_borne* borne, const float* sags);

// Apply hair_rods_are_mixed() to all guides.
bool hair_rods_are_any_mixed(const struct hair_rod_source* source, const struct hair_rod_borne* borne,
                             const hair_physics* physics, hair_solver solver, bool is_held, double substep);

// Apply hair_rods_substep() to all guides. All groups get the shortest length.
double hair_rods_shared_substep(const struct hair_rod_source* source, const struct hair_rod_borne* borne,
                                const hair_physics* physics, hair_solver solver, int mixed);

// Request for the rods of all guides.
struct hair_rods_order {
    const struct hair_rod_borne* borne;
    const hair_physics* physics;
    hair_solver solver;
    int mixed;
    double substep;
    // Pins in the order of guides and their vertices, pin_count of them.
    const struct hair_resolved_pin* pins;
    uint32_t pin_count;
    struct hair_rod_parts parts;
    bool is_reduced; // True if work groups solve the implicit systems.
};

// Rods as shaders read them.
struct hair_rods_result {
    hair_vec4* packed; // hair_rods_packed_count() of them.
    // Reduction of all guides, with a row of zeros after its rounds. NULL if no guide has an
    // implicit system.
    hair_vec4* reduction;
    uint32_t rounds; // Rounds before the final solve.
    struct hair_rods_softened softened;
};

// Write, pack and reduce the rods of all guides, in memory of the host that the caller frees.
hair_result hair_rods_make_all(const struct hair_rod_source* source, const struct hair_rods_order* order,
                               struct hair_rods_result* out);

// Rods for the physics that instances are created with, and for the solver's own substep.
struct hair_prepared_rods {
    hair_physics physics;
    hair_solver solver;
    struct hair_rod_borne* borne;
    float* sags; // See struct hair_rods_preload.
    struct hair_rods_report report;
    int mixed;
    double substep;
    // Packed rods, with all factors unless the scheme is mixed. The vectors before the factors that
    // the reduction replaces are packed rods too.
    hair_vec4* rod;
    hair_vec4* reduction; // NULL if there are no implicit systems.
    uint32_t rounds;
};

hair_result hair_prepared_rods_create(const struct hair_rod_source* source, const hair_physics* physics,
                                      hair_solver solver, struct hair_prepared_rods** out);
// Free what hair_prepared_rods_create() has made. NULL does nothing.
void hair_prepared_rods_free(const hair_host* host, struct hair_prepared_rods* prepared);

#endif
