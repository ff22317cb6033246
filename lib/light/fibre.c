// fibre.c - lobes of a dielectric cylinder, summed over the points of its width where a ray enters,
// and over the directions of its cross section.
#include "lib/light/fibre.h"
#include "lib/base/assert.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define PI 3.14159265358979
#define LOBES 4
#define ANGLES 64 // Number of angles along the fibre.
// Number of rays over the fibre's width, at even angles from its middle and so denser at grazing
// incidence.
#define RAYS 96
// Number of directions of an elliptic cross section over half a turn, and of rays in each.
#define DIRECTIONS 24
#define FLAT_RAYS 32
#define MAX_RAYS (DIRECTIONS * FLAT_RAYS)

void hair_fibre_variances(float roughness, float out[3])
{
    float b = 0.726f * roughness + 0.812f * roughness * roughness + 3.7f * powf(roughness, 20);
    out[0] = b * b;
    out[1] = 0.25f * out[0];
    out[2] = 4 * out[0];
}

float hair_fibre_darkening(float roughness)
{
    float b = roughness;
    return 5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + 0.245f * b))));
}

float hair_fibre_scale(float roughness)
{
    return 0.6266571f * (0.265f * roughness + 1.194f * roughness * roughness + 5.372f * powf(roughness, 22));
}

// Return the Fresnel reflectance of unpolarised light for the cosine of its angle of incidence.
static double reflect(double cosine, double index)
{
    double t = sqrt(1 - (1 - cosine * cosine) / (index * index));
    double p = (index * cosine - t) / (index * cosine + t), s = (cosine - index * t) / (cosine + index * t);
    return 0.5 * (p * p + s * s);
}

static double to_logistic(double x, double scale)
{
    return 1 / (1 + exp(-x / scale));
}

// Return the density, in 1/radian, of a logistic distribution of an angle, truncated to [-pi, pi].
// `kept` is the probability of that interval.
static double logistic(double x, double scale, double kept)
{
    x = x - 2 * PI * floor((x + PI) / (2 * PI));
    double e = exp(-fabs(x) / scale);
    return e / (scale * (1 + e) * (1 + e)) / kept;
}

// Paths of a ray that meets the fibre. `fraction` is the fraction of all incoming light that leaves
// in each lobe without absorption. `angle` is the angle from the incoming direction, and `path` the
// distance inside in radii.
struct ray {
    double fraction[LOBES], angle[LOBES], path[LOBES];
};

// Elliptic cross section of a fibre with the area of a unit circle, and light in its plane.
struct fibre_section {
    double axes[2]; // Halves, longer first.
    double way[2]; // Unit direction in which the light goes.
    double half_width; // Seen from the light.
    double index, true_index; // Index of refraction across the fibre, and in space.
    double cos_d; // Cosine of half the angle between the cones.
};

static struct fibre_section section_of(const struct hair_fibre* fibre, double turn, double cos_d)
{
    double index = (double)fibre->index, sin_d = sqrt(1 - cos_d * cos_d), flat = (double)fibre->flatness;
    struct fibre_section s = {
        .axes = {1 / sqrt(flat), sqrt(flat)}, .way = {-cos(turn), -sin(turn)}, .cos_d = cos_d};
    s.half_width = hypot(s.axes[0] * s.way[1], s.axes[1] * s.way[0]);
    s.index = sqrt(index * index - sin_d * sin_d) / cos_d;
    s.true_index = index;
    HAIR_ASSERT(s.index >= 1);
    return s;
}

// Move a point along a direction to where the line leaves the ellipse. Write the outward normal and
// return the way.
static double leave_section(const struct fibre_section* s, double at[2], const double way[2],
                            double normal[2])
{
    double a = 0, b = 0, c = -1, length = 0;
    for (int k = 0; k < 2; ++k) {
        double p = at[k] / s->axes[k], d = way[k] / s->axes[k];
        a += d * d, b += p * d, c += p * p;
    }
    double far = (-b + sqrt(fmax(b * b - a * c, 0))) / a;
    for (int k = 0; k < 2; ++k) {
        at[k] += far * way[k];
        normal[k] = at[k] / (s->axes[k] * s->axes[k]);
        length += normal[k] * normal[k];
    }
    for (int k = 0; k < 2; ++k) normal[k] /= sqrt(length);
    return far;
}

