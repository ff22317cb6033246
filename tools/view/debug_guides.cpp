// debug_guides.cpp - Numbers of the guides for the debug view.
#include "tools/view/debug_guides.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr float contact_range = 0.03f; // m
constexpr float fading = 0.97f; // of the range in a step, so that the colours do not flicker
constexpr double two_pi = 6.283185307179586;

bool is_guide_mode(int mode)
{
    return mode >= VIEW_DEBUG_STRETCH && mode <= VIEW_DEBUG_CONTACT;
}

double distance(const float* a, const float* b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sqrt(sum);
}

void find_stretch(viewer& viewer, const view_guide& guide)
{
    view_debug& debug = viewer.debug;
    for (uint32_t i = guide.first; i < guide.first + guide.count; ++i) {
        uint32_t from = std::min(i, guide.first + guide.count - 2);
        const float* x = &debug.positions[0][3 * (size_t)from];
        float length = view_guide_rest(viewer.session.groom, from)[3];
        debug.values[i] = (float)(distance(x, x + 3) / (double)length - 1);
    }
}

void find_velocity(view_debug& debug, const view_guide& guide)
{
    for (uint32_t i = guide.first; i < guide.first + guide.count; ++i) {
        size_t at = 3 * (size_t)i;
        debug.values[i] =
            debug.steps < 2
                ? 0
                : (float)(distance(&debug.positions[0][at], &debug.positions[1][at]) / debug.dt[0]);
    }
}

void find_contact(view_debug& debug, const std::vector<hair_collider>& colliders, const view_guide& guide)
{
    for (uint32_t i = guide.first; i < guide.first + guide.count; ++i) {
        const float* x = &debug.positions[0][3 * (size_t)i];
        const double point[3] = {(double)x[0], (double)x[1], (double)x[2]};
        double nearest = view_guide_distance(point, colliders.data(), (uint32_t)colliders.size());
        debug.values[i] = (float)std::min(nearest, 1.0);
    }
}

// Compute the force that accelerates a vertex less gravity, damping and the pull to the rest pose.
// This force is the sum of tension and bending. `fraction` is the position along the guide.
void find_force(const viewer& viewer, uint32_t vertex, double fraction, double mass, double out[3])
{
    const view_debug& debug = viewer.debug;
    const hair_physics& physics = viewer.document.scene->settings.physics;
    const float* velocity = viewer.document.scene->settings.wind.velocity;
    const float *m = viewer.session.transform, *rest = view_guide_rest(viewer.session.groom, vertex);
    double frequency =
        (double)physics.shape.frequency_root +
        fraction * ((double)physics.shape.frequency_tip - (double)physics.shape.frequency_root);
    double dt = 0.5 * (debug.dt[0] + debug.dt[1]), pull = two_pi * two_pi * frequency * frequency;
    for (int k = 0; k < 3; ++k) {
        size_t at = 3 * (size_t)vertex + (size_t)k;
        double x0 = (double)debug.positions[0][at], x1 = (double)debug.positions[1][at],
               x2 = (double)debug.positions[2][at];
        double target = (double)(m[k] * rest[0] + m[4 + k] * rest[1] + m[8 + k] * rest[2] + m[12 + k]);
        double v = (x0 - x2) / (2 * dt), a = (x0 - 2 * x1 + x2) / (dt * dt);
        out[k] = mass * (a - (double)physics.gravity[k] +
                         (double)physics.damping * (v - (double)velocity[k]) - pull * (target - x1));
    }
}

// Tension in the middle of the last three steps, N. The part of a guide beyond a segment has no
// other force from inside the hair than that of the segment.
void find_tension(viewer& viewer, const view_guide& guide)
{
    view_debug& debug = viewer.debug;
    double radius = (double)viewer.document.scene->settings.physics.fiber.radius, beyond[3] = {0, 0, 0};
    double density =
        0.5 * two_pi * radius * radius * (double)viewer.document.scene->settings.physics.fiber.density;
    for (uint32_t i = guide.count; debug.steps == 3 && i-- > 0;) {
        uint32_t vertex = guide.first + i, before = vertex - (i > 0);
        double after = (double)view_guide_rest(viewer.session.groom, vertex)[3];
        double length = (double)view_guide_rest(viewer.session.groom, before)[3], force[3], along = 0;
        const float *x = &debug.positions[1][3 * (size_t)vertex],
                    *y = &debug.positions[1][3 * (size_t)before];
        double mass = 0.5 * density * (after + (i > 0 ? length : 0));
        find_force(viewer, vertex, (double)i / (guide.count - 1), mass, force);
        double size = std::max(distance(x, y), 1e-12);
        for (int k = 0; k < 3; ++k) beyond[k] += force[k];
        for (int k = 0; k < 3; ++k) along -= beyond[k] * ((double)x[k] - (double)y[k]) / size;
        // A vertex has the tension of the segment to the root.
        debug.values[vertex] =
            i > 0 ? (float)along : debug.values[std::min(vertex + 1, guide.first + guide.count - 1)];
    }
}

