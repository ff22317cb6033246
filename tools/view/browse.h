// browse.h - A list of the scenes, haircuts and meshes of a folder, to open one by a click.
#ifndef HAIR_TOOLS_VIEW_BROWSE_H
#define HAIR_TOOLS_VIEW_BROWSE_H

#include "tools/view/viewer.h"

// Show the button that opens the list, and the list while it is open.
void view_browse(viewer& viewer);

#endif
