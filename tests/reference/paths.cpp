// paths.cpp - Path tracing of light among fibres from the eye, with the direct light of every light
// at every hit (Kajiya 1986).
#include "tests/reference/paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/reference/convert.h"

namespace
{

const double infinity = std::numeric_limits<double>::infinity();
const int always_on = 4; // number of hits before Russian roulette can end a path

struct hit {
    double way; // distance, m
    uint32_t segment;
};

// Segments sorted by the cells of a grid that their boxes touch.
class grid
{
  public:
    explicit grid(const hair_reference_hair& hair) : hair_(hair)
    {
        lower_ = Vector3d::Constant(infinity), upper_ = -lower_;
        for (size_t v = 0; v < size_t(hair.count) * hair.each; ++v) {
            lower_ = lower_.cwiseMin(vertex(v)), upper_ = upper_.cwiseMax(vertex(v));
        }
        lower_.array() -= 2 * hair.radius, upper_.array() += 2 * hair.radius;
        cell_ = std::max(std::cbrt((upper_ - lower_).prod() / 1e6), 4 * hair.radius);
        for (int i = 0; i < 3; ++i) size_[i] = 1 + int((upper_[i] - lower_[i]) / cell_);
        first_.assign(size_t(size_[0]) * size_[1] * size_[2] + 1, 0);
        for_cells([&](size_t cell, uint32_t) { ++first_[cell + 1]; });
        for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        segment_.resize(first_.back());
        std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
        for_cells([&](size_t cell, uint32_t segment) { segment_[next[cell]++] = segment; });
    }

    Vector3d vertex(size_t v) const
    {
        const float* p = hair_.positions + 3 * v;
        return Vector3d(p[0], p[1], p[2]);
    }
    Vector3d tangent(uint32_t segment) const
    {
        const size_t v = first_vertex(segment);
        return (vertex(v + 1) - vertex(v)).normalized();
    }
    uint32_t strand(uint32_t segment) const { return segment / (hair_.each - 1); }

    // Find the first segment of a strand other than `own` that a ray hits, or any such segment if
    // `any`. Return false if there is none.
    bool meet(const Vector3d& from, const Vector3d& way, uint32_t own, bool any, hit& out) const
    {
        double in = 0, leave = infinity;
        for (int i = 0; i < 3; ++i) {
            const double a = (lower_[i] - from[i]) / way[i], b = (upper_[i] - from[i]) / way[i];
            in = std::max(in, std::min(a, b)), leave = std::min(leave, std::max(a, b));
        }
        if (!(in < leave)) return false;
        const Vector3d start = (from + in * way - lower_) / cell_;
        int at[3], step[3];
        double next[3], each[3];
        for (int i = 0; i < 3; ++i) {
            at[i] = std::clamp(int(start[i]), 0, size_[i] - 1);
            step[i] = way[i] < 0 ? -1 : 1;
            each[i] = std::abs(cell_ / way[i]);
            next[i] = in + (way[i] < 0 ? start[i] - at[i] : at[i] + 1 - start[i]) * each[i];
        }
        out.way = infinity;
        for (;;) {
            const size_t cell = at[0] + size_t(size_[0]) * (at[1] + size_t(size_[1]) * at[2]);
            for (uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
                if (strand(segment_[i]) == own) continue;
                const double found = crossing(from, way, segment_[i]);
                if (found < out.way) out = {found, segment_[i]};
                if (any && found < infinity) return true;
            }
            const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
            if (out.way <= next[axis]) return true;
            at[axis] += step[axis];
            if (at[axis] < 0 || at[axis] >= size_[axis]) return out.way < infinity;
            next[axis] += each[axis];
        }
    }

  private:
    size_t first_vertex(uint32_t segment) const
    {
        return size_t(segment) / (hair_.each - 1) * hair_.each + segment % (hair_.each - 1);
    }

    // Return the distance at which a ray is closest to a segment's axis. Return infinity if the ray
    // misses the segment by more than a radius.
    double crossing(const Vector3d& from, const Vector3d& way, uint32_t segment) const
    {
        const size_t v = first_vertex(segment);
        const Vector3d a = vertex(v), along = vertex(v + 1) - a, normal = way.cross(along), to = a - from;
        const double square = normal.squaredNorm(), apart = to.dot(normal);
        if (apart * apart > hair_.radius * hair_.radius * square || square <= 0) return infinity;
        const double t = to.cross(along).dot(normal) / square, s = to.cross(way).dot(normal) / square;
        return t > 1e-9 && s >= 0 && s <= 1 ? t : infinity;
    }

    template <class Function> void for_cells(const Function& function) const
    {
        for (uint32_t segment = 0; segment < hair_.count * (hair_.each - 1); ++segment) {
            const size_t v = first_vertex(segment);
            const Vector3d a = vertex(v), b = vertex(v + 1);
            int low[3], high[3];
            for (int i = 0; i < 3; ++i) {
                low[i] = std::max(int((std::min(a[i], b[i]) - hair_.radius - lower_[i]) / cell_), 0);
                high[i] =
                    std::min(int((std::max(a[i], b[i]) + hair_.radius - lower_[i]) / cell_), size_[i] - 1);
            }
            for (int z = low[2]; z <= high[2]; ++z)
                for (int y = low[1]; y <= high[1]; ++y)
                    for (int x = low[0]; x <= high[0]; ++x)
                        function(x + size_t(size_[0]) * (y + size_t(size_[1]) * z), segment);
        }
    }

