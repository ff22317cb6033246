// grab.cpp - Hair and colliders that the mouse holds.
#include "tools/view/grab.h"
#include "tools/view/arrows.h"
#include "tools/view/camera.h"
#include "tools/view/gizmo.h"

#include <epoxy/gl.h>

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr int window = 15; // side of the square around the cursor that is searched, pixels
constexpr float ball_radius = 0.05f; // m

// Strand at a pixel, as HAIR_PASS_ID writes it.
struct pixel {
    uint32_t strand, guide, along, other;
};

// Return the pixel with hair that is nearest to the centre, or null.
const pixel* find_nearest(const pixel* pixels)
{
    const pixel* nearest = nullptr;
    int best = 1 << 30;
    for (int y = 0; y < window; ++y)
        for (int x = 0; x < window; ++x) {
            int dx = x - window / 2, dy = y - window / 2, distance = dx * dx + dy * dy;
            const pixel& here = pixels[y * window + x];
            if (!here.strand || distance >= best) continue;
            nearest = &here;
            best = distance;
        }
    return nearest;
}

hair_result draw_ids(viewer& viewer, const hair_matrices& matrices, pixel* out)
{
    const hair_scene& scene = *viewer.document.scene;
    static const GLuint none[4] = {0, 0, 0, 0};
    static const float far = 1;
    GLuint framebuffer, buffers[2];
    glCreateFramebuffers(1, &framebuffer);
    glCreateRenderbuffers(2, buffers);
    glNamedRenderbufferStorage(buffers[0], GL_RGBA32UI, window, window);
    glNamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT32F, window, window);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, window, window);
    glClearNamedFramebufferuiv(framebuffer, GL_COLOR, 0, none);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    if (viewer.session.render)
        hair_render_depth(viewer.session.render, &scene, viewer.session.transform, &matrices);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    hair_view view = scene.settings.view;
    view.pass = HAIR_PASS_ID;
    view.light_count = 0;
    memcpy(view.view, matrices.view, sizeof view.view);
    memcpy(view.projection, matrices.projection, sizeof view.projection);
    hair_result result = hair_draw(viewer.session.hair, &view);
    glDisable(GL_DEPTH_TEST);
    glReadPixels(0, 0, window, window, GL_RGBA_INTEGER, GL_UNSIGNED_INT, out);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(2, buffers);
    return result;
}

// Compute the matrices of the square around a place of the window.
hair_matrices matrices_at(const viewer& viewer, float x, float y)
{
    const view_place& picture = viewer.picture;
    float density = viewer.stage.density;
    float width = density * (picture.right - picture.left), height = density * (picture.bottom - picture.top);
    hair_scene seen = view_session_seen(viewer.session, *viewer.document.scene);
    seen.width = std::max(1u, (uint32_t)width);
    seen.height = std::max(1u, (uint32_t)height);
    hair_matrices matrices;
    hair_camera_matrices(&seen, viewer.session.transform, viewer.session.reach, &matrices);
    const float size[2] = {(float)window / width, (float)window / height};
    const float at[2] = {(x - picture.left) * density / width - 0.5f * size[0],
                         (y - picture.top) * density / height - 0.5f * size[1]};
    hair_matrices cropped = matrices;
    hair_camera_crop(matrices.projection, at, size, cropped.projection);
    return cropped;
}

// Return the vertex of a guide that appears nearest to a place of the window. The scalp holds the
// first two.
uint32_t find_vertex(const viewer& viewer, const float* guide, uint32_t vertices, float x, float y)
{
    uint32_t found = vertices - 1;
    float best = 1e30f;
    ImVec2 at;
    for (uint32_t i = 2; i < vertices; ++i) {
        if (!view_project(viewer, guide + 3 * i, at)) continue;
        float distance = (at.x - x) * (at.x - x) + (at.y - y) * (at.y - y);
        if (distance >= best) continue;
        best = distance;
        found = i;
    }
    return found;
}

// Pin the vertex of a guide that is nearest to a place of the window.
bool pin_guide(viewer& viewer, uint32_t guide, float x, float y)
{
    view_session& session = viewer.session;
    uint32_t count = 0;
    std::vector<float> positions(3 * (size_t)session.info.guide_vertex_count);
    if (guide >= session.info.guide_count ||
        hair_read_positions(session.hair, HAIR_READ_GUIDES, positions.data(), session.info.guide_vertex_count,
                            &count))
        return false;
    view_guide place = view_guide_of(session.groom, guide);
    const float* first = &positions[3 * (size_t)place.first];
    hair_pin pin = hair_pin_default();
    pin.guide = guide;
    pin.vertex = find_vertex(viewer, first, place.count, x, y);
    pin.to = HAIR_PIN_WORLD;
    memcpy(pin.position, first + 3 * (size_t)pin.vertex, sizeof pin.position);
    session.pins.assign(1, pin);
    return true;
}

