// pins.c - the public call that sets pins of guides.
#include "lib/api/api.h"

hair_result hair_set_pins(hair_instance* hair, const hair_pin* pins, uint32_t count, size_t stride)
{
    HAIR_TRY(hair_check_instance(hair));
    return hair_pins_set(&hair->sim, pins, count, stride);
}
