// frost.glsl - Example for hair-capture --shader. Hair glows towards its tips and has an edge on
// either side.
vec4 hair_shade(hair_fragment f)
{
    float frost = smoothstep(0.35, 1.0, f.t + 0.25 * f.random);
    vec3  ours  = hair_shade_ours(f);
    vec3  ice   = hair_sky(f) * vec3(0.5, 0.75, 1.0) * (0.6 + 0.8 * abs(f.across));
    return vec4(mix(ours, ice, frost), 1.0);
}
