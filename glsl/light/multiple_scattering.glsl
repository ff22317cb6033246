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

// Return the reflectance of hair through which no light passes (Kubelka and Munk 1931).
vec3 reflectance_of(fibre_scattering fibre)
{
    vec3 k = absorbed_by(fibre) / fibre.back;
    return 1.0 / (1.0 + k + sqrt(k * (k + 2.0)));
}

// Return the fraction of scattered light that the hair loses by each fibre on its way.
vec3 lost_by(fibre_scattering fibre)
{
    const float FIT_ON = 0.615, FIT_ROUND = 1.79;
    return min(FIT_ON * (1.0 - fibre.on) + FIT_ROUND * sqrt(absorbed_by(fibre) * fibre.back), 0.999);
}

// Light that reaches a fibre among others.
struct fibre_light {
    float direct;    // Fraction of the light that meets no fibre on its way.
    vec3  scattered; // Fraction that other fibres scatter on to the fibre.
    float open;      // Fraction of the sky that no fibre hides.
};

// Return the light scattered to the eye by a fibre among many. `once` is the scattering of one
// fibre. `weight` is that of light that other fibres scatter.
vec3 scatter_often(fibre_angles a, fibre_scattering fibre, vec3 once, fibre_light light, float weight)
{
    const float FIT_NEAR = 0.33, FIT_RETURNED = 0.74, FIT_AHEAD = 2.63, FIT_SIDE = 2.21;
    // The eye sees more of the lit points if the light is near the eye's direction.
    float near      = max(a.between, 0.0);
    float direct    = pow(light.direct, 1.0 - FIT_NEAR * near * near);
    vec3  scattered = light.scattered * ((1.0 - direct) / max(1.0 - light.direct, 1e-4));
    // A fibre that sees the sky on all sides has no fibres behind it to return light.
    vec3 arrived  = light.direct + light.scattered;
    vec3 returned = FIT_RETURNED * (1.0 - light.open) * reflectance_of(fibre) * arrived;
    float on = sin(1.5707963 * a.turn);
    on *= on;
    vec2 level = vec2(0.0, 1.0);
    vec3 ahead = fibre.on * longitudinal(a, fibre.variance.x, level);
    vec2 wide  = vec2(on, 1.0 - on) * longitudinal(a, fibre.variance.y, level);
    vec3 often = scattered * (FIT_AHEAD * on * on * ahead + FIT_SIDE * fibre.back * wide.y) +
                 returned * (fibre.on * wide.y + fibre.back * wide.x);
    return direct * once + weight * 0.31830989 * often;
}

// Return the reflectance under a uniform sky of hair in which a fraction `open` of the sky is
// visible. It is that of one fibre where all of the sky is visible, and falls to that of dense
// hair.
vec3 reflect_sky(fibre_scattering fibre, float open)
{
    const float FIT_DENSE = 0.226, FIT_OPEN = 1.042;
    vec3 single = fibre.on + fibre.back, ratio = log(single / reflectance_of(fibre));
    return single * pow(vec3(open), FIT_OPEN * ratio * ratio / (ratio + FIT_DENSE));
}
