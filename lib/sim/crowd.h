// crowd.h - what a hair feels of the hair around it: mass, momentum and volume of all guides gathered in a grid that
// goes along with the head, and out of that an acceleration for every guide vertex.
//
// The grid holds integers, so that the order in which threads add does not matter. Time goes in blocks of substeps,
// counted from the last reset: the grid is made at a block's start, and its accelerations last for the block.
#ifndef HAIR_SIM_CROWD_H
#define HAIR_SIM_CROWD_H

#include "lib/base/math.h"
#include "lib/gl/gl.h"

// Of all vertices together, in the grid's units of mass, and likewise of volume. Rounding adds at most half a unit a
// vertex, of which there are at most 2^26: no sum leaves 32 bits, even if all hair is at one node. Momentum has as many
// units, as many times fewer for a speed as HAIR_CROWD_SPEED says, which no vertex exceeds.
#define HAIR_CROWD_UNITS 1073741824.0

struct hair_crowd { // All 0 until hair first has cohesion or volume.
    GLuint params, grid, share, limit, push, texture; // buffers, as in shared.h; of push
    hair_vec3 lower; // node 0, in the head's frame. m
    float cell; // m
    double metres; // of all guides
    uint32_t nodes[3];
    uint32_t beat; // substeps done of the block under way
};

struct hair_sim;

int hair_crowd_is_on(const struct hair_sim* sim);
hair_result hair_crowd_make(struct hair_sim* sim, const struct hair_guide* guides,
                            const struct hair_rest* rest); // if it is on and not yet made
void hair_crowd_free(struct hair_sim* sim);

// What guide vertices put into a grid of mass alone, as hair_share[]; and of how many metres of guides a unit of mass is.
hair_result hair_crowd_weigh(struct hair_sim* sim, GLuint* share, double* metres);

// How many substeps the block under way still has. At its start: find its accelerations first.
uint32_t hair_crowd_left(struct hair_sim* sim);
void hair_crowd_bind(struct hair_sim* sim); // what the solver reads
void hair_crowd_count(struct hair_sim* sim, uint32_t substeps);

#endif
