// budget.h - frame budget: what all instances of a context give up so that their GPU time stays
// within a limit.
#ifndef HAIR_API_BUDGET_H
#define HAIR_API_BUDGET_H

#include "lib/gl/frame_timer.h"

#define HAIR_BUDGET_MEASURED 5 // Frames whose second greatest time is compared with the budget.
#define HAIR_BUDGET_MAX_IMPORTANCE 1000.0f

struct hair_budget {
    float ms; // GPU time of a frame. 0 disables the budget.
    // Importance of views without a hair_lod, and factor of hair_lod.importance below 1.
    float importance;
    float target; // Importance that `importance` moves to, some per cent each frame.
    float max_importance; // Importance with which the last frame would have given up nothing.
    float wanted; // Importance with which the current frame, so far, gives up nothing.
    uint32_t sample_divisor; // Ratio of the samples of the framebuffer to those that are computed.
    uint32_t rate_changes; // Instances whose substep rate has changed in the current frame.
    bool has_drawn; // True once the current frame has drawn something.
    bool is_new; // True until the first call with OpenGL of the current frame.
    double frame_ms; // Time of the newest measured frame.
    double measured[HAIR_BUDGET_MEASURED]; // Newest times with the current importance.
    uint32_t measured_count;
    uint32_t settled; // Frame in which `importance` has last changed.
    uint32_t calm; // Number of frames in sequence that were well below the budget.
    double last_ms, last_importance; // Time and importance of the decision before. 0 before it.
    double elasticity; // Relative change of the time per relative change of the importance.
    struct hair_gl_frame_timer timer;
};

// State of an instance under a budget.
struct hair_budget_part {
    uint32_t stepped; // Frame in which the instance was stepped last.
    float pixels; // Diameter of the hair in views since then. 0 if no view has shown it.
};

// Start a budget. 0 disables it.
void hair_budget_start(struct hair_budget* budget, float ms);
// End the current frame of a budget that is enabled, and begin the next. OpenGL is not called.
void hair_budget_next_frame(struct hair_budget* budget);
// Read what the GPU has finished and adapt the importance, once in a frame.
void hair_budget_update(struct hair_gl* gl, struct hair_budget* budget);
// Return the power of two that multiplies the substep rate of an instance whose hair has this
// diameter in pixels. `rate` is the last result, or 1. At most two instances of a frame change.
float hair_budget_find_rate(struct hair_budget* budget, float pixels, float rate);
// Note that hair is drawn for which `importance` gives up nothing.
void hair_budget_note(struct hair_budget* budget, float importance);

#endif
