// image_error.h - Visible error of the picture at rest, against the mean of many pictures that are
// shifted by fractions of a pixel.
#ifndef HAIR_TOOLS_VIEW_IMAGE_ERROR_H
#define HAIR_TOOLS_VIEW_IMAGE_ERROR_H

#include "tools/view/session.h"

#include <atomic>
#include <thread>
#include <vector>

struct view_image_error {
    bool is_on = false;
    uint64_t motion = 0; // value of viewer.motion for which the reference holds
    uint32_t width = 0, height = 0;
    uint32_t pictures = 0; // in the sum
    std::vector<float> sum; // linear colours
    std::vector<float> reference, shown; // input of the thread
    std::thread thread; // computes FLIP
    std::atomic<bool> is_done{false};
    uint32_t samples = 0; // per pixel, of the reference of `flip`
    double next_flip = 0; // written by the thread
    double flip = -1; // mean FLIP, below 0 if it is unknown
};

constexpr uint32_t view_reference_samples = 1024; // per pixel

// Add a picture to the reference, and measure the error from time to time. `shown` is the picture
// in the window. `motion` differs whenever anything has moved. Return an exit status.
int view_image_error_update(view_image_error& error, view_session& session, const hair_scene& scene,
                            unsigned shown, uint64_t motion);
// Compute the reference as an encoded picture, with an empty result before the first picture.
void view_image_error_reference(const view_image_error& error, float exposure, std::vector<float>& out);

// Wait for the thread.
void view_image_error_finish(view_image_error& error);

#endif
