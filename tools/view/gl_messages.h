// gl_messages.h - Messages of OpenGL in a window.
#ifndef HAIR_TOOLS_VIEW_GL_MESSAGES_H
#define HAIR_TOOLS_VIEW_GL_MESSAGES_H

#include <deque>
#include <string>

struct view_gl_message {
    std::string text; // with kind and source
    unsigned severity;
    unsigned count; // number of times in a row
};

struct view_gl_messages {
    bool shows = false;
    bool has_notes = false; // the list shows notifications too
    std::deque<view_gl_message> list; // newest last
};

// Listen to the messages of the current context. Messages of a context without the debug flag are
// those that its driver chooses to give.
void view_gl_messages_listen(view_gl_messages& messages);
void view_gl_messages_ignore();

// Show the window of the messages.
void view_gl_messages_window(view_gl_messages& messages);

#endif
