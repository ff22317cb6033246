// pins.h - pins, which hold vertices of guides to the head or to the world, as the scalp holds
// roots.
#ifndef HAIR_SIM_PINS_H
#define HAIR_SIM_PINS_H

#include "lib/base/pose.h"
#include "lib/gl/commands.h"
#include "lib/rod/rod.h"

// Maximum number of pins of an instance. Shaders count pins in floats.
#define HAIR_MAX_PINS 1048576u

struct hair_pins {
    struct hair_resolved_pin* resolved_pin; // Array in the order of guides and their vertices.
    uint32_t count;
    uint32_t max_per_guide; // Maximum number of pins of one guide.
    uint32_t vertex_hash; // Hash of the pinned vertices. 0 if there are none.
    GLuint buffer, texture; // hair_held[]. 0 until there are pins.
};

struct hair_sim;

// Replace the pins by `count` pins that are `stride` bytes apart. On failure nothing has changed.
hair_result hair_pins_set(struct hair_sim* sim, const hair_pin* from, uint32_t count, size_t stride);

// Return the pins in the order of guides and their vertices, and their number in *count.
const struct hair_resolved_pin* hair_pins_get(const struct hair_sim* sim, uint32_t* count);

// Check loaded pins. Fail if the vertex of a pin does not exist, or if the order is wrong.
hair_result hair_pins_check(const struct hair_sim* sim, const struct hair_resolved_pin* resolved_pin,
                            uint32_t count);
// Replace the pins by an allocated array, which the instance then owns.
void hair_pins_adopt(struct hair_sim* sim, struct hair_resolved_pin* resolved_pin, uint32_t count);
void hair_pins_free(struct hair_sim* sim);
// Remove the pins of vertices that guides have lost, or that are the tip of a guide that is cut.
void hair_pins_drop_lost(struct hair_sim* sim);

// Write the pins for the solver, for a step to sim->head.
hair_result hair_pins_write(struct hair_sim* sim);
void hair_pins_bind(struct hair_sim* sim);

// Move the pins in the world along with the head.
void hair_pins_teleport(struct hair_sim* sim, const struct hair_pose* from, const struct hair_pose* to);

#endif
