// gizmo.cpp - Handles of colliders: arrows that move them along an axis, and rings that turn them.
#include "tools/view/gizmo.h"
#include "tools/view/arrows.h"
#include "tools/view/camera.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr float arrow = 0.16f, ring = 0.11f; // fractions of the picture's height
constexpr float reach = 7; // distance at which the mouse takes a handle, at scale 1
constexpr int ring_parts = 40;

struct handle_points {
    std::vector<ImVec2> at; // line in the window
    ImVec2 centre;
};

float distance_to_line(ImVec2 p, ImVec2 a, ImVec2 b)
{
    float x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    float t = square > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0f, 1.0f) : 0;
    return hypotf(p.x - a.x - t * x, p.y - a.y - t * y);
}

bool is_shown(const viewer& viewer)
{
    return viewer.document.scene->show & HAIR_SHOW_COLLIDERS;
}

// Balls are the same after a turn.
bool has_rings(const hair_collider& collider)
{
    return collider.shape != HAIR_SHAPE_SPHERE;
}

// Return the length in metres at a point that a fraction of the picture's height covers.
float length_at(const viewer& viewer, const float point[3], float fraction)
{
    const hair_scene& scene = *viewer.document.scene;
    view_axes axes = view_camera_axes(scene);
    float depth = 0;
    for (int i = 0; i < 3; ++i) depth += (scene.eye[i] + viewer.session.way[i] - point[i]) * axes.back[i];
    return fraction * view_camera_height(scene) * std::max(depth / axes.distance, 0.0f);
}

// Find the line of a handle in the window. Return false if a part of it is behind the camera.
bool find_points(const viewer& viewer, const view_handle& handle, handle_points& out)
{
    const hair_scene& scene = *viewer.document.scene;
    hair_collider collider = view_collider_now(viewer, scene.colliders[handle.collider]);
    float size = length_at(viewer, collider.position, handle.is_ring ? ring : arrow);
    int parts = handle.is_ring ? ring_parts : 1;
    if (!view_project(viewer, collider.position, out.centre)) return false;
    out.at.clear();
    for (int i = 0; i <= parts; ++i) {
        float point[3], angle = 6.2831853f * (float)i / (float)parts;
        memcpy(point, collider.position, sizeof point);
        if (handle.is_ring) {
            point[(handle.axis + 1) % 3] += size * cosf(angle);
            point[(handle.axis + 2) % 3] += size * sinf(angle);
        } else {
            point[handle.axis] += size * (float)i;
        }
        ImVec2 at;
        if (!view_project(viewer, point, at)) return false;
        out.at.push_back(at);
    }
    return true;
}

// Call a function with every handle and its line in the window.
template <class F> void for_handles(const viewer& viewer, F&& call)
{
    const hair_scene& scene = *viewer.document.scene;
    handle_points points;
    if (!is_shown(viewer)) return;
    for (uint32_t i = 0; i < scene.collider_count; ++i)
        for (int k = 0; k < 6; ++k) {
            view_handle handle = {(int)i, k % 3, k > 2};
            if (handle.is_ring && !has_rings(scene.colliders[i].collider)) continue;
            if (find_points(viewer, handle, points)) call(handle, points);
        }
}

// Multiply quaternions, whose last element is real: `out` = a b.
void multiply(const float a[4], const float b[4], float out[4])
{
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[3] * b[i] + b[3] * a[i] + a[j] * b[k] - a[k] * b[j];
    }
    out[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

// Turn a direction of the world into the space that the collider is placed in.
void to_local(const viewer& viewer, const hair_scene_collider& collider, const float world[3], float out[3])
{
    const float* m = viewer.session.transform;
    for (int i = 0; i < 3; ++i)
        out[i] = collider.stays ? world[i]
                                : m[4 * i] * world[0] + m[4 * i + 1] * world[1] + m[4 * i + 2] * world[2];
}

void turn_collider(const viewer& viewer, hair_scene_collider& collider, int axis, float angle)
{
    float world[3] = {0, 0, 0}, local[3], turn[4], result[4], square = 0;
    world[axis] = 1;
    to_local(viewer, collider, world, local);
    for (int i = 0; i < 3; ++i) turn[i] = sinf(0.5f * angle) * local[i];
    turn[3] = cosf(0.5f * angle);
    multiply(turn, collider.collider.rotation, result);
    for (float v : result) square += v * v;
    for (int i = 0; i < 4 && square > 0; ++i) collider.collider.rotation[i] = result[i] / sqrtf(square);
}

bool is_equal(const view_handle& a, const view_handle& b)
{
    return a.collider == b.collider && a.axis == b.axis && a.is_ring == b.is_ring;
}

} // namespace

