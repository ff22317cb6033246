// actions.cpp - The table of all actions, each with a label and a key.
#include "tools/view/actions.h"
#include "tools/view/camera.h"

namespace
{

// Switch a part of the picture on or off.
template <uint32_t part> void toggle_show(viewer& viewer)
{
    viewer.document.scene->show ^= part;
}
template <uint32_t part> bool shows(const viewer& viewer)
{
    return viewer.document.scene->show & part;
}

template <bool viewer::*member> void toggle(viewer& viewer)
{
    viewer.*member = !(viewer.*member);
}
template <bool viewer::*member> bool is(const viewer& viewer)
{
    return viewer.*member;
}

void reset(viewer& viewer)
{
    view_session_reset(viewer.session, *viewer.document.scene);
}

void frame_hair(viewer& viewer)
{
    hair_bounds bounds;
    for (int i = 0; i < 3; ++i) {
        bounds.lower[i] = viewer.session.info.lower[i];
        bounds.upper[i] = viewer.session.info.upper[i];
    }
    hair_camera_frame(viewer.document.scene.get(), &bounds);
}

void undo(viewer& viewer)
{
    view_document_undo(viewer.document);
}
void redo(viewer& viewer)
{
    view_document_redo(viewer.document);
}

const view_action actions[] = {
    {"Help", SDLK_QUESTION, 0, "Show or hide the list of keys and mouse controls.",
     toggle<&viewer::shows_help>, is<&viewer::shows_help>},
    {"Panels", SDLK_TAB, 0, "Show or hide all panels.", toggle<&viewer::shows_panels>,
     is<&viewer::shows_panels>},
    {"Play", SDLK_SPACE, 0, "Move the head by its motion.", toggle<&viewer::plays>, is<&viewer::plays>},
    {"Loop", SDLK_l, 0, "Repeat the motion of the head.", toggle<&viewer::loops>, is<&viewer::loops>},
    {"Pause", SDLK_p, 0, "Stop the time.", toggle<&viewer::pauses>, is<&viewer::pauses>},
    {"Reset", SDLK_r, 0, "Begin again, with the hair at rest.", reset, nullptr},
    {"Frame the hair", SDLK_f, 0, "Move the camera until the hair fills the window.", frame_hair, nullptr},
    {"Show hair", SDLK_1, 0, "Draw the strands.", toggle_show<HAIR_SHOW_HAIR>, shows<HAIR_SHOW_HAIR>},
    {"Show head", SDLK_2, 0, "Draw the head.", toggle_show<HAIR_SHOW_HEAD>, shows<HAIR_SHOW_HEAD>},
    {"Show guides", SDLK_3, 0, "Draw the simulated guides, coloured by their stretch.",
     toggle_show<HAIR_SHOW_GUIDES>, shows<HAIR_SHOW_GUIDES>},
    {"Show colliders", SDLK_4, 0, "Draw what hair collides with.", toggle_show<HAIR_SHOW_COLLIDERS>,
     shows<HAIR_SHOW_COLLIDERS>},
    {"Show wind", SDLK_5, 0, "Draw the air as arrows.", toggle_show<HAIR_SHOW_WIND>, shows<HAIR_SHOW_WIND>},
    {"Undo", SDLK_z, KMOD_CTRL, "Take back the last change.", undo, nullptr},
    {"Redo", SDLK_y, KMOD_CTRL, "Do the change again.", redo, nullptr},
    {nullptr, SDLK_UNKNOWN, 0, nullptr, nullptr, nullptr}};

} // namespace

const view_action* view_actions()
{
    return actions;
}

bool view_action_key(viewer& viewer, const SDL_Keysym& key)
{
    bool is_ctrl = key.mod & KMOD_CTRL, is_shift = key.mod & KMOD_SHIFT;
    // The key of the question mark is Shift and / on many keyboards.
    bool is_help = key.sym == SDLK_QUESTION || (key.sym == SDLK_SLASH && is_shift);
    for (const view_action* action = actions; action->label; ++action) {
        bool has_ctrl = action->modifiers & KMOD_CTRL, has_shift = action->modifiers & KMOD_SHIFT;
        bool found = is_help ? action->key == SDLK_QUESTION
                             : action->key == key.sym && has_ctrl == is_ctrl && has_shift == is_shift;
        if (!found || action->key == SDLK_UNKNOWN) continue;
        action->run(viewer);
        return true;
    }
    return false;
}

std::string view_action_key_name(const view_action& action)
{
    if (action.key == SDLK_UNKNOWN) return "";
    std::string name = action.modifiers & KMOD_CTRL ? "Ctrl+" : "";
    if (action.modifiers & KMOD_SHIFT) name += "Shift+";
    return name + SDL_GetKeyName(action.key);
}
