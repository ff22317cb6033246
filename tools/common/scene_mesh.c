// scene_mesh.c - The mesh of a scene beside the hair: a character, the built-in head or a ball.
#include "tools/common/scene_mesh.h"
#include "tools/common/file.h"
#include "tools/common/head_rig.h"
#include "tools/common/head_tie.h"

int hair_scene_set_mesh(const char* tool, const struct hair_scene* scene, const hair_groom* groom,
                        const struct hair_character* character, struct hair_render* render)
{
    struct head_mesh mesh;
    struct head_tie tie;
    bool ball = scene->subject == HAIR_SUBJECT_FUR;
    if (character) {
        hair_render_set_mesh(render, &character->mesh, true);
        return HAIR_EXIT_OK;
    }
    if (!scene->head && !ball) return HAIR_EXIT_OK;
    const struct head_tie* own = scene->head && head_find_tie(groom, &tie) ? &tie : NULL;
    if (scene->head ? head_mesh_create(own, &mesh) : hair_head_rig_ball(scene->ball_radius, &mesh)) {
        hair_complain(tool, "out of memory for the head");
        return HAIR_EXIT_RUNTIME;
    }
    hair_render_set_mesh(render, &mesh, !scene->head);
    head_mesh_free(&mesh);
    return HAIR_EXIT_OK;
}
