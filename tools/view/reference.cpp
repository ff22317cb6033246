// reference.cpp - Guides that the reference moves in double precision, on a thread of its own.
#include "tools/view/reference.h"

#include <math.h>
#include <string.h>

#include <algorithm>

extern "C" {
#include "tests/reference/guide_rod.h"
}

namespace
{

constexpr double longest_substep = 1.0 / 3840; // s
// Distance from a collider's margin at which a guide may have touched it within the frame, m.
constexpr double nearness = 0.005;
constexpr size_t longest_queue = 60; // frames

// Return the pose of a rigid transform, column-major.
hair_reference_rod_pose pose_of(const float m[16])
{
    hair_reference_rod_pose pose;
    double q[4], largest = -1;
    int at = 3;
    // Each row is 4 times the square of a component, in the order xyzw.
    const double squares[4] = {1.0 + m[0] - m[5] - m[10], 1.0 - m[0] + m[5] - m[10],
                               1.0 - m[0] - m[5] + m[10], 1.0 + m[0] + m[5] + m[10]};
    for (int i = 0; i < 4; ++i)
        if (squares[i] > largest) {
            largest = squares[i];
            at = i;
        }
    const double yz = m[6] + m[9], zx = m[8] + m[2], xy = m[1] + m[4];
    const double wx = m[6] - m[9], wy = m[8] - m[2], wz = m[1] - m[4];
    const double rows[4][4] = {
        {largest, xy, zx, wx}, {xy, largest, yz, wy}, {zx, yz, largest, wz}, {wx, wy, wz, largest}};
    double length = 0;
    for (int i = 0; i < 4; ++i) q[i] = rows[at][i];
    for (double v : q) length += v * v;
    for (int i = 0; i < 4; ++i) pose.rotation[i] = q[i] / sqrt(length);
    for (int i = 0; i < 3; ++i) pose.position[i] = (double)m[12 + i];
    return pose;
}

double square(const double* a, const double* b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

double potential_of(const hair_reference_rod* rod)
{
    struct hair_reference_rod_energy energy = hair_reference_rod_energy_of(rod);
    return energy.total - energy.kinetic;
}

// Update the shown twin of a guide. Return its energy beyond that at rest. The velocity is that of
// the middle of the frame, therefore the potential is the mean of both ends.
double energy_of(view_followed& guide, const double* shown, double dt)
{
    std::vector<double> velocities(guide.before.size());
    for (size_t i = 0; i < velocities.size(); ++i) velocities[i] = (shown[i] - guide.before[i]) / dt;
    hair_reference_rod_set_state(guide.shown, shown, velocities.data());
    double potential = potential_of(guide.shown);
    double energy = hair_reference_rod_energy_of(guide.shown).kinetic + 0.5 * (potential + guide.potential);
    guide.potential = potential;
    guide.before.assign(shown, shown + guide.before.size());
    return energy - guide.rest_energy;
}

// Move a guide to the end of a frame. Return false if it does not remain free.
bool advance(const view_reference& reference, view_followed& guide, const view_reference_frame& frame)
{
    double longest = std::min(longest_substep, 0.5 * hair_reference_rod_longest_substep(guide.right));
    hair_reference_rod_set_wind(guide.right, frame.wind, frame.drag);
    if (!hair_reference_rod_advance(guide.right, &frame.head, frame.dt, (uint32_t)ceil(frame.dt / longest)))
        return false;
    std::vector<double> right(3 * (size_t)guide.count);
    hair_reference_rod_positions(guide.right, right.data());
    return !view_guide_touches(right.data(), guide.count, frame.colliders.data(),
                               (uint32_t)frame.colliders.size(), reference.margin);
}

void compare(const view_followed& guide, const double* shown, double& sum, view_reference_result& result)
{
    std::vector<double> right(3 * (size_t)guide.count);
    hair_reference_rod_positions(guide.right, right.data());
    double own = 0;
    for (uint32_t i = 0; i < guide.count; ++i) own += square(shown + 3 * i, &right[3 * i]);
    sum += own;
    double relative = sqrt(own / guide.count) / guide.length;
    if (relative < result.worst) return;
    result.worst = relative;
    result.worst_shown.assign(shown, shown + right.size());
    result.worst_right.assign(right.begin(), right.end());
}

void compute(view_reference& reference, const view_reference_frame& frame, size_t active,
             view_reference_result& result)
{
    double sum = 0, lengths = 0, energy = 0;
    size_t vertices = 0;
    result.worst = 0;
    result.free = 0;
    result.followed = (uint32_t)active;
    for (size_t i = 0; i < active; ++i) {
        view_followed& guide = reference.guides[i];
        guide.is_free = guide.is_free && !frame.is_held[i] && advance(reference, guide, frame);
        if (!guide.is_free) continue;
        const double* shown = &frame.shown[3 * guide.at];
        energy += energy_of(guide, shown, frame.dt);
        compare(guide, shown, sum, result);
        vertices += guide.count;
        lengths += guide.length;
        ++result.free;
    }
    ++result.frames;
    result.rms = result.free ? sqrt(sum / (double)vertices) / (lengths / result.free) : -1;
    result.energy = result.free ? reference.line_density * energy / result.free : 0;
}

void run(view_reference* reference)
{
    view_reference_result result;
    std::unique_lock<std::mutex> lock(reference->mutex);
    for (;;) {
        reference->changed.wait(lock, [&] { return reference->ends || !reference->queue.empty(); });
        if (reference->ends) return;
        view_reference_frame frame = std::move(reference->queue.front());
        reference->queue.pop_front();
        reference->is_busy = true;
        size_t active = reference->active;
        lock.unlock();
        compute(*reference, frame, active, result);
        lock.lock();
        reference->is_busy = false;
        reference->result = result;
        reference->changed.notify_all();
    }
}

void follow(view_reference& reference, const view_session& session, const hair_scene& scene, uint32_t guide)
{
    const hair_physics& physics = scene.settings.physics;
    hair_wind wind = hair_scene_wind_of(&scene.settings, &scene.wind);
    hair_reference_rod_pose head = pose_of(session.transform);
    view_followed followed;
    view_guide place = view_guide_of(session.groom, guide);
    followed.guide = guide;
    followed.first = place.first;
    followed.count = place.count;
    followed.right = view_guide_rod(session.hair, session.groom, guide, &physics, &wind, &head);
    if (!followed.right) return;
    followed.shown = hair_reference_rod_copy(followed.right);
    followed.potential = followed.rest_energy = potential_of(followed.shown);
    followed.before.resize(3 * (size_t)place.count);
    hair_reference_rod_positions(followed.shown, followed.before.data());
    for (uint32_t i = 0; i + 1 < place.count; ++i)
        followed.length += sqrt(square(&followed.before[3 * i], &followed.before[3 * i + 3]));
    const view_followed* last = reference.guides.empty() ? nullptr : &reference.guides.back();
    followed.at = last ? last->at + last->count : 0;
    reference.guides.push_back(std::move(followed));
}

} // namespace

const char* view_reference_obstacle(const hair_scene& scene)
{
    const hair_settings& settings = scene.settings;
    const hair_wind& wind = settings.wind;
    bool has_wind = wind.velocity[0] != 0 || wind.velocity[1] != 0 || wind.velocity[2] != 0;
    bool varies = wind.shelter > 0 || wind.turbulence.intensity > 0 || wind.model != HAIR_WIND_AMBIENT;
    if (*scene.character.file) return "a character bends the scalp";
    if (scene.wind.count || (has_wind && varies)) return "the wind varies";
    if (settings.physics.hair_hair.cohesion > 0 || settings.physics.hair_hair.pressure_stiffness > 0)
        return "hairs touch";
    return nullptr;
}

void view_reference_begin(view_reference& reference, const view_session& session, const hair_scene& scene,
                          uint32_t max_guides)
{
    view_reference_end(reference);
    uint32_t count = session.info.guide_count, wanted = std::min(count, max_guides);
    double radius = (double)scene.settings.physics.fiber.radius;
    reference.margin = (double)scene.settings.physics.collision.margin + nearness;
    reference.line_density =
        3.14159265358979 * radius * radius * (double)scene.settings.physics.fiber.density;
    reference.generation = session.generation;
    // The order by the golden ratio keeps any number of guides evenly spread.
    std::vector<bool> known(count, false);
    for (uint32_t i = 0; i < wanted; ++i) {
        uint32_t guide = (uint32_t)(fmod(0.6180339887498949 * (i + 1), 1) * count);
        if (known[guide]) continue;
        known[guide] = true;
        follow(reference, session, scene, guide);
    }
    reference.active = reference.guides.size();
    reference.ends = false;
    reference.result = {};
    reference.thread = std::thread(run, &reference);
}

void view_reference_end(view_reference& reference)
{
    if (reference.thread.joinable()) {
        {
            std::lock_guard<std::mutex> lock(reference.mutex);
            reference.ends = true;
        }
        reference.changed.notify_all();
        reference.thread.join();
    }
    for (view_followed& guide : reference.guides) {
        hair_reference_rod_destroy(guide.right);
        hair_reference_rod_destroy(guide.shown);
    }
    reference.guides.clear();
    reference.queue.clear();
    reference.result = {};
}

void view_reference_add(view_reference& reference, const view_session& session, const hair_scene& scene,
                        const std::vector<float>& positions, double dt)
{
    view_reference_frame frame;
    hair_wind wind = hair_scene_wind_of(&scene.settings, &scene.wind);
    frame.head = pose_of(session.transform);
    frame.dt = dt;
    frame.drag = hair_reference_guide_rod_drag(&scene.settings.physics, &wind);
    for (int i = 0; i < 3; ++i) frame.wind[i] = (double)wind.velocity[i];
    std::vector<hair_collider> colliders = view_session_known_colliders(session, scene);
    // Meshes of Bullet objects may be gone when the thread reads the frame.
    for (const hair_collider& collider : colliders)
        if (collider.shape != HAIR_SHAPE_MESH || collider.mesh == session.live_colliders.head)
            frame.colliders.push_back(collider);
    for (const view_followed& guide : reference.guides) {
        const float* from = &positions[3 * (size_t)guide.first];
        size_t at = frame.shown.size();
        frame.shown.insert(frame.shown.end(), from, from + 3 * (size_t)guide.count);
        bool is_held = view_guide_touches(&frame.shown[at], guide.count, colliders.data(),
                                          (uint32_t)colliders.size(), reference.margin) ||
                       std::any_of(session.pins.begin(), session.pins.end(),
                                   [&](const hair_pin& pin) { return pin.guide == guide.guide; });
        frame.is_held.push_back(is_held);
    }
    std::lock_guard<std::mutex> lock(reference.mutex);
    reference.queue.push_back(std::move(frame));
    if (reference.queue.size() > longest_queue && reference.queue.size() % longest_queue == 1)
        reference.active = std::max<size_t>(reference.active / 2, 1);
    reference.changed.notify_all();
}

void view_reference_wait(view_reference& reference)
{
    std::unique_lock<std::mutex> lock(reference.mutex);
    reference.changed.wait(lock, [&] { return reference.queue.empty() && !reference.is_busy; });
}

view_reference_result view_reference_newest(view_reference& reference)
{
    std::lock_guard<std::mutex> lock(reference.mutex);
    return reference.result;
}
