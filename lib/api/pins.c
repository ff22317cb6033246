// pins.c - the public call that sets pins of guides.
#include "lib/api/api.h"

hair_result hair_set_pins(hair_instance* hair, const hair_pin* pins, uint32_t count, size_t stride)
{
    return hair ? hair_pins_set(&hair->sim, pins, count, stride) : HAIR_ERROR_ARGUMENT;
}
