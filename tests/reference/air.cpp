// air.cpp - Closed-form wind around a ball, as potential flow with a wake behind the ball.
#include "tests/reference/air.h"

#include <algorithm>
#include <cmath>

#include "tests/reference/convert.h"

// Return the fraction d of its speed that air has lost in the middle of a wake with a Gaussian
// deficit.
//
// Momentum is conserved if C = 8 (s / (2 r))^2 d (2 - d) (Bastankhah and Porte-Agel 2014). C is the
// drag coefficient of the body, s the standard deviation of the deficit, r the body's radius.
// `width` is s / r.
static double lost(double drag, double width)
{
    return 1 - std::sqrt(std::max(1 - drag / (2 * width * width), 0.0));
}

void hair_reference_around_ball(const double wind[3], const double place[3], double out[3])
{
    const Vector3d u = vector_of(wind), p = vector_of(place);
    const double speed = u.norm(), r = std::max(p.norm(), 1e-6);
    if (!(speed > 0)) {
        store(u, out);
        return;
    }
    // The potential flow of a dipole is u + (u - 3 (u.n) n) / (2 r^3). u is the wind, n the
    // direction from the ball's middle, r the distance in radii. The component along n is 0 on the
    // ball.
    const Vector3d n = p / r, past = u + (u - 3 * u.dot(n) * n) / (2 * std::pow(std::max(r, 1.0), 3));
    const double x = p.dot(u) / speed, beside = std::sqrt(std::max(p.squaredNorm() - x * x, 0.0));
    const double width = 0.7 + 0.1 * std::max(x, 0.0), still = std::exp(-0.12 * x * x);
    const double begun = std::clamp(x + 0.4, 0.0, 1.0);
    const double lack =
        (still + (1 - still) * lost(0.5, width)) * std::exp(-beside * beside / (2 * width * width));
    store((1 - lack * begun * begun * (3 - 2 * begun)) * past, out);
}
