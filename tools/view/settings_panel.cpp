// settings_panel.cpp - The panel of all settings, made from the table of the library's members.
#include "tools/view/settings_panel.h"

#include <imgui_stdlib.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <algorithm>
#include <set>

extern "C" {
#include "tools/common/settings_keys.h"
}

namespace
{

// Settings of a heading. The key of a whole vector or colour is that of its elements without the
// last name.
struct row {
    hair_setting setting;
    std::string key; // of the row
    int elements; // 1 for a row of one setting
};

const char* heading_of(const hair_setting& setting)
{
    if (setting.group >= 0) return "Groups";
    switch (setting.kind) {
    case HAIR_STRUCT_IMPORT:
    case HAIR_STRUCT_STYLE_DESC:
    case HAIR_STRUCT_GROOM_DESC: return "Cut";
    case HAIR_STRUCT_DESC:
    case HAIR_STRUCT_PHYSICS: return "Physics";
    case HAIR_STRUCT_WIND: return "Flow";
    case HAIR_STRUCT_LOOK: return "Look";
    case HAIR_STRUCT_LOD: return "LOD";
    default: return "View";
    }
}

const std::vector<row>& rows()
{
    static std::vector<row> all;
    std::set<std::string> known;
    hair_setting setting;
    if (!all.empty()) return all;
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        bool is_element = setting.member.elements;
        std::string key = setting.key;
        if (is_element) key.erase(key.find_last_of('.'));
        if (!known.insert(key).second) continue;
        all.push_back({setting, key, is_element ? (int)setting.member.count : 1});
    }
    return all;
}

bool contains(const char* text, const std::string& word)
{
    for (const char* at = text; *at; ++at)
        if (!strncasecmp(at, word.c_str(), word.size())) return true;
    return word.empty();
}

// Return the bytes of a row in the settings, and their number.
char* bytes_of(const row& row, hair_settings& settings, size_t& size)
{
    char* bytes = (char*)hair_setting_bytes(&row.setting, &settings, &size);
    if (row.elements > 1) size = row.setting.member.size * (size_t)row.elements;
    return bytes;
}

// Set elements of a row to the text of each, as --set does.
void set(viewer& viewer, const row& row, const float* values, int count)
{
    char text[32];
    for (int i = 0; i < count; ++i) {
        std::string key = row.key;
        if (row.elements > 1) key = key + "." + row.setting.member.elements[i];
        snprintf(text, sizeof text, "%.9g", (double)values[i]);
        hair_settings_set(TOOL, &viewer.document.scene->settings, key.c_str(), text);
    }
}

bool show_slider(const hair_member& member, float* value)
{
    std::string format = std::string("%.4g ") + member.unit;
    float low = (float)member.slider_min, high = (float)member.slider_max;
    // A click with Ctrl takes a number beyond the useful range.
    ImGuiSliderFlags flags = member.is_logarithmic && low > 0 ? ImGuiSliderFlags_Logarithmic : 0;
    for (size_t at = 0; (at = format.find('%', at + 1)) != std::string::npos; at += 1) format.insert(at, "%");
    return ImGui::SliderFloat("##value", value, low, high, format.c_str(), flags);
}

// Show a button in place of a value that is guessed or inherited. The button sets the value.
bool show_button(viewer& viewer, const row& row, float* value)
{
    const hair_setting& setting = row.setting;
    *value = 1;
    if (setting.group < 0) return ImGui::Button("guessed; set to 1");
    memcpy(value, (const char*)&viewer.document.scene->settings.physics + setting.member.offset,
           sizeof *value);
    return ImGui::Button("inherited; set");
}

bool show_curve(float* values, uint32_t count, const hair_member& member)
{
    bool is_changed = false;
    float width = (ImGui::GetContentRegionAvail().x - 2 * (float)(count - 1)) / (float)count;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2, 2});
    for (uint32_t i = 0; i < count; ++i) {
        ImGui::PushID((int)i);
        if (i) ImGui::SameLine();
        is_changed |= ImGui::VSliderFloat("##v", {width, 3 * ImGui::GetFrameHeight()}, &values[i],
                                          (float)member.slider_min, (float)member.slider_max, "");
        if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetTooltip("%.4g", (double)values[i]);
        ImGui::PopID();
    }
    ImGui::PopStyleVar();
    return is_changed;
}

void show_choices(viewer& viewer, const row& row, const char* present)
{
    const hair_member& member = row.setting.member;
    if (!ImGui::BeginCombo("##value", present)) return;
    for (uint32_t i = 0; i < member.choice_count; ++i) {
        const char* choice = member.choices[i];
        if (ImGui::Selectable(choice, !strcmp(choice, present)))
            hair_settings_set(TOOL, &viewer.document.scene->settings, row.key.c_str(), choice);
        view_gui_mark(viewer.gui, choice);
    }
    ImGui::EndCombo();
}

