// stage.h - What the viewer draws into: a window, or a texture without a display.
#ifndef HAIR_TOOLS_VIEW_STAGE_H
#define HAIR_TOOLS_VIEW_STAGE_H

#include "tools/view/options.h"

#include <SDL.h>

#include <vector>

struct view_stage {
    SDL_Window* window = nullptr;
    SDL_GLContext context = nullptr; // null without a display
    hair_egl* egl = nullptr; // null with a display
    unsigned framebuffer = 0, texture = 0; // 0 draws into the window
    int texture_size[2] = {0, 0};
    int width = 0, height = 0; // pixels
    float density = 1; // pixels for one unit of mouse positions
    float scale = 1; // size of text and panels that the display asks for
};

// Open a window, or a texture for a script. Return an exit status, after printing any error.
int view_stage_open(const view_options& options, const hair_host& host, view_stage& out);
void view_stage_close(view_stage& stage);

// Return the function that finds functions of OpenGL.
void* (*view_stage_get_proc(const view_stage& stage))(const char* name, void* user);

// Bind the framebuffer of the size that the window has now, and clear it.
void view_stage_begin(view_stage& stage);
// Read the picture, RGB from the top. Call it before view_stage_end().
void view_stage_read(const view_stage& stage, std::vector<unsigned char>& out);
// Show the picture.
void view_stage_end(view_stage& stage);
// Update `width`, `height`, `density` and `scale`.
void view_stage_measure(view_stage& stage);

#endif
