// capture_outputs.c - What hair-capture writes: frames, and the positions of strands.
#include "tools/common/capture_outputs.h"

int hair_capture_outputs_plan(const char* tool, const struct hair_capture_options* options,
                              struct hair_capture_outputs* outputs)
{
    return hair_frame_writer_plan(tool, options->out, options->scene.width, options->scene.height,
                                  options->end - options->first, &outputs->frames);
}

int hair_capture_outputs_open(const char* tool, const struct hair_capture_options* options,
                              hair_instance* hair, struct hair_capture_outputs* outputs)
{
    double fps = (double)options->scene.fps;
    struct hair_dump_frames frames = {options->first, options->end - options->first, fps};
    if (!hair_frame_writer_open(&outputs->frames, fps)) return HAIR_EXIT_RUNTIME;
    int code = hair_dump_open(tool, options->dump_guides, HAIR_READ_SMOOTH, hair, &frames, &outputs->guides);
    if (code) return code;
    return hair_dump_open(tool, options->dump_followers, HAIR_READ_FOLLOWERS, hair, &frames,
                          &outputs->followers);
}

int hair_capture_outputs_dump(struct hair_capture_outputs* outputs, hair_instance* hair)
{
    int code = hair_dump_put(&outputs->guides, hair);
    return code ? code : hair_dump_put(&outputs->followers, hair);
}

int hair_capture_outputs_commit(struct hair_capture_outputs* outputs)
{
    int code = hair_frame_writer_commit(&outputs->frames) ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
    struct hair_dump* dumps[] = {&outputs->guides, &outputs->followers};
    for (int i = 0; i < 2; ++i)
        if (code)
            hair_dump_discard(dumps[i]);
        else
            code = hair_dump_commit(dumps[i]);
    return code;
}

void hair_capture_outputs_discard(struct hair_capture_outputs* outputs)
{
    hair_frame_writer_discard(&outputs->frames);
    hair_dump_discard(&outputs->guides);
    hair_dump_discard(&outputs->followers);
}
