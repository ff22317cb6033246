// strands.glsl - Example for hair-capture --shader. Each lock has its own colour, darker from root
// to tip.
vec4 hair_shade(hair_fragment f)
{
    vec3 hue = 0.5 + 0.5 * cos(6.2831853 * (0.61803 * float(f.lock) + vec3(0.0, 0.33, 0.67)));
    return vec4(hue * hue * (1.0 - 0.7 * f.t) * sqrt(1.0 - 0.9 * f.across * f.across), 1.0);
}
