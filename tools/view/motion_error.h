// motion_error.h - Error of the motion, against a second head of hair under the accurate solver
// with short substeps.
#ifndef HAIR_TOOLS_VIEW_MOTION_ERROR_H
#define HAIR_TOOLS_VIEW_MOTION_ERROR_H

#include "tools/view/session.h"

struct view_motion_error {
    bool is_on = false;
    double rms = -1; // distance of vertices as a fraction of the length, below 0 if unknown
    double worst = 0; // of one guide
    uint32_t worst_guide = 0;
    float worst_tip[3] = {0, 0, 0}; // m
};

// Make the second head, and begin again with both heads at rest. Return an exit status.
int view_motion_error_begin(view_motion_error& error, view_session& session, const hair_scene& scene);
void view_motion_error_end(view_motion_error& error, view_session& session);

// Measure the error. The call waits for the GPU. Return an exit status.
int view_motion_error_update(view_motion_error& error, view_session& session, const hair_scene& scene);

#endif
