// rod_dynamics.cpp - Motion of a rod.
//
// A substep is symmetric in time. It consists of half the damping, half the forces, motion under
// the constraints, half the forces and half the damping, in this order. Constraint forces act along
// the segments as they were at the start of the substep (SHAKE, Ryckaert, Ciccotti, Berendsen
// 1977). This preserves the second order and the energy. At the end, velocities are made consistent
// with the lengths (RATTLE, Andersen 1983).
#include "tests/reference/rod_state.h"

#include <algorithm>
#include <cmath>

namespace
{

// Motion of the head over a frame.
struct journey {
    hair_reference_rod_place from;
    Vector3d velocity, spin; // `spin` is in rad/s

    hair_reference_rod_place at(double t) const
    {
        return {from.position + t * velocity, (rotation_by(t * spin) * from.rotation).normalized()};
    }
};

journey journey_to(const hair_reference_rod_place& from, const hair_reference_rod_place& to, double dt)
{
    Quaterniond turn = to.rotation * from.rotation.conjugate();
    if (turn.w() < 0) turn.coeffs() *= -1;
    const double sine = turn.vec().norm();
    const double angle = 2 * std::atan2(sine, turn.w());
    const Vector3d spin = sine > 0 ? Vector3d(turn.vec() * (angle / sine / dt)) : Vector3d(0, 0, 0);
    return {from, (to.position - from.position) / dt, spin};
}

struct tridiagonal {
    std::vector<double> below, diagonal, above, right;

