// capsules.glsl - colliders of redblack as capsules at one moment, and the push of a vertex out
// of them.

struct capsule { // A collider at one moment.
    vec3  start, axis;
    float radius;
};

// Return the collider at `fraction` of the step, enlarged by `margin`.
capsule collider_at(hair_capsule collider, float fraction, float margin)
{
    vec4 a = mix(collider.start[0], collider.end[0], fraction);
    vec4 b = mix(collider.start[1], collider.end[1], fraction);
    return capsule(a.xyz, b.xyz - a.xyz, a.w + margin);
}

// Return the vector from the nearest point on the collider's axis to the position.
vec3 from_axis(vec3 position, capsule collider)
{
    vec3  arm   = position - collider.start;
    float along = clamp(dot(arm, collider.axis) / max(dot(collider.axis, collider.axis), 1e-12), 0.0, 1.0);
    return arm - along * collider.axis;
}

// Return the position pushed out of a collider by the shortest path.
vec3 push_out(vec3 position, capsule collider)
{
    vec3  out_to = from_axis(position, collider);
    float l      = length(out_to);
    if (l >= collider.radius) return position;
    return position + (l > 1e-9 ? out_to * (collider.radius / l - 1.0) : vec3(0.0, collider.radius, 0.0));
}
