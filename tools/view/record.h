// record.h - Pictures and films of the window.
#ifndef HAIR_TOOLS_VIEW_RECORD_H
#define HAIR_TOOLS_VIEW_RECORD_H

#include "tools/view/viewer.h"

// Write the window as .png. Return an exit status, after printing any error.
int view_write_picture(const viewer& viewer, const std::string& path);

// Begin a film of the window, .mp4. Return an exit status.
int view_record_begin(viewer& viewer, const std::string& path);
// Return whether the film takes this frame.
bool view_record_is_due(const viewer& viewer);
// Add the window to the film, if there is one. A resized window ends the film.
int view_record_frame(viewer& viewer);
// End the film and keep the file. Return an exit status.
int view_record_end(viewer& viewer);

// Return a file name of the form hair-view-N.ENDING that does not exist yet.
std::string view_new_name(const char* ending);

#endif