    explicit tridiagonal(size_t n) : below(n), diagonal(n), above(n), right(n) {}
    void solve() // the result replaces `right`
    {
        const size_t n = right.size();
        for (size_t j = 1; j < n; ++j) {
            const double f = below[j] / diagonal[j - 1];
            diagonal[j] -= f * above[j - 1];
            right[j] -= f * right[j - 1];
        }
        for (size_t j = n; j-- > 0;) {
            if (j + 1 < n) right[j] -= above[j] * right[j + 1];
            right[j] /= diagonal[j];
        }
    }
};

std::vector<Vector3d> directions(const std::vector<Vector3d>& x)
{
    std::vector<Vector3d> d;
    for (size_t j = 0; j + 1 < x.size(); ++j) d.push_back((x[j + 1] - x[j]).normalized());
    return d;
}

// Fill the matrix of length changes when the ends of segments are pushed apart along `along`. The
// segments point along `now`.
void fill(const hair_reference_rod& rod, const std::vector<Vector3d>& now, const std::vector<Vector3d>& along,
          tridiagonal& t)
{
    for (uint32_t j = 0; j < rod.segments(); ++j) {
        t.diagonal[j] = (rod.inverse_mass(j) + rod.inverse_mass(j + 1)) * now[j].dot(along[j]);
        if (j > 0) t.below[j] = -rod.inverse_mass(j) * now[j].dot(along[j - 1]);
        if (j + 1 < rod.segments()) t.above[j] = -rod.inverse_mass(j + 1) * now[j].dot(along[j + 1]);
    }
}

void push(const hair_reference_rod& rod, const std::vector<Vector3d>& along, const std::vector<double>& by,
          std::vector<Vector3d>& what)
{
    for (uint32_t j = 0; j < rod.segments(); ++j) {
        what[j] -= rod.inverse_mass(j) * by[j] * along[j];
        what[j + 1] += rod.inverse_mass(j + 1) * by[j] * along[j];
    }
}

// Move by `step`, corrected by Newton's method such that lengths are preserved. Return false if it
// does not converge.
bool move(hair_reference_rod& rod, std::vector<Vector3d>& step, tridiagonal& t)
{
    const std::vector<Vector3d> start = rod.x, along = directions(rod.x);
    double previous = INFINITY;
    for (int iteration = 0; iteration < 50; ++iteration) {
        double farthest = 0, sum = 0, error = 0;
        for (uint32_t i = 0; i < rod.vertices; ++i) {
            rod.x[i] = start[i] + step[i];
            farthest = std::fmax(farthest, rod.x[i].cwiseAbs().maxCoeff());
            // A sum with a non-finite term is not finite, but a maximum can be.
            sum += rod.x[i].sum();
        }
        std::vector<Vector3d> now = directions(rod.x);
        double rounding = 0;
        for (uint32_t j = 0; j < rod.segments(); ++j) {
            t.right[j] = rod.lengths[j] - (rod.x[j + 1] - rod.x[j]).norm();
            error = std::fmax(error, std::fabs(t.right[j]) / rod.lengths[j]);
            rounding = std::fmax(rounding, 4e-16 * farthest / rod.lengths[j]);
        }
        if (!std::isfinite(sum) || error > 1e3) return false;
        if (error < 1e-14 + rounding || (error < 1e-10 && error >= previous / 2)) return true;
        previous = error;
        fill(rod, now, along, t);
        t.solve();
        push(rod, along, t.right, step);
    }
    return false;
}

void make_velocities_agree(hair_reference_rod& rod, tridiagonal& t)
{
    if (rod.is_held()) rod.v[0] = rod.root_velocity;
    const std::vector<Vector3d> now = directions(rod.x);
    for (uint32_t j = 0; j < rod.segments(); ++j) t.right[j] = -now[j].dot(rod.v[j + 1] - rod.v[j]);
    fill(rod, now, now, t);
    t.solve();
    push(rod, now, t.right, rod.v);
}

void accelerate(hair_reference_rod& rod, double dt)
{
    for (uint32_t i = 0; i < rod.vertices; ++i)
        rod.v[i] +=
            dt * (rod.gravity + rod.force[i] / rod.masses[i] + rod.pull[i] * (rod.target_of(i) - rod.x[i]));
}

// Compute the acceleration by which drag exceeds damping. Each end of a segment has half of its
// drag, by the relative velocity there.
std::vector<Vector3d> drag_on(const hair_reference_rod& rod, const std::vector<Vector3d>& v)
{
    std::vector<Vector3d> sum(rod.vertices, Vector3d(0, 0, 0));
    const double damping = rod.damping * rod.line_density / rod.drag;
    for (uint32_t j = 0; j < rod.segments(); ++j) {
        double along[3], velocity[3], force[3];
        store((rod.x[j + 1] - rod.x[j]).normalized(), along);
        for (uint32_t i = j; i < j + 2; ++i) {
            store(rod.wind - v[i], velocity);
            hair_reference_drag(&rod.air, rod.diameter, damping, velocity, along, force);
            sum[i] += rod.inverse_mass(i) * rod.drag * rod.lengths[j] / 2 * vector_of(force);
        }
    }
    return sum;
}

// Apply drag by the midpoint rule.
void drag(hair_reference_rod& rod, double dt)
{
    std::vector<Vector3d> middle = rod.v, by = drag_on(rod, rod.v);
    for (uint32_t i = 0; i < rod.vertices; ++i) middle[i] += dt / 2 * by[i];
    by = drag_on(rod, middle);
    for (uint32_t i = 0; i < rod.vertices; ++i) rod.v[i] += dt * by[i];
}

void damp(hair_reference_rod& rod, double dt)
{
    const double keep = std::exp(-rod.damping * dt);
    for (Vector3d& v : rod.v) v = rod.wind + keep * (v - rod.wind);
    if (rod.drag > 0) drag(rod, dt);
}

bool advance(hair_reference_rod& rod, const journey& head, double dt, uint32_t substeps)
{
    const double h = dt / substeps;
    tridiagonal t(rod.segments());
    std::vector<Vector3d> step(rod.vertices);
    for (uint32_t k = 0; k < substeps; ++k) {
        damp(rod, h / 2);
        accelerate(rod, h / 2);
        rod.head = head.at((k + 1) * h);
        for (uint32_t i = 0; i < rod.vertices; ++i) step[i] = h * rod.v[i];
        if (rod.is_held()) step[0] = rod.root_position() - rod.x[0];
        if (!move(rod, step, t)) return false;
        for (uint32_t i = 0; i < rod.vertices; ++i) rod.v[i] = step[i] / h;
        hair_reference_rod_update(rod);
        accelerate(rod, h / 2);
        damp(rod, h / 2);
    }
    rod.root_velocity = head.velocity + head.spin.cross(rod.head.rotation * rod.arm);
    make_velocities_agree(rod, t);
    return true;
}

} // namespace

