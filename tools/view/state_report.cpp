// state_report.cpp - The state of the window as JSON, for tests and for reports of defects.
#include "tools/view/state_report.h"
#include "tools/view/arrows.h"
#include "tools/view/debug_draw.h"
#include "tools/view/hair_actions.h"

#include <epoxy/gl.h>
#include <jansson.h>

#include <math.h>
#include <unistd.h>

#include <algorithm>

namespace
{

bool read_guides(const viewer& viewer, std::vector<float>& out)
{
    uint32_t count = 0, room = viewer.session.info.guide_vertex_count;
    out.resize(3 * (size_t)room);
    return hair_read_positions(viewer.session.hair, HAIR_READ_GUIDES, out.data(), room, &count) == HAIR_OK;
}

// Return the held vertex with its place in the window.
json_t* held_of(const viewer& viewer, const std::vector<float>& guides)
{
    const hair_pin& pin = viewer.session.pins[0];
    uint32_t first = view_guide_of(viewer.session.groom, pin.guide).first;
    ImVec2 place = {-1, -1};
    view_project(viewer, &guides[3 * (size_t)(first + pin.vertex)], place);
    return json_pack("{s:i, s:i, s:f, s:f}", "guide", (int)pin.guide, "vertex", (int)pin.vertex, "x",
                     (double)place.x, "y", (double)place.y);
}

// Return a string of the driver, or "unknown".
json_t* driver_string(GLenum name)
{
    const char* text = (const char*)glGetString(name);
    json_t* string = json_string(text ? text : "unknown");
    return string ? string : json_string("unknown");
}

void add_program(json_t* root)
{
    char version[32];
    uint32_t number = hair_version();
    snprintf(version, sizeof version, "%u.%u.%u", number / 10000, number / 100 % 100, number % 100);
    json_object_set_new(root, "version", json_string(version));
    json_object_set_new(root, "vendor", driver_string(GL_VENDOR));
    json_object_set_new(root, "renderer", driver_string(GL_RENDERER));
    json_object_set_new(root, "opengl", driver_string(GL_VERSION));
}

// Return the memory of the process that is in use, bytes. It is 0 if the system does not tell.
json_int_t resident_bytes()
{
    long long pages[2] = {0, 0};
    FILE* file = fopen("/proc/self/statm", "r");
    if (file && fscanf(file, "%lld %lld", &pages[0], &pages[1]) != 2) pages[1] = 0;
    if (file) fclose(file);
    return (json_int_t)pages[1] * sysconf(_SC_PAGESIZE);
}

void add_memory(const viewer& viewer, json_t* root)
{
    hair_memory memory = hair_memory_default();
    hair_get_memory(viewer.session.context, &memory);
    json_object_set_new(root, "resident_bytes", json_integer(resident_bytes()));
    json_object_set_new(root, "hair_bytes", json_integer((json_int_t)memory.bytes));
}

// Return the stages in the order of the strip, with their times.
json_t* stages_of(const viewer& viewer)
{
    json_t* stages = json_array();
    for (const hair_report_row& row : viewer.measures.rows)
        json_array_append_new(stages, json_pack("{s:s, s:f}", "stage", row.stage, "ms", (double)row.ms));
    return stages;
}

// Add the debug view, and the messages of OpenGL.
void add_debug(const viewer& viewer, json_t* root)
{
    const view_debug& debug = viewer.debug;
    json_object_set_new(root, "debug",
                        json_pack("{s:s, s:f, s:f, s:i, s:i, s:f}", "mode", view_debug_name(debug.mode),
                                  "low", (double)debug.low, "high", (double)debug.high, "strands",
                                  (int)debug.strands, "drawn", (int)debug.drawn, "fragments",
                                  (double)debug.fragments));
    json_object_set_new(root, "shows_gl_messages", json_boolean(viewer.gl_messages.shows));
    json_t* gl_messages = json_array();
    for (const view_gl_message& message : viewer.gl_messages.list)
        json_array_append_new(gl_messages, json_string(message.text.c_str()));
    json_object_set_new(root, "gl_messages", gl_messages);
}

} // namespace

int view_state_report(const viewer& viewer, const std::string& path)
{
    std::vector<float> guides;
    if (!read_guides(viewer, guides)) return HAIR_EXIT_RUNTIME;
    bool is_finite = std::all_of(guides.begin(), guides.end(), [](float x) { return isfinite(x); });
    json_t* root = json_pack(
        "{s:i, s:f, s:b, s:b, s:b, s:b, s:b, s:b, s:b, s:b, s:i}", "frame", (int)viewer.frame, "time",
        viewer.session.time, "plays", viewer.plays, "loops", viewer.loops, "pauses", viewer.pauses, "is_slow",
        viewer.is_slow, "shows_help", viewer.shows_help, "shows_panels", viewer.shows_panels, "shows_strip",
        viewer.shows_strip, "is_finite", is_finite, "undo", (int)viewer.document.undo.size());
    if (!viewer.session.pins.empty()) json_object_set_new(root, "held", held_of(viewer, guides));
    json_object_set_new(root, "cut_strands", json_integer(viewer.session.cut_strands));
    json_object_set_new(root, "pieces", json_integer(viewer.session.pieces.count));
    if (viewer.image_error.flip >= 0) {
        json_object_set_new(root, "flip", json_real(viewer.image_error.flip));
        json_object_set_new(root, "samples", json_integer(viewer.image_error.samples));
    }
    if (viewer.motion_error.rms >= 0)
        json_object_set_new(root, "motion_error", json_real(viewer.motion_error.rms));
    const view_reference_result& free = viewer.motion_error.free;
    if (free.rms >= 0)
        json_object_set_new(root, "reference",
                            json_pack("{s:f, s:f, s:f, s:i, s:i}", "rms", free.rms, "worst", free.worst,
                                      "energy", free.energy, "free", (int)free.free, "followed",
                                      (int)free.followed));
    if (!viewer.pareto.points.empty() && !viewer.pareto.is_running) {
        json_t* points = json_array();
        for (const view_pareto_point& point : viewer.pareto.points)
            json_array_append_new(points, json_pack("{s:s, s:f, s:f}", "settings", point.settings.c_str(),
                                                    "ms", point.ms, "flip", point.flip));
        json_object_set_new(root, "pareto", points);
    }
    add_program(root);
    add_memory(viewer, root);
    json_object_set_new(root, "stages", stages_of(viewer));
    json_object_set_new(root, "frame_ms", json_real(viewer.frame_ms));
    json_object_set_new(
        root, "quality",
        json_string(
            view_quality_of(viewer.is_moving ? viewer.governor.level : viewer.options.quality).about));
    view_levels levels = view_present_levels(viewer);
    json_object_set_new(
        root, "drawn_fractions",
        json_pack("{s:f, s:f}", "strands", (double)levels.strands, "segments", (double)levels.segments));
    json_object_set_new(root, "film", json_boolean(viewer.film.is_on));
    add_debug(viewer, root);
    json_t* messages = json_array();
    for (const std::string& message : viewer.messages)
        json_array_append_new(messages, json_string(message.c_str()));
    json_object_set_new(root, "messages", messages);
    hair_output output;
    bool ok = hair_output_open(TOOL, path.c_str(), &output);
    if (ok) {
        json_dumpf(root, output.file, JSON_INDENT(2));
        fputc('\n', output.file);
        ok = hair_output_commit(&output);
    }
    json_decref(root);
    return ok ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}
