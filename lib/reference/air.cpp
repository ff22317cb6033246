// air.cpp - a ball in the wind: potential flow around it, and a wake behind it.
#include "lib/reference/air.h"

#include <algorithm>
#include <cmath>

#include "lib/reference/convert.h"

// Of a body with a drag coefficient C in a wake whose deficit is Gaussian, of standard deviation s radii, momentum is kept if
// C = 8 (s / (2 r))^2 d (2 - d) for the share d that air has lost in the middle, by Bastankhah and Porte-Agel 2014.
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
    // A source and a sink: u + (u - 3 (u.n) n) / (2 r^3), which has no part along n on the ball itself.
    const Vector3d n = p / r, past = u + (u - 3 * u.dot(n) * n) / (2 * std::pow(std::max(r, 1.0), 3));
    const double x = p.dot(u) / speed, beside = std::sqrt(std::max(p.squaredNorm() - x * x, 0.0));
    const double width = 0.7 + 0.1 * std::max(x, 0.0), still = std::exp(-0.12 * x * x);
    const double begun = std::clamp(x + 0.4, 0.0, 1.0);
    const double lack =
        (still + (1 - still) * lost(0.5, width)) * std::exp(-beside * beside / (2 * width * width));
    store((1 - lack * begun * begun * (3 - 2 * begun)) * past, out);
}
