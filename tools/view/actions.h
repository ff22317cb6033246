// actions.h - The table of all actions, each with a label and a key.
#ifndef HAIR_TOOLS_VIEW_ACTIONS_H
#define HAIR_TOOLS_VIEW_ACTIONS_H

#include "tools/view/viewer.h"

struct view_action {
    const char* group; // heading in the panel
    const char* label;
    SDL_Keycode key;
    uint16_t modifiers; // some of KMOD_CTRL and KMOD_SHIFT
    const char* about;
    void (*run)(viewer& viewer);
    bool (*is_on)(const viewer& viewer); // null if the action is no switch
};

// Return the table, which a row without a label ends.
const view_action* view_actions();

// Run the action of a label.
void view_run_action(viewer& viewer, const char* label);

// Run the action of a key. Return false if there is none.
bool view_action_key(viewer& viewer, const SDL_Keysym& key);

// Return the name of an action's key, such as "Ctrl+Z".
std::string view_action_key_name(const view_action& action);

#endif
