// redblack.cpp - Substeps of one guide as in Tariq 2010, "Hair", stage by stage.
//
// The Verlet step is x' = x + keep d + g dt^2 - D. x is the position relative to the head's origin,
// d the displacement of the last substep, D the displacement of the head, g gravity, dt the
// substep.
//
// The implicit pull is p' = p + (k / (1 + k)) (a - p) with k = (w dt)^2. w is the angular frequency
// of a spring to the target a.
#include "tests/reference/convert.h"

#include <cmath>
#include <vector>

namespace
{

// Number of vertices pinned to the scalp. The first segment keeps its direction too.
const uint32_t pinned = 2;

struct strand {
    double* positions;

    Vector3d operator[](uint32_t i) const { return vector_of(positions + 3 * i); }
    void put(uint32_t i, const Vector3d& p) { store(p, positions + 3 * i); }
};

double length_of_substep(const hair_reference_guide& g)
{
    return g.params->gravity.w;
}

Quaterniond head_rotation(const hair_reference_guide& g, uint32_t substep)
{
    return quaternion_of(g.params->substep[substep].rotation);
}

Vector3d rest_pose(const hair_reference_guide& g, uint32_t substep, uint32_t i)
{
    return head_rotation(g, substep) * vector_of(g.rest[i].position);
}

Vector3d pull(const Vector3d& p, const Vector3d& aim, double squared_frequency, double dt)
{
    const double k = squared_frequency * dt * dt;
    return (p + k * aim) / (1 + k);
}

// Move both ends of a link by half of its length error (Tariq 2010, figure 10). A pinned end does
// not move.
void relax(strand& s, uint32_t a, uint32_t b, double rest_length, double stiffness)
{
    if (b < pinned) return;
    const Vector3d link = s[b] - s[a];
    const double length = link.norm();
    if (length == 0) return;
    const Vector3d move = stiffness * (length - rest_length) * link / length;
    if (a < pinned) {
        s.put(b, s[b] - move);
    } else {
        s.put(a, s[a] + 0.5 * move);
        s.put(b, s[b] - 0.5 * move);
    }
}

Vector3d blend(const hair_vec4& a, const hair_vec4& b, double fraction)
{
    return (1 - fraction) * vector_of(a) + fraction * vector_of(b);
}

Vector3d push_out(const Vector3d& p, const hair_capsule& collider, double fraction, double margin)
{
    const Vector3d a = blend(collider.start[0], collider.end[0], fraction);
    const Vector3d b = blend(collider.start[1], collider.end[1], fraction);
    const double radius = (1 - fraction) * collider.start[0].w + fraction * collider.end[0].w + margin;
    const Vector3d axis = b - a;
    double along = axis.squaredNorm() > 0 ? (p - a).dot(axis) / axis.squaredNorm() : 0;
    along = std::fmin(std::fmax(along, 0), 1);
    const Vector3d nearest = a + along * axis;
    const double depth = radius - (p - nearest).norm();
    return depth > 0 ? Vector3d(nearest + radius * direction_of(p - nearest)) : p;
}

bool is_sound(const Vector3d& v)
{
    return v.squaredNorm() < 1e8; // false for NaN
}

// Return the smallest rotation from the unit vector r to the unit vector e.
Quaterniond min_rotation(const Vector3d& r, const Vector3d& e)
{
    const Vector3d axis = r.cross(e);
    return Quaterniond(1 + r.dot(e), axis.x(), axis.y(), axis.z()).normalized();
}

struct angular_moves {
    Vector3d end, couple; // moves of vertices i and i-2, vertex i-1 moves by minus their sum
};

// Return the gradient of (1 + e.r) / 2 * k/2 |d|^2 with d = x_(i-1) + q a - x_i. q is the smallest
// rotation from r to e, a the arm at rest. glsl/sim/angular.glsl derives the gradient and explains
// the bound of the stiffness.
angular_moves angular_force(const strand& s, const hair_rest* rest, const Quaterniond& head, uint32_t i,
                            double k)
{
    const Vector3d middle = vector_of(rest[i - 1].position);
    const Vector3d link = middle - vector_of(rest[i - 2].position);
    const Vector3d next = vector_of(rest[i].position) - middle;
    const Vector3d edge = s[i - 1] - s[i - 2];
    const Vector3d r = head * direction_of(link), e = direction_of(edge);
    const Vector3d arm = min_rotation(r, e) * (head * next), d = s[i - 1] + arm - s[i];
    const double ratio = next.norm() / link.norm(), sum = 1 + ratio;
    const double stiffness = k / (1 + 1.5 * (1 + sum * sum + ratio * ratio) * k);
    const Vector3d torque = stiffness * arm.cross(d);
    const Vector3d turning = (1 + e.dot(r)) / 2 * torque.cross(e) - torque.dot(e) / 2 * r.cross(e);
    const Vector3d opening = stiffness * d.squaredNorm() / 4 * (r - e.dot(r) * e);
    return {(1 + e.dot(r)) / 2 * stiffness * d,
            (turning + opening) / std::fmax(edge.norm(), link.norm() / 2)};
}

} // namespace

