// viewer.cpp - The state of hair-view, and one frame of its loop.
#include "tools/view/viewer.h"
#include "tools/view/arrows.h"
#include "tools/view/blade.h"
#include "tools/view/compare.h"
#include "tools/view/controls.h"
#include "tools/view/debug_draw.h"
#include "tools/view/debug_guides.h"
#include "tools/view/gizmo.h"
#include "tools/view/panel.h"
#include "tools/view/pareto.h"
#include "tools/view/record.h"
#include "tools/view/shader_watch.h"
#include "tools/view/state_report.h"

#include <epoxy/gl.h>

#include <string.h>
#include <unistd.h>

#include <algorithm>

namespace
{

constexpr float script_dt = 1.0f / 60; // s
constexpr size_t max_messages = 50;
constexpr uint32_t reload_frames = 20; // frames between two looks at the shaders
constexpr float slow_motion = 0.125f;
// Time without motion after which the picture has full quality, ms. The picture takes seconds by a
// software rasterizer, for which events wait.
constexpr double rest = 250, long_rest = 1000;

void log_sentence(hair_log_level level, const char* sentence, void* user)
{
    if (level == HAIR_LOG_INFO) return;
    hair_complain(TOOL, "%s", sentence);
    (void)user;
}

void hear_sentence(const char* sentence, void* user)
{
    viewer_say(*static_cast<viewer*>(user), sentence);
}

int open(viewer& viewer)
{
    hair_host host = {};
    host.log = log_sentence;
    int code =
        viewer.options.script.empty() ? HAIR_EXIT_OK : view_script_read(viewer.options.script, viewer.script);
    if (!code) code = view_stage_open(viewer.options, host, viewer.stage);
    if (!code)
        code =
            view_session_open(host, view_stage_get_proc(viewer.stage), viewer.options.glsl, viewer.session);
    if (!code) view_gl_messages_listen(viewer.gl_messages);
    if (!code && !view_gui_open(viewer.gui)) {
        hair_complain(TOOL, "the panels cannot be drawn with this OpenGL");
        code = HAIR_EXIT_OPENGL;
    }
    if (!code) code = view_session_apply(viewer.session, *viewer.document.scene, viewer.document.name);
    if (code) return code;
    const char* renderer = (const char*)glGetString(GL_RENDERER);
    viewer.is_software = renderer && strstr(renderer, "llvmpipe");
    if (viewer.is_software)
        viewer.governor.level = view_quality_levels - 2;
    else
        viewer.image_error.is_on = viewer.options.script.empty();
    *viewer.document.committed = *viewer.document.scene;
    hair_complain_to(hear_sentence, &viewer);
    return HAIR_EXIT_OK;
}

void close(viewer& viewer)
{
    hair_complain_to(nullptr, nullptr);
    view_image_error_finish(viewer.image_error);
    view_motion_error_end(viewer.motion_error, viewer.session);
    view_gui_close(viewer.gui);
    view_debug_close(viewer.debug);
    view_session_close(viewer.session);
    view_document_close(viewer.document);
    if (viewer.stage.egl || viewer.stage.context) view_gl_messages_ignore();
    view_stage_close(viewer.stage);
}

// Take the events of a frame. Panels see one place of the mouse a frame. Therefore a button waits
// for the next frame after a motion, and everything of the mouse does after a button.
void take_events(viewer& viewer)
{
    SDL_Event event;
    bool has_moved = false, has_button = false;
    SDL_PumpEvents();
    while (SDL_PeepEvents(&event, 1, SDL_PEEKEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT) > 0) {
        bool is_motion = event.type == SDL_MOUSEMOTION;
        bool is_button = event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEBUTTONUP;
        if ((is_button && has_moved) || ((is_button || is_motion) && has_button)) break;
        has_moved |= is_motion;
        has_button |= is_button;
        SDL_PeepEvents(&event, 1, SDL_GETEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT);
        bool is_taken = view_gui_event(viewer.gui, event) && viewer.drag == VIEW_DRAG_NONE;
        if (!is_taken) view_controls_event(viewer, event);
        if (event.type == SDL_DROPFILE) SDL_free(event.drop.file);
    }
}

// Make the hair follow the document. A scene that the library refuses is taken back.
void follow_document(viewer& viewer)
{
    hair_scene& scene = *viewer.document.scene;
    if (!memcmp(&scene, viewer.session.applied.get(), sizeof scene)) return;
    viewer_moved(viewer);
    if (view_session_apply(viewer.session, scene, viewer.document.name)) scene = *viewer.session.applied;
}

// Return whether pictures are drawn as in a window: every frame, by a budget while anything moves.
bool is_live(const viewer& viewer)
{
    return viewer.options.script.empty() || viewer.options.fps;
}

// Return the duration of the motion. The animation of a character repeats without an end.
float duration(const view_session& session, const hair_motion& motion)
{
    if (session.character) return INFINITY;
    return motion.count ? motion.key[motion.count - 1].time : 0;
}

int step(viewer& viewer, float dt)
{
    view_session& session = viewer.session;
    const hair_scene& scene = *viewer.document.scene;
    float end = duration(session, scene.motion);
    if (viewer.pauses && !viewer.steps_once) return HAIR_EXIT_OK;
    if (viewer.steps_once) dt = script_dt;
    if (viewer.is_slow) dt *= slow_motion;
    viewer.steps_once = false;
    if (viewer.plays && viewer.loops && end > 0 && session.time >= end) session.time -= end;
    bool is_measured = viewer.motion_error.is_on;
    int code = HAIR_EXIT_OK;
    if (is_measured) code = view_motion_error_prepare(viewer.motion_error, session, scene);
    if (is_measured) dt = (float)view_motion_error_frames(viewer.motion_error, (double)dt);
    if (code || dt <= 0) return code;
    viewer.draws = 0;
    code = view_session_step(session, scene, dt, viewer.plays);
    bool is_moving = (viewer.plays && session.time < end) || !session.pins.empty() ||
                     session.pieces.count > 0 || !view_session_sleeps(session);
    if (is_moving) viewer_moved(viewer);
    if (!code && is_measured)
        code = view_motion_error_update(viewer.motion_error, session, scene, (double)dt,
                                        !viewer.options.script.empty());
    if (!code) code = view_debug_update(viewer, (double)dt);
    return code;
}

// Draw the picture unless it is what it was.
int draw_picture(viewer& viewer)
{
    view_session& session = viewer.session;
    const view_place& place = viewer.picture;
    float density = viewer.stage.density;
    int width = std::max(1, (int)(density * (place.right - place.left)));
    int height = std::max(1, (int)(density * (place.bottom - place.top)));
    bool is_equal = viewer.is_full && !viewer.compared && viewer.picture_size[0] == width &&
                    viewer.picture_size[1] == height;
    viewer.is_moving = is_live(viewer) && hair_now() - viewer.moved < (viewer.is_software ? long_rest : rest);
    int code = HAIR_EXIT_OK;
    if (!is_equal || viewer.is_moving || !is_live(viewer)) {
        uint32_t level = viewer.is_moving ? viewer.governor.level : viewer.options.quality;
        view_render which = viewer.is_moving ? VIEW_RENDER_MOVING : VIEW_RENDER_FULL;
        code = view_session_draw(session, *viewer.document.scene, (uint32_t)width, (uint32_t)height,
                                 view_quality_of(level), which);
        ++viewer.draws;
        viewer.is_full = level == viewer.options.quality;
        viewer.picture_size[0] = width;
        viewer.picture_size[1] = height;
    }
    if (code) return code;
    unsigned texture = hair_render_texture(session.render);
    uint32_t pictures = viewer.image_error.pictures;
    if (viewer.image_error.is_on && viewer.is_full && !viewer.is_moving)
        code = view_image_error_update(viewer.image_error, session, *viewer.document.scene, texture,
                                       viewer.motion);
    if (viewer.image_error.pictures > pictures) ++viewer.draws;
    if (!code) code = view_pareto_update(viewer, (uint32_t)width, (uint32_t)height);
    if (code) return code;
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    ImGui::GetBackgroundDrawList()->AddImage((ImTextureID)(intptr_t)texture, {place.left, place.top},
                                             {place.right, place.bottom});
    uint32_t level = viewer.is_moving ? viewer.governor.level : viewer.options.quality;
    if (!is_equal || viewer.is_moving) code = view_debug_draw(viewer, (uint32_t)width, (uint32_t)height);
    if (code) return code;
    view_debug_show(viewer);
    if (viewer.compared)
        code = view_compare_draw(viewer, (uint32_t)width, (uint32_t)height, view_quality_of(level));
    view_draw_handles(viewer);
    view_arrows(viewer);
    view_blade_draw(viewer);
    view_hint(viewer);
    return code;
}

void write_bug_report(viewer& viewer)
{
    viewer.wants_bug_report = false;
    std::string scene = view_new_name("-bug.json"), base = scene.substr(0, scene.size() - 5);
    bool ok = hair_scene_write(TOOL, scene.c_str(), viewer.document.scene.get()) &&
              !view_write_picture(viewer, base + ".png") && !view_state_report(viewer, base + "-state.json");
    if (ok)
        viewer_say(viewer, "Wrote " + scene + ", " + base + ".png and " + base +
                               "-state.json. Attach them to your report.");
}

// Write what the end of a frame asks for: a picture, a frame of a film, or the shot of a script.
int write_pictures(viewer& viewer, bool is_last)
{
    int code = is_last && !viewer.options.shot.empty() ? view_write_picture(viewer, viewer.options.shot)
                                                       : HAIR_EXIT_OK;
    if (!code) code = view_record_frame(viewer);
    if (!code && is_last) code = view_record_end(viewer);
    if (viewer.wants_bug_report) write_bug_report(viewer);
    if (!viewer.wants_picture) return code;
    viewer.wants_picture = false;
    std::string path = view_new_name(".png");
    if (!view_write_picture(viewer, path)) viewer_say(viewer, "Wrote the picture " + path + ".");
    return code;
}

// Return a name of a scene file that does not exist yet.
std::string find_path()
{
    std::string path = "scene.json";
    for (int i = 2; i < 1000 && !access(path.c_str(), F_OK); ++i)
        path = "scene-" + std::to_string(i) + ".json";
    return path;
}

int save_by_script(viewer& viewer)
{
    std::string path, report;
    path.swap(viewer.script.save);
    report.swap(viewer.script.report);
    bool ok = path.empty() || hair_scene_write(TOOL, path.c_str(), viewer.document.scene.get());
    if (!ok) return HAIR_EXIT_RUNTIME;
    return report.empty() ? HAIR_EXIT_OK : view_state_report(viewer, report);
}

// Return the time since the last frame, s.
float tick(viewer& viewer)
{
    double now = hair_now();
    float dt = viewer.last > 0 ? (float)(1e-3 * (now - viewer.last)) : script_dt;
    viewer.last = now;
    return viewer.options.script.empty() ? std::clamp(dt, 1e-4f, 0.5f) : script_dt;
}

// Adjust the quality to the time that the frame has taken without waiting for the display. A frame
// that compiles programs is slow once, in any quality.
void measure_frame(viewer& viewer, double before)
{
    glFinish();
    double ms = hair_now() - before;
    uint32_t compiled = view_session_compiled(viewer.session);
    bool has_compiled = compiled != viewer.compiled;
    viewer.compiled = compiled;
    viewer.frame_ms += (viewer.frame_ms > 0 ? 0.1 : 1) * (ms - viewer.frame_ms);
    if (viewer.is_moving && !has_compiled) view_governor_add(viewer.governor, ms);
}

int run_frame(viewer& viewer)
{
    bool is_last = viewer.options.frames && viewer.frame + 1 >= viewer.options.frames;
    bool is_scripted = !viewer.options.script.empty();
    double before = hair_now();
    bool draws = is_live(viewer) || (is_last && !viewer.options.shot.empty()) || view_record_is_due(viewer) ||
                 viewer.wants_picture || viewer.wants_bug_report || viewer.image_error.is_on;
    int code = view_script_feed(viewer.script, viewer.gui, viewer.stage.window);
    // The debug view counts while it draws.
    draws = draws || (viewer.debug.mode != VIEW_DEBUG_OFF && !viewer.script.report.empty());
    float dt = tick(viewer);
    if (code) return code;
    take_events(viewer);
    view_stage_measure(viewer.stage);
    float scale = viewer.options.scale > 0 ? viewer.options.scale : viewer.stage.scale;
    view_gui_begin(viewer.gui, viewer.stage.width, viewer.stage.height, viewer.stage.density, scale, dt);
    view_panels(viewer);
    view_mark_handles(viewer);
    follow_document(viewer);
    if (viewer.drag == VIEW_DRAG_NONE && !ImGui::IsAnyItemActive()) view_document_commit(viewer.document);
    code = step(viewer, dt);
    if (viewer.frame % reload_frames == 0) view_watch_shaders(viewer);
    if (!code && draws) code = draw_picture(viewer);
    if (!code) code = save_by_script(viewer);
    // A shader with an error must not end a window.
    if (code == HAIR_EXIT_OPENGL && !is_scripted && !viewer.options.glsl.empty()) code = HAIR_EXIT_OK;
    if (draws) view_stage_begin(viewer.stage);
    view_gui_end(viewer.gui, draws);
    if (!code && draws) code = write_pictures(viewer, is_last);
    if (draws) measure_frame(viewer, before);
    if (draws) view_stage_end(viewer.stage);
    if (viewer.options.fps)
        view_frame_times_add(viewer.frame_times, viewer.is_moving, viewer.governor.level,
                             hair_now() - before);
    ++viewer.frame;
    viewer.quits = viewer.quits || is_last;
    return code;
}

} // namespace

void viewer_moved(viewer& viewer)
{
    viewer.moved = hair_now();
    ++viewer.motion;
}

void viewer_say(viewer& viewer, const std::string& sentence)
{
    viewer.messages.push_back(sentence);
    viewer.said = viewer.frame;
    if (viewer.messages.size() > max_messages) viewer.messages.erase(viewer.messages.begin());
}

int viewer_run(viewer& viewer)
{
    view_document_open(viewer.document, viewer.options.scene, viewer.options.name, viewer.options.file);
    viewer.path = !viewer.options.save.empty()   ? viewer.options.save
                  : !viewer.options.file.empty() ? viewer.options.file
                                                 : find_path();
    int code = open(viewer);
    if (!code && !viewer.options.film.empty()) code = view_record_begin(viewer, viewer.options.film);
    while (!code && !viewer.quits) code = run_frame(viewer);
    if (viewer.film.is_on && view_record_end(viewer) && !code) code = HAIR_EXIT_RUNTIME;
    if (!code && viewer.options.fps) {
        view_frame_times_print(viewer.frame_times);
        if (hair_flush(TOOL)) code = HAIR_EXIT_RUNTIME;
    }
    close(viewer);
    return code;
}
