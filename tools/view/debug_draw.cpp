// debug_draw.cpp - Pictures of the debug view, in place of the picture of the hair.
#include "tools/view/debug_draw.h"
#include "tools/view/debug_guides.h"
#include "tools/view/debug_programs.h"

#include <epoxy/gl.h>

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr float line_width = 2; // pixels at scale 1
constexpr int legend_steps = 24;

const char* const names[] = {"off",     "stretch",  "tension", "velocity", "contact", "patches",
                             "strands", "overdraw", "field x", "field y",  "field z", nullptr};

void make_target(view_debug& debug, uint32_t width, uint32_t height)
{
    if (debug.size[0] == (int)width && debug.size[1] == (int)height) return;
    glDeleteFramebuffers(1, &debug.framebuffer);
    glDeleteTextures(1, &debug.texture);
    glDeleteRenderbuffers(1, &debug.depth);
    glCreateTextures(GL_TEXTURE_2D, 1, &debug.texture);
    glTextureStorage2D(debug.texture, 1, GL_RGBA8, (int)width, (int)height);
    glTextureParameteri(debug.texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glCreateRenderbuffers(1, &debug.depth);
    glNamedRenderbufferStorage(debug.depth, GL_DEPTH_COMPONENT32F, (int)width, (int)height);
    glCreateFramebuffers(1, &debug.framebuffer);
    glNamedFramebufferTexture(debug.framebuffer, GL_COLOR_ATTACHMENT0, debug.texture, 0);
    glNamedFramebufferRenderbuffer(debug.framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, debug.depth);
    debug.size[0] = (int)width;
    debug.size[1] = (int)height;
}

// Draw the darkened picture, and the depth of the head.
void begin(viewer& viewer, const hair_matrices& matrices)
{
    view_debug& debug = viewer.debug;
    static const float far = 1;
    glBindFramebuffer(GL_FRAMEBUFFER, debug.framebuffer);
    glViewport(0, 0, debug.size[0], debug.size[1]);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glClearNamedFramebufferfv(debug.framebuffer, GL_DEPTH, 0, &far);
    glUseProgram(debug.programs[VIEW_DEBUG_BACKGROUND]);
    glUniform2f(0, (float)debug.size[0], (float)debug.size[1]);
    glBindTextureUnit(0, hair_render_texture(viewer.session.render));
    glBindVertexArray(debug.vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    hair_render_depth(viewer.session.render, viewer.document.scene.get(), viewer.session.transform,
                      &matrices);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindFramebuffer(GL_FRAMEBUFFER, debug.framebuffer);
    glEnable(GL_DEPTH_TEST);
}

void draw_segments(viewer& viewer, const hair_matrices& matrices)
{
    view_debug& debug = viewer.debug;
    std::vector<view_debug_segment> segments;
    float clip[16];
    view_debug_segments(viewer, segments);
    if (segments.empty()) return;
    hair_light_clip(&matrices, clip);
    glNamedBufferData(debug.segments, (GLsizeiptr)(segments.size() * sizeof segments[0]), segments.data(),
                      GL_STREAM_DRAW);
    glUseProgram(debug.programs[VIEW_DEBUG_SEGMENTS]);
    glUniform2f(0, (float)debug.size[0], (float)debug.size[1]);
    glUniform1f(1, line_width * viewer.gui.scale * viewer.stage.density);
    glUniformMatrix4fv(2, 1, GL_FALSE, clip);
    glBindVertexArray(debug.vertex_array);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 6, (GLsizei)segments.size());
}

hair_view view_of(const viewer& viewer, const hair_matrices& matrices, hair_pass pass)
{
    const hair_settings& settings = viewer.document.scene->settings;
    hair_view view = settings.view;
    view.pass = pass;
    view.light_count = 0;
    view.coverage = HAIR_COVERAGE_MSAA;
    view.lod = settings.has_lod ? &settings.lod : nullptr;
    memcpy(view.view, matrices.view, sizeof view.view);
    memcpy(view.projection, matrices.projection, sizeof view.projection);
    return view;
}

// Draw the hair by one of the shaders, which reads or writes a buffer.
hair_result draw_hair(viewer& viewer, const hair_matrices& matrices, view_debug_shader shader,
                      unsigned buffer)
{
    hair_view view = view_of(viewer, matrices, HAIR_PASS_COLOR);
    view.shader = viewer.debug.shaders[shader];
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, view_debug_binding, buffer);
    bool is_seen = shader == VIEW_DEBUG_PAINT;
    if (!is_seen) glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    if (!is_seen) glDepthMask(GL_FALSE);
    hair_result result = hair_draw(viewer.session.hair, &view);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    if (!is_seen) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    return result;
}

