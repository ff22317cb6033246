// strip.cpp - The strip below the picture: time and memory of each stage, and the errors of picture
// and motion.
#include "tools/view/strip.h"
#include "tools/view/actions.h"
#include "tools/view/pareto.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr uint32_t stats_frames = 20; // frames between two readings that wait for the GPU
constexpr size_t history_length = 240;
constexpr uint32_t max_rows = 64;

void add(std::vector<float>& history, float value)
{
    history.push_back(isfinite(value) ? value : 0);
    if (history.size() > history_length) history.erase(history.begin());
}

std::string bytes_of(uint64_t bytes)
{
    char text[32];
    snprintf(text, sizeof text, "%.1f MB", (double)bytes * 1e-6);
    return text;
}

// Return the number of pictures in the frame of the report, which lasts from step to step.
float pictures_of(const viewer& viewer)
{
    return (float)std::max(viewer.draws, 1u);
}

void show_frame(const viewer& viewer)
{
    const view_measures& now = viewer.measures;
    hair_memory memory = hair_memory_default();
    hair_get_memory(viewer.session.context, &memory);
    const char* quality =
        view_quality_of(viewer.is_moving ? viewer.governor.level : viewer.options.quality).about;
    // Frames of a script have no time of their own.
    if (viewer.options.script.empty()) {
        ImGui::Text("%.1f fps", viewer.frame_ms > 0 ? 1000 / viewer.frame_ms : 0);
        ImGui::Text("frame %.1f ms", viewer.frame_ms);
    } else {
        ImGui::Text("frame %u", viewer.frame);
    }
    ImGui::Text("hair %.1f ms", (double)(now.info.ms / pictures_of(viewer)));
    ImGui::Text("%s", bytes_of(memory.bytes).c_str());
    ImGui::TextDisabled("%s", quality);
    ImGui::TextDisabled("%u strands", viewer.session.info.follower_count);
    ImGui::TextDisabled("%u guides", viewer.session.info.guide_count);
}

// Show a stage with its time at the right edge, over a bar, or with the reason why it was skipped.
void show_stage(const viewer& viewer, const hair_report_row& row, float max)
{
    bool has_run = row.skip_reason == HAIR_SKIP_REASON_NONE;
    ImVec2 at = ImGui::GetCursorScreenPos();
    float height = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
    char text[64];
    if (has_run)
        snprintf(text, sizeof text, "%.2f ms", (double)(row.ms / pictures_of(viewer)));
    else
        snprintf(text, sizeof text, "%s", hair_skip_reason_string(row.skip_reason));
    if (has_run)
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width * row.ms / max, at.y + 1.1f * height},
                                                  IM_COL32(48, 96, 160, 255), 2);
    if (!has_run) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    float place = width - ImGui::CalcTextSize(text).x;
    ImGui::PushClipRect(at, {at.x + place - 0.3f * height, at.y + 2 * height}, true);
    ImGui::TextUnformatted(row.stage);
    ImGui::PopClipRect();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\n%s\n%s", row.stage, row.pass ? row.pass : "no pass",
                          bytes_of(row.bytes).c_str());
    ImGui::SameLine(place);
    ImGui::TextUnformatted(text);
    if (!has_run) ImGui::PopStyleColor();
}

void show_stages(viewer& viewer)
{
    const std::vector<hair_report_row>& rows = viewer.measures.rows;
    float max = rows.empty() ? 1 : std::max(rows[0].ms, 1e-3f);
    ImGui::TextDisabled("Stages");
    ImGui::SameLine();
    if (ImGui::SmallButton("Faster ...")) view_pareto_begin(viewer);
    view_gui_mark(viewer.gui, "Faster");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Try settings, and plot their time against their visible error.");
    ImGui::BeginChild("stages");
    for (const hair_report_row& row : rows) show_stage(viewer, row, max);
    ImGui::EndChild();
}

void show_history(const char* label, const std::vector<float>& values, const char* format, float factor)
{
    char text[64];
    size_t used = (size_t)snprintf(text, sizeof text, "%s ", label);
    if (values.empty())
        snprintf(text + used, sizeof text - used, "off");
    else
        snprintf(text + used, sizeof text - used, format, (double)(values.back() * factor));
    ImGui::PushID(label);
    ImGui::PlotLines("##plot", values.data(), (int)values.size(), 0, text, 0, FLT_MAX,
                     {ImGui::GetContentRegionAvail().x, 1.35f * ImGui::GetFontSize()});
    ImGui::PopID();
}

