// viewer.h - The state of hair-view, and one frame of its loop.
#ifndef HAIR_TOOLS_VIEW_VIEWER_H
#define HAIR_TOOLS_VIEW_VIEWER_H

#include "tools/view/document.h"
#include "tools/view/gui.h"
#include "tools/view/options.h"
#include "tools/view/script.h"
#include "tools/view/session.h"
#include "tools/view/stage.h"

#include <string>
#include <vector>

// Target of a drag of the mouse.
enum view_drag { VIEW_DRAG_NONE, VIEW_DRAG_ORBIT, VIEW_DRAG_PAN };

struct viewer {
    view_options options;
    view_stage stage;
    view_gui gui;
    view_script script;
    view_document document;
    view_session session;
    view_drag drag = VIEW_DRAG_NONE;
    int drag_button = 0;
    float mouse[2] = {0, 0}; // units of SDL
    bool quits = false;
    bool plays = true; // the head follows its motion
    bool loops = true;
    bool pauses = false;
    bool shows_help = false;
    bool shows_panels = true;
    uint32_t frame = 0;
    double moved = 0; // time of the last motion in the picture, ms
    double last = 0; // time of the last frame, ms
    std::vector<std::string> messages; // newest last
};

// Add a sentence to the messages of the window.
void viewer_say(viewer& viewer, const std::string& sentence);

// Run until the end. Return an exit status.
int viewer_run(viewer& viewer);

#endif