// Refract a direction on the way through a surface by the ratio of the indices. `cosine` is that of
// the direction and the normal along it, and `out` that behind the surface.
static void refract(const double way[2], const double normal[2], double ratio, double cosine, double out,
                    double result[2])
{
    for (int k = 0; k < 2; ++k) result[k] = ratio * way[k] + (out - ratio * cosine) * normal[k];
}

// Return the angle from the direction to the light to a direction that leaves the fibre.
static double angle_from(const struct fibre_section* s, const double out[2])
{
    return atan2(s->way[1] * out[0] - s->way[0] * out[1], -s->way[0] * out[0] - s->way[1] * out[1]);
}

// Trace the ray at the height `h` of the half width. `weight` is its fraction of all light.
static struct ray trace(const struct fibre_section* s, double h, double weight)
{
    struct ray ray = {.path = {0}};
    const double *d = s->way, back[2] = {-d[0], -d[1]};
    double at[2] = {-h * s->half_width * d[1], h * s->half_width * d[0]}, n[2], way[2], out[2];
    leave_section(s, at, back, n);
    double in = -(d[0] * n[0] + d[1] * n[1]), inside = sqrt(1 - (1 - in * in) / (s->index * s->index));
    double f = reflect(s->cos_d * in, s->true_index), left = weight * (1 - f);
    double along = sqrt(1 - (1 - s->cos_d * s->cos_d) / (s->true_index * s->true_index)), path = 0;
    ray.fraction[0] = weight * f;
    for (int k = 0; k < 2; ++k) out[k] = d[k] + 2 * in * n[k];
    ray.angle[0] = angle_from(s, out);
    const double inwards[2] = {-n[0], -n[1]};
    refract(d, inwards, 1 / s->index, in, inside, way);
    for (int p = 1; p < LOBES; ++p) {
        path += leave_section(s, at, way, n) / along;
        double cosine = way[0] * n[0] + way[1] * n[1],
               square = 1 - (1 - cosine * cosine) * s->index * s->index;
        f = square > 0 ? reflect(s->cos_d * sqrt(square), s->true_index) : 1; // All is reflected.
        // The last lobe is all that is reflected twice or more.
        ray.fraction[p] = left * (p < LOBES - 1 ? 1 - f : 1);
        ray.path[p] = path;
        refract(way, n, s->index, cosine, sqrt(fmax(square, 0)), out);
        ray.angle[p] = angle_from(s, out);
        for (int k = 0; k < 2; ++k) way[k] -= 2 * cosine * n[k];
        left *= f;
    }
    return ray;
}

static double cosine_of(int row)
{
    double cosine = (double)row / (HAIR_FIBRE_ROWS - 1);
    return cosine < 0.02 ? 0.02 : cosine;
}

// Trace rays over the width of a fibre. A circle is the same in all directions. Directions of an
// ellipse receive light in proportion to their width. Return the number of rays.
static int trace_all(const struct hair_fibre* fibre, double cos_d, struct ray rays[MAX_RAYS])
{
    bool is_flat = fibre->flatness < 1;
    int directions = is_flat ? DIRECTIONS : 1, each = is_flat ? FLAT_RAYS : RAYS;
    struct fibre_section section[DIRECTIONS];
    double width = 0;
    for (int k = 0; k < directions; ++k) {
        section[k] = section_of(fibre, PI * (k + 0.5) / directions, cos_d);
        width += section[k].half_width;
    }
    for (int k = 0; k < directions; ++k)
        for (int i = 0; i < each; ++i) {
            double in = PI * ((i + 0.5) / each - 0.5);
            double weight = section[k].half_width / width * 0.5 * PI / each * cos(in);
            rays[k * each + i] = trace(&section[k], sin(in), weight);
        }
    return directions * each;
}

