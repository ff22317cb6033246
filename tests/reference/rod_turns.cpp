// rod_turns.cpp - First and second derivatives of a rod's energy by rotations of its segments.
#include "tests/reference/rod_turns.h"

namespace
{

const Vector3d y_axis(0, 1, 0);

Matrix3d cross_matrix(const Vector3d& v)
{
    Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

void add_slope(hair_reference_turns& t, uint32_t j, const Vector3d& slope)
{
    t.slope.segment<3>(3 * int(j)) += slope;
}

// Add the energy E = -f.(q y) of a load f in the segment's frame. A rotation by b changes y to y +
// b x y + b x (b x y) / 2.
void add_load(hair_reference_turns& t, uint32_t j, const Vector3d& f)
{
    t.size = std::fmax(t.size, f.norm());
    add_slope(t, j, f.cross(y_axis));
    const Matrix3d mixed = f * y_axis.transpose();
    t.curvature.add(int(j), int(j), f.y() * Matrix3d::Identity() - (mixed + mixed.transpose()) / 2);
}

// Add the energy of a joint. r = (w, v) becomes exp(-a/2) r exp(b/2) if the segments before and
// after the joint rotate by a and b. To second order r becomes r + (r b - a r) / 2 - (|a|^2 +
// |b|^2) r / 8 - a r b / 4. u is twice the vector part. Twice the real part is
//
// 2 w + v.(a - b) - (|a|^2 + |b|^2) w / 4 + (w a.b + a.(v x b)) / 2.
void add_joint(const hair_reference_rod& rod, uint32_t i, hair_reference_turns& t)
{
    const hair_reference_rod_joint j =
        hair_reference_rod_joint_at(rod, i, hair_reference_rod_before(rod, i), rod.frames[i]);
    const Matrix3d turn = cross_matrix(j.v), one = Matrix3d::Identity();
    const Matrix3d by_a = -(j.w * one - turn), by_b = j.w * one + turn;
    const Matrix3d of_real = hair_reference_rod_real_stiffness(rod, i) * j.v * j.v.transpose();
    const Matrix3d k = rod.stiffness[i].asDiagonal(), c = of_real - 0.5 * (j.g.dot(j.v) + j.e * j.w) * one;
    const int n = int(i);
    t.energy += j.energy;
    t.size = std::fmax(t.size,
                       // The precision of strains is absolute, not relative.
                       rod.stiffness[i].maxCoeff());
    add_slope(t, i, by_b.transpose() * j.g - j.e * j.v);
    t.curvature.add(n, n, by_b.transpose() * k * by_b + c);
    if (i == 0) return; // The scalp does not rotate.
    add_slope(t, i - 1, by_a.transpose() * j.g + j.e * j.v);
    t.curvature.add(n - 1, n - 1, by_a.transpose() * k * by_a + c);
    const Matrix3d a_r_b = -j.v * j.g.transpose() - j.g * j.v.transpose() + j.g.dot(j.v) * one -
                           j.w * cross_matrix(j.g); // second derivative of g.(a r b) by a and b
    const Matrix3d mixed = by_a.transpose() * k * by_b - of_real - 0.5 * a_r_b + 0.5 * j.e * by_b;
    t.curvature.add(n, n - 1, mixed.transpose());
}

// Add the energy of a straight joint, E = k |t_i - t_{i-1}|^2 / 2 = k (1 - t_{i-1}.t_i). For each
// segment the other's tangent t acts as a load.
void add_straight_joint(const hair_reference_rod& rod, uint32_t i, hair_reference_turns& t)
{
    const Quaterniond before = hair_reference_rod_before(rod, i), after = rod.frames[i];
    const double k = rod.stiffness[i].x();
    const int n = int(i);
    t.energy += k * (along(after) - along(before)).squaredNorm() / 2;
    add_load(t, i, k * (after.conjugate() * along(before)));
    if (i == 0) return;
    add_load(t, i - 1, k * (before.conjugate() * along(after)));
    const Matrix3d y = cross_matrix(y_axis), r = (after.conjugate() * before).toRotationMatrix();
    t.curvature.add(n, n - 1, -k * y.transpose() * r * y);
}

// Add gravity and pull. The load on a segment is the sum of the loads on the vertices beyond it.
void add_loads(const hair_reference_rod& rod, bool is_pulled, hair_reference_turns& t)
{
    Vector3d load(0, 0, 0);
    double spring = 0;
    for (uint32_t j = rod.segments(); j-- > 0;) {
        const double k = rod.masses[j + 1] * rod.pull[j + 1];
        const Vector3d off = rod.x[j + 1] - rod.target_of(j + 1);
        load += rod.masses[j + 1] * rod.gravity - k * off;
        spring += k;
        t.energy += k * off.squaredNorm() / 2 - rod.masses[j + 1] * rod.gravity.dot(rod.x[j + 1]);
        add_load(t, j, rod.lengths[j] * (rod.frames[j].conjugate() * load));
        if (!is_pulled) continue;
        const Matrix3d own = spring * hair_reference_rod_arm(rod, j).transpose();
        for (uint32_t i = 0; i <= j; ++i)
            t.curvature.add(int(j), int(i), own * hair_reference_rod_arm(rod, i));
    }
}

void forget_twist(hair_reference_turns& t)
{
    hair_reference_band& h = t.curvature;
    for (int j = 1; j < h.size; j += 3) {
        t.slope[j] = 0;
        for (int i = std::max(j - h.width, 0); i < j; ++i) h.at(j, i) = 0;
        for (int i = j + 1; i < h.size && i <= j + h.width; ++i) h.at(i, j) = 0;
        h.at(j, j) = t.stiffest;
    }
}

} // namespace

void hair_reference_band::add(int i, int j, const Matrix3d& block)
{
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < (i == j ? a + 1 : 3); ++b) at(3 * i + a, 3 * j + b) += block(a, b);
}

