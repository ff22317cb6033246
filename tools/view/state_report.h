// state_report.h - The state of the window as JSON, for tests and for reports of defects.
#ifndef HAIR_TOOLS_VIEW_STATE_REPORT_H
#define HAIR_TOOLS_VIEW_STATE_REPORT_H

#include "tools/view/viewer.h"

// Write what is not in the scene: time, switches, held hair, and whether all guides are finite.
// Return an exit status, after printing any error.
int view_state_report(const viewer& viewer, const std::string& path);

#endif