hair_result paint(viewer& viewer, const hair_matrices& matrices, const std::vector<float>& colors)
{
    unsigned buffer = viewer.debug.storage[1];
    glNamedBufferData(buffer, (GLsizeiptr)(colors.size() * sizeof(float)), colors.data(), GL_STREAM_DRAW);
    return draw_hair(viewer, matrices, VIEW_DEBUG_PAINT, buffer);
}

void set_color(std::vector<float>& colors, uint32_t strand, const float color[3])
{
    memcpy(&colors[4 * (size_t)strand], color, 3 * sizeof *color);
}

hair_result draw_patches(viewer& viewer, const hair_matrices& matrices, const std::vector<uint32_t>& patches)
{
    std::vector<float> colors(4 * patches.size());
    for (uint32_t i = 0; i < patches.size(); ++i) {
        float color[3];
        for (int k = 0; k < 3; ++k)
            color[k] = 0.55f + 0.45f * cosf(6.2831853f * (0.618034f * (float)patches[i] + (float)k / 3));
        set_color(colors, i, color);
    }
    return paint(viewer, matrices, colors);
}

// Colour each patch by the fraction of its strands that the view draws.
hair_result draw_fractions(viewer& viewer, const hair_matrices& matrices,
                           const std::vector<uint32_t>& patches)
{
    view_debug& debug = viewer.debug;
    size_t count = patches.size();
    std::vector<uint32_t> marks(count, 0), drawn(viewer.session.info.patch_count, 0);
    std::vector<uint32_t> all(drawn.size(), 0);
    GLsizeiptr bytes = (GLsizeiptr)(count * sizeof marks[0]);
    glNamedBufferData(debug.storage[0], bytes, marks.data(), GL_STREAM_READ);
    hair_result result = draw_hair(viewer, matrices, VIEW_DEBUG_MARK, debug.storage[0]);
    if (result) return result;
    glGetNamedBufferSubData(debug.storage[0], 0, bytes, marks.data());
    debug.drawn = 0;
    for (size_t i = 0; i < count; ++i) {
        ++all[patches[i]];
        drawn[patches[i]] += marks[i];
        debug.drawn += marks[i];
    }
    std::vector<float> colors(4 * count);
    for (uint32_t i = 0; i < count; ++i) {
        float color[3];
        view_debug_color(debug.mode, (float)drawn[patches[i]] / (float)all[patches[i]], color);
        set_color(colors, i, color);
    }
    return paint(viewer, matrices, colors);
}

hair_result draw_overdraw(viewer& viewer, const hair_matrices& matrices)
{
    view_debug& debug = viewer.debug;
    size_t pixels = (size_t)debug.size[0] * (size_t)debug.size[1], covered = 0;
    std::vector<uint32_t> counts(1 + pixels, 0);
    counts[0] = (uint32_t)debug.size[0];
    GLsizeiptr bytes = (GLsizeiptr)(counts.size() * sizeof counts[0]);
    glNamedBufferData(debug.storage[0], bytes, counts.data(), GL_STREAM_READ);
    hair_result result = draw_hair(viewer, matrices, VIEW_DEBUG_COUNT, debug.storage[0]);
    if (result) return result;
    glGetNamedBufferSubData(debug.storage[0], 0, bytes, counts.data());
    double sum = 0;
    for (size_t i = 1; i < counts.size(); ++i) {
        sum += counts[i];
        covered += counts[i] > 0;
    }
    debug.fragments = covered ? (float)(sum / (double)covered) : 0;
    glDisable(GL_DEPTH_TEST);
    glUseProgram(debug.programs[VIEW_DEBUG_COUNTS]);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, view_debug_binding, debug.storage[0]);
    glBindVertexArray(debug.vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return HAIR_OK;
}

hair_result draw_slice(viewer& viewer, const hair_matrices& matrices)
{
    hair_view view = view_of(viewer, matrices, HAIR_PASS_COLLIDERS);
    view.slice = (hair_slice)(HAIR_SLICE_X + viewer.debug.mode - VIEW_DEBUG_FIELD_X);
    hair_result result = hair_draw(viewer.session.hair, &view);
    view.pass = HAIR_PASS_WIND;
    return result ? result : hair_draw(viewer.session.hair, &view);
}

hair_result draw_mode(viewer& viewer, const hair_matrices& matrices)
{
    view_debug& debug = viewer.debug;
    std::vector<uint32_t> patches(viewer.session.info.follower_count);
    debug.strands = (uint32_t)patches.size();
    if (debug.mode == VIEW_DEBUG_PATCHES || debug.mode == VIEW_DEBUG_LOD)
        view_find_patches(viewer.session.groom, patches.data());
    switch (debug.mode) {
    case VIEW_DEBUG_PATCHES: return draw_patches(viewer, matrices, patches);
    case VIEW_DEBUG_LOD: return draw_fractions(viewer, matrices, patches);
    case VIEW_DEBUG_OVERDRAW: return draw_overdraw(viewer, matrices);
    case VIEW_DEBUG_FIELD_X:
    case VIEW_DEBUG_FIELD_Y:
    case VIEW_DEBUG_FIELD_Z: return draw_slice(viewer, matrices);
    default: draw_segments(viewer, matrices); return HAIR_OK;
    }
}

