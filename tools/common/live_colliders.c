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

// Create the surfaces of the built-in head if there are none.
static hair_result ensure_head(struct hair_live_colliders* colliders)
{
    if (colliders->head) return HAIR_OK;
    hair_collision_mesh* head;
    if (head_collision_mesh_create(colliders->host, &head)) return HAIR_ERROR_MEMORY;
    hair_result result = hair_head_body_create(colliders->context, &colliders->body);
    if (result)
        hair_collision_mesh_destroy(head);
    else
        colliders->head = head;
    return result;
}

hair_result hair_live_colliders_place(struct hair_live_colliders* colliders, const struct hair_scene* scene,
                                      const struct hair_character* character, float time,
                                      const float transform[16], const hair_collider* others,
                                      uint32_t other_count)
{
    // The solver by red-black projection knows no meshes.
    bool meshes = scene->head && scene->settings.desc.solver != HAIR_SOLVER_REDBLACK;
    hair_result result = meshes ? ensure_head(colliders) : HAIR_OK;
    if (!result && meshes)
        result = hair_head_body_move(&colliders->body, transform, hair_head_rig_breath(scene, time));
    if (result) return result;
    if (!reserve(colliders, HAIR_HEAD_RIG_COLLIDERS + 1 + other_count)) {
        hair_complain(colliders->tool, "out of memory for %u colliders", other_count);
        return HAIR_ERROR_MEMORY;
    }
    struct hair_head_meshes head = {colliders->head, hair_body_get_mesh(colliders->body.body)};
    uint32_t count = hair_head_rig_colliders(scene, meshes ? &head : NULL, time, transform, colliders->at);
    if (character) colliders->at[count++] = hair_character_collider(character);
    if (other_count) memcpy(colliders->at + count, others, other_count * sizeof *others);
    colliders->count = count + other_count;
    return HAIR_OK;
}

void hair_live_colliders_free(struct hair_live_colliders* colliders)
{
    hair_head_body_destroy(&colliders->body);
    hair_collision_mesh_destroy(colliders->head);
    free(colliders->at);
    *colliders = (struct hair_live_colliders){0};
}