void show_floats(viewer& viewer, const row& row)
{
    const hair_member& member = row.setting.member;
    float values[16];
    size_t size;
    const char* bytes = bytes_of(row, viewer.document.scene->settings, size);
    memcpy(values, bytes, std::min(sizeof values, size));
    if (member.layout == HAIR_LAYOUT_CURVE) {
        if (!show_curve(values, member.count, member)) return;
        std::string text;
        for (uint32_t i = 0; i < member.count; ++i) {
            char number[32];
            snprintf(number, sizeof number, i ? ",%.9g" : "%.9g", (double)values[i]);
            text += number;
        }
        hair_settings_set(TOOL, &viewer.document.scene->settings, row.key.c_str(), text.c_str());
    } else if (member.layout == HAIR_LAYOUT_COLOR && row.elements == 3) {
        // Colours of lights may be brighter than 1.
        if (ImGui::ColorEdit3("##value", values, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR)) {
            for (int i = 0; i < 3; ++i)
                values[i] = std::min(std::max(values[i], (float)member.min), (float)member.max);
            set(viewer, row, values, 3);
        }
    } else if (row.elements > 1) {
        float speed = 0.005f * (float)(member.slider_max - member.slider_min);
        float low = (float)member.min, high = (float)member.max;
        if (ImGui::DragScalarN("##value", ImGuiDataType_Float, values, row.elements, speed, &low, &high,
                               "%.3g", ImGuiSliderFlags_AlwaysClamp))
            set(viewer, row, values, row.elements);
    } else if (isfinite(values[0]) ? show_slider(member, values) : show_button(viewer, row, values)) {
        set(viewer, row, values, 1);
    }
}

void show_whole(viewer& viewer, const row& row, const char* text)
{
    const hair_member& member = row.setting.member;
    hair_settings& settings = viewer.document.scene->settings;
    char number[32];
    if (member.type == HAIR_MEMBER_BOOL) {
        bool is_on = !strcmp(text, "true");
        if (ImGui::Checkbox("##value", &is_on))
            hair_settings_set(TOOL, &settings, row.key.c_str(), is_on ? "on" : "off");
        return;
    }
    unsigned long long value = strtoull(text, nullptr, 10);
    unsigned long long low = (unsigned long long)member.slider_min,
                       high = (unsigned long long)member.slider_max;
    if (!ImGui::SliderScalar("##value", ImGuiDataType_U64, &value, &low, &high)) return;
    snprintf(number, sizeof number, "%llu", value);
    hair_settings_set(TOOL, &settings, row.key.c_str(), number);
}

void show_value(viewer& viewer, const row& row)
{
    const hair_member& member = row.setting.member;
    char text[256];
    hair_setting_read(&row.setting, &viewer.document.scene->settings, text);
    ImGui::SetNextItemWidth(-1);
    if (member.choice_count)
        show_choices(viewer, row, text);
    else if (member.type == HAIR_MEMBER_FLOAT)
        show_floats(viewer, row);
    else
        show_whole(viewer, row, text);
    view_gui_mark(viewer.gui, row.key.c_str());
    // Scripts drag the first element.
    auto place = viewer.gui.next_places.find(row.key);
    if (row.elements > 1 && place != viewer.gui.next_places.end())
        place->second.right =
            place->second.left + (place->second.right - place->second.left) / (float)row.elements;
}

// Show the sentence, the unit and the range of a setting.
void show_about(const row& row)
{
    const hair_member& member = row.setting.member;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(22 * ImGui::GetFontSize());
    ImGui::TextUnformatted(member.about);
    ImGui::PopTextWrapPos();
    if (!member.choice_count && member.type != HAIR_MEMBER_BOOL)
        ImGui::TextDisabled("[%.10g, %.10g] %s%s", member.min, member.max, member.unit,
                            member.has_auto ? ", 0 is automatic" : "");
    ImGui::TextDisabled("--set %s=...", row.key.c_str());
    ImGui::EndTooltip();
}

// Return whether a row has another value than a new scene with the same style.
bool is_changed(viewer& viewer, const row& row)
{
    size_t size;
    const char* now = bytes_of(row, viewer.document.scene->settings, size);
    const char* usual = bytes_of(row, viewer.usual.settings, size);
    return memcmp(now, usual, size) != 0;
}

void reset(viewer& viewer, const row& row)
{
    size_t size;
    for (int i = 0; i < row.elements; ++i) {
        hair_setting setting;
        for (size_t at = 0; hair_setting_next(&at, &setting);) {
            std::string key = row.key;
            if (row.elements > 1) key = key + "." + row.setting.member.elements[i];
            if (key != setting.key) continue;
            void* to = hair_setting_bytes(&setting, &viewer.document.scene->settings, &size);
            const void* from = hair_setting_bytes(&setting, &viewer.usual.settings, &size);
            memcpy(to, from, size);
        }
    }
}

