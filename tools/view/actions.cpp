// actions.cpp - The table of all actions, each with a label and a key.
#include "tools/view/actions.h"
#include "tools/view/compare.h"
#include "tools/view/debug_draw.h"
#include "tools/view/grab.h"
#include "tools/view/hair_actions.h"
#include "tools/view/record.h"
#include "tools/view/shader_watch.h"

#include <string.h>

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

void reset_head(viewer& viewer)
{
    memset(&viewer.document.scene->motion.pose, 0, sizeof viewer.document.scene->motion.pose);
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

void single_step(viewer& viewer)
{
    viewer.pauses = true;
    viewer.steps_once = true;
}

void undo(viewer& viewer)
{
    if (!view_document_undo(viewer.document)) viewer_say(viewer, "There is no change to take back.");
}

void redo(viewer& viewer)
{
    if (!view_document_redo(viewer.document)) viewer_say(viewer, "There is no change to do again.");
}

void open(viewer& viewer)
{
    viewer_open(viewer, viewer.path);
}

void save(viewer& viewer)
{
    viewer_save(viewer);
}

void picture(viewer& viewer)
{
    viewer.wants_picture = true;
}

void bug_report(viewer& viewer)
{
    viewer.wants_bug_report = true;
}

void record(viewer& viewer)
{
    if (viewer.film.is_on)
        view_record_end(viewer);
    else
        view_record_begin(viewer, view_new_name(".mp4"));
}

bool is_recording(const viewer& viewer)
{
    return viewer.film.is_on;
}

void toggle_image_error(viewer& viewer)
{
    view_image_error_finish(viewer.image_error);
    viewer.image_error.is_on = !viewer.image_error.is_on;
}
bool has_image_error(const viewer& viewer)
{
    return viewer.image_error.is_on;
}

void toggle_motion_error(viewer& viewer)
{
    viewer.motion_error.is_on = !viewer.motion_error.is_on;
    if (!viewer.motion_error.is_on) view_motion_error_end(viewer.motion_error, viewer.session);
}
bool has_motion_error(const viewer& viewer)
{
    return viewer.motion_error.is_on;
}

void toggle_pareto(viewer& viewer)
{
    viewer.pareto.shows = !viewer.pareto.shows;
}
bool shows_pareto(const viewer& viewer)
{
    return viewer.pareto.shows;
}

void toggle_gl_messages(viewer& viewer)
{
    viewer.gl_messages.shows = !viewer.gl_messages.shows;
}
bool shows_gl_messages(const viewer& viewer)
{
    return viewer.gl_messages.shows;
}

#define CTRL KMOD_CTRL

const view_action actions[] = {
    {"Scene", "Save", SDLK_s, CTRL, "Save the scene, with all changes, as the file above.", save, nullptr},
    {"Scene", "Open", SDLK_o, CTRL,
     "Open the file above: a scene (.json), a haircut (.groom, .hair, .tfx) or a mesh (.obj).", open,
     nullptr},
    {"Scene", "Picture", SDLK_F12, 0, "Write a picture of the window, hair-view-N.png.", picture, nullptr},
    {"Scene", "Record", SDLK_F9, 0, "Write a film of the window, hair-view-N.mp4.", record, is_recording},
    {"Scene", "Undo", SDLK_z, CTRL, "Take back the last change.", undo, nullptr},
    {"Scene", "Redo", SDLK_y, CTRL, "Do the change again.", redo, nullptr},
    {"Scene", "Bug report", SDLK_F8, 0,
     "Write the scene, a picture and the state of the window, to attach to a report of a defect.", bug_report,
     nullptr},
    {"Hair", "Next colour", SDLK_c, 0, "Take the next of the natural colours.", view_next_color, nullptr},
    {"Hair", "Short", SDLK_s, 0, "Cut the strands to less than half.", view_toggle_short, view_is_short},
    {"Hair", "Curly", SDLK_u, 0, "Curl the strands.", view_toggle_curly, view_is_curly},
    {"Hair", "Multi-strand", SDLK_m, 0, "Interpolate each strand between several guides.", view_toggle_multi,
     view_is_multi},
    {"Hair", "Single-strand", SDLK_n, 0, "Let each strand follow one guide.", view_toggle_single,
     view_is_single},
    {"Hair", "Add a ball", SDLK_b, 0, "Add a ball that hair collides with. Ctrl + left drag moves it.",
     view_add_ball, nullptr},
    {"Wind", "Wind", SDLK_k, 0, "Let the wind blow.", view_toggle_wind, view_has_wind},
    {"Wind", "Weaker", SDLK_LEFTBRACKET, 0, "Slow the wind by 1 m/s.", view_weaker_wind, nullptr},
    {"Wind", "Stronger", SDLK_RIGHTBRACKET, 0, "Speed up the wind by 1 m/s.", view_stronger_wind, nullptr},
    {"Time", "Play", SDLK_SPACE, 0, "Move the head by its motion.", toggle<&viewer::plays>,
     is<&viewer::plays>},
    {"Time", "Loop", SDLK_l, 0, "Repeat the motion of the head.", toggle<&viewer::loops>, is<&viewer::loops>},
    {"Time", "Pause", SDLK_p, 0, "Stop the time.", toggle<&viewer::pauses>, is<&viewer::pauses>},
    {"Time", "Slow motion", SDLK_o, 0, "Let the time run at an eighth of its speed.",
     toggle<&viewer::is_slow>, is<&viewer::is_slow>},
    {"Time", "Single step", SDLK_PERIOD, 0, "Pause, and advance by one frame of 1/60 s.", single_step,
     nullptr},
    {"Time", "Reset", SDLK_r, 0, "Begin again, with the hair at rest and whole.", reset, nullptr},
    {"Show", "Hair", SDLK_1, 0, "Draw the strands.", toggle_show<HAIR_SHOW_HAIR>, shows<HAIR_SHOW_HAIR>},
    {"Show", "Head", SDLK_2, 0, "Draw the head.", toggle_show<HAIR_SHOW_HEAD>, shows<HAIR_SHOW_HEAD>},
    {"Show", "Guides", SDLK_3, 0, "Draw the simulated guides, coloured by their stretch.",
     toggle_show<HAIR_SHOW_GUIDES>, shows<HAIR_SHOW_GUIDES>},
    {"Show", "Colliders", SDLK_4, 0, "Draw what hair collides with.", toggle_show<HAIR_SHOW_COLLIDERS>,
     shows<HAIR_SHOW_COLLIDERS>},
    {"Show", "Air", SDLK_5, 0, "Draw the wind as arrows.", toggle_show<HAIR_SHOW_WIND>,
     shows<HAIR_SHOW_WIND>},
    {"Show", "Next debug", SDLK_j, 0, "Show numbers of guides and strands as colours, by the list below.",
     view_debug_next, nullptr},
    {"Show", "Frame", SDLK_f, 0, "Move the camera until the hair fills the window.", frame_hair, nullptr},
    {"Show", "Head at rest", SDLK_h, 0, "Put the head back where its motion wants it.", reset_head, nullptr},
    {"Detail", "Level of detail", SDLK_d, 0, "Draw fewer, wider strands where they are small.",
     view_toggle_lod, view_has_lod},
    {"Detail", "Dynamic", SDLK_a, 0, "Choose the level by the size on the screen, not by the sliders.",
     view_toggle_dynamic, view_is_dynamic},
    {"Detail", "Tessellation", SDLK_t, 0, "Make strands by the tessellation of the hardware.",
     view_toggle_tessellation, view_is_tessellated},
    {"Simulation", "Multi-pass", SDLK_x, 0, "Simulate by passes of transform feedback, as in 2010.",
     view_toggle_passes, view_has_passes},
    {"Simulation", "Fewer steps", SDLK_v, 0, "Simulate by fewer substeps, and the fewest out of the picture.",
     view_toggle_simulation_lod, view_has_simulation_lod},
    {"Errors", "Image error", SDLK_e, 0, "Measure the picture at rest against one of 1,024 samples.",
     toggle_image_error, has_image_error},
    {"Errors", "Motion error", SDLK_g, 0,
     "Measure the motion against the reference, and its contacts against short steps.", toggle_motion_error,
     has_motion_error},
    {"Errors", "Pareto", SDLK_q, 0, "Try settings, and plot their time against their visible error.",
     toggle_pareto, shows_pareto},
    {"Errors", "Compare", SDLK_w, 0, "Keep these settings on the left of a line, and change the right.",
     view_toggle_compare, view_compares},
    {"Errors", "Reload shaders", SDLK_F5, 0, "Compile the shaders of --glsl again.", view_reload_shaders,
     nullptr},
    {"Errors", "OpenGL", SDLK_y, 0, "Show or hide the messages of OpenGL.", toggle_gl_messages,
     shows_gl_messages},
    {"Window", "Help", SDLK_QUESTION, 0, "Show or hide the list of keys and mouse controls.",
     toggle<&viewer::shows_help>, is<&viewer::shows_help>},
    {"Window", "Strip", SDLK_i, 0, "Show or hide timings and errors below the picture.",
     toggle<&viewer::shows_strip>, is<&viewer::shows_strip>},
    {"Window", "Panels", SDLK_TAB, 0, "Show or hide all panels.", toggle<&viewer::shows_panels>,
     is<&viewer::shows_panels>},
    {nullptr, nullptr, SDLK_UNKNOWN, 0, nullptr, nullptr, nullptr}};

} // namespace

const view_action* view_actions()
{
    return actions;
}

void view_run_action(viewer& viewer, const char* label)
{
    for (const view_action* action = actions; action->label; ++action)
        if (!strcmp(action->label, label)) action->run(viewer);
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
        if (!found) continue;
        action->run(viewer);
        return true;
    }
    return false;
}

std::string view_action_key_name(const view_action& action)
{
    std::string name = action.modifiers & KMOD_CTRL ? "Ctrl+" : "";
    if (action.modifiers & KMOD_SHIFT) name += "Shift+";
    return name + SDL_GetKeyName(action.key);
}
