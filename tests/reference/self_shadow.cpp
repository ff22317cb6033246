// self_shadow.cpp - Light through hair by a density grid, with Beer's law along straight lines.
#include "tests/reference/self_shadow.h"

#include <algorithm>
#include <cmath>

#include "tests/reference/convert.h"

namespace
{

const double max_met = 30;

// Compute the trilinear weights of the corners of the cell that contains `place`, in cells. Return
// false if a corner is outside the grid.
bool corners_of(const hair_reference_grid& grid, const Vector3d& place, size_t node[8], double weight[8])
{
    for (int k = 0; k < 8; ++k) {
        size_t at[3];
        weight[k] = 1;
        for (int i = 0; i < 3; ++i) {
            const double low = std::floor(place[i]), fraction = place[i] - low;
            const bool high = k >> i & 1;
            if (low < 0 || low + 1 >= grid.nodes[i]) return false;
            at[i] = size_t(low) + high;
            weight[k] *= high ? fraction : 1 - fraction;
        }
        node[k] = at[0] + grid.nodes[0] * (at[1] + grid.nodes[1] * at[2]);
    }
    return true;
}

Vector3d place_of(const hair_reference_grid& grid, const double position[3])
{
    return (vector_of(position) - vector_of(grid.lower)) / grid.cell;
}

double density_at(const hair_reference_grid& grid, const Vector3d& place)
{
    size_t node[8];
    double weight[8], sum = 0;
    if (!corners_of(grid, place, node, weight)) return 0;
    for (int k = 0; k < 8; ++k) sum += weight[k] * grid.density[node[k]];
    return sum;
}

bool around(const hair_reference_grid& grid, const Vector3d& place, const double* values, double& out)
{
    size_t node[8];
    double weight[8], sum = 0, all = 0;
    if (!corners_of(grid, place, node, weight)) return false;
    for (int k = 0; k < 8; ++k)
        if (grid.density[node[k]] > 0) sum += weight[k] * values[node[k]], all += weight[k];
    if (all <= 1e-6) return false;
    out = sum / all;
    return true;
}

} // namespace

void hair_reference_fill(const struct hair_reference_grid* grid, const double a[3], const double b[3],
                         double width, double* density)
{
    const Vector3d from = place_of(*grid, a), way = place_of(*grid, b) - from;
    const int places = 1 + int(way.norm());
    for (int i = 0; i < places; ++i) {
        size_t node[8];
        double weight[8];
        if (!corners_of(*grid, from + (i + 0.5) / places * way, node, weight)) continue;
        for (int k = 0; k < 8; ++k) density[node[k]] += weight[k] * way.norm() * width / grid->cell / places;
    }
}

double hair_reference_met(const struct hair_reference_grid* grid, const double from[3], const double to[3],
                          double reach, const double* met)
{
    const Vector3d place = place_of(*grid, from), way = vector_of(to);
    double sum = 0, each = 1;
    for (double k = 1; k * grid->cell < reach; k += each) {
        const Vector3d at = place + k * way;
        double known;
        for (int i = 0; i < 3; ++i)
            if (at[i] < 0 || at[i] > grid->nodes[i] - 1) return std::min(sum, max_met);
        if (!met || k <= 2) sum += density_at(*grid, at);
        if (met && k >= 2 && around(*grid, at, met, known)) return std::min(sum + known, max_met);
        if (met && k > 2) each *= 1.5;
    }
    return std::min(sum, max_met);
}

double hair_reference_sky(const struct hair_reference_grid* grid, const double from[3])
{
    const double pi = 3.14159265358979;
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
        Vector3d way = Vector3d::Zero();
        double met = 0, start = 0.5;
        way[i / 2] = i % 2 ? -1 : 1;
        for (double each = 1; each <= 16; start += each, each *= 2)
            met += pi / 4 * each * density_at(*grid, place_of(*grid, from) + (start + each / 2) * way);
        sum += std::exp(-std::min(met, max_met));
    }
    return sum / 6;
}

double hair_reference_around(const struct hair_reference_grid* grid, const double at[3], const double* values)
{
    double out = 0;
    around(*grid, place_of(*grid, at), values, out);
    return out;
}

void hair_reference_stop(struct hair_reference_rays* rays, const double a[2], const double b[2],
                         double radius_a, double radius_b)
{
    const double way[2] = {b[0] - a[0], b[1] - a[1]}, square = way[0] * way[0] + way[1] * way[1];
    const double max_value = std::max(radius_a, radius_b), step = rays->side / rays->count;
    long from[2], to[2];
    if (square <= 0) return;
    for (int i = 0; i < 2; ++i) {
        from[i] = long(std::floor((std::min(a[i], b[i]) - max_value - rays->lower[i]) / step));
        to[i] = long(std::ceil((std::max(a[i], b[i]) + max_value - rays->lower[i]) / step));
        from[i] = std::max(from[i], 0L), to[i] = std::min(to[i], long(rays->count));
    }
    for (long y = from[1]; y < to[1]; ++y)
        for (long x = from[0]; x < to[0]; ++x) {
            const double at[2] = {rays->lower[0] + (x + 0.5) * step - a[0],
                                  rays->lower[1] + (y + 0.5) * step - a[1]};
            const double t = (at[0] * way[0] + at[1] * way[1]) / square;
            const double off = std::fabs(at[0] * way[1] - at[1] * way[0]) / std::sqrt(square);
            if (t >= 0 && t < 1 && off <= radius_a + t * (radius_b - radius_a))
                rays->stopped[size_t(y) * rays->count + size_t(x)] = 1;
        }
}

double hair_reference_stopped(const struct hair_reference_rays* rays, double x, double y, double side)
{
    const long from[2] = {std::lround(x * rays->count), std::lround(y * rays->count)};
    const long each = std::max(std::lround(side * rays->count), 1L);
    double sum = 0;
    for (long k = from[1]; k < from[1] + each; ++k)
        for (long i = from[0]; i < from[0] + each; ++i)
            sum += rays->stopped[size_t(k) * rays->count + size_t(i)];
    return sum / double(each * each);
}
