// continuum.cpp - Rods and chains with known solutions.
#include "tests/reference/continuum.h"

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "tests/reference/gragg.h"

namespace
{

const double pi = 3.141592653589793;

// Return the zero of f between a and b, where f has opposite signs. Bisect until no number lies
// between.
template <class Function> double zero_between(const Function& f, double a, double b)
{
    const bool rises = f(a) < 0;
    for (;;) {
        const double middle = a + (b - a) / 2;
        if (middle == a || middle == b) return middle;
        ((f(middle) < 0) == rises ? a : b) = middle;
    }
}

// Return the n-th sign change of f above `from`. Sign changes must be at least `step` apart.
template <class Function> double zero_above(const Function& f, double from, double step, uint32_t n)
{
    for (double a = from;; a += step)
        if ((f(a) < 0) != (f(a + step) < 0) && --n == 0) return zero_between(f, a, a + step);
}

// Return J(x) of the given order over (x/2)^order, the sum of (-x^2/4)^k / (k! Gamma(order + k +
// 1)) over k.
double bessel(double order, double x)
{
    double term = 1 / std::tgamma(order + 1), sum = 0;
    for (int k = 1; k < 100; ++k) {
        sum += term;
        term *= -x * x / 4 / (k * (order + k));
    }
    return sum;
}

// State of a hanging rod at a distance from the tip. The components are the angle from straight
// down, its derivative, and the integrals of its sine and cosine.
using curve = Eigen::Vector4d;

curve hang(double gamma, double load, double tip)
{
    const auto slope = [&](double s, const curve& c) {
        const double sine = std::sin(c[0]);
        return curve(c[1], (gamma * s + load) * sine, sine, std::cos(c[0]));
    };
    const int steps = 8 + int(std::sqrt(gamma + load));
    curve c(tip, 0, 0, 0);
    for (int i = 0; i < steps; ++i) c = gragg_step(slope, double(i) / steps, c, 1.0 / steps);
    return c;
}

} // namespace

double hair_reference_bessel_zero(double order, uint32_t n)
{
    return zero_above([&](double x) { return bessel(order, x); }, 0.01, 0.1, n);
}

double hair_reference_agm(double a, double b)
{
    for (int i = 0; i < 60; ++i) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return a;
}

double hair_reference_pendulum_period(double amplitude)
{
    return 1 / hair_reference_agm(1, std::cos(amplitude / 2));
}

double hair_reference_beam_root(uint32_t n)
{
    const auto f = [](double x) { return std::cos(x) + 1 / std::cosh(x); };
    return zero_between(f, (n - 1) * pi, n * pi);
}

// Let s be the distance from the lower end, y the displacement of a mode, w its angular frequency,
// g gravity and L the length. The equation of motion is -w^2 y = g ((s + tip L) y')'. It is
// Bessel's equation of order 0 in z = 2 w sqrt((s + tip L) / g). The mass at the tip requires g y'
// = -w^2 y at s = 0.
double hair_reference_chain_frequency(uint32_t n, double length, double gravity, double tip)
{
    const double unit = std::sqrt(gravity / length);
    if (tip == 0) return unit * hair_reference_bessel_zero(0, n) / 2;
    const auto f = [&](double w) {
        const double low = 2 * w * std::sqrt(tip), high = 2 * w * std::sqrt(1 + tip);
        // y = a J0(z) + b Y0(z) with y = 0 at the upper end. dy/ds = (dy/dz) w / sqrt(tip) in units
        // of length and gravity.
        const double a = y0(high), b = -j0(high);
        return -(a * j1(low) + b * y1(low)) / std::sqrt(tip) + w * (a * j0(low) + b * y0(low));
    };
    return unit * zero_above(f, 0.05, 0.1, n);
}

double hair_reference_linkage_frequency(uint32_t n, uint32_t links, const double* lengths,
                                        const double* masses, double gravity)
{
    std::vector<double> tension(links + 1, 0.0); // tension over length of the link above each mass
    double weight = 0;
    for (uint32_t i = links; i-- > 0;) tension[i] = (weight += masses[i] * gravity) / lengths[i];
    // The number of eigenvalues of K y = lambda M y below w^2 is the number of negative pivots of K
    // - w^2 M (Sylvester). K is the stiffness matrix, M the mass matrix.
    const auto short_of = [&](double w) {
        uint32_t below = 0;
        double pivot = 1;
        for (uint32_t i = 0; i < links; ++i) {
            const double beside = i ? tension[i] * tension[i] / pivot : 0;
            pivot = tension[i] + tension[i + 1] - w * w * masses[i] - beside;
            if (pivot < 0) ++below;
        }
        return below < n ? -1.0 : 1.0;
    };
    double high = 1;
    while (short_of(high) < 0) high *= 2;
    return zero_between(short_of, 0, high);
}

// The angle a from straight down at the distance s from the tip satisfies a'' = (gamma s + load)
// sin a. It grows by up to e^60 from the tip to the clamp, therefore the unknown is the logarithm
// of tan(a / 2) at the tip.
struct hair_reference_elastica hair_reference_elastica(double gamma, double load, double angle)
{
    const double clamp = pi / 2 - angle;
    const auto tip = [](double y) { return 2 * std::atan(std::exp(y)); };
    const auto f = [&](double y) { return hang(gamma, load, tip(y))[0] - clamp; };
    // A load P lets the angle grow by at most a factor of e^(length sqrt(P)). The weight lets it
    // grow by at most 2/3 of that exponent.
    const double from = std::log(clamp) - 5 - std::sqrt(gamma + load);
    const double y = zero_above(f, from, 0.5, 1);
    const curve c = hang(gamma, load, tip(y));
    return {c[2], c[3], pi / 2 - tip(y)};
}

// Half the chain satisfies a sinh(s / a) = 1/2. a is the lowest tension over the weight per length,
// s half the span.
struct hair_reference_catenary hair_reference_catenary(double span)
{
    const auto f = [&](double x) { return std::sinh(x) * span - x; }; // x = span / (2 a)
    const double x = zero_between(f, 1e-9, 700), a = span / (2 * x);
    return {a * (std::cosh(x) - 1), std::atan(std::sinh(x)), a * std::cosh(x)};
}

// The slope of a link is the weight between its middle and the chain's middle over the horizontal
// tension.
struct hair_reference_catenary hair_reference_catenary_of_links(double span, uint32_t links)
{
    const double length = 1.0 / links;
    const auto reaches = [&](double tension) {
        double across = 0;
        for (uint32_t i = 0; i < links; ++i)
            across += length * std::cos(std::atan((i + 0.5 - links / 2.0) * length / tension));
        return across - span;
    };
    const double tension = zero_between(reaches, 1e-9, 1e9);
    struct hair_reference_catenary c = {0, std::atan(0.5 * (1 - length) / tension), 0};
    for (uint32_t i = 0; i < links / 2; ++i)
        c.sag += length * std::sin(std::atan((links / 2.0 - i - 0.5) * length / tension));
    c.tension = tension / std::cos(c.slope);
    return c;
}
