// gusts.c - turbulence from waves of random direction and phase, summed by a Fourier transform
// along one axis at a time.
#include "lib/wind/gusts.h"

#include "lib/base/math.h"

#define N HAIR_GUST_NODES
#define COUNT (N * N * N)
#define PI 3.14159265358979
#define SCALE 0.7468 // sqrt(pi) Gamma(5/6) / Gamma(1/3), the ratio of L to l.

struct wave {
    float re, im;
};

static int wave_number(int i)
{
    return i < N / 2 ? i : i - N;
}

// Write one wave. Its velocity is perpendicular to its direction, with a random angle and phase.
static void make_wave(struct wave* const* field, int at, const int n[3], uint32_t* random)
{
    double size = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    HAIR_ASSERT(0 <= at && at < COUNT && size > 0);
    double kl = 2 * PI * size / (HAIR_GUST_LENGTHS * SCALE);
    double amplitude = kl / pow(1 + kl * kl, 17.0 / 12); // This is sqrt(E) / k.
    hair_vec3 along = hair_scale(hair_v3((float)n[0], (float)n[1], (float)n[2]), (float)(1 / size));
    hair_vec3 a = hair_perpendicular(along), b = hair_cross(along, a);
    float angle = 2 * (float)PI * hair_random(random), phase = 2 * (float)PI * hair_random(random);
    hair_vec3 way = hair_add(hair_scale(a, cosf(angle)), hair_scale(b, sinf(angle)));
    float of[3] = {way.x, way.y, way.z};
    for (int c = 0; c < 3; ++c) {
        field[c][at].re = (float)amplitude * of[c] * cosf(phase);
        field[c][at].im = (float)amplitude * of[c] * sinf(phase);
    }
}

static void make_waves(struct wave* const* field, uint32_t seed)
{
    uint32_t random = hair_hash(seed);
    for (int i = 0; i < COUNT; ++i) {
        const int n[3] = {wave_number(i % N), wave_number(i / N % N), wave_number(i / N / N)};
        // The highest wave number has no direction.
        int is_highest = n[0] == -N / 2 || n[1] == -N / 2 || n[2] == -N / 2;
        if (i > 0 && !is_highest) make_wave(field, i, n, &random);
    }
}

// Transform N numbers in place, which are `stride` apart.
static void transform_line(struct wave* line, int stride, const struct wave* turn)
{
    struct wave out[N];
    for (int x = 0; x < N; ++x) {
        struct wave sum = {0, 0};
        for (int k = 0; k < N; ++k) {
            struct wave a = line[k * stride], t = turn[k * x % N];
            sum.re += a.re * t.re - a.im * t.im;
            sum.im += a.re * t.im + a.im * t.re;
        }
        out[x] = sum;
    }
    for (int x = 0; x < N; ++x) line[x * stride] = out[x];
}

static void transform(struct wave* field)
{
    static const int strides[3] = {1, N, N * N};
    struct wave turn[N];
    for (int k = 0; k < N; ++k)
        turn[k] = (struct wave){cosf(2 * (float)PI * (float)k / N), sinf(2 * (float)PI * (float)k / N)};
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < COUNT; ++i)
            if (i / strides[axis] % N == 0) transform_line(field + i, strides[axis], turn);
}

// Return the mean square of the real part when read linearly between texels. It sums weighted
// products of each texel with itself and with its neighbours.
static double mean_square(const struct wave* field)
{
    static const double fraction[3] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
    double sum = 0;
    for (int i = 0; i < COUNT; ++i) {
        int x = i % N, y = i / N % N, z = i / N / N;
        double near = 0;
        for (int k = 0; k < 27; ++k) {
            int a = (x + k % 3 + N - 1) % N, b = (y + k / 3 % 3 + N - 1) % N, c = (z + k / 9 + N - 1) % N;
            near += fraction[k % 3] * fraction[k / 3 % 3] * fraction[k / 9] *
                    (double)field[a + N * (b + N * c)].re;
        }
        sum += near * (double)field[i].re;
    }
    return sum / COUNT;
}

float* hair_gusts_make(const hair_host* host, uint32_t seed)
{
    struct wave* waves = hair_alloc(host, 3 * (size_t)COUNT, sizeof *waves);
    float* out = hair_alloc(host, 4 * (size_t)COUNT, sizeof *out);
    if (!waves || !out) {
        hair_free(host, waves);
        hair_free(host, out);
        return NULL;
    }
    struct wave* const field[3] = {waves, waves + COUNT, waves + 2 * COUNT};
    double square = 0;
    make_waves(field, seed);
    for (int c = 0; c < 3; ++c) {
        transform(field[c]);
        square += mean_square(field[c]);
    }
    HAIR_ASSERT(square > 0);
    float one = (float)(1 / sqrt(square / 3));
    for (int i = 0; i < COUNT; ++i)
        for (int c = 0; c < 3; ++c) out[4 * i + c] = one * field[c][i].re;
    hair_free(host, waves);
    return out;
}