void find_values(viewer& viewer)
{
    view_debug& debug = viewer.debug;
    std::vector<hair_collider> colliders;
    if (debug.mode == VIEW_DEBUG_CONTACT)
        colliders = view_session_known_colliders(viewer.session, *viewer.document.scene);
    debug.values.assign(viewer.session.info.guide_vertex_count, 0);
    for (uint32_t i = 0; i < viewer.session.info.guide_count; ++i) {
        view_guide guide = view_guide_of(viewer.session.groom, i);
        switch (debug.mode) {
        case VIEW_DEBUG_STRETCH: find_stretch(viewer, guide); break;
        case VIEW_DEBUG_TENSION: find_tension(viewer, guide); break;
        case VIEW_DEBUG_VELOCITY: find_velocity(debug, guide); break;
        default: find_contact(debug, colliders, guide); break;
        }
    }
}

void find_range(view_debug& debug)
{
    float largest = 0;
    for (float value : debug.values) largest = std::max(largest, fabsf(value));
    debug.high = std::max({largest, fading * debug.high, 1e-9f});
    debug.low = debug.mode == VIEW_DEBUG_VELOCITY ? 0 : -debug.high;
    if (debug.mode != VIEW_DEBUG_CONTACT) return;
    debug.low = 0;
    debug.high = contact_range;
}

} // namespace

int view_debug_update(viewer& viewer, double dt)
{
    view_debug& debug = viewer.debug;
    view_session& session = viewer.session;
    if (!is_guide_mode(debug.mode) || dt <= 0) return HAIR_EXIT_OK;
    bool is_other = debug.generation != session.generation ||
                    debug.positions[0].size() != 3 * (size_t)session.info.guide_vertex_count;
    if (is_other) debug.steps = 0;
    debug.generation = session.generation;
    debug.positions[2].swap(debug.positions[1]);
    debug.positions[1].swap(debug.positions[0]);
    debug.dt[1] = debug.dt[0];
    debug.dt[0] = dt;
    uint32_t count = 0, all = session.info.guide_vertex_count;
    debug.positions[0].resize(3 * (size_t)all);
    hair_result result =
        hair_read_positions(session.hair, HAIR_READ_GUIDES, debug.positions[0].data(), all, &count);
    if (result) return hair_exit_for(result);
    debug.steps = std::min(debug.steps + 1, 3u);
    find_values(viewer);
    find_range(debug);
    return HAIR_EXIT_OK;
}

void view_debug_segments(const viewer& viewer, std::vector<view_debug_segment>& out)
{
    const view_debug& debug = viewer.debug;
    out.clear();
    if (!is_guide_mode(debug.mode) || debug.generation != viewer.session.generation ||
        debug.values.size() != viewer.session.info.guide_vertex_count)
        return;
    float range = std::max(debug.high - debug.low, 1e-12f);
    for (uint32_t i = 0; i < viewer.session.info.guide_count; ++i) {
        view_guide guide = view_guide_of(viewer.session.groom, i);
        for (uint32_t k = guide.first; k + 1 < guide.first + guide.count; ++k) {
            view_debug_segment segment;
            const float* x = &debug.positions[0][3 * (size_t)k];
            memcpy(segment.from, x, sizeof segment.from);
            memcpy(segment.to, x + 3, sizeof segment.to);
            view_debug_color(debug.mode, (debug.values[k] - debug.low) / range, segment.from_color);
            view_debug_color(debug.mode, (debug.values[k + 1] - debug.low) / range, segment.to_color);
            out.push_back(segment);
        }
    }
}

void view_debug_color(int mode, float fraction, float out[3])
{
    static const float sequence[5][3] = {
        {0.12f, 0.2f, 0.6f}, {0.1f, 0.6f, 0.85f}, {0.35f, 0.85f, 0.4f}, {1, 0.8f, 0.2f}, {1, 0.2f, 0.12f}};
    static const float signs[5][3] = {
        {0.15f, 0.35f, 1}, {0.5f, 0.65f, 1}, {0.93f, 0.93f, 0.93f}, {1, 0.6f, 0.5f}, {1, 0.2f, 0.12f}};
    static const float touch[5][3] = {
        {1, 0.2f, 0.12f}, {1, 0.75f, 0.2f}, {0.5f, 0.75f, 0.55f}, {0.4f, 0.55f, 0.75f}, {0.35f, 0.4f, 0.55f}};
    bool has_signs = mode == VIEW_DEBUG_STRETCH || mode == VIEW_DEBUG_TENSION;
    const float(*stops)[3] = has_signs ? signs : mode == VIEW_DEBUG_CONTACT ? touch : sequence;
    float at = 4 * std::clamp(isfinite(fraction) ? fraction : 1, 0.0f, 1.0f);
    int stop = std::min((int)at, 3);
    for (int k = 0; k < 3; ++k)
        out[k] = stops[stop][k] + (at - (float)stop) * (stops[stop + 1][k] - stops[stop][k]);
}

std::string view_debug_text(int mode, float value)
{
    char text[48];
    double v = (double)value;
    switch (mode) {
    case VIEW_DEBUG_STRETCH: snprintf(text, sizeof text, "%.3g %%", 100 * v); break;
    case VIEW_DEBUG_TENSION: snprintf(text, sizeof text, "%.3g \xc2\xb5N", 1e6 * v); break;
    case VIEW_DEBUG_VELOCITY: snprintf(text, sizeof text, "%.2f m/s", v); break;
    case VIEW_DEBUG_CONTACT: snprintf(text, sizeof text, "%.0f mm", 1e3 * v); break;
    case VIEW_DEBUG_LOD: snprintf(text, sizeof text, "%.0f %%", 100 * v); break;
    default: snprintf(text, sizeof text, "%.0f", v); break;
    }
    return text;
}
