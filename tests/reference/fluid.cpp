// fluid.cpp - Air on a staggered grid, in double precision.
#include "tests/reference/fluid.h"
#include "tests/reference/drag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{

using place = std::array<double, 3>;
using cell = std::array<int, 3>;

struct grid {
    int n;

    int size() const { return n * n * n; }
    int faces() const { return (n + 1) * (n + 1) * (n + 1); }
    int face(int axis, const cell& at) const
    {
        return axis * faces() + at[0] + (n + 1) * (at[1] + (n + 1) * at[2]);
    }
    int index(const cell& at) const { return at[0] + n * (at[1] + n * at[2]); }
    cell at(int i) const { return {i % n, i / n % n, i / n / n}; }
    bool holds(const cell& at) const
    {
        return std::all_of(at.begin(), at.end(), [this](int k) { return k >= 0 && k < n; });
    }
    bool holds(const place& at) const
    {
        return std::all_of(at.begin(), at.end(), [this](double k) { return k >= 0 && k <= n; });
    }
    // Return whether a face exists. Along its own axis there is one more face than cells.
    bool is_face(int axis, const cell& at) const
    {
        cell below = at;
        below[axis] -= at[axis] == n;
        return holds(below);
    }
};

cell next(cell at, int axis, int by)
{
    at[axis] += by;
    return at;
}

place middle(int axis, const cell& at)
{
    place p;
    for (int k = 0; k < 3; ++k) p[k] = at[k] + (k == axis ? 0 : 0.5);
    return p;
}

// Corners and weights of trilinear interpolation. Points lie `offset` from the cells' corners,
// count[k] of them along axis k.
struct corners {
    std::array<cell, 8> at;
    std::array<double, 8> weight;

    corners(const place& p, const place& offset, const cell& count)
    {
        cell lowest;
        place part;
        for (int k = 0; k < 3; ++k) {
            const double g = std::clamp(p[k] - offset[k], 0.0, count[k] - 1.0);
            lowest[k] = std::min(int(std::floor(g)), count[k] - 2);
            part[k] = g - lowest[k];
        }
        for (int c = 0; c < 8; ++c) {
            weight[c] = 1;
            for (int k = 0; k < 3; ++k) {
                at[c][k] = lowest[k] + (c >> k & 1);
                weight[c] *= c >> k & 1 ? part[k] : 1 - part[k];
            }
        }
    }
};

corners faces_around(const grid& g, int axis, const place& p)
{
    place offset = {0.5, 0.5, 0.5};
    cell count = {g.n, g.n, g.n};
    offset[axis] = 0, count[axis] = g.n + 1;
    return corners(p, offset, count);
}

double sample(const grid& g, const double* faces, int axis, const place& p)
{
    const corners c = faces_around(g, axis, p);
    double sum = 0;
    for (int k = 0; k < 8; ++k) sum += c.weight[k] * faces[g.face(axis, c.at[k])];
    return sum;
}

place way(const hair_reference_flow& flow, const place& p)
{
    const grid g{int(flow.cells)};
    const corners c(p, {0.5, 0.5, 0.5}, {g.n, g.n, g.n});
    place sum = {0, 0, 0};
    for (int k = 0; k < 8; ++k)
        for (int a = 0; a < 3; ++a)
            sum[a] += flow.cells_per * c.weight[k] * flow.air[3 * g.index(c.at[k]) + a];
    for (double& a : sum) a = std::clamp(a, -4.0 * g.n, 4.0 * g.n);
    return sum;
}

// Trace a path by the midpoint rule.
place trace(const hair_reference_flow& flow, const place& p, double direction)
{
    const place first = way(flow, p);
    place half, end;
    for (int k = 0; k < 3; ++k) half[k] = p[k] + 0.5 * direction * first[k];
    const place second = way(flow, half);
    for (int k = 0; k < 3; ++k) end[k] = p[k] + direction * second[k];
    return end;
}

place shifted(const hair_reference_flow& flow, place p, double by)
{
    for (int k = 0; k < 3; ++k) p[k] += by * flow.shift[k];
    return p;
}

// Return p and all points at the distance `far` along any combination of axes and signs.
std::array<place, 27> around(const place& p, double far)
{
    std::array<place, 27> all;
    for (int i = 0; i < 27; ++i)
        all[i] = {p[0] + far * (i % 3 - 1), p[1] + far * (i / 3 % 3 - 1), p[2] + far * (i / 9 - 1)};
    return all;
}

struct range {
    double min_value = INFINITY, max_value = -INFINITY;