int hair_reference_band::factor()
{
    int not_positive = 0;
    std::vector<double> row(static_cast<size_t>(width) + 1); // of L D
    for (int i = 0; i < size; ++i) {
        const int from = std::max(i - width, 0);
        double pivot = at(i, i);
        for (int j = from; j < i; ++j) {
            double sum = at(i, j);
            for (int k = std::max(from, j - width); k < j; ++k) sum -= row[size_t(k - from)] * at(j, k);
            row[size_t(j - from)] = sum;
        }
        for (int j = from; j < i; ++j) {
            at(i, j) = row[size_t(j - from)] / at(j, j);
            pivot -= row[size_t(j - from)] * at(i, j);
        }
        at(i, i) = pivot;
        if (!(pivot > 0)) ++not_positive;
    }
    return not_positive;
}

VectorXd hair_reference_band::solve(VectorXd right) const
{
    for (int i = 0; i < size; ++i)
        for (int j = std::max(i - width, 0); j < i; ++j) right[i] -= at(i, j) * right[j];
    for (int i = size; i-- > 0;) {
        right[i] /= at(i, i);
        for (int j = i + 1; j < size && j <= i + width; ++j) right[i] -= at(j, i) * right[j];
    }
    return right;
}

Matrix3d hair_reference_rod_arm(const hair_reference_rod& rod, uint32_t j)
{
    return -rod.lengths[j] * rod.frames[j].toRotationMatrix() * cross_matrix(y_axis);
}

hair_reference_turns hair_reference_rod_turns(const hair_reference_rod& rod)
{
    const int n = 3 * int(rod.segments());
    bool is_pulled = false;
    for (double k : rod.pull) is_pulled = is_pulled || k > 0;
    const int width = is_pulled ? n - 1 : std::min(5, n - 1);
    hair_reference_turns t{0, 0, 0, VectorXd::Zero(n), VectorXd(n), hair_reference_band(n, width)};
    for (uint32_t i = hair_reference_rod_first_joint(rod); i < rod.segments(); ++i)
        rod.straight ? add_straight_joint(rod, i, t) : add_joint(rod, i, t);
    add_loads(rod, is_pulled, t);
    for (int i = 0; i < n; ++i) {
        t.length[i] = rod.lengths[size_t(i) / 3];
        t.stiffest = std::fmax(t.stiffest, std::fabs(t.curvature.at(i, i)));
    }
    if (rod.straight) forget_twist(t);
    return t;
}

double hair_reference_rod_potential(const hair_reference_rod& rod)
{
    double energy = 0;
    for (uint32_t i = hair_reference_rod_first_joint(rod); i < rod.segments(); ++i) {
        const Quaterniond before = hair_reference_rod_before(rod, i), after = rod.frames[i];
        energy += rod.straight ? rod.stiffness[i].x() * (along(after) - along(before)).squaredNorm() / 2
                               : hair_reference_rod_joint_at(rod, i, before, after).energy;
    }
    for (uint32_t i = 1; i < rod.vertices; ++i)
        energy += rod.masses[i] *
                  (rod.pull[i] * (rod.x[i] - rod.target_of(i)).squaredNorm() / 2 - rod.gravity.dot(rod.x[i]));
    return energy;
}

void hair_reference_rod_turn(hair_reference_rod& rod, const VectorXd& turns, double fraction)
{
    for (uint32_t j = 0; j < rod.segments(); ++j) {
        const Vector3d turn = fraction * turns.segment<3>(3 * int(j));
        rod.frames[j] = (rod.frames[j] * rotation_by(turn)).normalized();
        rod.x[j + 1] = rod.x[j] + rod.lengths[j] * along(rod.frames[j]);
    }
}
