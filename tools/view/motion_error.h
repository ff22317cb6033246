// motion_error.h - Error of the motion: against the reference where hair is free, and against a
// second head of hair under the accurate solver with short substeps, which has contacts too.
#ifndef HAIR_TOOLS_VIEW_MOTION_ERROR_H
#define HAIR_TOOLS_VIEW_MOTION_ERROR_H

#include "tools/view/reference.h"

struct view_motion_error {
    bool is_on = false;
    view_reference reference;
    const char* obstacle = nullptr; // why there is no reference, or null
    view_reference_result free; // newest result of the reference
    hair_physics physics = {}; // of the measurement
    double dt = 0; // time that the hair has not advanced yet, s
    uint32_t frames = 0; // since the hair was at rest
    // Distance from the second head as a fraction of the length, below 0 if unknown.
    double rms = -1;
    double worst = 0; // of one guide
};

// Begin the measurement with hair at rest if nothing is measured, or if the physics has changed.
// Return an exit status.
int view_motion_error_prepare(view_motion_error& error, view_session& session, const hair_scene& scene);
void view_motion_error_end(view_motion_error& error, view_session& session);

// Return the part of a time, in s, by which the hair must advance now, in whole frames of 1/60 s.
// The library computes no positions between its substeps.
double view_motion_error_frames(view_motion_error& error, double dt);

// Measure the error after the hair has advanced by `dt`. The call waits for the GPU, and for the
// reference too if `waits`. Return an exit status.
int view_motion_error_update(view_motion_error& error, view_session& session, const hair_scene& scene,
                             double dt, bool waits);

#endif
