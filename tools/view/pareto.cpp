// pareto.cpp - Time against visible error of several settings for the present picture.
#include "tools/view/pareto.h"

#include <epoxy/gl.h>

#include <math.h>
#include <string.h>

#include <algorithm>

extern "C" {
#include "tools/common/flip.h"
}

namespace
{

constexpr uint32_t reference_samples = 64; // per pixel, at least

// Settings that are tried, "" for the present ones.
const char* const choices[] = {
    "",
    "render_path=tessellation lod=off",
    "render_path=cached lod=off",
    "render_path=compute lod=off",
    "render_path=tessellation lod=on lod.strand_pixels=0.25",
    "render_path=tessellation lod=on lod.strand_pixels=0.5",
    "render_path=tessellation lod=on lod.strand_pixels=1",
    "render_path=tessellation lod=on lod.strand_pixels=2",
    "render_path=cached lod=on lod.strand_pixels=0.5",
    "render_path=compute lod=on lod.strand_pixels=0.5",
    "self_shadow.method=depth",
    "self_shadow.method=depth lod=on lod.strand_pixels=1",
    "followers.collision=none lod=on lod.strand_pixels=1",
    "primitive=lines",
};

// Set the settings of a text such as "lod=on lod.strand_pixels=1".
void set_all(const std::string& text, hair_settings& settings)
{
    for (size_t at = 0; at < text.size();) {
        size_t end = std::min(text.find(' ', at), text.size()), equals = text.find('=', at);
        hair_settings_set(TOOL, &settings, text.substr(at, equals - at).c_str(),
                          text.substr(equals + 1, end - equals - 1).c_str());
        at = end + 1;
    }
}

// Draw a picture twice. The second, without compilation, is timed.
int draw(viewer& viewer, const hair_scene& scene, uint32_t width, uint32_t height, double& ms)
{
    int code = HAIR_EXIT_OK;
    for (int i = 0; i < 2 && !code; ++i) {
        glFinish();
        double before = hair_now();
        code =
            view_session_draw(viewer.session, scene, width, height, view_quality_of(0), VIEW_RENDER_COMPARED);
        glFinish();
        ms = hair_now() - before;
    }
    return code;
}

int measure(viewer& viewer, view_pareto_point& point, uint32_t width, uint32_t height)
{
    auto scene = std::make_unique<hair_scene>(*viewer.document.scene);
    set_all(point.settings, scene->settings);
    hair_render* present = viewer.session.render;
    int code = draw(viewer, *scene, width, height, point.ms);
    unsigned texture = viewer.session.render ? hair_render_texture(viewer.session.render) : 0;
    viewer.session.render = present;
    if (code) return code;
    std::vector<float> reference, shown(3 * (size_t)width * height), errors((size_t)width * height);
    view_image_error_reference(viewer.image_error, scene->exposure, reference);
    if (reference.size() != shown.size()) return HAIR_EXIT_OK;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, 0, GL_RGB, GL_FLOAT, (GLsizei)(shown.size() * sizeof(float)), shown.data());
    if (!hair_flip(reference.data(), shown.data(), width, height, HAIR_FLIP_DISPLAY, errors.data()))
        return HAIR_EXIT_RUNTIME;
    double sum = 0;
    for (float e : errors) sum += (double)e;
    point.flip = sum / (double)errors.size();
    return HAIR_EXIT_OK;
}

bool is_on_front(const view_pareto& pareto, const view_pareto_point& point)
{
    if (point.flip < 0) return false;
    for (const view_pareto_point& other : pareto.points)
        if (other.flip >= 0 && other.ms <= point.ms && other.flip <= point.flip &&
            (other.ms < point.ms || other.flip < point.flip))
            return false;
    return true;
}

// Show a point, and take its settings if it is clicked.
void show_point(viewer& viewer, const view_pareto_point& point, size_t index, ImVec2 place)
{
    float size = 5 * viewer.gui.scale;
    bool is_front = is_on_front(viewer.pareto, point);
    ImU32 color = is_front ? IM_COL32(90, 200, 120, 255) : IM_COL32(150, 155, 160, 255);
    ImGui::GetWindowDrawList()->AddCircleFilled(place, size, color);
    ImGui::SetCursorScreenPos({place.x - size, place.y - size});
    ImGui::PushID((int)index);
    bool is_pressed = ImGui::InvisibleButton("point", {2 * size, 2 * size});
    ImGui::PopID();
    view_gui_mark(viewer.gui, ("Point " + std::to_string(index)).c_str());
    const char* name = point.settings.empty() ? "the present settings" : point.settings.c_str();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\n%.2f ms, FLIP %.4f%s", name, point.ms, point.flip,
                          is_front ? "\nOn the front. Click to take these settings." : "");
    if (is_pressed) set_all(point.settings, viewer.document.scene->settings);
}

