// fibre.glsl - scattering of light by one hair fibre. The model is that of Marschner et al. 2003,
// with the longitudinal part after d'Eon et al. 2011. lib/light/fibre.c tabulates the azimuthal
// part.
//
// Longitudinal lobes are made symmetric, so that the path of light is reversible. They are divided
// by a factor q that is fitted to conserve energy, to 0.7 % for a fibre without tilt.
#include "draw_params.glsl"

layout(binding = HAIR_UNIT_FIBRE) uniform sampler3D fibre_texture;

vec4 fibre_table(float x, float y, float layer)
{
    const vec2 size = vec2(HAIR_FIBRE_COLUMNS, HAIR_FIBRE_ROWS);
    vec2       at   = (vec2(x, y) * (size - 1.0) + 0.5) / size;
    return textureLod(fibre_texture, vec3(at, (layer + 0.5) / float(HAIR_FIBRE_LAYERS)), 0.0);
}

// Directions relative to the fibre. `light` and `eye` are sine and cosine of the inclination to the
// plane across the fibre. `half_cosine` is the cosine of half the angle between their cones. `turn`
// is phi / pi, and 0 when the eye is on the side of the light. `between` is the cosine of the angle
// between both directions.
struct fibre_angles {
    vec2  light, eye;
    float half_cosine, turn, between;
};

fibre_angles measure_angles(vec3 tangent, vec3 to_light, vec3 to_eye)
{
    fibre_angles a;
    float l = clamp(dot(tangent, to_light), -1.0, 1.0), e = clamp(dot(tangent, to_eye), -1.0, 1.0);
    a.light = vec2(l, sqrt(1.0 - l * l)), a.eye = vec2(e, sqrt(1.0 - e * e));
    // cos((x - y) / 2) = sqrt((1 + cos(x - y)) / 2).
    a.half_cosine = sqrt(clamp(0.5 + 0.5 * (a.light.y * a.eye.y + l * e), 0.0, 1.0));
    float across  = (dot(to_light, to_eye) - l * e) / max(a.light.y * a.eye.y, 1e-6);
    a.turn        = acos(clamp(across, -1.0, 1.0)) * 0.31830989;
    a.between     = dot(to_light, to_eye);
    return a;
}

// Return the logarithm of the modified Bessel function I0 (Abramowitz and Stegun 1964, 9.8.1 and
// 9.8.2).
float log_bessel(float x)
{
    float t = x * x / 14.0625, u = 3.75 / max(x, 3.75);
    float small = t * (0.2659732 + t * (0.0360768 + t * 0.0045813));
    small       = 1.0 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + small)));
    float large = u * (-0.02057706 + u * (0.02635537 + u * (-0.01647633 + u * 0.00392377)));
    large = 0.39894228 + u * (0.01328592 + u * (0.00225319 + u * (-0.00157565 + u * (0.00916281 + large))));
    return x < 3.75 ? log(small) : x - 0.5 * log(x) + log(large);
}

// Return a longitudinal lobe of the given variance. `tilt` is sine and cosine of the angle by which
// the fibre's scales tilt it.
float longitudinal(fibre_angles a, float variance, vec2 tilt)
{
    vec2  l = vec2(a.light.x * tilt.y - a.light.y * tilt.x, abs(a.light.y * tilt.y + a.light.x * tilt.x));
    vec2  e = vec2(a.eye.x * tilt.y - a.eye.y * tilt.x, abs(a.eye.y * tilt.y + a.eye.x * tilt.x));
    float r = 1.0 / variance;
    float m = exp(log_bessel(l.y * e.y * r) - (l.x * e.x + 1.0) * r) * r / (1.0 - exp(-2.0 * r));
    float s = variance / (variance + 0.3);
    // q where the cosine is 0.
    float grazing = sqrt(s * (0.304161 + s * (-0.101796 + s * (1.961349 - 1.543683 * s))));
    // q where the cosine is 1.
    float normal  = 1.0 + s * (-0.138467 + s * (0.363444 + s * (-1.358778 + 0.927069 * s)));
    float g = grazing * grazing * grazing, n = normal * normal * normal - g;
    return m * pow((g + n * l.y * l.y * l.y) * (g + n * e.y * e.y * e.y), -1.0 / 6.0);
}

// Return the absorption per radius at which hair of this fibre has the given reflectance (Chiang et
// al. 2016, equation 9).
vec3 absorption_of(vec3 reflectance)
{
    vec3 l = log(clamp(reflectance, 0.001, 0.995));
    return l * l * draw.fibre.y;
}

// Return the light that one fibre scatters from the light to the eye, 1/sr. `mu` is the absorption
// per radius. `v` is the longitudinal variance of the fibre.
vec3 scatter_once(fibre_angles a, vec3 mu, float tilt, float v)
{
    vec4  fraction = fibre_table(a.turn, a.half_cosine, 0.0), path = fibre_table(a.turn, a.half_cosine, 1.0);
    float t1 = -tilt, t2 = 0.5 * tilt, t3 = 1.5 * tilt;
    float m1 = longitudinal(a, v, vec2(sin(t1), cos(t1)));
    float m2 = longitudinal(a, 0.25 * v, vec2(sin(t2), cos(t2)));
    float m3 = longitudinal(a, 4.0 * v, vec2(sin(t3), cos(t3)));
    float balance = fibre_table(0.0, a.light.y, 1.0).w * fibre_table(0.0, a.eye.y, 1.0).w;
    vec3  turned  = fraction.z * exp(-mu * path.y) + fraction.w * exp(-mu * path.z);
    return balance * (m1 * fraction.x + m2 * fraction.y * exp(-mu * path.x) + m3 * turned);
}

vec3 scatter_once(fibre_angles a, vec3 mu, float tilt) { return scatter_once(a, mu, tilt, draw.fibre.x); }
