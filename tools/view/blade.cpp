// blade.cpp - A blade that the mouse draws across the picture. Its edge is a line of sight, which
// sweeps from one end of the line to the other.
#include "tools/view/blade.h"
#include "tools/view/camera.h"

#include <string.h>

namespace
{

constexpr float shortest = 2; // units of SDL

// Find the far end of the line of sight at a place of the window.
void find_far_end(const viewer& viewer, float x, float y, float out[3])
{
    const hair_scene& scene = *viewer.document.scene;
    const view_place& picture = viewer.picture;
    float width = picture.right - picture.left, height = picture.bottom - picture.top, ray[3];
    float far = view_camera_axes(scene).distance + 2 * viewer.session.reach;
    view_camera_ray(scene, (x - picture.left) / width, (y - picture.top) / height, width / height, ray);
    for (int i = 0; i < 3; ++i) out[i] = scene.eye[i] + viewer.session.way[i] + far * ray[i];
}

} // namespace

void view_blade_draw(const viewer& viewer)
{
    if (viewer.drag != VIEW_DRAG_BLADE) return;
    ImGui::GetBackgroundDrawList()->AddLine({viewer.blade[0], viewer.blade[1]},
                                            {viewer.mouse[0], viewer.mouse[1]}, IM_COL32(255, 255, 255, 220),
                                            0.1f * ImGui::GetFontSize());
}

void view_blade_cut(viewer& viewer, float x, float y)
{
    const view_place& picture = viewer.picture;
    float dx = x - viewer.blade[0], dy = y - viewer.blade[1];
    if (picture.right - picture.left < 1 || picture.bottom - picture.top < 1) return;
    if (dx * dx + dy * dy < shortest * shortest) return;
    hair_cut_desc cut = hair_cut_desc_default();
    cut.shape = HAIR_CUT_SHAPE_BLADE;
    for (int i = 0; i < 3; ++i)
        cut.start[i] = cut.last_start[i] = viewer.document.scene->eye[i] + viewer.session.way[i];
    find_far_end(viewer, viewer.blade[0], viewer.blade[1], cut.last_end);
    find_far_end(viewer, x, y, cut.end);
    // The reference of the motion has whole guides.
    if (viewer.motion_error.is_on) view_motion_error_end(viewer.motion_error, viewer.session);
    viewer.motion_error.is_on = false;
    uint32_t strands = 0;
    if (view_session_cut(viewer.session, cut, strands)) return;
    viewer_moved(viewer);
    viewer_say(viewer, "The blade cut " + std::to_string(strands) + " strands. R makes them whole.");
}