void show_histories(const viewer& viewer)
{
    const view_measures& now = viewer.measures;
    ImGui::TextDisabled("Over time");
    show_history("energy", now.energy, "%.3f \xc2\xb5J", 1e6f);
    show_history("stretch", now.stretch, "%.4f %%", 100);
    show_history("fallback", now.fallbacks, "%.0f", 1);
    show_history("fastest", now.fastest, "%.2f m/s", 1);
}

// Show the error of free hair against the reference, and that of all hair against the second head.
void show_motion_error(const view_motion_error& motion)
{
    const view_reference_result& free = motion.free;
    if (motion.obstacle)
        ImGui::TextDisabled("motion: %s", motion.obstacle);
    else if (!free.frames)
        ImGui::TextDisabled("motion: measuring");
    else if (free.rms < 0)
        ImGui::TextDisabled("motion: no free guide");
    else
        ImGui::Text("motion: %.3f %%\n  worst %.3f %% of %u", 100 * free.rms, 100 * free.worst, free.free);
    if (motion.rms < 0)
        ImGui::TextDisabled("contact: measuring");
    else
        ImGui::Text("contact: %.3f %%\n  worst %.3f %%", 100 * motion.rms, 100 * motion.worst);
}

// Show a switch of an action in the height of a line.
void show_switch(viewer& viewer, const char* label, const char* action, bool is_on)
{
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
    if (ImGui::Checkbox(label, &is_on)) view_run_action(viewer, action);
    ImGui::PopStyleVar();
    view_gui_mark(viewer.gui, label);
}

void show_errors(viewer& viewer)
{
    const view_image_error& image = viewer.image_error;
    show_switch(viewer, "image", "Image error", image.is_on);
    ImGui::SameLine();
    show_switch(viewer, "motion", "Motion error", viewer.motion_error.is_on);
    if (!image.is_on)
        ImGui::TextDisabled("image: off");
    else if (image.flip < 0)
        ImGui::Text("image: measuring\n  %u of %u", image.pictures * view_quality_of(0).samples,
                    view_reference_samples);
    else
        ImGui::Text("image: FLIP %.4f\n  %u samples", image.flip, image.samples);
    if (viewer.motion_error.is_on)
        show_motion_error(viewer.motion_error);
    else
        ImGui::TextDisabled("motion: off");
}

} // namespace

void view_strip_update(viewer& viewer)
{
    view_measures& now = viewer.measures;
    hair_report_row rows[max_rows];
    uint32_t count = 0;
    now.info = hair_report_info_default();
    if (!hair_report(viewer.session.hair, false, &now.info, rows, sizeof *rows, max_rows, &count))
        now.rows.assign(rows, rows + std::min(count, max_rows));
    std::stable_sort(now.rows.begin(), now.rows.end(),
                     [](const hair_report_row& a, const hair_report_row& b) {
                         bool a_ran = a.skip_reason == HAIR_SKIP_REASON_NONE;
                         bool b_ran = b.skip_reason == HAIR_SKIP_REASON_NONE;
                         return a_ran != b_ran ? a_ran : a.ms > b.ms;
                     });
    if (viewer.frame % stats_frames) return;
    now.stats = hair_solver_stats_default();
    if (hair_get_solver_stats(viewer.session.hair, &now.stats)) return;
    uint32_t fallbacks = now.stats.euler_fallbacks + now.stats.follow_fallbacks + now.stats.parts;
    add(now.fastest, now.stats.fastest);
    add(now.stretch, now.stats.stretch);
    add(now.fallbacks, (float)(fallbacks - std::min(fallbacks, now.fallback_count)));
    now.fallback_count = fallbacks;
    if (!viewer.motion_error.is_on)
        now.energy.clear();
    else if (viewer.motion_error.free.free)
        add(now.energy, (float)viewer.motion_error.free.energy);
}

void view_strip(viewer& viewer)
{
    // A narrow window has no room for the last columns.
    float font = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x / font;
    int columns = width > 34 ? 4 : width > 26 ? 3 : 2;
    if (!ImGui::BeginTable("strip", columns)) return;
    ImGui::TableSetupColumn("frame", ImGuiTableColumnFlags_WidthFixed, 7.9f * font);
    ImGui::TableSetupColumn("stages", ImGuiTableColumnFlags_WidthStretch, 1.5f);
    if (columns > 2) ImGui::TableSetupColumn("errors", ImGuiTableColumnFlags_WidthFixed, 9.8f * font);
    if (columns > 3) ImGui::TableSetupColumn("histories", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableNextColumn();
    show_frame(viewer);
    ImGui::TableNextColumn();
    show_stages(viewer);
    if (columns > 2 && ImGui::TableNextColumn()) show_errors(viewer);
    if (columns > 3 && ImGui::TableNextColumn()) show_histories(viewer);
    ImGui::EndTable();
}
