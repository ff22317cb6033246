// panel.cpp - The panels of the window.
#include "tools/view/panel.h"
#include "tools/view/actions.h"
#include "tools/view/controls.h"

namespace
{

void show_help(viewer& viewer)
{
    if (!viewer.shows_help) return;
    ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Keys and mouse", &viewer.shows_help,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    if (ImGui::BeginTable("keys", 3, ImGuiTableFlags_SizingFixedFit)) {
        for (const view_mouse_help* row = view_mouse_controls(); row->gesture; ++row) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(row->gesture);
            ImGui::TableNextColumn();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(row->about);
        }
        for (const view_action* action = view_actions(); action->label; ++action) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(view_action_key_name(*action).c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(action->label);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", action->about);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void show_actions(viewer& viewer)
{
    ImGui::SetNextWindowPos({10 * viewer.gui.scale, 10 * viewer.gui.scale}, ImGuiCond_FirstUseEver);
    ImGui::Begin("hair-view", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    for (const view_action* action = view_actions(); action->label; ++action) {
        bool is_on = action->is_on && action->is_on(viewer);
        bool is_pressed =
            action->is_on ? ImGui::Checkbox(action->label, &is_on) : ImGui::Button(action->label);
        view_gui_mark(viewer.gui, action->label);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s\nKey: %s", action->about, view_action_key_name(*action).c_str());
        if (is_pressed) action->run(viewer);
    }
    ImGui::End();
}

} // namespace

void view_panels(viewer& viewer)
{
    if (viewer.shows_panels) show_actions(viewer);
    show_help(viewer);
}
