// shading.glsl - light from a strand to the eye as views need it: by the library's shader, or by
// the application's, which may call the library's.
#if defined(HAIR_USER_VERTICES) || (defined(HAIR_USER_PIXELS) && !defined(HAIR_OF_VERTICES))
#define HAIR_USER_SHADER 1
#define hair_shade hair_shade_ours
#endif
#include "light/shade.glsl"
#ifdef HAIR_USER_SHADER
#undef hair_shade

vec3 hair_world(hair_fragment f) { return draw.origin.xyz + f.position; }

uint  hair_lights() { return draw.lights; }
vec3  hair_light(hair_fragment f, uint i, out vec3 to)
{
    hair_beam beam = beam_at(i, f.position);
    to = beam.to;
    return beam.irradiance;
}
float hair_light_through(hair_fragment f, uint i)
{
    float met;
    return light_through(f, i, met) * light_past_bodies(i, f.position);
}
vec3  hair_sky(hair_fragment f) { return sky_of(f); }
float hair_sky_through(hair_fragment f) { return sky_open(f, 1.0); }
vec3  hair_reflect(hair_fragment f, vec3 to, vec3 irradiance, float through)
{
    float direct = clamp(through, 0.0, 1.0), met = -log(max(direct, 1e-4));
    strand_reflection own = find_reflection(f);
    hair_beam beam = hair_beam(to, irradiance);
    return reflect_beam(f, own, beam, direct, met, sky_open(f, direct));
}

vec4 hair_shade(hair_fragment f);
#include "light/user_shader.glsl"
#endif
