// shade.glsl - light that a strand reflects to the eye.
#include "draw_params.glsl"
#include "light/lights.glsl"
#include "light/shadow.glsl"
#include "light/strand_color.glsl"
#include "strands/group_look.glsl"
#include "strands/strand_factors.glsl"
#ifdef HAIR_FIBRES
#include "light/multiple_scattering.glsl"
#endif

struct hair_fragment {
    vec3  position; // m, from the head's origin.
    vec3  tangent;  // Unit, from root to tip.
    vec3  to_eye;   // Unit.
    float t;        // From root to tip, [0, 1].
    float random;   // The strand's own, [0, 1).
    uint  seed;     // The strand's own.
    uint  lock;     // The strand's guide.
    uint  group;    // The strand's group.
    uint  strand;   // Number of the follower.
    uint  cached;   // Number of the follower in the vertex cache.
    vec2  uv;       // Texture coordinates of its root on the scalp. 0 if there are none.
    float across; // From -1 at one edge of a ribbon to 1 at the other. 0 when vertices are shaded.
    vec3  color;    // Reflectance.
};

vec3 albedo_of(hair_fragment f) { return f.color; }

// Return the factor of the variance of the longitudinal lobes, by the strand and its group.
float find_variance(hair_fragment f)
{
    return GROUP_FACTOR(f.group, variance) * VARIANCE_FACTOR(f.strand) * variance_of(f.seed);
}

// Return the normal of the ribbon.
vec3 normal_of(hair_fragment f)
{
    return normalize(f.to_eye - dot(f.to_eye, f.tangent) * f.tangent + 1e-6);
}

// Return the fraction of a light that meets no strand on its way. `met` is the number of strands
// that light meets.
float light_through(hair_fragment f, uint number, out float met)
{
    float through;
    if (draw.light_values > 0u)
        through = light_through_strands(number, f.cached, f.t, met);
    else
        through = light_through_depth(number, f.position, f.seed, met);
    return through;
}

// Return the fraction of the sky that no hair hides. Without the density grid, it is an estimate
// from the fraction `through` of the first light, because occluders of the first light also occlude
// the sky. The constants are fitted to the density grid. Hair on the side away from the light sees
// the sky as well, so they are close to the mean.
float sky_open(hair_fragment f, float through)
{
    const float FIT_SHADED = 0.29, FIT_LIT = 0.13;
    if (draw.light_values == 0u) return FIT_SHADED + FIT_LIT * through;
    return clamp(light_found(0u, f.cached, f.t).x, 1e-3, 1.0);
}

// Return how parallel the strands around are: 1 for straight hair and 0 for curls. Without the
// density grid, it is the mean of the head.
float order_of(hair_fragment f)
{
    return draw.light_values > 0u ? light_found(0u, f.cached, f.t).y : draw.order;
}

vec3 sky_of(hair_fragment f)
{
    vec3 normal = normal_of(f);
    return sky_round(normal, cross(f.tangent, normal));
}

#ifdef HAIR_FIBRES
// Properties of a strand that its reflection of all lights has in common.
struct strand_reflection {
    vec3  mu;
    float tilt, variance, order;
};

strand_reflection find_reflection(hair_fragment f)
{
    return strand_reflection(absorption_of(albedo_of(f)), draw.fibre.z * tilt_of(f.random),
                             draw.fibre.x * find_variance(f), order_of(f));
}

// Return the light that a strand reflects of one light, of which the fraction `direct` meets no
// strand. `met` is the number of strands that light meets, and `open` the visible part of the sky.
vec3 reflect_beam(hair_fragment f, strand_reflection own, hair_beam beam, float direct, float met, float open)
{
    // Structs have names here, because Mesa 22.3 loses some that one call passes to another.
    fibre_angles     a        = measure_angles(f.tangent, beam.to, f.to_eye);
    fibre_scattering inclined = find_scattering(a.half_cosine, own.mu);
    vec3 once  = scatter_once(a, own.mu, own.tilt, own.variance);
    fibre_light light = fibre_light(direct, met, open, own.order);
    vec3 often = scatter_often(a, inclined, light);
    once *= find_visible_light(direct, a.between);
    return a.light.y * beam.irradiance * (once + draw.fibre.w * often);
}

