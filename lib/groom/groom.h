// groom.h - a haircut at rest: guides to simulate, followers bound to them, patches to draw them by.
#ifndef HAIR_GROOM_GROOM_H
#define HAIR_GROOM_GROOM_H

#include "lib/base/host.h"
#include "lib/groom/seats.h"
#include "glsl/shared.h"

struct hair_groom {
    hair_host host;
    hair_groom_info info;
    struct hair_guide* guides; // info.guide_count
    struct hair_rest* rest; // info.guide_vertex_count
    struct hair_follower* followers; // info.follower_count
    struct hair_patch* patches; // info.patch_count
    uint16_t* paint; // rgb and nothing at HAIR_STRAND_COLORS places of each follower, 65535 for 1; NULL: none
    hair_vec4 skull; // a ball under the hair: xyz: m; w: radius, m, 0 where there is none
    uint32_t most_vertices; // of a guide
    uint32_t map_sets;
    struct hair_seats* seats; // NULL: there is no scalp, or no triangle of it has three corners
};

// `desc` is whole and has been checked, but for what its arrays hold. On failure *out is untouched.
hair_result hair_groom_build(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             hair_groom** out);
void hair_groom_free(hair_groom* groom);

// extent.c, once there are followers: how far each patch gets; and the ball under the hair.
void hair_measure_patches(struct hair_groom* groom);
hair_vec4 hair_find_skull(const struct hair_groom* groom);

#endif
