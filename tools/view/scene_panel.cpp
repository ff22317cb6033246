// scene_panel.cpp - The panel of files, presets and actions.
#include "tools/view/scene_panel.h"
#include "tools/view/actions.h"
#include "tools/view/browse.h"
#include "tools/view/debug_draw.h"
#include "tools/view/hair_actions.h"

#include <imgui_stdlib.h>

#include <string.h>

extern "C" {
#include "tools/common/builtin.h"
}

namespace
{

// Show a list of names. Return the chosen name, or null if there is none in this frame.
const char* show_names(viewer& viewer, const char* label, const char* present, const char* (*name)(int))
{
    const char* chosen = nullptr;
    ImGui::SetNextItemWidth(-0.38f * ImGui::GetWindowWidth());
    bool is_open = ImGui::BeginCombo(label, present, ImGuiComboFlags_HeightLarge);
    view_gui_mark(viewer.gui, label);
    if (!is_open) return nullptr;
    for (int i = 0; name(i); ++i) {
        if (ImGui::Selectable(name(i), !strcmp(name(i), present))) chosen = name(i);
        view_gui_mark(viewer.gui, name(i));
    }
    ImGui::EndCombo();
    return chosen;
}

const char* scene_name(int i)
{
    return hair_builtin_scenes[i].name;
}
const char* style_name(int i)
{
    return i < HAIR_STYLE_COUNT ? hair_style_name((hair_style)i) : nullptr;
}
const char* motion_name(int i)
{
    return hair_builtin_motions[i].name;
}
const char* preset_name(int i)
{
    return hair_preset_name((hair_preset)i);
}
const char* look_name(int i)
{
    return hair_look_name((hair_look_preset)i);
}
const char* color_name(int i)
{
    return hair_color_name((hair_color)i);
}

void show_files(viewer& viewer)
{
    ImGui::SetNextItemWidth(-2.4f * ImGui::GetFontSize());
    ImGui::InputTextWithHint("##path", "file to open, or to save the scene as", &viewer.path);
    view_gui_mark(viewer.gui, "File");
    ImGui::SameLine(0, 0.3f * ImGui::GetFontSize());
    view_browse(viewer);
}

void show_presets(viewer& viewer)
{
    hair_scene& scene = *viewer.document.scene;
    bool is_style = scene.subject == HAIR_SUBJECT_STYLE;
    const char* chosen = show_names(viewer, "Scene", "open ...", scene_name);
    if (chosen) viewer_open_named(viewer, chosen);
    hair_scene& now = *viewer.document.scene;
    chosen = show_names(viewer, "Haircut", is_style ? hair_style_name(now.settings.style.style) : "file",
                        style_name);
    if (chosen) hair_scene_set_style(TOOL, chosen, &now);
    chosen = show_names(viewer, "Motion", "choose ...", motion_name);
    if (chosen) hair_scene_set_motion(TOOL, chosen, &now);
    static const struct {
        const char *label, *key;
        const char* (*name)(int);
    } rows[] = {
        {"Kind", "preset", preset_name}, {"Shape", "look", look_name}, {"Colour", "color", color_name}};
    for (const auto& row : rows) {
        chosen = show_names(viewer, row.label, "choose ...", row.name);
        if (chosen) hair_settings_set(TOOL, &now.settings, row.key, chosen);
    }
}

// Show one action as a switch or a button.
void show_action(viewer& viewer, const view_action& action)
{
    bool is_on = action.is_on && action.is_on(viewer);
    bool is_pressed =
        action.is_on ? ImGui::Checkbox(action.label, &is_on) : ImGui::Button(action.label, {-1, 0});
    view_gui_mark(viewer.gui, action.label);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\nKey: %s", action.about, view_action_key_name(action).c_str());
    if (is_pressed) action.run(viewer);
}

// Show a slider of a setting of levels of detail.
void show_level(viewer& viewer, const char* label, float* value, float min, float max)
{
    ImGui::SetNextItemWidth(-0.45f * ImGui::GetWindowWidth());
    ImGui::SliderFloat(label, value, min, max, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    view_gui_mark(viewer.gui, label);
}

// Show the list of debug views, and the position of a slice.
void show_debug(viewer& viewer)
{
    int& mode = viewer.debug.mode;
    const char* chosen = show_names(viewer, "Debug", view_debug_name(mode), view_debug_name);
    for (int i = 0; chosen && view_debug_name(i); ++i)
        if (chosen == view_debug_name(i)) view_debug_select(viewer, i);
    if (mode < VIEW_DEBUG_FIELD_X) return;
    show_level(viewer, "Slice at", &viewer.document.scene->settings.view.slice_at, 0, 1);
}

void show_sliders(viewer& viewer, const char* group)
{
    hair_settings& settings = viewer.document.scene->settings;
    if (!strcmp(group, "Show")) show_debug(viewer);
    if (!strcmp(group, "Detail") && settings.has_lod && settings.lod.per_patch) {
        // The camera moves these sliders.
        view_levels levels = view_present_levels(viewer);
        ImGui::BeginDisabled();
        show_level(viewer, "Strands", &levels.strands, 0.01f, 1);
        show_level(viewer, "Segments", &levels.segments, 0.05f, 1);
        ImGui::EndDisabled();
        show_level(viewer, "Strand px", &settings.lod.strand_pixels, 0.05f, 4);
        show_level(viewer, "Segment px", &settings.lod.segment_pixels, 1, 40);
    } else if (!strcmp(group, "Detail")) {
        show_level(viewer, "Strands", &settings.lod.strand_fraction, 0.01f, 1);
        show_level(viewer, "Segments", &settings.lod.segment_fraction, 0.05f, 1);
    } else if (!strcmp(group, "Wind")) {
        float speed = view_wind_speed(*viewer.document.scene), old = speed;
        show_level(viewer, "Speed, m/s", &speed, 0, 20);
        if (speed != old) view_set_wind_speed(viewer, speed);
    }
}

} // namespace

void view_scene_panel(viewer& viewer)
{
    const char* group = "";
    for (const view_action* action = view_actions(); action->label; ++action) {
        if (strcmp(action->group, group)) {
            if (*group) ImGui::EndTable();
            if (*group) show_sliders(viewer, group);
            group = action->group;
            ImGui::TextDisabled("%s", group);
            if (!strcmp(group, "Scene")) {
                show_files(viewer);
                show_presets(viewer);
            }
            ImGui::BeginTable(group, 2, ImGuiTableFlags_SizingStretchSame);
        }
        ImGui::TableNextColumn();
        show_action(viewer, *action);
    }
    ImGui::EndTable();
}
