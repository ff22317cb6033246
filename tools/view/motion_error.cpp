// motion_error.cpp - Error of the motion, against the reference and against a second head of hair.
#include "tools/view/motion_error.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr double frame = 1.0 / 60; // s
constexpr uint32_t max_guides = 32; // that the reference follows
constexpr uint32_t second_head_frames = 10; // frames between two comparisons with the second head
constexpr float substep = 1.0f / 1920; // s

double square(const float* a, const float* b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sum;
}

bool read(hair_instance* hair, uint32_t vertices, std::vector<float>& out)
{
    uint32_t count = 0;
    out.resize(3 * (size_t)vertices);
    return !hair_read_positions(hair, HAIR_READ_GUIDES, out.data(), vertices, &count) && count == vertices;
}

// Compare the guides of two heads.
void compare(view_motion_error& error, const view_session& session, const std::vector<float>& shown,
             const std::vector<float>& right)
{
    double sum = 0, lengths = 0;
    error.worst = 0;
    for (uint32_t guide = 0; guide < session.info.guide_count; ++guide) {
        view_guide place = view_guide_of(session.groom, guide);
        const float* a = &shown[3 * (size_t)place.first];
        const float* b = &right[3 * (size_t)place.first];
        double own = 0, length = 0;
        for (uint32_t i = 0; i < place.count; ++i) {
            own += square(a + 3 * i, b + 3 * i);
            if (i) length += sqrt(square(b + 3 * i, b + 3 * i - 3));
        }
        sum += own;
        lengths += length;
        if (length > 0) error.worst = std::max(error.worst, sqrt(own / place.count) / length);
    }
    uint32_t vertices = session.info.guide_vertex_count;
    if (lengths > 0) error.rms = sqrt(sum / vertices) / (lengths / session.info.guide_count);
}

// Make the second head.
hair_result make_twin(view_session& session, const hair_scene& scene)
{
    hair_desc desc = scene.settings.desc;
    desc.label = "reference of the motion";
    desc.solver = HAIR_SOLVER_ACCURATE;
    desc.thread_mapping = HAIR_THREAD_MAPPING_AUTO;
    desc.substep = substep;
    desc.physics = &scene.settings.physics;
    memcpy(desc.transform, session.transform, sizeof desc.transform);
    hair_wind wind = hair_scene_wind_of(&scene.settings, &scene.wind);
    hair_result result = hair_create(session.context, session.groom, &desc, &session.twin);
    if (!result) result = hair_groups_apply(session.twin, &scene.settings, nullptr);
    return result ? result : hair_set_wind(session.twin, &wind);
}

} // namespace

void view_motion_error_end(view_motion_error& error, view_session& session)
{
    hair_destroy(session.twin);
    session.twin = nullptr;
    view_reference_end(error.reference);
    error.free = {};
    error.rms = -1;
}

int view_motion_error_prepare(view_motion_error& error, view_session& session, const hair_scene& scene)
{
    const hair_physics& physics = scene.settings.physics;
    const char* obstacle = view_reference_obstacle(scene);
    bool is_other =
        !session.twin || memcmp(&error.physics, &physics, sizeof physics) || !error.obstacle != !obstacle;
    if (!is_other && error.reference.generation == session.generation) return HAIR_EXIT_OK;
    if (is_other) {
        view_motion_error_end(error, session);
        hair_result result = make_twin(session, scene);
        int code = result ? hair_exit_for(result) : view_session_reset(session, scene);
        if (code) {
            view_motion_error_end(error, session);
            return code;
        }
    }
    error.physics = physics;
    error.obstacle = obstacle;
    error.frames = 0;
    error.rms = -1;
    error.free = {};
    view_reference_begin(error.reference, session, scene, obstacle ? 0 : max_guides);
    return HAIR_EXIT_OK;
}

double view_motion_error_frames(view_motion_error& error, double dt)
{
    error.dt = std::min(error.dt + dt, 4 * frame);
    double now = frame * floor(error.dt / frame + 1e-3);
    error.dt = std::max(error.dt - now, 0.0);
    return now;
}

int view_motion_error_update(view_motion_error& error, view_session& session, const hair_scene& scene,
                             double dt, bool waits)
{
    std::vector<float> shown, right;
    uint32_t all = session.info.guide_vertex_count;
    if (!read(session.hair, all, shown)) return HAIR_EXIT_RUNTIME;
    bool is_due = error.frames++ % second_head_frames == 0;
    if (is_due && read(session.twin, all, right)) compare(error, session, shown, right);
    if (error.obstacle) return HAIR_EXIT_OK;
    view_reference_add(error.reference, session, scene, shown, dt);
    if (waits) view_reference_wait(error.reference);
    error.free = view_reference_newest(error.reference);
    return HAIR_EXIT_OK;
}
