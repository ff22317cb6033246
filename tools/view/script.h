// script.h - Events of mouse and keys from a file, which reach the viewer by the queue of SDL.
//
// A line is one command. A command takes effect in the next frame:
//
//     move X Y              move the mouse
//     glide X Y N           move the mouse there in N frames
//     down BUTTON, up BUTTON    left, middle or right
//     wheel N               turn the wheel, up if above 0
//     key NAME              press and release a key, such as k, ?, Space or Ctrl+Z
//     press NAME, release NAME    one of both
//     text WORDS            type text
//     click LABEL           click on the widget of a label
//     drag LABEL X Y        drag a widget of a label by X and Y
//     drop PATH             drop a file on the window
//     size W H              resize the window
//     save PATH             write the scene
//     report PATH           write the state of the window
//     wait N                wait for N frames
#ifndef HAIR_TOOLS_VIEW_SCRIPT_H
#define HAIR_TOOLS_VIEW_SCRIPT_H

#include "tools/view/gui.h"

#include <deque>
#include <string>
#include <vector>

struct view_command {
    std::string verb, text;
    float x = 0, y = 0;
    float count = 0; // frames of a glide
    int line = 0;
    int tries = 0; // frames in which no widget had the label
};

struct view_script {
    std::string path; // "" disables the script
    std::deque<view_command> commands;
    float mouse[2] = {-1, -1};
    uint32_t wait = 0; // frames until the next command
    uint16_t modifiers = 0;
    std::string save; // file to write the scene to at the end of this frame, or ""
    std::string report; // file to write the state to at the end of this frame, or ""
};

// Read a script. Return an exit status, after printing any error.
int view_script_read(const std::string& path, view_script& out);

// Push the events of the next frame. Return an exit status. A label that no widget has is an error.
int view_script_feed(view_script& script, const view_gui& gui, SDL_Window* window);

#endif