void hair_reference_integrate(hair_reference_guide g, uint32_t substep, const hair_reference_vertex* before,
                              double* positions)
{
    strand s{positions};
    const double dt = length_of_substep(g);
    const Vector3d head = vector_of(g.params->substep[substep].displacement);
    const Vector3d gravity = vector_of(g.params->gravity);
    for (uint32_t i = 0; i < g.guide->count; ++i) {
        const Vector3d aim = rest_pose(g, substep, i);
        if (i < pinned) {
            s.put(i, aim);
            continue;
        }
        const double fraction = double(i) / (g.guide->count - 1);
        const double frequency =
            g.params->shape_frequency_root +
            fraction * (double(g.params->shape_frequency_tip) - g.params->shape_frequency_root);
        const Vector3d free = vector_of(before[i].position) +
                              g.params->keep * vector_of(before[i].displacement) + gravity * dt * dt - head;
        s.put(i, pull(free, aim, frequency * frequency, dt));
    }
}

void hair_reference_angular(hair_reference_guide g, uint32_t substep, double* positions)
{
    if (g.params->angular <= 0) return;
    const Quaterniond head = head_rotation(g, substep);
    const double dt = length_of_substep(g);
    std::vector<Vector3d> moved(g.guide->count, Vector3d(0, 0, 0));
    strand s{positions};
    for (uint32_t i = pinned; i < g.guide->count; ++i) {
        const angular_moves moves = angular_force(s, g.rest, head, i, g.params->angular * dt * dt);
        moved[i] += moves.end;
        moved[i - 1] -= moves.end + moves.couple;
        moved[i - 2] += moves.couple;
    }
    for (uint32_t i = pinned; i < g.guide->count; ++i) s.put(i, s[i] + moved[i]);
}

void hair_reference_distance(hair_reference_guide g, uint32_t phase, double* positions)
{
    strand s{positions};
    for (uint32_t a = phase; a + 1 < g.guide->count; a += 2) relax(s, a, a + 1, g.rest[a].position.w, 1);
}

static double rest_distance(const hair_rest& a, const hair_rest& b)
{
    double x = double(b.position.x) - double(a.position.x), y = double(b.position.y) - double(a.position.y);
    double z = double(b.position.z) - double(a.position.z);
    return std::sqrt(x * x + y * y + z * z);
}

void hair_reference_bend(hair_reference_guide g, uint32_t phase, double* positions)
{
    strand s{positions};
    for (uint32_t block = 2 * phase; block < g.guide->count; block += 4)
        for (uint32_t a = block; a < block + 2 && a + 2 < g.guide->count; ++a)
            relax(s, a, a + 2, rest_distance(g.rest[a], g.rest[a + 2]), g.params->bend);
}

void hair_reference_collide(hair_reference_guide g, uint32_t substep, double* positions)
{
    strand s{positions};
    const double fraction = g.params->substep[substep].displacement.w;
    for (uint32_t i = pinned; i < g.guide->count; ++i)
        for (uint32_t k = 0; k < g.params->colliders; ++k)
            s.put(i, push_out(s[i], g.params->collider[k], fraction, g.params->collision_margin));
}

// Simulate one substep and compute its displacements. A strand that is not finite or too far away
// is reset to its rest pose and moves with the head. If the head moved too far, the displacement is
// 0.
static void advance(const hair_reference_guide& g, uint32_t substep, hair_reference_vertex* state)
{
    std::vector<double> moved(3 * g.guide->count);
    strand s{moved.data()};
    hair_reference_integrate(g, substep, state, moved.data());
    hair_reference_angular(g, substep, moved.data());
    for (uint32_t n = 0; n < g.params->iterations; ++n) {
        hair_reference_distance(g, 0, moved.data());
        hair_reference_distance(g, 1, moved.data());
        hair_reference_bend(g, 0, moved.data());
        hair_reference_bend(g, 1, moved.data());
        hair_reference_collide(g, substep, moved.data());
    }
    bool sound = true;
    const Vector3d head = vector_of(g.params->substep[substep].displacement);
    for (uint32_t i = 0; i < g.guide->count; ++i) {
        const Vector3d displacement = s[i] - vector_of(state[i].position) + head;
        store(displacement, state[i].displacement);
        sound = sound && is_sound(s[i]) && is_sound(displacement);
    }
    for (uint32_t i = 0; i < g.guide->count; ++i) {
        store(sound ? s[i] : rest_pose(g, substep, i), state[i].position);
        if (!sound) store(is_sound(head) ? head : Vector3d(0, 0, 0), state[i].displacement);
    }
}

void hair_reference_redblack(hair_reference_guide g, hair_reference_vertex* state)
{
    for (uint32_t substep = 0; substep < g.params->substeps; ++substep) advance(g, substep, state);
}
