// scene_write.h - Scenes as JSON files that hair_scene_read() reads back to equal scenes.
#ifndef HAIR_TOOLS_COMMON_SCENE_WRITE_H
#define HAIR_TOOLS_COMMON_SCENE_WRITE_H

#include "tools/common/scene.h"

// Write a scene. Members with their default values are left out. Return false after printing an
// error.
bool hair_scene_write(const char* tool, const char* path, const struct hair_scene* scene);

#endif
