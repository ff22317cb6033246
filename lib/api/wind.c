// wind.c - public calls that set and get the wind.
#include "lib/api/api.h"

static hair_result check_number(const hair_instance* hair, uint32_t i, const char* name, float value,
                                double min, double max)
{
    if ((double)value >= min && (double)value <= max) return HAIR_OK; // NaN fails too.
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                     "%s: hair_wind.sources[%u].%s is %g, not in [%g, %g]", hair->label, i, name,
                     (double)value, min, max);
}

static hair_result check_source(const hair_instance* hair, uint32_t i, const hair_wind_source* source)
{
    HAIR_TRY(check_number(hair, i, "speed", source->speed, -1000, 1000));
    HAIR_TRY(check_number(hair, i, "radius", source->radius, 0.001, 100));
    for (int k = 0; k < 3; ++k) {
        HAIR_TRY(check_number(hair, i, "position", source->position[k], -1e9, 1e9));
        HAIR_TRY(check_number(hair, i, "direction", source->direction[k], -1e6, 1e6));
    }
    return HAIR_OK;
}

// Check that a texture is 3D. Binding an object that is no texture would raise the application's
// error flag.
static hair_result check_texture(const hair_instance* hair, GLuint texture)
{
    const struct hair_gl* gl = &hair->context->gl;
    HAIR_TRY(hair_check_current(hair->context));
    if (hair_gl_find_texture_target(gl, texture) == GL_TEXTURE_3D) return HAIR_OK;
    hair_result result = hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                                   "%s: hair_wind.texture is %u, not a 3D texture", hair->label, texture);
    return hair_check_lost(hair->context, result);
}

hair_result hair_set_wind(hair_instance* hair, const hair_wind* wind)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    hair_wind own;
    hair_wind_source sources[HAIR_WIND_SOURCES] = {0};
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(host, hair_wind, wind, &own));
    if (own.source_count && !own.sources)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_wind.sources is NULL but source_count is %u",
                         hair->label, own.source_count);
    HAIR_ASSERT(own.source_count <= HAIR_WIND_SOURCES);
    for (uint32_t i = 0; i < own.source_count; ++i) {
        sources[i] = own.sources[i];
        HAIR_TRY(check_source(hair, i, &sources[i]));
    }
    if (own.texture) HAIR_TRY(check_texture(hair, own.texture));
    own.sources = sources;
    hair_sim_set_wind(&hair->sim, &own);
    return HAIR_OK;
}

hair_result hair_get_wind(const hair_instance* hair, hair_wind* out)
{
    HAIR_TRY(hair_check_instance(hair));
    return HAIR_COPY_OUT(&hair->context->host, hair_wind, &hair->sim.wind, out);
}
