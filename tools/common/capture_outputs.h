// capture_outputs.h - What hair-capture writes: frames, and the positions of strands.
#ifndef HAIR_TOOLS_COMMON_CAPTURE_OUTPUTS_H
#define HAIR_TOOLS_COMMON_CAPTURE_OUTPUTS_H

#include "tools/common/capture_options.h"
#include "tools/common/dump.h"
#include "tools/common/frame_writer.h"

struct hair_capture_outputs {
    struct hair_frame_writer frames;
    struct hair_dump guides, followers;
};

// Choose the output of frames. These functions return an exit status for the tool, after printing
// any error.
int hair_capture_outputs_plan(const char* tool, const struct hair_capture_options* options,
                              struct hair_capture_outputs* outputs);
// Open all outputs. Then call exactly one of hair_capture_outputs_commit() and
// hair_capture_outputs_discard(), also after an error.
int hair_capture_outputs_open(const char* tool, const struct hair_capture_options* options,
                              hair_instance* hair, struct hair_capture_outputs* outputs);
// Write the positions of strands in a frame, if they are wanted.
int hair_capture_outputs_dump(struct hair_capture_outputs* outputs, hair_instance* hair);
// Complete all outputs. If one cannot be completed, discard those that are left.
int hair_capture_outputs_commit(struct hair_capture_outputs* outputs);
void hair_capture_outputs_discard(struct hair_capture_outputs* outputs);

#endif