    bool is_empty() const { return min_value > max_value; }
    void add(double v) { min_value = std::min(min_value, v), max_value = std::max(max_value, v); }
};

// Call the function for each existing face.
template <typename Function> void for_faces(const grid& g, Function function)
{
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < g.faces(); ++i) {
            const int m = g.n + 1;
            const cell at = {i % m, i / m % m, i / m / m};
            if (g.is_face(axis, at)) function(axis, at);
        }
}

// Sums of a cell's pressure equation over its six sides. The pressure is 0 on the boundary of the
// box.
struct row {
    double whole = 0, neighbours = 0;

    row(const grid& g, const double* open, const double* pressure, const cell& at)
    {
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) {
                const double fraction = open[g.face(axis, next(at, axis, side))];
                const cell other = next(at, axis, 2 * side - 1);
                whole += g.holds(other) ? fraction : 2 * fraction;
                if (g.holds(other)) neighbours += fraction * pressure[g.index(other)];
            }
    }
};

} // namespace

double hair_reference_open(uint32_t axis, const int32_t at[3],
                           double (*distance)(const double place[3], const void* user), const void* user)
{
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) {
            double p[3] = {double(at[0]), double(at[1]), double(at[2])};
            p[(axis + 1) % 3] += (i + 0.5) / 4;
            p[(axis + 2) % 3] += (k + 0.5) / 4;
            sum += std::clamp(0.5 + 4 * distance(p, user), 0.0, 1.0) / 16;
        }
    return sum;
}

void hair_reference_coarsen(uint32_t cells, const double* open, double* coarse)
{
    const grid fine{int(cells)}, g{int(cells) / 2};
    for_faces(g, [&](int axis, const cell& at) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) {
            cell part = {2 * at[0], 2 * at[1], 2 * at[2]};
            part[(axis + 1) % 3] += k & 1, part[(axis + 2) % 3] += k >> 1;
            sum += open[fine.face(axis, part)] / 4;
        }
        coarse[g.face(axis, at)] = sum;
    });
}

void hair_reference_carry(const hair_reference_flow* flow, double* min_value, double* max_value)
{
    const grid g{int(flow->cells)};
    for_faces(g, [&](int axis, const cell& at) {
        const place from = trace(*flow, shifted(*flow, middle(axis, at), 1), -1);
        range r;
        for (const place& p : around(from, flow->blur))
            r.add(g.holds(p) ? sample(g, flow->before, axis, p) : flow->wind[axis]);
        min_value[g.face(axis, at)] = r.min_value, max_value[g.face(axis, at)] = r.max_value;
    });
}

void hair_reference_correct(const hair_reference_flow* flow, const double* carried, double* min_value,
                            double* max_value)
{
    const grid g{int(flow->cells)};
    for_faces(g, [&](int axis, const cell& at) {
        const int face = g.face(axis, at);
        const place own = shifted(*flow, middle(axis, at), 1);
        const place from = trace(*flow, own, -1), to = shifted(*flow, trace(*flow, own, 1), -1);
        const double was = g.holds(own) ? sample(g, flow->before, axis, own) : NAN;
        range better, r;
        bool ends = !g.holds(own); // The way back is unknown.
        for (const place& p : around(to, flow->blur)) {
            if (g.holds(own) && g.holds(p))
                better.add(carried[face] + (was - sample(g, carried, axis, p)) / 2);
            else
                ends = true;
        }
        for (const place& p : around(from, flow->blur)) {
            const double gain = g.holds(p) ? flow->gain[axis] : 0;
            if (ends || !g.holds(p)) r.add(carried[face] + gain);
            if (!g.holds(p) || better.is_empty()) continue;
            range kept;
            for (const cell& corner : faces_around(g, axis, p).at)
                kept.add(flow->before[g.face(axis, corner)]);
            r.add(std::clamp(better.min_value, kept.min_value, kept.max_value) + gain);
            r.add(std::clamp(better.max_value, kept.min_value, kept.max_value) + gain);
        }
        min_value[face] = r.min_value, max_value[face] = r.max_value;
    });
}