vec3 hair_shade(hair_fragment f)
{
    strand_reflection own   = find_reflection(f);
    vec3              sum   = vec3(0.0);
    float             open  = draw.lights == 0u ? sky_open(f, 1.0) : 0.0;
    fibre_scattering  fibre = find_scattering(1.0, own.mu);
    for (uint i = 0u; i < draw.lights; ++i) {
        hair_beam beam = beam_at(i, f.position);
        float met, direct = light_through(f, i, met), past = light_past_bodies(i, f.position);
        if (i == 0u) open = sky_open(f, past * direct);
        sum += past * reflect_beam(f, own, beam, direct, met, open);
    }
    return sum + sky_of(f) * reflect_sky(fibre, open) * 0.31830989;
}
#else
// Shading after Kajiya and Kay 1989, with the two highlights of Marschner et al. 2003 as
// Scheuermann 2004 approximates them. The white highlight is shifted towards the root, the coloured
// one towards the tip.

float lobe(vec3 tangent, vec3 halfway, float exponent)
{
    float along = dot(tangent, halfway);
    return pow(max(1.0 - along * along, 0.0), 0.5 * exponent);
}

// Properties of a strand that its reflection of all lights has in common.
struct strand_reflection {
    vec3 albedo, normal, to_root, to_tip, tinted;
    vec2 glossy;
};

strand_reflection find_reflection(hair_fragment f)
{
    strand_reflection own;
    float shift = 0.12 + 0.16 * (tilt_of(f.random) - 1.0);
    own.albedo  = albedo_of(f);
    own.normal  = normal_of(f);
    own.glossy  = draw.specular.zw / find_variance(f);
    own.to_root = normalize(f.tangent + shift * own.normal);
    own.to_tip  = normalize(f.tangent - 1.5 * shift * own.normal);
    own.tinted  = draw.specular.y * sparkle_at(f.seed, f.t) * own.albedo;
    return own;
}

// Return the light that a strand reflects of one light, of which the fraction `direct` meets no
// strand. This model ignores `met` and `open`.
vec3 reflect_beam(hair_fragment f, strand_reflection own, hair_beam beam, float direct, float met, float open)
{
    vec3  halfway = normalize(beam.to + f.to_eye + 1e-6);
    float along   = dot(f.tangent, beam.to);
    float diffuse = sqrt(max(1.0 - along * along, 0.0));
    vec3  glints  = draw.specular.x * lobe(own.to_root, halfway, own.glossy.x) +
                  own.tinted * lobe(own.to_tip, halfway, own.glossy.y);
    // Light from behind passes through the fibre but does not glint on its near side.
    float facing = clamp(0.5 + 0.75 * dot(own.normal, beam.to), 0.0, 1.0);
    return beam.irradiance * (direct * (own.albedo * diffuse * mix(0.35, 1.0, facing) + facing * glints));
}

vec3 hair_shade(hair_fragment f)
{
    strand_reflection own  = find_reflection(f);
    vec3              sum  = vec3(0.0);
    float             open = 1.0;
    for (uint i = 0u; i < draw.lights; ++i) {
        hair_beam beam = beam_at(i, f.position);
        float     met, light = light_through(f, i, met) * light_past_bodies(i, f.position);
        sum += reflect_beam(f, own, beam, light, met, open);
        if (i == 0u) open = light; // Occluders of the first light also occlude the sky.
    }
    // Light hair transmits more of the sky.
    vec3 through = pow(vec3(sky_open(f, open)), 1.0 - sqrt(clamp(f.color, 0.0, 1.0)));
    return sum + sky_of(f) * own.albedo * through;
}
#endif
