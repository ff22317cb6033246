// wind.c - the public call that sets the wind.
#include "lib/api/api.h"

hair_result hair_set_wind(hair_instance* hair, const hair_wind* wind)
{
    if (!hair) return HAIR_ERROR_ARGUMENT;
    hair_wind   own;
    hair_result result = HAIR_TAKE_OR_DEFAULT(&hair->context->host, hair_wind, wind, &own);
    if (!result) hair->sim.wind = own;
    return result;
}