static void fill_lobes(const struct hair_fibre* fibre, hair_fibre_table table)
{
    double scale = (double)hair_fibre_scale(fibre->around);
    double kept = to_logistic(PI, scale) - to_logistic(-PI, scale);
    for (int row = 0; row < HAIR_FIBRE_ROWS; ++row) {
        struct ray rays[MAX_RAYS];
        int count = trace_all(fibre, cosine_of(row), rays);
        for (int column = 0; column < HAIR_FIBRE_COLUMNS; ++column) {
            double phi = PI * column / (HAIR_FIBRE_COLUMNS - 1), sum[LOBES] = {0}, path[LOBES] = {0};
            for (int i = 0; i < count; ++i)
                for (int p = 0; p < LOBES; ++p) {
                    // Light that was reflected inside twice or more has lost its direction.
                    double density = p < 3 ? logistic(phi - rays[i].angle[p], scale, kept) : 0.5 / PI;
                    sum[p] += rays[i].fraction[p] * density;
                    path[p] += rays[i].fraction[p] * density * rays[i].path[p];
                }
            for (int p = 1; p < LOBES; ++p) path[p] = sum[p] > 1e-30 ? path[p] / sum[p] : 2 * p;
            table[0][row][column] = (hair_vec4){(float)sum[0], (float)sum[1], (float)sum[2], (float)sum[3]};
            table[1][row][column] = (hair_vec4){(float)path[1], (float)path[2], (float)path[3], 0};
        }
    }
}

// Return the weight of a column in an integral over all azimuths, in radians.
static double weight_of(int column)
{
    int end = column == 0 || column == HAIR_FIBRE_COLUMNS - 1;
    return 2 * PI / (HAIR_FIBRE_COLUMNS - 1) * (end ? 0.5 : 1);
}

static double angle_of(int i)
{
    return PI * ((i + 0.5) / ANGLES - 0.5);
}

// Return the fractions of light that a fibre sends on and back, and the variances of both. Light
// comes evenly from one side of a plane through the fibre. At the angle phi from the light, phi /
// pi of it goes on to the other side.
static hair_vec4 send(const hair_fibre_table table, int row, double mu, const float variance[3])
{
    double on = 0, back = 0, on_variance = 0, back_variance = 0;
    for (int column = 0; column < HAIR_FIBRE_COLUMNS; ++column) {
        const hair_vec4 *w = &table[0][row][column], *l = &table[1][row][column];
        double fraction = (double)column / (HAIR_FIBRE_COLUMNS - 1);
        double weight = weight_of(column);
        double lobe[4] = {(double)w->x, (double)w->y * exp(-mu * (double)l->x),
                          (double)w->z * exp(-mu * (double)l->y), (double)w->w * exp(-mu * (double)l->z)};
        for (int p = 0; p < LOBES; ++p) {
            double v = (double)variance[p < 2 ? p : 2];
            on += weight * fraction * lobe[p];
            back += weight * (1 - fraction) * lobe[p];
            on_variance += weight * fraction * lobe[p] * v;
            back_variance += weight * (1 - fraction) * lobe[p] * v;
        }
    }
    HAIR_ASSERT(on > 0 && back > 0);
    return (hair_vec4){(float)on, (float)back, (float)(on_variance / on), (float)(back_variance / back)};
}

// Return the logarithm of the modified Bessel function I0, from its integral.
static double log_bessel(double x)
{
    double sum = 0;
    for (int i = 0; i < 24; ++i) {
        // 2 s^2 is 1 - cos of twice the angle, without losing digits.
        double s = sin(PI * (i + 0.5) / 48);
        sum += exp(-2 * x * s * s) / 24;
    }
    return x + log(sum);
}

// Return the longitudinal scattering for scales without tilt, as in light/fibre.glsl. Angles are
// measured from the plane across the fibre.
static double longitudinal(double light, double eye, double variance)
{
    double r = 1 / variance, s = variance / (variance + 0.3);
    double m =
        exp(log_bessel(cos(light) * cos(eye) * r) - (sin(light) * sin(eye) + 1) * r) * r / (1 - exp(-2 * r));
    double grazing = sqrt(s * (0.304161 + s * (-0.101796 + s * (1.961349 - 1.543683 * s))));
    double normal = 1 + s * (-0.138467 + s * (0.363444 + s * (-1.358778 + 0.927069 * s)));
    double g = pow(grazing, 3), n = pow(normal, 3) - g;
    return m * pow((g + n * pow(cos(light), 3)) * (g + n * pow(cos(eye), 3)), -1.0 / 6);
}

