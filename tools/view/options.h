// options.h - Command line of hair-view.
#ifndef HAIR_TOOLS_VIEW_OPTIONS_H
#define HAIR_TOOLS_VIEW_OPTIONS_H

#include "tools/view/common.h"

#include <string>

struct view_options {
    hair_scene scene; // with all changes of the command line applied
    std::string name; // name of the scene, for messages
    std::string file; // scene file, or ""
    std::string script, shot, film, save, glsl; // "" disables each
    uint32_t frames = 0; // 0 runs until the window is closed
    uint32_t width = 1280, height = 720; // size of the window, pixels
    bool debug = false; // OpenGL checks its calls
    bool fps = false; // prints the times of the frames at the end
    bool has_size = false; // the size is given, not that of the last window
    float scale = 0; // size of text and panels, 0 selects by the display
    uint32_t quality = 0; // of pictures at rest and of scripts, 0 is full
    int device = -1; // EGL device of a script, -1 selects any
};

// Parse the command line. Return an exit status if the tool must exit at once, after printing the
// reason. Return -1 to continue. Free the scene in either case.
int view_options_parse(int count, char** arguments, view_options& out);

// Return whether the end of a path is that of a scene file.
bool view_is_scene(const std::string& path);

#endif
