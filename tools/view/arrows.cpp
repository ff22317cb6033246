// arrows.cpp - Arrows of light and wind over the picture.
#include "tools/view/arrows.h"
#include "tools/view/camera.h"
#include "tools/view/hair_actions.h"

#include <math.h>
#include <stdio.h>

#include <algorithm>

namespace
{

void draw(const viewer& viewer, const float from[3], const float to[3], ImU32 color, const char* text)
{
    ImVec2 a, b;
    if (!view_project(viewer, from, a) || !view_project(viewer, to, b)) return;
    float scale = viewer.gui.scale, x = b.x - a.x, y = b.y - a.y, length = sqrtf(x * x + y * y);
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    if (length > 1) {
        x *= 7 * scale / length;
        y *= 7 * scale / length;
        list->AddLine(a, {b.x - x, b.y - y}, color, 3 * scale);
        list->AddTriangleFilled(b, {b.x - 2 * x + y, b.y - 2 * y - x}, {b.x - 2 * x - y, b.y - 2 * y + x},
                                color);
    } else {
        list->AddCircleFilled(b, 5 * scale, color);
    }
    list->AddText({a.x + 6 * scale, a.y + 4 * scale}, color, text);
}

// Draw the vertices of a guide as a line. Return the place of its tip.
ImVec2 draw_guide(const viewer& viewer, const std::vector<float>& vertices, ImU32 color)
{
    ImVec2 last = {0, 0}, next;
    bool has_last = false;
    for (size_t i = 0; i + 2 < vertices.size(); i += 3) {
        bool is_seen = view_project(viewer, &vertices[i], next);
        if (is_seen && has_last)
            ImGui::GetBackgroundDrawList()->AddLine(last, next, color, 2.5f * viewer.gui.scale);
        has_last = is_seen;
        last = next;
    }
    return last;
}

// Draw the guide with the largest error of motion, and its reference.
void draw_worst(const viewer& viewer)
{
    const view_reference_result& result = viewer.motion_error.free;
    const ImU32 red = IM_COL32(255, 90, 80, 255), green = IM_COL32(90, 220, 130, 255);
    if (!viewer.motion_error.is_on || result.rms < 0 || result.worst_shown.empty()) return;
    float gap = 8 * viewer.gui.scale;
    ImVec2 right = draw_guide(viewer, result.worst_right, green);
    ImVec2 tip = draw_guide(viewer, result.worst_shown, red);
    ImGui::GetBackgroundDrawList()->AddCircle(tip, gap, red, 0, 2 * viewer.gui.scale);
    ImGui::GetBackgroundDrawList()->AddText({tip.x + 1.5f * gap, tip.y - gap}, red, "worst motion");
    ImGui::GetBackgroundDrawList()->AddText({right.x + 1.5f * gap, right.y + gap}, green, "reference");
}

} // namespace

bool view_project(const viewer& viewer, const float point[3], ImVec2& out)
{
    const hair_scene& scene = *viewer.document.scene;
    const view_place& picture = viewer.picture;
    view_axes axes = view_camera_axes(scene);
    float x = 0, y = 0, depth = 0;
    for (int i = 0; i < 3; ++i) {
        float offset = point[i] - scene.eye[i] - viewer.session.way[i];
        x += offset * axes.right[i];
        y += offset * axes.up[i];
        depth -= offset * axes.back[i];
    }
    if (depth < 1e-4f) return false;
    float height = picture.bottom - picture.top;
    float unit = height / (2 * depth * tanf(scene.field_of_view * 0.00872664626f));
    out = {0.5f * (picture.left + picture.right) + unit * x,
           0.5f * (picture.top + picture.bottom) - unit * y};
    return true;
}

void view_arrows(const viewer& viewer)
{
    const hair_scene& scene = *viewer.document.scene;
    float centre[3], from[3], to[3], towards[3], speed = view_wind_speed(scene);
    float size = 0.3f * view_camera_height(scene);
    hair_camera_pivot(&scene, viewer.session.transform, centre);
    draw_worst(viewer);
    if (viewer.drag == VIEW_DRAG_LIGHT) {
        hair_light_direction(&scene, towards);
        for (int i = 0; i < 3; ++i) {
            from[i] = centre[i] + 1.25f * size * towards[i];
            to[i] = centre[i] + 0.45f * size * towards[i];
        }
        draw(viewer, from, to, IM_COL32(255, 205, 90, 255), "light");
    }
    if (speed > 0 && (viewer.drag == VIEW_DRAG_WIND || viewer.shows_panels)) {
        char text[48];
        snprintf(text, sizeof text, "wind %.1f m/s", (double)speed);
        float length = size * (0.4f + 0.6f * std::min(speed / 10, 1.0f));
        for (int i = 0; i < 3; ++i) {
            float along = scene.settings.wind.velocity[i] / speed;
            from[i] = centre[i] - 1.2f * size * along;
            to[i] = from[i] + length * along;
        }
        draw(viewer, from, to, IM_COL32(110, 190, 255, 255), text);
    }
}