// Return the index of the collider of the scene that a ray hits first, or -1. Colliders count as
// balls around them.
int find_collider(const viewer& viewer, const float ray[3])
{
    const hair_scene& scene = *viewer.document.scene;
    float nearest = 1e30f;
    int found = -1;
    for (uint32_t i = 0; i < scene.collider_count; ++i) {
        const hair_scene_collider& from = scene.colliders[i];
        hair_collider collider = view_collider_now(viewer, from);
        float radius = collider.rounding + std::max({collider.size[0], collider.size[1], collider.size[2]});
        float along = 0, square = 0;
        for (int k = 0; k < 3; ++k) {
            float offset = collider.position[k] - scene.eye[k] - viewer.session.way[k];
            along += offset * ray[k];
            square += offset * offset;
        }
        if (collider.shape == HAIR_SHAPE_PLANE || square - along * along > radius * radius) continue;
        if (along > 0 && along < nearest) {
            nearest = along;
            found = (int)i;
        }
    }
    return found;
}

} // namespace

view_drag view_grab(viewer& viewer, float x, float y)
{
    const view_place& picture = viewer.picture;
    float width = picture.right - picture.left, height = picture.bottom - picture.top, ray[3];
    if (width < 1 || height < 1) return VIEW_DRAG_NONE;
    view_camera_ray(*viewer.document.scene, (x - picture.left) / width, (y - picture.top) / height,
                    width / height, ray);
    bool shows_colliders = viewer.document.scene->show & HAIR_SHOW_COLLIDERS;
    viewer.held_collider = shows_colliders ? find_collider(viewer, ray) : -1;
    if (viewer.held_collider >= 0) return VIEW_DRAG_COLLIDER;
    if (viewer.document.scene->settings.desc.solver == HAIR_SOLVER_REDBLACK) {
        viewer_say(viewer, "The solver redblack has no pins, which hold hair.");
        return VIEW_DRAG_NONE;
    }
    pixel pixels[window * window];
    if (draw_ids(viewer, matrices_at(viewer, x, y), pixels)) return VIEW_DRAG_NONE;
    const pixel* found = find_nearest(pixels);
    bool is_held = found && pin_guide(viewer, found->guide - 1, x, y);
    return is_held ? VIEW_DRAG_HAIR : VIEW_DRAG_NONE;
}

void view_grab_move(viewer& viewer, float x, float y)
{
    hair_scene& scene = *viewer.document.scene;
    view_axes axes = view_camera_axes(scene);
    float *position = nullptr, height = view_camera_height(scene), by[3];
    for (int i = 0; i < 3; ++i) by[i] = height * (x * axes.right[i] - y * axes.up[i]);
    if (viewer.drag == VIEW_DRAG_HAIR && !viewer.session.pins.empty()) {
        position = viewer.session.pins[0].position;
        float depth = 0; // Hair before the target moves less for the same way of the mouse.
        for (int i = 0; i < 3; ++i)
            depth += (scene.eye[i] + viewer.session.way[i] - position[i]) * axes.back[i];
        for (float& v : by) v *= std::max(depth / axes.distance, 0.0f);
    } else if (viewer.drag == VIEW_DRAG_COLLIDER && viewer.held_collider < (int)scene.collider_count) {
        view_move_collider(viewer, scene.colliders[viewer.held_collider], by);
    }
    for (int i = 0; i < 3 && position; ++i) position[i] = std::clamp(position[i] + by[i], -1e5f, 1e5f);
}

void view_grab_end(viewer& viewer)
{
    viewer.session.pins.clear();
    viewer.held_collider = -1;
}

void view_add_ball(viewer& viewer)
{
    hair_scene& scene = *viewer.document.scene;
    if (scene.collider_count == HAIR_SCENE_COLLIDERS) {
        viewer_say(viewer, "The scene has all colliders that it can have.");
        return;
    }
    view_axes axes = view_camera_axes(scene);
    const view_place& picture = viewer.picture;
    float aspect = (picture.right - picture.left) / std::max(picture.bottom - picture.top, 1.0f);
    // Beside the hair, and in the picture.
    float aside = std::min(0.25f, 0.3f * aspect * view_camera_height(scene));
    hair_scene_collider& collider = scene.colliders[scene.collider_count++];
    collider = {};
    collider.collider = hair_collider_default();
    collider.stays = true;
    for (int i = 0; i < 3; ++i) {
        collider.collider.size[i] = i ? 0.1f : ball_radius;
        collider.collider.position[i] =
            scene.target[i] + viewer.session.way[i] + aside * axes.right[i] + 0.05f * axes.back[i];
    }
    scene.show |= HAIR_SHOW_COLLIDERS;
}
