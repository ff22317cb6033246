// gragg.h - Solution of ordinary differential equations by extrapolation.
#ifndef HAIR_TESTS_REFERENCE_GRAGG_H
#define HAIR_TESTS_REFERENCE_GRAGG_H

// Integrate y' = f(t, y) over one step. The modified midpoint rule is applied with 2, 4, … 16 parts
// (Gragg 1965). Its error is a series in the square of the part size, and the result is
// extrapolated to size 0. The order is 16 (Hairer, Nørsett, Wanner 1993, II.9).
template <class Vector, class Function>
Vector gragg_step(const Function& f, double t, const Vector& y, double step)
{
    const int columns = 8;
    Vector table[columns][columns];
    for (int k = 0; k < columns; ++k) {
        const int parts = 2 * (k + 1);
        const double h = step / parts;
        Vector before = y, at = y + h * f(t, y);
        for (int i = 1; i < parts; ++i) {
            const Vector after = before + 2 * h * f(t + i * h, at);
            before = at;
            at = after;
        }
        table[k][0] = (at + before + h * f(t + step, at)) / 2;
        for (int j = 1; j <= k; ++j) {
            const double ratio = double(k + 1) / (k + 1 - j);
            table[k][j] = table[k][j - 1] + (table[k][j - 1] - table[k - 1][j - 1]) / (ratio * ratio - 1);
        }
    }
    return table[columns - 1][columns - 1];
}

#endif
