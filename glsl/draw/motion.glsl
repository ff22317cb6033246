// motion.glsl - motion vectors, in viewports to the right and up.

// Return the motion vector of a point with x, y and w of clip space without jitter. A point that
// was not in front of the eye has no previous position.
vec4 motion_between(vec3 before, vec3 now)
{
    return vec4(before.z > 1e-6 ? 0.5 * (now.xy / now.z - before.xy / before.z) : vec2(0.0), 0.0, 1.0);
}
