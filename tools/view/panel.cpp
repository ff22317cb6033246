// panel.cpp - The panels of the window.
#include "tools/view/panel.h"
#include "tools/view/actions.h"
#include "tools/view/controls.h"
#include "tools/view/pareto.h"
#include "tools/view/scene_panel.h"
#include "tools/view/settings_panel.h"
#include "tools/view/strip.h"

#include <string.h>

#include <algorithm>

namespace
{

constexpr float left_width = 280, right_width = 370, strip_height = 166; // at scale 1
constexpr uint32_t message_frames = 300; // time that a message stays

void show_help_row(const char* key, const char* label)
{
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(key);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", label);
}

// Show the keys in three columns. A tooltip tells what a key does.
void show_keys()
{
    constexpr int columns = 3;
    int count = 0;
    while (view_actions()[count].label) ++count;
    int rows = (count + columns - 1) / columns;
    if (!ImGui::BeginTable("keys", 2 * columns, ImGuiTableFlags_SizingFixedFit)) return;
    for (int i = 0; i < rows * columns; ++i) {
        int at = i % columns * rows + i / columns;
        const view_action* action = at < count ? &view_actions()[at] : nullptr;
        show_help_row(action ? view_action_key_name(*action).c_str() : "", action ? action->label : "");
        if (action && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", action->about);
    }
    ImGui::EndTable();
}

void show_help(viewer& viewer)
{
    if (!viewer.shows_help) return;
    ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x, 0.96f * size.y});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("Keys and mouse", &viewer.shows_help,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    if (ImGui::BeginTable("mouse", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const view_mouse_help* row = view_mouse_controls(); row->gesture; ++row)
            show_help_row(row->gesture, row->about);
        ImGui::EndTable();
    }
    ImGui::Separator();
    show_keys();
    ImGui::End();
}

// Begin a panel between two edges of the window.
bool begin_panel(const char* name, float left, float top, float width, float height, bool is_flat = false)
{
    ImGui::SetNextWindowPos({left, top});
    ImGui::SetNextWindowSize({width, height});
    return ImGui::Begin(name, nullptr,
                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                            ImGuiWindowFlags_NoTitleBar | (is_flat ? ImGuiWindowFlags_NoScrollbar : 0) |
                            ImGuiWindowFlags_NoBringToFrontOnFocus);
}

void show_messages(const viewer& viewer)
{
    if (viewer.messages.empty() || viewer.frame - viewer.said > message_frames) return;
    const view_place& picture = viewer.picture;
    float margin = 10 * viewer.gui.scale;
    ImGui::SetNextWindowPos({0.5f * (picture.left + picture.right), picture.bottom - margin},
                            ImGuiCond_Always, {0.5f, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {picture.right - picture.left - 2 * margin, 1e6f});
    ImGui::Begin("Messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(0.9f * (picture.right - picture.left));
    ImGui::TextUnformatted(viewer.messages.back().c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

} // namespace

void view_panels(viewer& viewer)
{
    ImVec2 size = ImGui::GetIO().DisplaySize;
    float left = std::min(left_width * viewer.gui.scale, 0.3f * size.x);
    float right = std::min(right_width * viewer.gui.scale, 0.4f * size.x);
    float strip = std::min(strip_height * viewer.gui.scale, 0.3f * size.y);
    viewer.picture = {0, 0, size.x, size.y};
    if (viewer.shows_panels) viewer.picture = {left, 0, size.x - right, size.y};
    if (viewer.shows_panels && viewer.shows_strip) viewer.picture.bottom = size.y - strip;
    if (viewer.shows_panels) {
        if (begin_panel("Scene", 0, 0, left, size.y)) view_scene_panel(viewer);
        ImGui::End();
        if (begin_panel("Settings", size.x - right, 0, right, size.y)) view_settings_panel(viewer);
        ImGui::End();
    }
    if (viewer.shows_panels && viewer.shows_strip) {
        view_strip_update(viewer);
        if (begin_panel("Strip", left, size.y - strip, size.x - left - right, strip, true))
            view_strip(viewer);
        ImGui::End();
    }
    view_pareto_window(viewer);
    view_gl_messages_window(viewer.gl_messages);
    show_help(viewer);
    show_messages(viewer);
}

void view_hint(const viewer& viewer)
{
    if (!viewer.shows_panels) return;
    const view_place& picture = viewer.picture;
    float size = ImGui::GetFontSize();
    ImGui::GetBackgroundDrawList()->AddText({picture.left + 0.6f * size, picture.bottom - 1.5f * size},
                                            IM_COL32(255, 255, 255, 110),
                                            "Drag to orbit, Ctrl + drag to pull hair, ? for all keys");
}