// Compute a factor by which the table conserves energy. Lobes of different widths take light from
// cones on which their strengths differ. Together they lose some of the light that grazes the
// fibre. A factor for the cosine of either direction makes up for the loss (Sinkhorn 1967). Every
// row holds the factor of its cosine.
static void balance(hair_fibre_table table, const float variance[3])
{
    // Smallest variance that the sums below resolve.
    static const double finest = 4 * (PI / ANGLES) * (PI / ANGLES);
    double lobe[HAIR_FIBRE_ROWS][LOBES] = {{0}}, pair[ANGLES][ANGLES], factor[ANGLES];
    for (int row = 0; row < HAIR_FIBRE_ROWS; ++row)
        for (int column = 0; column < HAIR_FIBRE_COLUMNS; ++column) {
            const hair_vec4* w = &table[0][row][column];
            double weight = weight_of(column);
            lobe[row][0] += weight * (double)w->x, lobe[row][1] += weight * (double)w->y;
            lobe[row][2] += weight * ((double)w->z + (double)w->w);
        }
    for (int i = 0; i < ANGLES; ++i)
        for (int k = 0; k < ANGLES; ++k) {
            double light = angle_of(i), eye = angle_of(k),
                   at = cos(0.5 * (light - eye)) * (HAIR_FIBRE_ROWS - 1);
            int row = at < HAIR_FIBRE_ROWS - 2 ? (int)at : HAIR_FIBRE_ROWS - 2;
            pair[i][k] = 0;
            for (int p = 0; p < 3; ++p)
                pair[i][k] += (lobe[row][p] + (at - row) * (lobe[row + 1][p] - lobe[row][p])) * PI / ANGLES *
                              cos(light) * cos(light) *
                              longitudinal(light, eye, fmax((double)variance[p], finest));
        }
    for (int k = 0; k < ANGLES; ++k) factor[k] = 1;
    for (int round = 0; round < 16; ++round) {
        double sum[ANGLES] = {0};
        for (int i = 0; i < ANGLES; ++i)
            for (int k = 0; k < ANGLES; ++k) sum[k] += pair[i][k] * factor[i] * factor[k];
        for (int k = 0; k < ANGLES; ++k) HAIR_ASSERT(sum[k] > 0);
        for (int k = 0; k < ANGLES; ++k) factor[k] /= sqrt(sum[k]);
    }
    for (int row = 0; row < HAIR_FIBRE_ROWS; ++row) {
        double at = (acos((double)row / (HAIR_FIBRE_ROWS - 1)) / PI + 0.5) * ANGLES - 0.5;
        int k = at < ANGLES - 2 ? (int)at : ANGLES - 2;
        for (int column = 0; column < HAIR_FIBRE_COLUMNS; ++column)
            table[1][row][column].w = (float)(factor[k] + fmin(at - k, 1) * (factor[k + 1] - factor[k]));
    }
}

void hair_fibre_fill(const struct hair_fibre* fibre, hair_fibre_table table)
{
    float variance[3];
    hair_fibre_variances(fibre->along, variance);
    fill_lobes(fibre, table);
    balance(table, variance);
    for (int row = 0; row < HAIR_FIBRE_ROWS; ++row)
        for (int column = 0; column < HAIR_FIBRE_COLUMNS; ++column) {
            double x = (double)column / (HAIR_FIBRE_COLUMNS - 1);
            double mu = x < 1 ? HAIR_FIBRE_MU * x / (1 - x) : 1e4;
            table[2][row][column] =
                send((const hair_vec4(*)[HAIR_FIBRE_ROWS][HAIR_FIBRE_COLUMNS])table, row, mu, variance);
        }
}
