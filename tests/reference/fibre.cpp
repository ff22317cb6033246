// fibre.cpp - Scattering of one hair fibre (Marschner et al. 2003, d'Eon et al. 2011), and
// importance sampling of directions.
#include "tests/reference/fibre.h"

#include <algorithm>
#include <cmath>

#include "tests/reference/convert.h"

namespace
{

const double pi = 3.14159265358979323846;
const int lobes = 3;

// Longitudinal variance of each lobe as a multiple of R's, and tilt of each lobe as a multiple of
// the scales' tilt (Marschner et al. 2003).
const double width_of[lobes] = {1, 0.25, 4}, tilt_of[lobes] = {-1, 0.5, 1.5};

struct table {
    const hair_vec4* values;

    // Interpolate a layer at x along columns and y along rows, both from 0 to 1.
    void look_up(double x, double y, int layer, double out[4]) const
    {
        const double column = std::clamp(x, 0.0, 1.0) * (HAIR_FIBRE_COLUMNS - 1),
                     row = std::clamp(y, 0.0, 1.0) * (HAIR_FIBRE_ROWS - 1);
        const int i = std::min(int(column), HAIR_FIBRE_COLUMNS - 2),
                  k = std::min(int(row), HAIR_FIBRE_ROWS - 2);
        std::fill(out, out + 4, 0.0);
        for (int n = 0; n < 4; ++n) {
            const int a = n & 1, b = n >> 1;
            const double weight = (a ? column - i : i + 1 - column) * (b ? row - k : k + 1 - row);
            const hair_vec4& v = values[(layer * HAIR_FIBRE_ROWS + k + b) * HAIR_FIBRE_COLUMNS + i + a];
            out[0] += weight * v.x, out[1] += weight * v.y, out[2] += weight * v.z, out[3] += weight * v.w;
        }
    }
    double balance(double cosine) const
    {
        double v[4];
        look_up(0, cosine, 1, v);
        return v[3];
    }
};

// Return the logarithm of the modified Bessel function I0. Small x use its power series, large x
// its asymptotic series (Abramowitz and Stegun 1964, 9.6.12 and 9.7.1).
double log_bessel(double x)
{
    double sum = 1, term = 1;
    if (x < 20) {
        for (int k = 1; term > 1e-17 * sum; ++k) sum += term *= x * x / (4.0 * k * k);
        return std::log(sum);
    }
    for (int k = 1; k < 10; ++k) sum += term *= (2.0 * k - 1) * (2.0 * k - 1) / (8 * k * x);
    return x - 0.5 * std::log(2 * pi * x) + std::log(sum);
}

// Return the density of the sine of the light's inclination, for a given inclination of the eye
// (d'Eon et al. 2011). Inclinations are angles from the plane perpendicular to the fibre.
double longitudinal(double sin_l, double cos_l, double sin_e, double cos_e, double v)
{
    const double exponent = log_bessel(cos_l * cos_e / v) - (sin_l * sin_e + 1) / v;
    return std::exp(exponent) / (v * (1 - std::exp(-2 / v)));
}

// Return the factor that makes longitudinal() symmetric. fibre.glsl has the fit.
double symmetric(double cos_l, double cos_e, double v)
{
    const double s = v / (v + 0.3);
    const double grazing = std::sqrt(s * (0.304161 + s * (-0.101796 + s * (1.961349 - 1.543683 * s)))),
                 normal = 1 + s * (-0.138467 + s * (0.363444 + s * (-1.358778 + 0.927069 * s)));
    const double g = std::pow(grazing, 3), n = std::pow(normal, 3) - g;
    return std::pow((g + n * std::pow(cos_l, 3)) * (g + n * std::pow(cos_e, 3)), -1.0 / 6);
}

struct angles {
    double sin_l, cos_l, sin_e, cos_e, half, turn;
};

angles measure(const Vector3d& tangent, const Vector3d& light, const Vector3d& eye)
{
    angles a;
    a.sin_l = std::clamp(tangent.dot(light), -1.0, 1.0), a.sin_e = std::clamp(tangent.dot(eye), -1.0, 1.0);
    a.cos_l = std::sqrt(1 - a.sin_l * a.sin_l), a.cos_e = std::sqrt(1 - a.sin_e * a.sin_e);
    a.half = std::sqrt(std::clamp(0.5 + 0.5 * (a.cos_l * a.cos_e + a.sin_l * a.sin_e), 0.0, 1.0));
    const double across = (light.dot(eye) - a.sin_l * a.sin_e) / std::max(a.cos_l * a.cos_e, 1e-9);
    a.turn = std::acos(std::clamp(across, -1.0, 1.0)) / pi;
    return a;
}

// Inclinations as seen by a lobe. Scales tilt those of light and eye equally.
struct tilted {
    double sin_l, cos_l, sin_e, cos_e, v;

