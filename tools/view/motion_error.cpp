// motion_error.cpp - Error of the motion, against a second head of hair under the accurate solver
// with short substeps.
#include "tools/view/motion_error.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

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
void compare(view_motion_error& error, const std::vector<float>& shown, const std::vector<float>& right,
             uint32_t guides, uint32_t vertices)
{
    double sum = 0, lengths = 0;
    error.worst = 0;
    for (uint32_t guide = 0; guide < guides; ++guide) {
        const float* a = &shown[3 * (size_t)guide * vertices];
        const float* b = &right[3 * (size_t)guide * vertices];
        double own = 0, length = 0;
        for (uint32_t i = 0; i < vertices; ++i) {
            own += square(a + 3 * i, b + 3 * i);
            if (i) length += sqrt(square(b + 3 * i, b + 3 * i - 3));
        }
        sum += own;
        lengths += length;
        double relative = length > 0 ? sqrt(own / vertices) / length : 0;
        if (relative <= error.worst) continue;
        error.worst = relative;
        error.worst_guide = guide;
        memcpy(error.worst_tip, a + 3 * (vertices - 1), sizeof error.worst_tip);
    }
    if (lengths > 0) error.rms = sqrt(sum / ((double)guides * vertices)) / (lengths / guides);
}

} // namespace

void view_motion_error_end(view_motion_error& error, view_session& session)
{
    hair_destroy(session.twin);
    session.twin = nullptr;
    error.rms = -1;
}

int view_motion_error_begin(view_motion_error& error, view_session& session, const hair_scene& scene)
{
    view_motion_error_end(error, session);
    hair_desc desc = scene.settings.desc;
    desc.label = "reference of the motion";
    desc.solver = HAIR_SOLVER_ACCURATE;
    desc.thread_mapping = HAIR_THREAD_MAPPING_AUTO;
    desc.substep = substep;
    desc.physics = &scene.settings.physics;
    hair_motion_at(&scene.motion, 0, desc.transform);
    hair_wind wind = hair_scene_wind_of(&scene.settings, &scene.wind);
    hair_result result = hair_create(session.context, session.groom, &desc, &session.twin);
    if (!result) result = hair_set_wind(session.twin, &wind);
    if (result) {
        view_motion_error_end(error, session);
        return hair_exit_for(result);
    }
    return view_session_reset(session, scene);
}

int view_motion_error_update(view_motion_error& error, view_session& session, const hair_scene& scene)
{
    if (!session.twin) return view_motion_error_begin(error, session, scene);
    std::vector<float> shown, right;
    uint32_t all = session.info.guide_vertex_count, guides = session.info.guide_count;
    bool ok = guides && read(session.hair, all, shown) && read(session.twin, all, right);
    if (ok) compare(error, shown, right, guides, all / guides);
    return HAIR_EXIT_OK;
}
