// shader_watch.h - Shaders of a folder that are compiled again when a file changes.
#ifndef HAIR_TOOLS_VIEW_SHADER_WATCH_H
#define HAIR_TOOLS_VIEW_SHADER_WATCH_H

#include "tools/view/viewer.h"

// Compile all shaders again. Errors become messages of the window.
void view_reload_shaders(viewer& viewer);

// Compile all shaders again if a file of the folder of --glsl has changed.
void view_watch_shaders(viewer& viewer);

#endif
