// air.h - the wind as the solvers feel it. All 0 while there is none.
#ifndef HAIR_WIND_AIR_H
#define HAIR_WIND_AIR_H

#include <hair/hair.h>

#include "lib/gl/gl.h"

struct hair_air {
    GLuint    params; // buffer, as in shared.h
    hair_vec4 box;    // of the fluid, likewise
};

int hair_wind_is_on(const hair_wind* wind);

// What such a wind takes; nothing if there is none.
hair_result hair_air_need(struct hair_air* air, struct hair_gl* gl, const hair_wind* wind);
void        hair_air_free(struct hair_air* air, struct hair_gl* gl);

// What the next dispatch of a solver reads.
void hair_air_bind(struct hair_air* air, struct hair_gl* gl, const hair_wind* wind,
                   const hair_physics* physics);

#endif