    const hair_reference_hair& hair_;
    Vector3d lower_, upper_;
    double cell_; // m
    int size_[3];
    std::vector<uint32_t> first_, segment_;
};

class tracer
{
  public:
    tracer(const hair_reference_hair& hair, uint64_t seed) : hair_(hair), grid_(hair), random_(seed) {}

    // Trace a ray and add its radiance, in total and scattered once. Return false if the ray hits
    // no hair.
    bool look(Vector3d from, Vector3d way, hair_reference_glow& sum)
    {
        double left[HAIR_REFERENCE_MAX_COLORS],
            seen[HAIR_REFERENCE_MAX_LIGHTS][HAIR_REFERENCE_MAX_COLORS] = {};
        uint32_t own = ~0u;
        hit at;
        std::fill(left, left + hair_.colors, 1.0);
        for (int met = 0; grid_.meet(from, way, own, false, at); ++met) {
            const Vector3d tangent = grid_.tangent(at.segment), to_eye = -way;
            from += at.way * way, own = grid_.strand(at.segment);
            add_lights(from, tangent, to_eye, own, left, seen);
            if (met == 0) add(seen, sum.once);
            if (!go_on(tangent, to_eye, met, left, way)) break;
            if (hair_.sky > 0 && !grid_.meet(from, way, own, true, at))
                for (uint32_t i = 0; i < hair_.colors; ++i) seen[0][i] += hair_.sky * left[i];
        }
        if (own == ~0u) return false;
        add(seen, sum.often);
        for (uint32_t l = 0; l < std::max(hair_.lights, 1u); ++l)
            for (uint32_t i = 0; i < hair_.colors; ++i) sum.error[l][i] += seen[l][i] * seen[l][i];
        return true;
    }

  private:
    void add(const double (*seen)[HAIR_REFERENCE_MAX_COLORS], double (*sum)[HAIR_REFERENCE_MAX_COLORS]) const
    {
        for (uint32_t l = 0; l < std::max(hair_.lights, 1u); ++l)
            for (uint32_t i = 0; i < hair_.colors; ++i) sum[l][i] += seen[l][i];
    }

    void add_lights(const Vector3d& from, const Vector3d& tangent, const Vector3d& to_eye, uint32_t own,
                    const double* left, double (*seen)[HAIR_REFERENCE_MAX_COLORS])
    {
        double scattered[HAIR_REFERENCE_MAX_COLORS];
        hit any;
        for (uint32_t l = 0; l < hair_.lights; ++l) {
            const Vector3d to = vector_of(hair_.to_light + 3 * l);
            if (grid_.meet(from, to, own, true, any)) continue;
            const double along = tangent.dot(to), cosine = std::sqrt(std::max(1 - along * along, 0.0));
            hair_reference_scatter(&hair_.fibre, tangent.data(), to.data(), to_eye.data(), hair_.mu,
                                   int(hair_.colors), scattered);
            for (uint32_t i = 0; i < hair_.colors; ++i) seen[l][i] += left[i] * scattered[i] * cosine;
        }
    }

    // Choose the next direction and attenuate the path. Return false if the path ends.
    bool go_on(const Vector3d& tangent, const Vector3d& to_eye, int met, double* left, Vector3d& way)
    {
        const double random[3] = {next(), next(), next()};
        double scattered[HAIR_REFERENCE_MAX_COLORS], max_value = 0;
        const double density =
            hair_reference_choose(&hair_.fibre, tangent.data(), to_eye.data(), random, way.data());
        if (!(density > 0)) return false;
        hair_reference_scatter(&hair_.fibre, tangent.data(), way.data(), to_eye.data(), hair_.mu,
                               int(hair_.colors), scattered);
        const double along = tangent.dot(way), weight = std::sqrt(std::max(1 - along * along, 0.0)) / density;
        for (uint32_t i = 0; i < hair_.colors; ++i)
            max_value = std::max(max_value, left[i] *= scattered[i] * weight);
        const double chance = met < always_on ? 1 : std::min(max_value, 1.0);
        if (!(next() < chance)) return false;
        for (uint32_t i = 0; i < hair_.colors; ++i) left[i] /= chance;
        return true;
    }

    double next() { return std::generate_canonical<double, 53>(random_); }

    const hair_reference_hair& hair_;
    const grid grid_;
    std::mt19937_64 random_;
};

} // namespace

void hair_reference_paths(const struct hair_reference_hair* hair, const double* from, const double* way,
                          uint64_t rays, uint64_t seed, struct hair_reference_glow* out)
{
    *out = {};
    tracer paths(*hair, seed);
    for (uint64_t i = 0; i < rays; ++i)
        out->met += paths.look(vector_of(from + 3 * i), vector_of(way + 3 * i), *out);
    const double met = double(std::max<uint64_t>(out->met, 1));
    for (int l = 0; l < HAIR_REFERENCE_MAX_LIGHTS; ++l)
        for (int i = 0; i < HAIR_REFERENCE_MAX_COLORS; ++i) {
            const double mean = out->often[l][i] / met;
            out->error[l][i] = std::sqrt(std::max(out->error[l][i] / met - mean * mean, 0.0) / met);
            out->often[l][i] = mean;
            out->once[l][i] /= met;
        }
}