    tilted(const angles& a, const hair_reference_fibre& fibre, int lobe)
    {
        const double by = tilt_of[lobe] * fibre.tilt, s = std::sin(by), c = std::cos(by);
        sin_l = a.sin_l * c - a.cos_l * s, cos_l = std::abs(a.cos_l * c + a.sin_l * s);
        sin_e = a.sin_e * c - a.cos_e * s, cos_e = std::abs(a.cos_e * c + a.sin_e * s);
        v = width_of[lobe] * fibre.variance;
    }
};

// Return the azimuthal density of a lobe, 1/rad, from interpolated values.
double fraction_at(const double fraction[4], int lobe)
{
    return lobe < 2 ? fraction[lobe] : fraction[2] + fraction[3];
}
// Return the azimuthal density of a lobe, 1/rad, at a table entry. Columns range from azimuth 0 to
// half a turn.
double fraction_of(const hair_vec4& fraction, int lobe)
{
    return lobe == 0 ? fraction.x : lobe == 1 ? fraction.y : double(fraction.z) + fraction.w;
}

struct row_sums {
    double upto[HAIR_FIBRE_COLUMNS]; // integral from azimuth 0 to each column
    double at[HAIR_FIBRE_COLUMNS];

    row_sums(const table& t, double half, int lobe)
    {
        const double step = pi / (HAIR_FIBRE_COLUMNS - 1), row = half * (HAIR_FIBRE_ROWS - 1);
        const int k = std::min(int(row), HAIR_FIBRE_ROWS - 2);
        const hair_vec4 *low = t.values + k * HAIR_FIBRE_COLUMNS, *high = low + HAIR_FIBRE_COLUMNS;
        for (int i = 0; i < HAIR_FIBRE_COLUMNS; ++i) {
            at[i] = (k + 1 - row) * fraction_of(low[i], lobe) + (row - k) * fraction_of(high[i], lobe);
            upto[i] = i ? upto[i - 1] + 0.5 * step * (at[i - 1] + at[i]) : 0;
        }
    }
    double whole() const { return 2 * upto[HAIR_FIBRE_COLUMNS - 1]; }

    // Return the azimuth at which the integral reaches the fraction `random`. The density is linear
    // between columns.
    double choose(double random) const
    {
        const double step = pi / (HAIR_FIBRE_COLUMNS - 1), wanted = random * upto[HAIR_FIBRE_COLUMNS - 1];
        int i = int(std::upper_bound(upto, upto + HAIR_FIBRE_COLUMNS, wanted) - upto) - 1;
        i = std::clamp(i, 0, HAIR_FIBRE_COLUMNS - 2);
        const double a = at[i], slope = (at[i + 1] - a) / step, left = wanted - upto[i];
        const double root = std::sqrt(std::max(a * a + 2 * slope * left, 0.0));
        return i * step + std::min(a + root > 0 ? 2 * left / (a + root) : 0, step);
    }
};

} // namespace

