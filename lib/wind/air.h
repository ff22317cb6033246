// air.h - the wind as the solvers feel it: see glsl/wind/air.glsl.
#ifndef HAIR_WIND_AIR_H
#define HAIR_WIND_AIR_H

#include "lib/collide/solid.h"
#include "lib/gl/gl.h"

struct hair_air { // But for `ball` and `moved` all 0 while there is no wind.
    GLuint params; // buffer, as in shared.h
    hair_vec4 box; // of the fluid, likewise
    GLuint gusts; // texture; 0: there are none
    uint32_t gust_seed; // that it was made of
    hair_vec4 ball; // under the hair: xyz: in the head's frame, m; w: radius, m; 0: there is none
    hair_wind_source source[HAIR_WIND_SOURCES]; // what the wind's are copied to
    double moved[3]; // how far the wind has carried gusts, at the end of the last substep. m
};

// Where a dispatch of substeps leads, which step->substep has.
struct hair_air_now {
    const hair_wind* wind;
    const hair_physics* physics;
    const struct hair_solids* solids;
    const struct hair_step_params* step;
    struct hair_pose head; // at its end
    uint32_t substeps;
    double substep; // s
};

// Gusts as shaders find them: see hair_wind_params.
struct hair_air_gusts {
    GLuint texture; // 0: there are none
    hair_vec4 turn, from;
    float speed; // standard deviation, m/s
};

int hair_wind_is_on(const hair_wind* wind);
int hair_wind_is_unsteady(const hair_wind* wind); // 1: air changes though nothing is set anew

// What such a wind takes; nothing if there is none.
hair_result hair_air_need(struct hair_air* air, struct hair_gl* gl, const hair_wind* wind);
void hair_air_free(struct hair_air* air, struct hair_gl* gl);

// As far as they have gone, seen from a head.
struct hair_air_gusts hair_air_gusts_from(const struct hair_air* air, const hair_wind* wind,
                                          const struct hair_pose* head);

// What the next dispatch of a solver reads; gusts go on by its time.
void hair_air_blow(struct hair_air* air, struct hair_gl* gl, const struct hair_air_now* now);

// The same for who looks at it afterwards, where there is any.
void hair_air_bind(const struct hair_air* air, struct hair_gl* gl, const hair_wind* wind);

#endif
