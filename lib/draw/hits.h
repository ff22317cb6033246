// hits.h - followers that come into solids: found, and led round them. Only where a solid is near the hair is there a pass, memory, or another program to draw with.
#ifndef HAIR_DRAW_HITS_H
#define HAIR_DRAW_HITS_H

#include "lib/field/field.h"
#include "lib/interpolate/interpolate.h"

struct hair_hits {
    GLuint hit, repair, list; // buffers, as in shared.h; 0 until they are needed
    GLuint hit_texture, repair_texture; // the first two, for what draws
    GLuint image, frame; // of a prepass: a texel per follower, to draw into
    int prepass; // hits are found by one
    int active; // solids are near
    const struct hair_solid_field* field; // then: that they are in
    int fresh; // for what was asked last; what changes followers or solids clears it
    uint32_t smoothed; // runs of smooth.comp that it is for
    uint32_t met; // how often it has been found out
    uint32_t turn; // as in hair_draw_params
};

#endif