void hair_reference_scatter(const struct hair_reference_fibre* fibre, const double tangent[3],
                            const double to_light[3], const double to_eye[3], const double* mu, int count,
                            double* out)
{
    const table t{fibre->table};
    const angles a = measure(vector_of(tangent), vector_of(to_light), vector_of(to_eye));
    double fraction[4], path[4], m[lobes];
    t.look_up(a.turn, a.half, 0, fraction);
    t.look_up(a.turn, a.half, 1, path);
    for (int p = 0; p < lobes; ++p) {
        const tilted l(a, *fibre, p);
        m[p] = longitudinal(l.sin_l, l.cos_l, l.sin_e, l.cos_e, l.v) * symmetric(l.cos_l, l.cos_e, l.v);
    }
    const double balance = t.balance(a.cos_l) * t.balance(a.cos_e);
    for (int i = 0; i < count; ++i)
        out[i] =
            balance *
            (m[0] * fraction[0] + m[1] * fraction[1] * std::exp(-mu[i] * path[0]) +
             m[2] * (fraction[2] * std::exp(-mu[i] * path[1]) + fraction[3] * std::exp(-mu[i] * path[2])));
}

double hair_reference_choose(const struct hair_reference_fibre* fibre, const double tangent[3],
                             const double to_eye[3], const double random[3], double to_light[3])
{
    const table t{fibre->table};
    const Vector3d along = vector_of(tangent), eye = vector_of(to_eye);
    const double sin_e = std::clamp(along.dot(eye), -1.0, 1.0), cos_e = std::sqrt(1 - sin_e * sin_e);
    // Choose lobes about in proportion to their strength at the mirrored cone of the eye.
    double chosen[lobes], all = 0, x = random[0];
    int lobe = 0;
    for (int p = 0; p < lobes; ++p) all += chosen[p] = row_sums(t, cos_e, p).whole();
    for (double& fraction : chosen) fraction /= all;
    while (lobe < lobes - 1 && x >= chosen[lobe]) x -= chosen[lobe++];
    x /= chosen[lobe];

    // Choose the inclination around the mirrored cone of the eye (d'Eon et al. 2013).
    const double v = width_of[lobe] * fibre->variance, by = tilt_of[lobe] * fibre->tilt;
    const double cone = by - std::asin(sin_e);
    const double u = 1 + v * std::log(std::max(x, 1e-12) + (1 - x) * std::exp(-2 / v));
    const double sine = u * std::sin(cone) +
                        std::sqrt(std::max(1 - u * u, 0.0)) * std::cos(2 * pi * random[1]) * std::cos(cone);
    const double level = std::asin(std::clamp(sine, -1.0, 1.0)) + by;
    const double sin_l = std::sin(level), cos_l = std::abs(std::cos(level));

    const double half = std::sqrt(std::clamp(0.5 + 0.5 * (cos_l * cos_e + sin_l * sin_e), 0.0, 1.0));
    const bool left = random[2] < 0.5;
    const double turn = row_sums(t, half, lobe).choose(2 * random[2] - (left ? 0 : 1));
    Vector3d out = eye - sin_e * along;
    if (out.norm() < 1e-9) out = along.unitOrthogonal();
    out.normalize();
    const Vector3d side = along.cross(out);
    const Vector3d light =
        sin_l * along + cos_l * (std::cos(turn) * out + (left ? 1 : -1) * std::sin(turn) * side);
    store(light, to_light);

    // Scales tilt directions near the fibre's ends over to the other side, therefore add the
    // density of all preimages.
    const angles a = measure(along, light, eye);
    const double at = std::asin(a.sin_l), ways[3] = {at, pi - at, -pi - at};
    double fraction[4], density = 0;
    t.look_up(a.turn, a.half, 0, fraction);
    for (int p = 0; p < lobes; ++p) {
        const tilted l(a, *fibre, p);
        double m = 0;
        for (const double way : ways) {
            const double from = way - tilt_of[p] * fibre->tilt;
            if (std::abs(from) < 0.5 * pi)
                m += longitudinal(std::sin(from), std::cos(from), l.sin_e, l.cos_e, l.v) * std::cos(from) /
                     a.cos_l;
        }
        density += chosen[p] * m * fraction_at(fraction, p) / row_sums(t, a.half, p).whole();
    }
    return density;
}
