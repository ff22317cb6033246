// multiple_scattering.glsl - scattering of light by a fibre among many.
//
// The model has two streams of scattered light, as dual scattering has (Zinke et al. 2008). One
// goes on from the light. Dense hair returns the other (Kubelka and Munk 1931). The number of
// fibres in front of a point is that of a Poisson process. The constants named FIT are fitted to
// path tracing. tools/truth/README.md has the errors.
#include "light/fibre.glsl"

// Light that fibres transmit forward and backward, by channel, when they are lit from one side.
struct fibre_scattering {
    vec3 on, back;
    vec2 variance; // Longitudinal variances, forward and backward.
};

fibre_scattering find_scattering(float half_cosine, vec3 mu)
{
    vec3 x = mu / (mu + HAIR_FIBRE_MU);
    vec4 r = fibre_table(x.r, half_cosine, 2.0), g = fibre_table(x.g, half_cosine, 2.0);
    vec4 b = fibre_table(x.b, half_cosine, 2.0);
    return fibre_scattering(vec3(r.x, g.x, b.x), vec3(r.y, g.y, b.y), (r.zw + g.zw + b.zw) / 3.0);
}

// Return the fraction of light that each fibre absorbs.
vec3 absorbed_by(fibre_scattering fibre) { return max(1.0 - fibre.on - fibre.back, 0.0); }

// Return the reflectance of hair through which no light passes (Kubelka and Munk 1931). Each fibre
// loses a fraction of the light, and returns another.
vec3 reflectance_of(vec3 lost, vec3 back)
{
    vec3 k = lost / back;
    return 1.0 / (1.0 + k + sqrt(k * (k + 2.0)));
}

// Light that reaches a fibre among others.
struct fibre_light {
    float direct; // Fraction that meets no fibre on its way.
    float met;    // Number of fibres that the light meets.
    float open;   // Fraction of the sky that no fibre hides.
    float order;  // From 0 where fibres point in all directions to 1 where they are parallel.
};

// Return the fraction of a light that meets no fibre on its way to the visible places of a fibre.
// `between` is the cosine of the angle between light and eye. An eye near the light sees places
// that are lit more often than others (Kuusk 1991).
float find_visible_light(float direct, float between)
{
    const float FIT_SEEN = 0.382;
    return pow(direct, 1.0 - FIT_SEEN * between);
}

// Return the fraction of light that hair lets through, scattered or not, past `met` fibres (Kubelka
// and Munk 1931). Parallel fibres return more of the light. Some of it leaves the hair sideways.
vec3 pass_through(fibre_scattering fibre, float met, float order)
{
    const float FIT_CURLED = 0.781, FIT_PARALLEL = 4.402, FIT_ABSORBED = 0.799, FIT_LOST = 0.003;
    vec3 back = mix(FIT_CURLED, FIT_PARALLEL, order) * fibre.back;
    vec3 lost = FIT_ABSORBED * absorbed_by(fibre) + FIT_LOST, rate = sqrt(lost * (lost + 2.0 * back));
    vec3 on   = exp(-min(rate * met, 40.0));
    return 2.0 * rate * on / ((back + lost) * (1.0 - on * on) + rate * (1.0 + on * on));
}

// Return the light that reaches a fibre from others and is scattered to the eye.
vec3 scatter_often(fibre_angles a, fibre_scattering fibre, fibre_light light)
{
    const float FIT_AHEAD_CURLED = 1.395, FIT_AHEAD = 3.484, FIT_NARROW = 1.503, FIT_EVEN_CURLED = 0.278;
    const float FIT_RETURNED = 1.688, FIT_ABSORBED = 1.502, FIT_LOST = 0.011;
    const float EVEN = 0.5; // Longitudinal lobe of light that is scattered to all sides.
    vec2  level = vec2(0.0, 1.0);
    float none  = exp(-light.met);
    // If light meets any fibre, a Poisson process has at least one.
    vec3  if_any = max(pass_through(fibre, light.met, light.order) - none, 0.0) / max(1.0 - none, 1e-3);
    vec3  scattered = (1.0 - light.direct) * if_any;
    // The fibres around, which return light, hide the sky.
    float fibres   = -log(light.open);
    vec3  lost     = FIT_ABSORBED * absorbed_by(fibre) + FIT_LOST;
    vec3  returned = fibres * reflectance_of(lost, fibre.back) * (light.direct + scattered);
    float on    = pow(sin(1.5707963 * a.turn), 2.0 * FIT_NARROW);
    float even  = mix(FIT_EVEN_CURLED, 1.0, light.order);
    float ahead = on * mix(longitudinal(a, fibre.variance.x, level), EVEN, even);
    float around = 0.5 * mix(EVEN, longitudinal(a, fibre.variance.y, level), light.order);
    ahead *= mix(FIT_AHEAD_CURLED, FIT_AHEAD, light.order);
    vec3 forward = ahead * fibre.on * scattered;
    return 0.31830989 * (forward + FIT_RETURNED * around * (fibre.on + fibre.back) * returned);
}

// Return the reflectance under a uniform sky of hair in which a fraction `open` of the sky is
// visible. It is that of one fibre where all of the sky is visible, and falls to that of dense
// hair.
vec3 reflect_sky(fibre_scattering fibre, float open)
{
    const float FIT_DENSE = 0.404, FIT_OPEN = 1.132;
    vec3 single = fibre.on + fibre.back, dense = reflectance_of(absorbed_by(fibre), fibre.back);
    vec3 ratio  = log(single / dense);
    return single * pow(vec3(open), FIT_OPEN * ratio * ratio / (ratio + FIT_DENSE));
}
