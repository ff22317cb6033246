// viewer.h - The state of hair-view, and its loop.
#ifndef HAIR_TOOLS_VIEW_VIEWER_H
#define HAIR_TOOLS_VIEW_VIEWER_H

#include "tools/view/debug_state.h"
#include "tools/view/document.h"
#include "tools/view/frame_times.h"
#include "tools/view/gl_messages.h"
#include "tools/view/gui.h"
#include "tools/view/image_error.h"
#include "tools/view/motion_error.h"
#include "tools/view/options.h"
#include "tools/view/script.h"
#include "tools/view/session.h"
#include "tools/view/stage.h"

#include <string>
#include <vector>

// Target of a drag of the mouse.
enum view_drag {
    VIEW_DRAG_NONE,
    VIEW_DRAG_ORBIT,
    VIEW_DRAG_PAN,
    VIEW_DRAG_LIGHT,
    VIEW_DRAG_WIND,
    VIEW_DRAG_TURN, // turns the head
    VIEW_DRAG_MOVE, // moves the head
    VIEW_DRAG_HAIR, // pulls a strand
    VIEW_DRAG_COLLIDER,
    VIEW_DRAG_HANDLE, // moves or turns a collider
    VIEW_DRAG_WIPE, // moves the line of a comparison
    VIEW_DRAG_BLADE // draws a line that cuts hair
};

// Handle of a collider: an arrow or a ring.
struct view_handle {
    int collider = -1; // index into the scene's colliders, or -1
    int axis = 0; // of the world
    bool is_ring = false;
};

// Newest values of the strip.
struct view_measures {
    hair_report_info info = {};
    std::vector<hair_report_row> rows;
    hair_solver_stats stats = {};
    std::vector<float> energy, stretch, fallbacks, fastest; // over time
    uint32_t fallback_count = 0; // until the newest value of `fallbacks`
};

// Settings with their time and error, for the plot of time against error.
struct view_pareto_point {
    std::string settings; // as "lod=on lod.strand_pixels=1"
    double ms, flip; // below 0 before the measurement
};
struct view_pareto {
    bool shows = false;
    bool is_running = false;
    bool was_paused = false; // before the measurement
    size_t next = 0; // point to measure
    std::vector<view_pareto_point> points;
};

// List of the files of a folder.
struct view_files {
    std::string folder;
    std::vector<std::string> names; // names of folders end in a slash
};

// Film of the window that is being written.
struct view_film {
    bool is_on = false;
    std::string path;
    hair_frame_writer writer = {};
    uint32_t frames = 0;
    std::vector<unsigned char> pixels;
};

struct viewer {
    view_options options;
    view_stage stage;
    view_gui gui;
    view_script script;
    view_document document;
    view_session session;
    view_place picture = {}; // part of the window that shows the hair
    view_drag drag = VIEW_DRAG_NONE;
    int drag_button = 0;
    int held_collider = -1; // index into the scene's colliders
    view_handle handle; // that the mouse pulls
    float mouse[2] = {0, 0}; // units of SDL
    float blade[2] = {0, 0}; // where the blade begins, units of SDL
    bool quits = false;
    bool plays = true; // the head follows its motion
    bool loops = true;
    bool pauses = false;
    bool is_slow = false;
    bool steps_once = false; // advances one frame although the time is paused
    bool shows_help = false;
    bool is_software = false; // a software rasterizer draws
    bool shows_panels = true;
    float wind_direction[3] = {1, 0, 0}; // of the last wind
    float wind_speed = 0; // before the wind was switched off, m/s
    uint32_t frame = 0;
    view_governor governor;
    bool is_full = false; // the picture has full quality, and nothing has moved since
    bool is_moving = false; // the picture is that of a moving scene
    uint32_t draws = 0; // pictures since the last step
    int picture_size[2] = {0, 0}; // pixels
    double frame_ms = 0; // smoothed time of a frame
    uint32_t compiled = 0; // programs that the driver had compiled at the end of the last frame
    view_frame_times frame_times; // for --fps
    bool shows_strip = true; // timings and errors below the picture
    view_measures measures;
    view_film film;
    std::unique_ptr<hair_scene> compared; // scene of the left side of a comparison, or null
    float wipe = 0.5f; // fraction of the picture that the left side has
    uint64_t shaders = 0; // newest time of the shaders that are watched
    view_image_error image_error;
    view_motion_error motion_error;
    view_pareto pareto;
    view_debug debug;
    view_gl_messages gl_messages;
    uint64_t motion = 0; // number of motions in the picture so far
    bool wants_picture = false; // writes the window at the end of this frame
    bool wants_bug_report = false; // writes scene, window and state then
    double moved = 0; // time of the last motion in the picture, ms
    double last = 0; // time of the last frame, ms
    std::string path; // file that the scene is saved as
    view_files files;
    std::string filter; // words in the names of the settings that the panel shows
    hair_scene usual = {}; // scene with the default settings of the style
    bool has_usual = false;
    bool only_changed = false; // the panel shows only settings without their default
    std::vector<std::string> messages; // newest last
    uint32_t said = 0; // frame of the newest message
};

// Note that something in the picture has moved.
void viewer_moved(viewer& viewer);

// Add a sentence to the messages of the window.
void viewer_say(viewer& viewer, const std::string& sentence);

// Open a scene file or a haircut instead of the present scene. A haircut keeps the rest of the
// scene. On failure the present scene stays.
void viewer_open(viewer& viewer, const std::string& path);
// Save the scene as viewer.path.
void viewer_save(viewer& viewer);
// Take the scene of a name, with a style or one of the built-in scenes.
void viewer_open_named(viewer& viewer, const char* name);

// Run until the end. Return an exit status.
int viewer_run(viewer& viewer);

#endif
