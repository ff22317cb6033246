// strand.cpp - Curves along a strand, and strays, frizz and curls, as hair.h and shared.h define
// them.
#include "tests/reference/strand.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace
{

// Return a hash by pcg (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering").
uint32_t hash(uint32_t seed)
{
    const uint32_t state = seed * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

double low(uint32_t seed)
{
    return (hash(seed) & 65535) / 65536.0;
}

double high(uint32_t seed)
{
    return (hash(seed) >> 16) / 65536.0;
}

// Evaluate a cubic with given values and slopes at 0 and 1, in Bernstein form.
along cubic(double a, double b, double slope_a, double slope_b, double x)
{
    const double p[4] = {a, a + slope_a / 3, b - slope_b / 3, b};
    const double s = 1 - x;
    return {s * s * s * p[0] + 3 * s * s * x * p[1] + 3 * s * x * x * p[2] + x * x * x * p[3],
            3 * (s * s * (p[1] - p[0]) + 2 * s * x * (p[2] - p[1]) + x * x * (p[3] - p[2]))};
}

double harmonic(double a, double b)
{
    return a * b > 0 ? 2 / (1 / a + 1 / b) : 0;
}

double at_end(double rise, double next)
{
    const double slope = (3 * rise - next) / 2;
    return slope * rise > 0 ? slope : 0;
}

// Evaluate a random spline by de Boor's recurrence on the random control points around t.
astray wander(uint32_t seed, double t, double waves)
{
    const double at = t * waves, k = std::floor(at), x = at - k;
    Vector3d d[4], e[3];
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t h = hash(seed + uint32_t(k) + i);
        d[i] = Vector3d(std::max(int16_t(h & 65535) / 32767.0, -1.0), 0,
                        std::max(int16_t(h >> 16) / 32767.0, -1.0));
    }
    for (int i = 0; i < 3; ++i) e[i] = d[i + 1] - d[i];
    for (int i = 0; i < 2; ++i) e[i] += (x + 1 - i) / 2 * (e[i + 1] - e[i]);
    const Vector3d slope = e[0] + x * (e[1] - e[0]);
    for (int level = 3; level > 0; --level)
        for (int i = 0; i < level; ++i) d[i] += (x + level - 1 - i) / level * (d[i + 1] - d[i]);
    return {d[0], waves * slope};
}

astray times(const astray& a, double factor, const along& curve)
{
    return {factor * curve.value * a.at, factor * (curve.value * a.slope + curve.slope * a.at)};
}

astray sum(const astray& a, const astray& b)
{
    return {a.at + b.at, a.slope + b.slope};
}

// Evaluate the periodic cubic spline through 16 values. Second derivatives are continuous at each
// value.
along turn(const float* values, double turns)
{
    const int n = HAIR_TURN_PLACES;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right(n);
    for (int i = 0; i < n; ++i) {
        matrix(i, i) = 4;
        matrix(i, (i + 1) % n) = matrix(i, (i + n - 1) % n) = 1;
        right(i) = 3 * (double(values[(i + 1) % n]) - values[(i + n - 1) % n]);
    }
    const Eigen::VectorXd slope = matrix.partialPivLu().solve(right);
    const double at = n * (turns - std::floor(turns));
    const int k = std::min(int(at), n - 1), next = (k + 1) % n;
    const along c = cubic(values[k], values[next], slope(k), slope(next), at - k);
    return {c.value, n * c.slope};
}

astray curl(const hair_look& look, uint32_t guide, uint32_t seed, double t, double length, double ratio)
{
    const double spread = look.curl.spread * (2 * high(seed + 2) - 1);
    const double size = (1 + spread) * (1 + look.curl.guide_spread * (2 * low(guide + 0x2aaaaaaau) - 1));
    const double turns = (length / look.curl.wavelength + look.curl.turns) / size;
    astray wind = wander(64 * guide + 0x71c71c71u, t * ratio, 8);
    wind.slope *= ratio;
    const double shift = look.curl.variation * turns / (8 * ratio);
    const double phase = look.curl.guide_phase * low(guide) + look.curl.strand_phase * low(seed + 2);
    const double hand = high(guide) < double(look.curl.left_fraction) ? -1 : 1;
    const double flat = 1 - double(look.curl.flatness), at = t * turns + shift * wind.at[0] + phase;
    along x, z;
    if (look.curl.shape == HAIR_CURL_SHAPE_EXAMPLE) {
        x = turn(look.curl.profile_x, at);
        z = turn(look.curl.profile_z, at);
    } else {
        const double angle = 6.283185307179586 * at;
        x = {std::cos(angle), -6.283185307179586 * std::sin(angle)};
        z = {std::sin(angle), 6.283185307179586 * std::cos(angle)};
    }
    const astray around = {Vector3d(x.value, 0, hand * flat * z.value),
                           (turns + shift * wind.slope[0]) * Vector3d(x.slope, 0, hand * flat * z.slope)};
    const along wider = {1 + look.curl.variation * wind.at[2], look.curl.variation * wind.slope[2]};
    return times(times(around, look.curl.radius * size, hair_reference_curve(look.curl.profile, t)), 1,
                 wider);
}

} // namespace

// Evaluate a curve that is monotone where its values are (Fritsch and Butland 1984).
along hair_reference_curve(const hair_curve& curve, double t)
{
    const int n = HAIR_CURVE_INTERVALS;
    double rise[n], slope[n + 1];
    for (int i = 0; i < n; ++i) rise[i] = double(curve.at[i + 1]) - curve.at[i];
    for (int i = 1; i < n; ++i) slope[i] = harmonic(rise[i - 1], rise[i]);
    slope[0] = at_end(rise[0], slope[1]);
    slope[n] = at_end(rise[n - 1], slope[n - 1]);
    const int k = std::min(int(n * t), n - 1);
    const along own = cubic(curve.at[k], curve.at[k + 1], slope[k], slope[k + 1], n * t - k);
    return {own.value, n * own.slope};
}

along hair_reference_singleness(const hair_look& look, double t)
{
    if (look.clump.interpolation == HAIR_INTERPOLATION_SINGLE) return {1, 0};
    if (look.clump.interpolation == HAIR_INTERPOLATION_MULTI) return {0, 0};
    return hair_reference_curve(look.clump.weight, t);
}

double hair_reference_fraction(const hair_look& look, uint32_t seed)
{
    return look.strand.length * (1 - look.strand.length_variation * ((hash(seed + 3) >> 8) / 16777216.0));
}

astray hair_reference_astray(const hair_look& look, uint32_t guide, uint32_t seed, double t, double length,
                             double ratio)
{
    const along by_tip = hair_reference_curve(look.strays.tip_distance, t),
                by = hair_reference_curve(look.strays.distance, t);
    const bool tip = low(seed + 1) < double(look.strays.tip_fraction),
               whole = high(seed + 1) < double(look.strays.fraction);
    const along stray = {tip * by_tip.value + whole * by.value, tip * by_tip.slope + whole * by.slope};
    astray all = times(wander(seed + 16, t, 6), length, stray);
    if (low(seed + 4) < double(look.strays.frizz_fraction))
        all = sum(all, times(wander(seed + 0x55555555u, t, length / look.strays.frizz_wavelength), 1,
                             hair_reference_curve(look.strays.frizz, t)));
    return sum(all, curl(look, guide, seed, t, length, ratio));
}
