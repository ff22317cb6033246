// cuts.h - The cuts of a scene while it runs, and what falls off.
#ifndef HAIR_TOOLS_COMMON_CUTS_H
#define HAIR_TOOLS_COMMON_CUTS_H

#include "tools/common/scene_cuts.h"

struct hair_cut_pieces {
    hair_instance* at[HAIR_SCENE_CUTS];
    uint32_t count;
};

// Make the cuts of a frame, and add their pieces.
hair_result hair_cuts_run(const struct hair_scene_cuts* cuts, uint32_t frame, hair_instance* hair,
                          struct hair_cut_pieces* pieces);
// Step the pieces among colliders.
hair_result hair_cuts_step(const struct hair_cut_pieces* pieces, const hair_collider* colliders,
                           uint32_t count, float dt);
void hair_cuts_destroy(struct hair_cut_pieces* pieces);

#endif