// Return the key without the names of its groups, which are shown above.
const char* short_key(const row& row)
{
    size_t length = strlen(row.setting.member.group);
    const char* key = row.key.c_str();
    if (row.setting.group >= 0) key += strlen("groups.N.");
    const char* at = length ? strstr(key, row.setting.member.group) : nullptr;
    return at && at[length] == '.' ? at + length + 1 : key;
}

void show_row(viewer& viewer, const row& row)
{
    bool has_changed = is_changed(viewer, row);
    ImGui::PushID(row.key.c_str());
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (has_changed) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.55f, 0.8f, 1, 1));
    ImGui::Text("%s%s", *row.setting.member.group ? "  " : "", short_key(row));
    if (has_changed) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) show_about(row);
    ImGui::TableNextColumn();
    show_value(viewer, row);
    ImGui::TableNextColumn();
    if (has_changed && ImGui::SmallButton("x")) reset(viewer, row);
    if (has_changed) view_gui_mark(viewer.gui, ("Reset " + row.key).c_str());
    if (has_changed && ImGui::IsItemHovered()) ImGui::SetTooltip("Reset to the default");
    ImGui::PopID();
}

// Return the group of members of a row, after its group of strands if it has one.
std::string group_of(const row& row)
{
    std::string group = row.setting.member.group;
    if (row.setting.group < 0) return group;
    return "group " + std::to_string(row.setting.group) + (group.empty() ? "" : ", " + group);
}

void show_group(const std::string& group)
{
    if (group.empty()) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", group.c_str());
    ImGui::TableNextRow();
}

bool is_shown(viewer& viewer, const row& row)
{
    // Groups that the haircut does not have are hidden.
    if (row.setting.group >= (int)viewer.session.info.group_count) return false;
    bool is_found =
        contains(row.key.c_str(), viewer.filter) || contains(row.setting.member.about, viewer.filter);
    return is_found && (!viewer.only_changed || is_changed(viewer, row));
}

// Show the rows of a heading that the search finds.
void show_rows(viewer& viewer, const char* heading)
{
    float width = ImGui::GetContentRegionAvail().x;
    if (!ImGui::BeginTable(heading, 3)) return;
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 0.5f * width);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, 1.2f * ImGui::GetFontSize());
    std::string group;
    for (const row& row : rows()) {
        if (strcmp(heading_of(row.setting), heading) || !is_shown(viewer, row)) continue;
        if (group != group_of(row)) show_group(group_of(row));
        group = group_of(row);
        show_row(viewer, row);
    }
    ImGui::EndTable();
}

// Show what a search finds under all headings.
void show_found(viewer& viewer, const char* heading)
{
    bool has_rows = false;
    for (const row& row : rows())
        has_rows |= !strcmp(heading_of(row.setting), heading) && is_shown(viewer, row);
    if (!has_rows) return;
    ImGui::TextDisabled("%s", heading);
    ImGui::Separator();
    show_rows(viewer, heading);
}

void show_tab(viewer& viewer, const char* heading)
{
    bool is_open = ImGui::BeginTabItem(heading);
    view_gui_mark(viewer.gui, heading);
    if (!is_open) return;
    ImGui::BeginChild(heading);
    show_rows(viewer, heading);
    ImGui::EndChild();
    ImGui::EndTabItem();
}

// Make the scene whose settings are the defaults of the panel.
void update_usual(viewer& viewer)
{
    const hair_scene& scene = *viewer.document.scene;
    hair_style style = scene.settings.style.style;
    if (viewer.has_usual && viewer.usual.subject == scene.subject &&
        viewer.usual.settings.style.style == style)
        return;
    hair_scene_default(&viewer.usual);
    if (scene.subject == HAIR_SUBJECT_STYLE)
        hair_scene_set_style(TOOL, hair_style_name(style), &viewer.usual);
    viewer.usual.subject = scene.subject;
    viewer.has_usual = true;
}

} // namespace

void view_settings_panel(viewer& viewer)
{
    static const char* const headings[] = {"Physics", "Look", "Flow", "View", "LOD", "Cut", "Groups"};
    update_usual(viewer);
    ImGui::SetNextItemWidth(-9 * ImGui::GetFontSize());
    ImGui::InputTextWithHint("##search", "search settings", &viewer.filter);
    view_gui_mark(viewer.gui, "Search");
    ImGui::SameLine();
    ImGui::Checkbox("changed only", &viewer.only_changed);
    view_gui_mark(viewer.gui, "Changed only");
    if (!viewer.filter.empty() || viewer.only_changed) {
        ImGui::Separator();
        ImGui::BeginChild("found");
        for (const char* heading : headings) show_found(viewer, heading);
        ImGui::EndChild();
    } else if (ImGui::BeginTabBar("headings")) {
        // A haircut of one group has no tab for groups, but the search finds the group.
        for (const char* heading : headings)
            if (strcmp(heading, "Groups") || viewer.session.info.group_count > 1) show_tab(viewer, heading);
        ImGui::EndTabBar();
    }
}