void show_plot(viewer& viewer)
{
    double low = 1e30, high = 0, worst = 1e-6;
    for (const view_pareto_point& point : viewer.pareto.points) {
        if (point.flip < 0) continue;
        low = std::min(low, point.ms);
        high = std::max(high, point.ms);
        worst = std::max(worst, point.flip);
    }
    if (high <= 0) return;
    float scale = viewer.gui.scale, margin = 14 * scale;
    ImVec2 at = ImGui::GetCursorScreenPos(), size = {380 * scale, 220 * scale};
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(28, 30, 34, 255),
                                              4);
    double range = std::max(log(high / low), 0.1);
    for (size_t i = 0; i < viewer.pareto.points.size(); ++i) {
        const view_pareto_point& point = viewer.pareto.points[i];
        if (point.flip < 0) continue;
        float x = (float)(log(point.ms / low) / range), y = (float)(point.flip / worst);
        show_point(
            viewer, point, i,
            {at.x + margin + x * (size.x - 2 * margin), at.y + size.y - margin - y * (size.y - 2 * margin)});
    }
    ImGui::SetCursorScreenPos({at.x, at.y + size.y + 4 * scale});
    ImGui::TextDisabled("Time from %.2f to %.2f ms to the right, FLIP up to %.4f upwards.", low, high, worst);
}

// Show the settings on the front, the fastest first. A click takes them.
void show_front(viewer& viewer)
{
    std::vector<const view_pareto_point*> front;
    for (const view_pareto_point& point : viewer.pareto.points)
        if (is_on_front(viewer.pareto, point)) front.push_back(&point);
    std::sort(front.begin(), front.end(),
              [](const view_pareto_point* a, const view_pareto_point* b) { return a->ms < b->ms; });
    double present = viewer.pareto.points.empty() ? 0 : viewer.pareto.points[0].ms;
    for (size_t i = 0; i < front.size(); ++i) {
        const view_pareto_point& point = *front[i];
        char text[160];
        snprintf(text, sizeof text, "%.1f ms (%.0f %%), FLIP %.4f: %s", point.ms, 100 * point.ms / present,
                 point.flip, point.settings.empty() ? "the present settings" : point.settings.c_str());
        if (ImGui::Selectable(text)) set_all(point.settings, viewer.document.scene->settings);
        view_gui_mark(viewer.gui, ("Front " + std::to_string(i)).c_str());
    }
}

// Take the settings of the smallest error with half the time of the present ones.
void take_half(viewer& viewer)
{
    const std::vector<view_pareto_point>& points = viewer.pareto.points;
    const view_pareto_point* best = nullptr;
    for (const view_pareto_point& point : points)
        if (point.flip >= 0 && point.ms <= 0.5 * points[0].ms && (!best || point.flip < best->flip))
            best = &point;
    if (!best) {
        viewer_say(viewer, "None of the settings takes half the time.");
        return;
    }
    set_all(best->settings, viewer.document.scene->settings);
    char text[256];
    snprintf(text, sizeof text, "Took %s: %.1f ms, FLIP %.4f.", best->settings.c_str(), best->ms, best->flip);
    viewer_say(viewer, text);
}

} // namespace

void view_pareto_begin(viewer& viewer)
{
    view_pareto& pareto = viewer.pareto;
    pareto.shows = true;
    if (pareto.is_running) return;
    pareto.points.clear();
    for (const char* choice : choices) pareto.points.push_back({choice, -1, -1});
    pareto.next = 0;
    pareto.is_running = true;
    pareto.was_paused = viewer.pauses;
    viewer.pauses = true; // Pictures of one moment are compared.
    viewer.image_error.is_on = true;
}

int view_pareto_update(viewer& viewer, uint32_t width, uint32_t height)
{
    view_pareto& pareto = viewer.pareto;
    bool is_ready =
        pareto.is_running && viewer.image_error.pictures * view_quality_of(0).samples >= reference_samples;
    if (!is_ready) return HAIR_EXIT_OK;
    if (pareto.next < pareto.points.size())
        return measure(viewer, pareto.points[pareto.next++], width, height);
    pareto.is_running = false;
    viewer.pauses = pareto.was_paused;
    return HAIR_EXIT_OK;
}

void view_pareto_window(viewer& viewer)
{
    view_pareto& pareto = viewer.pareto;
    if (!pareto.shows) return;
    const view_place& picture = viewer.picture;
    float margin = 10 * viewer.gui.scale;
    ImGui::SetNextWindowPos({picture.left + margin, picture.top + margin}, ImGuiCond_Appearing);
    ImGui::Begin("Time against error", &pareto.shows,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    if (!pareto.is_running && ImGui::Button("Measure settings")) view_pareto_begin(viewer);
    if (!pareto.is_running) view_gui_mark(viewer.gui, "Measure settings");
    if (pareto.is_running && !pareto.next)
        ImGui::Text("Reference: %u of %u samples", viewer.image_error.pictures * view_quality_of(0).samples,
                    reference_samples);
    else if (pareto.is_running)
        ImGui::Text("Setting %zu of %zu", pareto.next, pareto.points.size());
    show_plot(viewer);
    bool is_done = !pareto.is_running && !pareto.points.empty();
    if (is_done && ImGui::Button("Halve the time")) take_half(viewer);
    if (is_done) view_gui_mark(viewer.gui, "Halve the time");
    if (is_done) show_front(viewer);
    ImGui::End();
}
