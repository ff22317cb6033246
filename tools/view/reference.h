// reference.h - Guides that the reference of tests/reference moves in double precision, on a thread
// of its own, beside those that are shown.
#ifndef HAIR_TOOLS_VIEW_REFERENCE_H
#define HAIR_TOOLS_VIEW_REFERENCE_H

#include "tools/view/session.h"

extern "C" {
#include "tools/view/guides.h"
}

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

// Comparison of the newest frame that the thread has finished.
struct view_reference_result {
    uint32_t frames = 0; // since the guides were at rest
    uint32_t followed = 0, free = 0; // guides, and those of them that have touched nothing
    double rms = -1; // distance of vertices as a fraction of the length, below 0 if unknown
    double worst = 0; // of one guide
    double energy = 0; // of a shown guide beyond that at rest, J, the mean of all free guides
    std::vector<float> worst_shown, worst_right; // its vertices, m
};

// Frame that the thread is to compute.
struct view_reference_frame {
    hair_reference_rod_pose head; // at its end
    double dt; // s
    double wind[3], drag;
    std::vector<double> shown; // vertices of all followed guides
    std::vector<bool> is_held; // guides that something else than the head holds
    std::vector<hair_collider> colliders; // without meshes, which another thread may free
};

// Guide that the thread follows.
struct view_followed {
    uint32_t guide; // index in the groom
    uint32_t first, count; // vertices in the groom
    size_t at; // first vertex in view_reference_frame.shown
    hair_reference_rod* right = nullptr; // moved by the reference
    hair_reference_rod* shown = nullptr; // with the shown positions, for its energy
    std::vector<double> before; // shown positions at the end of the last frame
    double length = 0, potential = 0, rest_energy = 0;
    bool is_free = true;
};

struct view_reference {
    std::vector<view_followed> guides;
    double margin = 0; // distance at which hair touches colliders, m
    double line_density = 0; // kg/m
    uint32_t generation = 0; // value of session.generation that the guides belong to
    std::thread thread;
    std::mutex mutex; // guards the members below
    std::condition_variable changed;
    std::deque<view_reference_frame> queue;
    bool is_busy = false, ends = false;
    size_t active = 0; // number of guides that the thread has time for
    view_reference_result result;
};

// Return why the reference cannot move the hair of a scene, or null.
const char* view_reference_obstacle(const hair_scene& scene);

// Follow up to `max_guides` guides of hair that is at rest.
void view_reference_begin(view_reference& reference, const view_session& session, const hair_scene& scene,
                          uint32_t max_guides);
void view_reference_end(view_reference& reference);

// Add a frame, at the end of which the guides have the given positions. The thread follows fewer
// guides if it falls behind.
void view_reference_add(view_reference& reference, const view_session& session, const hair_scene& scene,
                        const std::vector<float>& positions, double dt);

// Wait until the thread has finished all frames.
void view_reference_wait(view_reference& reference);

// Return the newest result.
view_reference_result view_reference_newest(view_reference& reference);

#endif
