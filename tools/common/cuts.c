// cuts.c - The cuts of a scene while it runs, and what falls off.
#include "tools/common/cuts.h"

hair_result hair_cuts_run(const struct hair_scene_cuts* cuts, uint32_t frame, hair_instance* hair,
                          struct hair_cut_pieces* pieces)
{
    hair_result result = HAIR_OK;
    for (uint32_t i = 0; i < cuts->count && !result; ++i) {
        const struct hair_scene_cut* cut = &cuts->at[i];
        hair_instance* fallen = NULL;
        if (cut->frame != frame) continue;
        result = hair_cut(hair, &cut->desc, NULL, cut->pieces ? &fallen : NULL);
        if (fallen) pieces->at[pieces->count++] = fallen;
    }
    return result;
}

hair_result hair_cuts_step(const struct hair_cut_pieces* pieces, const hair_collider* colliders,
                           uint32_t count, float dt)
{
    hair_result result = HAIR_OK;
    for (uint32_t i = 0; i < pieces->count && !result; ++i) {
        result = hair_set_colliders(pieces->at[i], colliders, count, sizeof *colliders);
        if (!result) result = hair_step(pieces->at[i], dt);
    }
    return result;
}

void hair_cuts_destroy(struct hair_cut_pieces* pieces)
{
    for (uint32_t i = 0; i < pieces->count; ++i) hair_destroy(pieces->at[i]);
    pieces->count = 0;
}
