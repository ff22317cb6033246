// view.cpp - hair-view, which shows hair in a window with every option in a panel.
#include "tools/view/viewer.h"

#include <memory>

int main(int count, char** arguments)
{
    auto state = std::make_unique<viewer>();
    int code = view_options_parse(count, arguments, state->options);
    if (code < 0) return viewer_run(*state);
    hair_scene_free(&state->options.scene);
    return code;
}