hair_collider view_collider_now(const viewer& viewer, const hair_scene_collider& from)
{
    hair_collider collider = hair_scene_collider_at(&from, (float)viewer.session.time);
    if (!from.stays) hair_collider_carry(viewer.session.transform, 1, &collider);
    return collider;
}

void view_move_collider(const viewer& viewer, hair_scene_collider& collider, const float by[3])
{
    float local[3], *position = collider.collider.position;
    to_local(viewer, collider, by, local);
    for (int i = 0; i < 3; ++i) position[i] = std::clamp(position[i] + local[i], -1e5f, 1e5f);
}

view_handle view_find_handle(const viewer& viewer, float x, float y)
{
    view_handle found;
    float best = reach * viewer.gui.scale;
    for_handles(viewer, [&](const view_handle& handle, const handle_points& points) {
        for (size_t i = 1; i < points.at.size(); ++i) {
            float distance = distance_to_line({x, y}, points.at[i - 1], points.at[i]);
            if (distance >= best) continue;
            best = distance;
            found = handle;
        }
    });
    return found;
}

void view_pull_handle(viewer& viewer, float x, float y)
{
    hair_scene& scene = *viewer.document.scene;
    const view_handle& handle = viewer.handle;
    handle_points points;
    if (handle.collider < 0 || handle.collider >= (int)scene.collider_count ||
        !find_points(viewer, handle, points))
        return;
    hair_scene_collider& collider = scene.colliders[handle.collider];
    if (handle.is_ring) {
        float before = atan2f(points.centre.y - viewer.mouse[1], viewer.mouse[0] - points.centre.x);
        float angle = std::remainder(atan2f(points.centre.y - y, x - points.centre.x) - before, 6.2831853f);
        bool is_away = view_camera_axes(scene).back[handle.axis] < 0;
        turn_collider(viewer, collider, handle.axis, is_away ? -angle : angle);
        return;
    }
    float ax = points.at[1].x - points.at[0].x, ay = points.at[1].y - points.at[0].y;
    float square = ax * ax + ay * ay, by[3] = {0, 0, 0};
    if (square < 1) return; // The arrow points at the camera.
    hair_collider now = view_collider_now(viewer, collider);
    by[handle.axis] = length_at(viewer, now.position, arrow) *
                      ((x - viewer.mouse[0]) * ax + (y - viewer.mouse[1]) * ay) / square;
    view_move_collider(viewer, collider, by);
}

void view_mark_handles(viewer& viewer)
{
    for_handles(viewer, [&](const view_handle& handle, const handle_points& points) {
        // A ring is taken between two arrows, and an arrow at its tip.
        ImVec2 at = points.at[handle.is_ring ? ring_parts / 8 : 1];
        std::string label = std::string(handle.is_ring ? "Ring " : "Arrow ") +
                            std::to_string(handle.collider) + " " + "xyz"[handle.axis];
        viewer.gui.next_places[label] = {at.x - 1, at.y - 1, at.x + 1, at.y + 1};
    });
}

void view_draw_handles(const viewer& viewer)
{
    static const ImU32 colors[3] = {IM_COL32(240, 80, 80, 255), IM_COL32(110, 210, 90, 255),
                                    IM_COL32(90, 140, 255, 255)};
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    ImVec2 mouse = ImGui::GetIO().MousePos;
    view_handle hot = viewer.drag == VIEW_DRAG_HANDLE ? viewer.handle
                      : viewer.drag == VIEW_DRAG_NONE ? view_find_handle(viewer, mouse.x, mouse.y)
                                                      : view_handle{};
    float scale = viewer.gui.scale;
    for_handles(viewer, [&](const view_handle& handle, const handle_points& points) {
        ImU32 color = is_equal(handle, hot) ? IM_COL32(255, 225, 90, 255) : colors[handle.axis];
        list->AddPolyline(points.at.data(), (int)points.at.size(), color, 0, 2.5f * scale);
        if (!handle.is_ring) list->AddCircleFilled(points.at[1], 5 * scale, color);
    });
}
