// controls.cpp - Mouse and keys outside of the panels.
#include "tools/view/controls.h"
#include "tools/view/actions.h"
#include "tools/view/blade.h"
#include "tools/view/camera.h"
#include "tools/view/compare.h"
#include "tools/view/gizmo.h"
#include "tools/view/grab.h"
#include "tools/view/hair_actions.h"

#include <math.h>

#include <algorithm>

namespace
{

constexpr float turn = 3.0f; // radians for a drag over the height of the window
constexpr float degrees = 57.2957795f;
constexpr float wheel_factor = 0.9f;
constexpr float farthest = 100; // of the head from its motion, m
constexpr float usual_wind = 4; // m/s

const view_mouse_help mouse_controls[] = {
    {"Left drag", "orbit the camera around the head"},
    {"Alt + left drag", "move the camera sideways"},
    {"Wheel", "zoom"},
    {"Shift + left drag", "turn the light"},
    {"Shift + right drag", "turn the wind"},
    {"Right drag", "turn the head"},
    {"Middle drag", "move the head"},
    {"Ctrl + left drag", "pull the hair under the cursor, or move a collider that is shown"},
    {"Ctrl + right drag", "cut the hair behind a line"},
    {"Left drag of an arrow or ring", "move or turn a collider that is shown"},
    {"Drop a file",
     "open a scene (.json) or a haircut (.groom, .hair, .tfx), or add a mesh (.obj) to collide with"},
    {nullptr, nullptr},
};

view_drag drag_of(uint8_t button, int modifiers)
{
    bool is_alt = modifiers & KMOD_ALT, is_shift = modifiers & KMOD_SHIFT, is_ctrl = modifiers & KMOD_CTRL;
    if (button == SDL_BUTTON_LEFT)
        return is_shift ? VIEW_DRAG_LIGHT : is_alt ? VIEW_DRAG_PAN : VIEW_DRAG_ORBIT;
    if (button == SDL_BUTTON_RIGHT && is_ctrl) return VIEW_DRAG_BLADE;
    if (button == SDL_BUTTON_RIGHT) return is_shift ? VIEW_DRAG_WIND : VIEW_DRAG_TURN;
    if (button == SDL_BUTTON_MIDDLE) return VIEW_DRAG_MOVE;
    return VIEW_DRAG_NONE;
}

// Turn a direction with the mouse, about the axes of the camera.
void turn_direction(const hair_scene& scene, float x, float y, float direction[3])
{
    view_axes axes = view_camera_axes(scene);
    view_rotate(axes.up, turn * x, direction);
    view_rotate(axes.right, turn * y, direction);
}

void turn_head(hair_scene& scene, float x, float y)
{
    float* rotation = scene.motion.pose.rotation;
    rotation[0] = std::remainder(rotation[0] + turn * degrees * x, 360.0f);
    rotation[1] = std::clamp(rotation[1] + turn * degrees * y, -90.0f, 90.0f);
}

void move_head(hair_scene& scene, float x, float y)
{
    view_axes axes = view_camera_axes(scene);
    float height = view_camera_height(scene), *position = scene.motion.pose.position;
    for (int i = 0; i < 3; ++i)
        position[i] =
            std::clamp(position[i] + height * (x * axes.right[i] - y * axes.up[i]), -farthest, farthest);
}

void press(viewer& viewer, const SDL_MouseButtonEvent& event)
{
    if (viewer.drag != VIEW_DRAG_NONE) return;
    bool grabs = event.button == SDL_BUTTON_LEFT && (SDL_GetModState() & KMOD_CTRL);
    bool wipes = event.button == SDL_BUTTON_LEFT && view_is_on_wipe(viewer, (float)event.x, (float)event.y);
    viewer.handle = event.button == SDL_BUTTON_LEFT ? view_find_handle(viewer, (float)event.x, (float)event.y)
                                                    : view_handle{};
    viewer.drag = wipes                         ? VIEW_DRAG_WIPE
                  : viewer.handle.collider >= 0 ? VIEW_DRAG_HANDLE
                  : grabs                       ? view_grab(viewer, (float)event.x, (float)event.y)
                                                : drag_of(event.button, SDL_GetModState());
    viewer.drag_button = event.button;
    viewer.mouse[0] = viewer.blade[0] = (float)event.x;
    viewer.mouse[1] = viewer.blade[1] = (float)event.y;
    if (viewer.drag == VIEW_DRAG_WIND && !view_has_wind(viewer)) view_set_wind_speed(viewer, usual_wind);
}

void move(viewer& viewer, const SDL_MouseMotionEvent& event)
{
    float height = std::max(viewer.picture.bottom - viewer.picture.top, 1.0f);
    float x = ((float)event.x - viewer.mouse[0]) / height, y = ((float)event.y - viewer.mouse[1]) / height;
    hair_scene& scene = *viewer.document.scene;
    if (viewer.drag == VIEW_DRAG_HANDLE) view_pull_handle(viewer, (float)event.x, (float)event.y);
    viewer.mouse[0] = (float)event.x;
    viewer.mouse[1] = (float)event.y;
    switch (viewer.drag) {
    case VIEW_DRAG_ORBIT: view_camera_orbit(scene, -turn * x, turn * y); break;
    case VIEW_DRAG_PAN: view_camera_pan(scene, x, y); break;
    case VIEW_DRAG_LIGHT: turn_direction(scene, x, y, scene.settings.light.direction); break;
    case VIEW_DRAG_WIND: turn_direction(scene, x, y, scene.settings.wind.velocity); break;
    case VIEW_DRAG_TURN: turn_head(scene, x, y); break;
    case VIEW_DRAG_MOVE: move_head(scene, x, y); break;
    case VIEW_DRAG_HAIR:
    case VIEW_DRAG_COLLIDER: view_grab_move(viewer, x, y); break;
    case VIEW_DRAG_WIPE: view_move_wipe(viewer, (float)event.x); break;
    case VIEW_DRAG_HANDLE:
    case VIEW_DRAG_BLADE:
    case VIEW_DRAG_NONE: break;
    }
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
        if (event.button.button == viewer.drag_button) {
            if (viewer.drag == VIEW_DRAG_BLADE)
                view_blade_cut(viewer, (float)event.button.x, (float)event.button.y);
            viewer.drag = VIEW_DRAG_NONE;
            view_grab_end(viewer);
        }
        break;
    case SDL_KEYDOWN:
        if (event.key.keysym.sym == SDLK_ESCAPE) viewer.shows_help = false;
        view_action_key(viewer, event.key.keysym);
        break;
    case SDL_DROPFILE: viewer_open(viewer, event.drop.file); break;
    default: break;
    }
}
