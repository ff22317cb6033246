// wind.c - public calls that set and get the wind.
#include "lib/api/api.h"

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
        HAIR_TRY(hair_schema_check_element(host, "hair_wind.sources", i, &sources[i],
                                           hair_schema_of_hair_wind_source()));
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
