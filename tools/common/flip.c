// flip.c - LDR-FLIP, the colour difference that the eye's resolution leaves visible, raised where
// edges and points differ.
#include "tools/common/flip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979
#define MAX_RADIUS 256

struct rgb {
    double r, g, b;
};

struct xyz {
    double x, y, z;
};

// Matrices from linear RGB with Rec. 709 primaries to XYZ and back. The columns of `to` are scaled
// such that RGB white (1, 1, 1) maps to D65.
struct colors {
    double to[3][3], from[3][3];
    struct xyz white;
};

// One dimension of a separable filter, with taps from -radius to radius.
struct kernel {
    int radius;
    float taps[2 * MAX_RADIUS + 1];
};

// Working memory of one picture. Each plane has one float per pixel.
struct planes {
    uint32_t width, height;
    float* memory;
    float *luma, *red_green, *blue_yellow; // Y, Cx, Cz. After filtering: Hunt-adjusted L*, a*, b*.
    float *edges, *points; // magnitudes
    float *half, *row, *spare[2];
};

// Colours -----------------------------------------------------------------------------------------

static void invert(double m[3][3], double out[3][3])
{
    double determinant = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out[j][i] = m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                        m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
    for (int j = 0; j < 3; ++j) determinant += m[0][j] * out[j][0];
    for (int i = 0; i < 9; ++i) out[i / 3][i % 3] /= determinant;
}

static struct xyz multiply(double m[3][3], double a, double b, double c)
{
    return (struct xyz){m[0][0] * a + m[0][1] * b + m[0][2] * c, m[1][0] * a + m[1][1] * b + m[1][2] * c,
                        m[2][0] * a + m[2][1] * b + m[2][2] * c};
}

static void make_colors(struct colors* out)
{
    static const double primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    static const double d65[2] = {0.31271, 0.32902};
    double inverse[3][3];
    out->white = (struct xyz){d65[0] / d65[1], 1, (1 - d65[0] - d65[1]) / d65[1]};
    for (int i = 0; i < 3; ++i) {
        double x = primaries[i][0], y = primaries[i][1];
        out->to[0][i] = x / y;
        out->to[1][i] = 1;
        out->to[2][i] = (1 - x - y) / y;
    }
    invert(out->to, inverse);
    struct xyz scale = multiply(inverse, out->white.x, out->white.y, out->white.z);
    for (int row = 0; row < 3; ++row) {
        out->to[row][0] *= scale.x;
        out->to[row][1] *= scale.y;
        out->to[row][2] *= scale.z;
    }
    invert(out->to, out->from);
}

