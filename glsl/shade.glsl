// shade.glsl - light from a strand to the eye: Kajiya and Kay 1989, with the two highlights of Marschner et al. 2003
// as Scheuermann 2004 approximates them: a white one shifted towards the root, a coloured one towards the tip.
#include "draw_params.glsl"

struct hair_fragment {
    vec3  tangent; // unit, from root to tip
    vec3  to_eye;  // unit
    float t;       // from root to tip, [0, 1]
    float random;  // the strand's own, [0, 1)
    float light;   // that reaches here, [0, 1]
};

float lobe(vec3 tangent, vec3 halfway, float exponent)
{
    float along = dot(tangent, halfway);
    return pow(max(1.0 - along * along, 0.0), 0.5 * exponent);
}

vec3 hair_shade(hair_fragment f)
{
    vec3  albedo  = mix(draw.root_color.rgb, draw.tip_color.rgb, f.t) * (1.0 + draw.root_color.w * (2.0 * f.random - 1.0));
    vec3  normal  = normalize(f.to_eye - dot(f.to_eye, f.tangent) * f.tangent + 1e-6); // Of the ribbon
    vec3  halfway = normalize(draw.light_to.xyz + f.to_eye);
    float along   = dot(f.tangent, draw.light_to.xyz);
    float diffuse = sqrt(max(1.0 - along * along, 0.0));

    float shift   = 0.12 + 0.08 * (f.random - 0.5);
    vec3  first   = vec3(draw.specular.x) * lobe(normalize(f.tangent + shift * normal), halfway, draw.specular.z);
    vec3  second  = draw.specular.y * albedo * lobe(normalize(f.tangent - 1.5 * shift * normal), halfway, draw.specular.w);
    // Light from behind passes through the fibre but does not glint on its near side.
    float facing  = clamp(0.5 + 0.75 * dot(normal, draw.light_to.xyz), 0.0, 1.0);

    vec3 direct  = draw.light.rgb * f.light * (albedo * diffuse * mix(0.35, 1.0, facing) + facing * (first + second));
    vec3 indirect = draw.ambient.rgb * albedo * (0.25 + 0.75 * sqrt(f.light)); // Hair that shades from the light hides the sky too.
    return direct + indirect;
}
