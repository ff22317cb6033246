// frequency.c - Frequency of an oscillation, from samples of it.
#include "tools/bench/frequency.h"

#include <math.h>

#define PI 3.14159265358979323846

// Return the weighted sum of squares that a fit leaves. The fit is a cos + b sin of the frequency,
// both with a linear slope in time. Hann's window lowers the weights towards both ends, so that
// other oscillations matter little.
static double misfit(const double* samples, uint32_t count, double dt, double frequency)
{
    enum { N = 4 };
    double a[N][N + 1] = {{0}}, squares = 0;
    for (uint32_t k = 0; k < count; ++k) {
        double t = 2.0 * k / count - 1, c = cos(frequency * k * dt), s = sin(frequency * k * dt);
        double basis[N] = {c, s, t * c, t * s};
        double weight = 0.5 + 0.5 * cos(PI * t);
        squares += weight * samples[k] * samples[k];
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j < N; ++j) a[i][j] += weight * basis[i] * basis[j];
            a[i][N] += weight * basis[i] * samples[k];
        }
    }
    double right[N];
    for (int i = 0; i < N; ++i) right[i] = a[i][N];
    // Gaussian elimination without pivoting. The matrix is positive definite.
    for (int i = 0; i < N; ++i)
        for (int j = i + 1; j < N; ++j) {
            double f = a[j][i] / a[i][i];
            for (int k = i; k <= N; ++k) a[j][k] -= f * a[i][k];
        }
    for (int i = N; i-- > 0;) {
        for (int j = i + 1; j < N; ++j) a[i][N] -= a[i][j] * a[j][N];
        a[i][N] /= a[i][i];
        squares -= a[i][N] * right[i];
    }
    return squares;
}

double bench_frequency(const double* samples, uint32_t count, double dt, double low, double high)
{
    const double golden = 0.61803398874989485, step = 0.1 / (count * dt);
    double best = low, min = INFINITY;
    for (double f = low; f <= high; f += step) {
        double m = misfit(samples, count, dt, f);
        if (m < min) min = m, best = f;
    }
    for (low = best - step, high = best + step; high - low > 1e-9 * best;) {
        double a = high - golden * (high - low), b = low + golden * (high - low);
        if (misfit(samples, count, dt, a) < misfit(samples, count, dt, b))
            high = b;
        else
            low = a;
    }
    return (low + high) / 2;
}
