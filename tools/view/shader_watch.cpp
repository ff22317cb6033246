// shader_watch.cpp - Shaders of a folder that are compiled again when a file changes.
#include "tools/view/shader_watch.h"

#include <ftw.h>
#include <sys/stat.h>

#include <algorithm>

namespace
{

uint64_t newest; // of the walk that is under way, ns

int look_at(const char* path, const struct stat* status, int kind, struct FTW* place)
{
    (void)path, (void)place;
    uint64_t time = (uint64_t)status->st_mtim.tv_sec * 1000000000u + (uint64_t)status->st_mtim.tv_nsec;
    if (kind == FTW_F) newest = std::max(newest, time);
    return 0;
}

uint64_t find_newest(const std::string& folder)
{
    newest = 0;
    nftw(folder.c_str(), look_at, 8, FTW_PHYS);
    return newest;
}

} // namespace

void view_reload_shaders(viewer& viewer)
{
    if (viewer.options.glsl.empty()) {
        viewer_say(viewer, "Start hair-view with --glsl FOLDER, the folder of the shaders.");
        return;
    }
    viewer.shaders = find_newest(viewer.options.glsl);
    if (!hair_context_reload(viewer.session.context)) viewer_say(viewer, "Compiled all shaders again.");
    viewer_moved(viewer);
}

void view_watch_shaders(viewer& viewer)
{
    if (viewer.options.glsl.empty()) return;
    uint64_t now = find_newest(viewer.options.glsl);
    if (viewer.shaders && now != viewer.shaders) view_reload_shaders(viewer);
    viewer.shaders = now;
}
