// raster_params.glsl - parameters of the compute rasteriser, and where a head is in its buffers. In
// a batch they are those of the head `own_head`, which a work group finds first.
#include "shared.h"

#ifdef HAIR_BATCH
layout(std430, binding = HAIR_BIND_BATCH) readonly restrict buffer batch_buffer { hair_batch_head batch[]; };

uint own_head = 0u;
#define raster batch[own_head].raster
#define draw batch[own_head]

// Return the number of work groups of a head and of those before it.
uint groups_until(uint head, bool composes)
{
    return composes ? batch[head].compose_end : batch[head].raster_end;
}

// Find the head of a work group. Return the number of the group among those of the head.
uint find_head(uint group, bool composes)
{
    for (uint step_ = uint(HAIR_BATCH_HEADS) / 2u; step_ > 0u; step_ /= 2u)
        if (own_head + step_ < batch[0].heads && groups_until(own_head + step_ - 1u, composes) <= group)
            own_head += step_;
    return group - (own_head > 0u ? groups_until(own_head - 1u, composes) : 0u);
}

int  first_vertex() { return int(draw.first_vertex); }
uint first_sample() { return draw.first_sample; }
#else
layout(std140, binding = HAIR_BIND_RASTER) uniform raster_buffer { hair_raster_params raster; };

int  first_vertex() { return 0; }
uint first_sample() { return 0u; }
#endif
