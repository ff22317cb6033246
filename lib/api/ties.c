// ties.c - the public call that sets pins of guides.
#include "lib/api/api.h"

hair_result hair_set_ties(hair_instance* hair, const hair_tie* ties, uint32_t count, size_t stride)
{
    return hair ? hair_ties_set(&hair->sim, ties, count, stride) : HAIR_ERROR_ARGUMENT;
}
