// compare.cpp - The picture with earlier settings beside that with the present ones, with a wipe.
#include "tools/view/compare.h"

#include <epoxy/gl.h>

#include <math.h>

#include <algorithm>

namespace
{

constexpr float reach = 8; // distance at which the mouse takes the line, at scale 1

float line_of(const viewer& viewer)
{
    const view_place& picture = viewer.picture;
    return picture.left + viewer.wipe * (picture.right - picture.left);
}

// Return the present scene with the earlier settings of look and view.
std::unique_ptr<hair_scene> scene_of(const viewer& viewer)
{
    auto scene = std::make_unique<hair_scene>(*viewer.document.scene);
    const hair_scene& earlier = *viewer.compared;
    scene->settings.look = earlier.settings.look;
    scene->settings.view = earlier.settings.view;
    scene->settings.light = earlier.settings.light;
    scene->settings.lod = earlier.settings.lod;
    scene->settings.has_lod = earlier.settings.has_lod;
    scene->settings.hides = earlier.settings.hides;
    scene->lights = earlier.lights;
    scene->shadow = earlier.shadow;
    scene->exposure = earlier.exposure;
    scene->show = earlier.show;
    return scene;
}

} // namespace

void view_toggle_compare(viewer& viewer)
{
    if (viewer.compared)
        viewer.compared.reset();
    else
        viewer.compared = std::make_unique<hair_scene>(*viewer.document.scene);
    viewer.is_full = false;
    if (viewer.compared) viewer_say(viewer, "The left side keeps these settings. Drag the line.");
}

bool view_compares(const viewer& viewer)
{
    return viewer.compared != nullptr;
}

int view_compare_draw(viewer& viewer, uint32_t width, uint32_t height, const view_quality& quality)
{
    view_session& session = viewer.session;
    hair_render* present = session.render;
    int code = view_session_draw(session, *scene_of(viewer), width, height, quality, VIEW_RENDER_COMPARED);
    unsigned texture = session.render ? hair_render_texture(session.render) : 0;
    session.render = present;
    if (code) return code;
    const view_place& picture = viewer.picture;
    float line = line_of(viewer), scale = viewer.gui.scale;
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddImage((ImTextureID)(intptr_t)texture, {picture.left, picture.top}, {line, picture.bottom},
                   {0, 0}, {viewer.wipe, 1});
    list->AddLine({line, picture.top}, {line, picture.bottom}, IM_COL32(255, 255, 255, 200), 2 * scale);
    list->AddText({std::max(line - 60 * scale, picture.left), picture.top + 8 * scale},
                  IM_COL32(255, 255, 255, 220), "earlier");
    list->AddText({line + 8 * scale, picture.top + 8 * scale}, IM_COL32(255, 255, 255, 220), "now");
    return HAIR_EXIT_OK;
}

bool view_is_on_wipe(const viewer& viewer, float x, float y)
{
    return viewer.compared && fabsf(x - line_of(viewer)) < reach * viewer.gui.scale &&
           y >= viewer.picture.top && y < viewer.picture.bottom;
}

void view_move_wipe(viewer& viewer, float x)
{
    float width = std::max(viewer.picture.right - viewer.picture.left, 1.0f);
    viewer.wipe = std::clamp((x - viewer.picture.left) / width, 0.0f, 1.0f);
}
