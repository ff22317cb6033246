// frost.glsl - Example for hair-capture --shader. Hair is covered by rime towards its tips, which
// is bright at both edges of a strand.
vec4 hair_shade(hair_fragment f)
{
    float frost = smoothstep(0.35, 1.0, f.t + 0.25 * f.random);
    vec3  ours  = hair_shade_ours(f);
    float light = dot(ours, vec3(0.3, 0.6, 0.1));
    vec3  ice   = 0.35 * hair_sky(f) * (0.6 + 0.8 * abs(f.across)) + 2.5 * light;
    ice        *= vec3(0.78, 0.9, 1.0);
    return vec4(mix(ours, ice, frost), 1.0);
}
