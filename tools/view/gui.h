// gui.h - Dear ImGui over events of SDL, and the places of all widgets by their labels.
#ifndef HAIR_TOOLS_VIEW_GUI_H
#define HAIR_TOOLS_VIEW_GUI_H

#include <SDL.h>
#include <imgui.h>

#include <string>
#include <unordered_map>

// Rectangle of a widget in the last frame, in units of mouse positions.
struct view_place {
    float left, top, right, bottom;
};

struct view_gui {
    std::unordered_map<std::string, view_place> places, next_places;
    float scale = 0; // size of the font that is loaded
    int pixels[2] = {0, 0};
    bool pressed[3] = {false, false, false}; // buttons pressed since the last frame
    bool held[3] = {false, false, false};
};

// Start Dear ImGui. An OpenGL context is current.
bool view_gui_open(view_gui& gui);
void view_gui_close(view_gui& gui);

// Pass an event to the widgets. Return whether it is theirs alone.
bool view_gui_event(view_gui& gui, const SDL_Event& event);

// Begin a frame of `width` by `height` pixels. `density` is the number of pixels of a unit of mouse
// positions.
void view_gui_begin(view_gui& gui, int width, int height, float density, float scale, float dt);
// End the frame. With `draws`, the widgets are drawn into the bound framebuffer.
void view_gui_end(view_gui& gui, bool draws);

// Remember where the last widget is, for scripts.
void view_gui_mark(view_gui& gui, const char* label);

#endif
