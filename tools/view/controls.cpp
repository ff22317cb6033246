// controls.cpp - Mouse and keys outside of the panels.
#include "tools/view/controls.h"
#include "tools/view/actions.h"
#include "tools/view/camera.h"

#include <math.h>

namespace
{

constexpr float turn = 3.0f; // radians for a drag over the height of the window
constexpr float wheel_factor = 0.9f;

const view_mouse_help mouse_controls[] = {
    {"Left drag", "orbit the camera around the head"},
    {"Alt + left drag", "move the camera sideways"},
    {"Wheel", "zoom"},
    {nullptr, nullptr},
};

view_drag drag_of(uint8_t button, uint16_t modifiers)
{
    bool is_alt = modifiers & KMOD_ALT;
    if (button == SDL_BUTTON_LEFT) return is_alt ? VIEW_DRAG_PAN : VIEW_DRAG_ORBIT;
    return VIEW_DRAG_NONE;
}

void press(viewer& viewer, const SDL_MouseButtonEvent& event)
{
    if (viewer.drag != VIEW_DRAG_NONE) return;
    viewer.drag = drag_of(event.button, (uint16_t)SDL_GetModState());
    viewer.drag_button = event.button;
    viewer.mouse[0] = (float)event.x;
    viewer.mouse[1] = (float)event.y;
}

void move(viewer& viewer, const SDL_MouseMotionEvent& event)
{
    float height = (float)viewer.stage.height / viewer.stage.density;
    float x = ((float)event.x - viewer.mouse[0]) / height, y = ((float)event.y - viewer.mouse[1]) / height;
    hair_scene& scene = *viewer.document.scene;
    viewer.mouse[0] = (float)event.x;
    viewer.mouse[1] = (float)event.y;
    if (viewer.drag == VIEW_DRAG_ORBIT) view_camera_orbit(scene, -turn * x, turn * y);
    if (viewer.drag == VIEW_DRAG_PAN) view_camera_pan(scene, x, y);
}

} // namespace

const view_mouse_help* view_mouse_controls()
{
    return mouse_controls;
}

void view_controls_event(viewer& viewer, const SDL_Event& event)
{
    switch (event.type) {
    case SDL_QUIT: viewer.quits = true; break;
    case SDL_MOUSEBUTTONDOWN: press(viewer, event.button); break;
    case SDL_MOUSEMOTION: move(viewer, event.motion); break;
    case SDL_MOUSEWHEEL:
        view_camera_zoom(*viewer.document.scene, powf(wheel_factor, (float)event.wheel.y));
        break;
    case SDL_MOUSEBUTTONUP:
        if (event.button.button == viewer.drag_button) viewer.drag = VIEW_DRAG_NONE;
        break;
    case SDL_KEYDOWN: view_action_key(viewer, event.key.keysym); break;
    default: break;
    }
}