// Set the range of the legend. Return false if the mode has none.
bool find_range(const view_debug& debug, float& low, float& high)
{
    low = debug.low;
    high = debug.high;
    if (debug.mode == VIEW_DEBUG_LOD) {
        low = 0;
        high = 1;
    } else if (debug.mode == VIEW_DEBUG_OVERDRAW) {
        low = 1;
        high = (float)view_debug_most_fragments;
    }
    return debug.mode < VIEW_DEBUG_PATCHES || debug.mode == VIEW_DEBUG_LOD ||
           debug.mode == VIEW_DEBUG_OVERDRAW;
}

std::string title_of(const view_debug& debug)
{
    char text[96];
    const char* name = names[debug.mode];
    if (debug.mode == VIEW_DEBUG_LOD)
        snprintf(text, sizeof text, "strands drawn of each patch, %u of %u", debug.drawn, debug.strands);
    else if (debug.mode == VIEW_DEBUG_OVERDRAW)
        snprintf(text, sizeof text, "fragments of a pixel, %.1f on average", (double)debug.fragments);
    else
        snprintf(text, sizeof text, debug.mode < VIEW_DEBUG_PATCHES ? "%s of the guides" : "%s", name);
    return text;
}

} // namespace

const char* view_debug_name(int mode)
{
    return names[mode];
}

void view_debug_select(viewer& viewer, int mode)
{
    view_debug& debug = viewer.debug;
    debug.mode = mode;
    debug.steps = 0;
    debug.high = 0;
    debug.values.clear();
    viewer.is_full = false;
}

void view_debug_next(viewer& viewer)
{
    view_debug_select(viewer, (viewer.debug.mode + 1) % VIEW_DEBUG_MODES);
}

int view_debug_draw(viewer& viewer, uint32_t width, uint32_t height)
{
    view_debug& debug = viewer.debug;
    if (debug.mode == VIEW_DEBUG_OFF) return HAIR_EXIT_OK;
    int code = view_debug_make_programs(debug, viewer.session.context);
    if (code) return code;
    hair_scene seen = view_session_seen(viewer.session, *viewer.document.scene);
    hair_matrices matrices;
    seen.width = width;
    seen.height = height;
    hair_camera_matrices(&seen, viewer.session.transform, viewer.session.reach, &matrices);
    make_target(debug, width, height);
    begin(viewer, matrices);
    code = hair_exit_for(draw_mode(viewer, matrices));
    glDisable(GL_DEPTH_TEST);
    return code;
}

void view_debug_show(const viewer& viewer)
{
    const view_debug& debug = viewer.debug;
    const view_place& picture = viewer.picture;
    if (debug.mode == VIEW_DEBUG_OFF || !debug.texture) return;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddImage((ImTextureID)(intptr_t)debug.texture, {picture.left, picture.top},
                   {picture.right, picture.bottom}, {0, 1}, {1, 0});
    float scale = viewer.gui.scale, low, high, step = 8 * scale;
    ImVec2 at = {picture.left + 14 * scale, picture.top + 12 * scale};
    list->AddText(at, IM_COL32(255, 255, 255, 255), title_of(debug).c_str());
    if (!find_range(debug, low, high)) return;
    at.y += 24 * scale;
    for (int i = 0; i < legend_steps; ++i) {
        float color[3], left = at.x + step * (float)i;
        view_debug_color(debug.mode, ((float)i + 0.5f) / legend_steps, color);
        list->AddRectFilled({left, at.y}, {left + step, at.y + step},
                            ImGui::ColorConvertFloat4ToU32({color[0], color[1], color[2], 1}));
    }
    std::string first = view_debug_text(debug.mode, low), last = view_debug_text(debug.mode, high);
    float right = at.x + step * legend_steps - ImGui::CalcTextSize(last.c_str()).x;
    list->AddText({at.x, at.y + 1.3f * step}, IM_COL32(255, 255, 255, 255), first.c_str());
    list->AddText({right, at.y + 1.3f * step}, IM_COL32(255, 255, 255, 255), last.c_str());
}

void view_debug_close(view_debug& debug)
{
    for (hair_shader*& shader : debug.shaders) hair_shader_destroy(shader);
    if (!debug.vertex_array) return; // OpenGL may be missing.
    for (unsigned program : debug.programs) glDeleteProgram(program);
    glDeleteFramebuffers(1, &debug.framebuffer);
    glDeleteTextures(1, &debug.texture);
    glDeleteRenderbuffers(1, &debug.depth);
    glDeleteVertexArrays(1, &debug.vertex_array);
    glDeleteBuffers(1, &debug.segments);
    glDeleteBuffers(2, debug.storage);
    debug = {};
}
