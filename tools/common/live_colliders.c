// live_colliders.c - All colliders of a scene at one time.
#include "tools/common/live_colliders.h"
#include "tools/common/file.h"

#include <stdlib.h>
#include <string.h>

static bool reserve(struct hair_live_colliders* colliders, uint32_t count)
{
    if (count <= colliders->room) return true;
    hair_collider* more = realloc(colliders->at, count * sizeof *more);
    if (!more) return false;
    colliders->at = more;
    colliders->room = count;
    return true;
}

hair_result hair_live_colliders_place(struct hair_live_colliders* colliders, const struct hair_scene* scene,
                                      const struct hair_character* character, float time,
                                      const float transform[16], const hair_collider* others,
                                      uint32_t other_count)
{
    // The solver by red-black projection knows no meshes.
    bool meshes = scene->head && scene->settings.desc.solver != HAIR_SOLVER_REDBLACK;
    if (meshes && !colliders->head[0] && head_collision_meshes_create(colliders->host, colliders->head))
        return HAIR_ERROR_MEMORY;
    if (!reserve(colliders, HAIR_HEAD_RIG_COLLIDERS + 1 + other_count)) {
        hair_complain(colliders->tool, "out of memory for %u colliders", other_count);
        return HAIR_ERROR_MEMORY;
    }
    uint32_t count =
        hair_head_rig_colliders(scene, meshes ? colliders->head : NULL, time, transform, colliders->at);
    if (character) colliders->at[count++] = hair_character_collider(character);
    if (other_count) memcpy(colliders->at + count, others, other_count * sizeof *others);
    colliders->count = count + other_count;
    return HAIR_OK;
}

void hair_live_colliders_free(struct hair_live_colliders* colliders)
{
    for (int i = 0; i < HEAD_MESHES; ++i) hair_collision_mesh_destroy(colliders->head[i]);
    free(colliders->at);
    *colliders = (struct hair_live_colliders){0};
}
