// air.c - what the solvers read of the wind.
#include "lib/wind/air.h"

#define PI 3.14159265358979

int hair_wind_is_on(const hair_wind* wind)
{
    return wind->velocity[0] != 0 || wind->velocity[1] != 0 || wind->velocity[2] != 0;
}

hair_result hair_air_need(struct hair_air* air, struct hair_gl* gl, const hair_wind* wind)
{
    if (!hair_wind_is_on(wind)) {
        hair_air_free(air, gl);
        return HAIR_OK;
    }
    if (air->params) return HAIR_OK;
    return hair_gl_uniform(gl, "hair wind", sizeof(struct hair_wind_params), &air->params);
}

void hair_air_free(struct hair_air* air, struct hair_gl* gl)
{
    hair_gl_free_buffer(gl, &air->params);
}

void hair_air_bind(struct hair_air* air, struct hair_gl* gl, const hair_wind* wind,
                   const hair_physics* physics)
{
    double radius                  = (double)physics->fiber_radius,
           mass                    = (double)physics->fiber_density * PI * radius * radius;
    struct hair_wind_params params = {
        .box       = air->box,
        .velocity  = {wind->velocity[0], wind->velocity[1], wind->velocity[2], 0},
        .per_speed = (float)(2 * radius * (double)wind->density / (double)wind->viscosity),
        .viscous   = (float)((double)physics->drag * (double)wind->viscosity / mass),
    };
    hair_gl_write_uniform(gl, air->params, sizeof params, &params);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, HAIR_BIND_WIND, 1, &air->params);
}