static double decode(double s)
{
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

// Convert linear RGB to XYZ relative to white.
static struct xyz to_xyz(const struct colors* colors, struct rgb c)
{
    struct xyz v = multiply((double(*)[3])colors->to, c.r, c.g, c.b);
    return (struct xyz){v.x / colors->white.x, v.y, v.z / colors->white.z};
}

static double compress(double t)
{
    const double delta = 6.0 / 29;
    return t > delta * delta * delta ? cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

// Convert linear RGB to CIELAB with the Hunt effect, which scales chroma by lightness. x = L*, y =
// a*, z = b*.
static struct xyz to_hunt(const struct colors* colors, struct rgb c)
{
    struct xyz v = to_xyz(colors, c);
    double light = 116 * compress(v.y) - 16;
    return (struct xyz){light, 0.01 * light * 500 * (compress(v.x) - compress(v.y)),
                        0.01 * light * 200 * (compress(v.y) - compress(v.z))};
}

// HyAB, a distance for large colour differences.
static double hyab(struct xyz a, struct xyz b)
{
    return fabs(a.x - b.x) + hypot(a.y - b.y, a.z - b.z);
}

// Filters -----------------------------------------------------------------------------------------

// Fill the kernel with exp(-squared * d^2), normalized to sum 1. Return the sum before
// normalization.
static double make_gaussian(struct kernel* kernel, int radius, double squared)
{
    double sum = 0;
    kernel->radius = radius;
    for (int d = -radius; d <= radius; ++d) sum += exp(-squared * d * d);
    for (int d = -radius; d <= radius; ++d) kernel->taps[radius + d] = (float)(exp(-squared * d * d) / sum);
    return sum;
}

// Normalize the positive taps to sum 1 and the negative taps to sum -1.
static void balance(struct kernel* kernel)
{
    double positive = 0, negative = 0;
    int count = 2 * kernel->radius + 1;
    for (int i = 0; i < count; ++i) *(kernel->taps[i] > 0 ? &positive : &negative) += kernel->taps[i];
    for (int i = 0; i < count; ++i)
        kernel->taps[i] = (float)(kernel->taps[i] / (kernel->taps[i] > 0 ? positive : -negative));
}

// Make a Gaussian and its first and second derivative, which detect edges and points. The Gaussian
// is 0.082 degrees wide.
static void make_features(double pixels_per_degree, struct kernel* smooth, struct kernel* first,
                          struct kernel* second)
{
    double sigma = 0.5 * 0.082 * pixels_per_degree;
    int radius = (int)ceil(3 * sigma);
    make_gaussian(smooth, radius, 1 / (2 * sigma * sigma));
    *first = *second = *smooth;
    for (int d = -radius; d <= radius; ++d) {
        first->taps[radius + d] *= (float)-d;
        second->taps[radius + d] *= (float)(d * d / (sigma * sigma) - 1);
    }
    balance(first);
    balance(second);
}

static uint32_t clamp_index(int64_t i, uint32_t count)
{
    return i < 0 ? 0 : i >= (int64_t)count ? count - 1 : (uint32_t)i;
}

// Apply a separable filter. `out` must not be `in`. Border pixels are repeated beyond the border.
static void filter(const struct planes* p, const float* in, const struct kernel* across,
                   const struct kernel* down, float* out)
{
    size_t width = p->width;
    int r = across->radius;
    for (uint32_t y = 0; y < p->height; ++y) {
        float* to = p->half + y * width;
        for (int x = -r; x < (int)width + r; ++x) p->row[x + r] = in[y * width + clamp_index(x, p->width)];
        memset(to, 0, width * sizeof *to);
        for (int tap = 0; tap <= 2 * r; ++tap)
            for (size_t x = 0; x < width; ++x) to[x] += across->taps[2 * r - tap] * p->row[x + (size_t)tap];
    }
    for (uint32_t y = 0; y < p->height; ++y) {
        float* to = out + y * width;
        memset(to, 0, width * sizeof *to);
        for (int tap = -r; tap <= r; ++tap) {
            const float* from = p->half + width * clamp_index((int64_t)y + tap, p->height);
            for (size_t x = 0; x < width; ++x) to[x] += down->taps[r - tap] * from[x];
        }
    }
}

// Planes of a picture -----------------------------------------------------------------------------

enum { PLANES = 8 };

static bool make_planes(struct planes* p, uint32_t width, uint32_t height)
{
    size_t count = (size_t)width * height, row = width + 2 * MAX_RADIUS;
    *p = (struct planes){.width = width, .height = height};
    if (count > SIZE_MAX / sizeof(float) / (PLANES + 1)) return false;
    p->memory = malloc((PLANES * count + row) * sizeof *p->memory);
    if (!p->memory) return false;
    float** const planes[PLANES] = {&p->luma,   &p->red_green, &p->blue_yellow, &p->edges,
                                    &p->points, &p->half,      &p->spare[0],    &p->spare[1]};
    for (size_t i = 0; i < PLANES; ++i) *planes[i] = p->memory + i * count;
    p->row = p->memory + PLANES * count;
    return true;
}

// Convert to YCxCz, which is linear in light and can therefore be filtered.
static void split(const struct colors* colors, const float* picture, struct planes* p)
{
    for (size_t i = 0; i < (size_t)p->width * p->height; ++i) {
        const float* s = picture + 3 * i;
        struct xyz v = to_xyz(colors, (struct rgb){decode(s[0]), decode(s[1]), decode(s[2])});
        p->luma[i] = (float)(116 * v.y - 16);
        p->red_green[i] = (float)(500 * (v.x - v.y));
        p->blue_yellow[i] = (float)(200 * (v.y - v.z));
    }
}

static void find_features(struct planes* p, double pixels_per_degree)
{
    struct kernel smooth, first, second;
    size_t count = (size_t)p->width * p->height;
    make_features(pixels_per_degree, &smooth, &first, &second);
    for (int is_point = 0; is_point < 2; ++is_point) {
        const struct kernel* kernel = is_point ? &second : &first;
        float* out = is_point ? p->points : p->edges;
        filter(p, p->luma, kernel, &smooth, p->spare[0]);
        filter(p, p->luma, &smooth, kernel, p->spare[1]);
        // The features are those of (Y + 16) / 116, which is in [0, 1]. The constant 16 vanishes,
        // because the derivative kernels sum to 0.
        for (size_t i = 0; i < count; ++i) out[i] = hypotf(p->spare[0][i], p->spare[1][i]) / 116;
    }
}

// Filter a channel with the eye's contrast sensitivity, a sum of one or two Gaussians in degrees.
static void blur(struct planes* p, float* channel, double pixels_per_degree, const double a[2],
                 const double b[2])
{
    struct kernel kernels[2];
    double weights[2] = {0, 0};
    size_t count = (size_t)p->width * p->height;
    // All channels use one radius, three standard deviations of the widest Gaussian of any channel.
    int radius = (int)ceil(3 * sqrt(0.04 / (2 * PI * PI)) * pixels_per_degree);
    for (int i = 0; i < 2 && a[i] > 0; ++i) {
        double sum =
            make_gaussian(&kernels[i], radius, PI * PI / (b[i] * pixels_per_degree * pixels_per_degree));
        weights[i] = a[i] * sqrt(PI / b[i]) * sum * sum;
        filter(p, channel, &kernels[i], &kernels[i], p->spare[i]);
    }
    float fraction = (float)(weights[1] / (weights[0] + weights[1]));
    for (size_t i = 0; i < count; ++i)
        channel[i] =
            fraction > 0 ? (1 - fraction) * p->spare[0][i] + fraction * p->spare[1][i] : p->spare[0][i];
}

static void find_colors(const struct colors* colors, struct planes* p, double pixels_per_degree)
{
    blur(p, p->luma, pixels_per_degree, (double[]){1, 0}, (double[]){0.0047, 1});
    blur(p, p->red_green, pixels_per_degree, (double[]){1, 0}, (double[]){0.0053, 1});
    blur(p, p->blue_yellow, pixels_per_degree, (double[]){34.1, 13.5}, (double[]){0.04, 0.025});
    for (size_t i = 0; i < (size_t)p->width * p->height; ++i) {
        double y = (p->luma[i] + 16) / 116, x = y + p->red_green[i] / 500, z = y - p->blue_yellow[i] / 200;
        struct xyz c = multiply((double(*)[3])colors->from, x * colors->white.x, y, z * colors->white.z);
        struct xyz hunt = to_hunt(
            colors, (struct rgb){fmin(fmax(c.x, 0), 1), fmin(fmax(c.y, 0), 1), fmin(fmax(c.z, 0), 1)});
        p->luma[i] = (float)hunt.x;
        p->red_green[i] = (float)hunt.y;
        p->blue_yellow[i] = (float)hunt.z;
    }
}

static bool look_at(const struct colors* colors, const float* picture, uint32_t width, uint32_t height,
                    double pixels_per_degree, struct planes* out)
{
    if (!make_planes(out, width, height)) return false;
    split(colors, picture, out);
    find_features(out, pixels_per_degree);
    find_colors(colors, out, pixels_per_degree);
    return true;
}

// Comparison --------------------------------------------------------------------------------------

// Map a colour difference to [0, 1]. The lower 40 % of the input range get 95 % of the output
// range.
static double redistribute(double error, double max)
{
    const double knee = 0.4 * max, at_knee = 0.95;
    return error < knee ? error * at_knee / knee : at_knee + (error - knee) / (max - knee) * (1 - at_knee);
}

static void compare(const struct colors* colors, const struct planes* a, const struct planes* b, float* out)
{
    struct xyz green = to_hunt(colors, (struct rgb){0, 1, 0}), blue = to_hunt(colors, (struct rgb){0, 0, 1});
    double max = pow(hyab(green, blue), 0.7);
    for (size_t i = 0; i < (size_t)a->width * a->height; ++i) {
        struct xyz ca = {a->luma[i], a->red_green[i], a->blue_yellow[i]};
        struct xyz cb = {b->luma[i], b->red_green[i], b->blue_yellow[i]};
        double color = redistribute(pow(hyab(ca, cb), 0.7), max);
        double edge = fabs(a->edges[i] - b->edges[i]), point = fabs(a->points[i] - b->points[i]);
        double feature = sqrt(fmax(edge, point) / sqrt(2));
        out[i] = (float)fmin(pow(color, 1 - feature), 1);
    }
}

bool hair_flip(const float* reference, const float* test, uint32_t width, uint32_t height,
               float pixels_per_degree, float* out)
{
    struct colors colors;
    struct planes a = {0}, b = {0};
    make_colors(&colors);
    bool ok = look_at(&colors, reference, width, height, (double)pixels_per_degree, &a) &&
              look_at(&colors, test, width, height, (double)pixels_per_degree, &b);
    if (ok) compare(&colors, &a, &b, out);
    free(a.memory);
    free(b.memory);
    return ok;
}