int hair_reference_rod_advance(hair_reference_rod* rod, const hair_reference_rod_pose* head, double dt,
                               uint32_t substeps)
{
    if (!(dt > 0) || substeps == 0) return 0;
    hair_reference_rod_place to = rod->head;
    if (head) to = {vector_of(head->position), quaternion_of(head->rotation).normalized()};
    if (!advance(*rod, journey_to(rod->head, to, dt), dt, substeps)) return 0;
    rod->head = to; // Remove the rounding of the motion.
    return 1;
}

// The squared frequencies of a chain are at most the maximum row sum of its stiffness over its mass
// (Gershgorin). A joint's stiffness k / l^2 acts on the vertices around it as (1, -2, 1) (1, -2,
// 1)^T.
double hair_reference_rod_longest_substep(const hair_reference_rod* rod)
{
    std::vector<double> sums(rod->vertices);
    for (uint32_t i = hair_reference_rod_first_joint(*rod); i < rod->segments(); ++i) {
        // Twist bends a curved rod, therefore use the maximum.
        const double k = rod->stiffness[i].maxCoeff();
        const double row[3] = {i ? 1 / rod->lengths[i - 1] : 0,
                               (i ? 1 / rod->lengths[i - 1] : 0) + 1 / rod->lengths[i], 1 / rod->lengths[i]};
        for (uint32_t a = i ? 0 : 1; a < 3; ++a) sums[i + a - 1] += k * row[a] * (row[0] + row[1] + row[2]);
    }
    double max_value = 0;
    for (uint32_t i = rod->is_held() ? 1 : 0; i < rod->vertices; ++i)
        max_value = std::fmax(max_value, sums[i] / rod->masses[i] + rod->pull[i]);
    return max_value > 0 ? 2 / std::sqrt(max_value) : INFINITY;
}

hair_reference_rod_report hair_reference_rod_converge(hair_reference_rod* rod, uint32_t frames,
                                                      const hair_reference_rod_pose* heads, double dt,
                                                      uint32_t substeps, uint32_t max_value, double tolerance,
                                                      double* positions)
{
    const size_t size = 3 * size_t(rod->vertices);
    hair_reference_rod_report report = {0, 0, INFINITY, NAN};
    std::vector<double> before, now(frames * size);
    const hair_reference_rod start = *rod;
    double last = NAN;
    const double needs = std::ceil(2 * dt / hair_reference_rod_longest_substep(rod));
    uint32_t count = substeps ? substeps : 1;
    while (count < needs) count *= 2;
    for (; count <= max_value && !report.converged; count *= 2) {
        *rod = start;
        bool ok = true;
        for (uint32_t k = 0; k < frames && ok; ++k) {
            ok = hair_reference_rod_advance(rod, heads ? heads + k : nullptr, dt, count);
            hair_reference_rod_positions(rod, &now[k * size]);
        }
        report.substeps = count;
        if (ok && !before.empty()) {
            report.change = 0;
            for (size_t i = 0; i < now.size(); i += 3)
                report.change = std::fmax(report.change, (vector_of(&now[i]) - vector_of(&before[i])).norm());
            report.order = std::log2(last / report.change);
            report.converged = report.change < tolerance;
            last = report.change;
        }
        before = ok ? now : std::vector<double>();
        if (!ok) last = NAN;
    }
    if (positions) std::copy(now.begin(), now.end(), positions);
    return report;
}
