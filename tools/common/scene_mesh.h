// scene_mesh.h - The mesh of a scene beside the hair: a character, the built-in head or a ball.
#ifndef HAIR_TOOLS_COMMON_SCENE_MESH_H
#define HAIR_TOOLS_COMMON_SCENE_MESH_H

#include "tools/common/character.h"
#include "tools/common/render.h"

// Set the mesh of a scene in a renderer, with a hair tie if the groom is tied. The character may be
// NULL. Return an exit status for the tool, after printing any error.
int hair_scene_set_mesh(const char* tool, const struct hair_scene* scene, const hair_groom* groom,
                        const struct hair_character* character, struct hair_render* render);

#endif
