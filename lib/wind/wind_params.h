// wind_params.h - parameters of the wind as the solvers feel it. See glsl/wind/air.glsl.
#ifndef HAIR_WIND_WIND_PARAMS_H
#define HAIR_WIND_WIND_PARAMS_H

#include "lib/collide/collider.h"
#include "lib/gl/commands.h"

#include <stdbool.h>

// State of the wind. Except `ball` and `moved`, all is 0 while there is no wind.
struct hair_wind_state {
    GLuint params; // Buffer, as in shared.h.
    hair_vec4 box; // Box of the fluid, as in shared.h.
    GLuint gusts; // Texture of gusts. 0 if there are none.
    uint32_t gust_seed; // Seed of that texture.
    // Sphere under the hair, in the head's frame. xyz is the centre, w the radius in metres. 0 if
    // there is none.
    hair_vec4 ball;
    hair_wind_source source[HAIR_WIND_SOURCES]; // Copies of the wind's sources.
    double moved[3]; // Displacement of gusts by the wind at the end of the last substep, in metres.
};

// Inputs of a dispatch of substeps. step->substep holds the motion of the head.
struct hair_wind_step {
    const hair_wind* wind;
    const hair_physics* physics;
    const struct hair_colliders* colliders;
    const struct hair_step_params* step;
    struct hair_pose head; // Head at the end of the dispatch.
    uint32_t substeps;
    double substep; // Length of a substep, in s.
};

// Gusts as shaders read them. See hair_wind_params.
struct hair_wind_gusts {
    GLuint texture; // 0 if there are none.
    hair_vec4 turn, from;
    float speed; // Standard deviation, in m/s.
};

bool hair_wind_is_on(const hair_wind* wind);
// Return whether the air changes although no setting does.
bool hair_wind_is_unsteady(const hair_wind* wind);

// Create the resources that `wind` needs. Free them if there is no wind.
hair_result hair_wind_ensure(struct hair_wind_state* state, struct hair_gl* gl, const hair_wind* wind);
void hair_wind_free_state(struct hair_wind_state* state, struct hair_gl* gl);

// Return the gusts as carried so far, relative to a head.
struct hair_wind_gusts hair_wind_find_gusts(const struct hair_wind_state* state, const hair_wind* wind,
                                            const struct hair_pose* head);

// Write and bind the parameters of a solver's next dispatch. Advance the gusts by its duration.
void hair_wind_write(struct hair_wind_state* state, struct hair_gl* gl, const struct hair_wind_step* step);

// Bind the parameters again for passes after the solver, if there is wind.
void hair_wind_bind(const struct hair_wind_state* state, struct hair_gl* gl, const hair_wind* wind);

#endif