void hair_reference_hold(const hair_reference_flow* flow, const hair_reference_thicket* hair, double* open,
                         double* wall)
{
    const grid g{int(flow->cells)}, nodes{int(hair->nodes)};
    const double finer = double(hair->nodes) / flow->cells;
    for_faces(g, [&](int axis, const cell& at) {
        const int face = g.face(axis, at);
        const place here = middle(axis, at), then = shifted(*flow, here, 1);
        const corners c({finer * here[0], finer * here[1], finer * here[2]}, {0.5, 0.5, 0.5},
                        {nodes.n, nodes.n, nodes.n});
        double density = 0, speed = 0;
        place air = way(*flow, then), hairs = {0, 0, 0};
        for (int k = 0; k < 8; ++k) {
            density += c.weight[k] * hair->density[nodes.index(c.at[k])];
            for (int a = 0; a < 3; ++a) hairs[a] += c.weight[k] * hair->flux[3 * nodes.index(c.at[k]) + a];
        }
        if (!(density > 0)) return;
        for (int a = 0; a < 3; ++a) {
            hairs[a] /= density;
            air[a] = g.holds(then) ? air[a] / flow->cells_per : flow->wind[a];
            speed += (air[a] - hairs[a]) * (air[a] - hairs[a]);
        }
        const double reynolds = std::sqrt(speed) * hair->per_speed;
        const double across = reynolds > 0 ? hair_reference_drag_across(reynolds) * reynolds / 2 : 0;
        const double along = hair_reference_drag_along(reynolds);
        const double left = 1 / (1 + density * hair->viscous * (2 * across + along) / 3);
        const double closed = 1 - open[face], held = open[face] * (1 - left);
        if (closed + held > 0) wall[face] = (held * hairs[axis] + closed * wall[face]) / (closed + held);
        open[face] *= left;
    });
}

void hair_reference_inflow(uint32_t cells, const double* open, const double* wall, const double* velocity,
                           double* right)
{
    const grid g{int(cells)};
    for (int i = 0; i < g.size(); ++i) {
        right[i] = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) {
                const int f = g.face(axis, next(g.at(i), axis, side));
                const double flow = open[f] * velocity[f] + (1 - open[f]) * wall[f];
                right[i] += side ? -flow : flow;
            }
    }
}

void hair_reference_relax(uint32_t cells, const double* open, const double* right, uint32_t color,
                          double fraction, double* pressure)
{
    const grid g{int(cells)};
    const std::vector<double> before(pressure, pressure + g.size());
    for (int i = 0; i < g.size(); ++i) {
        const cell at = g.at(i);
        if (color < 2 && uint32_t(at[0] + at[1] + at[2]) % 2 != color) continue;
        const row r(g, open, before.data(), at);
        if (r.whole > 0) pressure[i] += fraction * ((right[i] + r.neighbours) / r.whole - before[i]);
    }
}

void hair_reference_residual(uint32_t cells, const double* open, const double* right, const double* pressure,
                             double* left)
{
    const grid g{int(cells)};
    for (int i = 0; i < g.size(); ++i) {
        const row r(g, open, pressure, g.at(i));
        left[i] = r.whole > 0 ? right[i] + r.neighbours - r.whole * pressure[i] : 0;
    }
}

void hair_reference_restrict(uint32_t cells, const double* left, double* coarse_right)
{
    const grid fine{int(cells)}, g{int(cells) / 2};
    std::fill(coarse_right, coarse_right + g.size(), 0);
    for (int i = 0; i < fine.size(); ++i) {
        const cell at = fine.at(i);
        coarse_right[g.index({at[0] / 2, at[1] / 2, at[2] / 2})] += left[i] / 2;
    }
}

void hair_reference_prolong(uint32_t cells, const double* coarse, double* pressure)
{
    const grid fine{int(cells)}, g{int(cells) / 2};
    for (int i = 0; i < fine.size(); ++i) {
        const cell at = fine.at(i);
        pressure[i] += coarse[g.index({at[0] / 2, at[1] / 2, at[2] / 2})];
    }
}

void hair_reference_release(uint32_t cells, const double* open, const double* wall, const double* pressure,
                            double* velocity)
{
    const grid g{int(cells)};
    for_faces(g, [&](int axis, const cell& at) {
        const int f = g.face(axis, at);
        const cell below = next(at, axis, -1);
        double slope = 0;
        if (!g.holds(below))
            slope = 2 * pressure[g.index(at)];
        else if (!g.holds(at))
            slope = -2 * pressure[g.index(below)];
        else
            slope = pressure[g.index(at)] - pressure[g.index(below)];
        velocity[f] = open[f] > 0 ? velocity[f] - slope : wall[f];
    });
}

void hair_reference_air(uint32_t cells, const double* velocity, double* air)
{
    const grid g{int(cells)};
    for (int i = 0; i < g.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            air[3 * i + axis] =
                (velocity[g.face(axis, g.at(i))] + velocity[g.face(axis, next(g.at(i), axis, 1))]) / 2;
}
