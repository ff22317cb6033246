// capsules.glsl - solids of redblack, as capsules at one moment: what a vertex is pushed out of.

struct capsule { // a solid at one moment
    vec3  start, axis;
    float radius;
};

capsule solid_at(hair_capsule solid, float share, float margin)
{
    vec4 a = mix(solid.start[0], solid.end[0], share);
    vec4 b = mix(solid.start[1], solid.end[1], share);
    return capsule(a.xyz, b.xyz - a.xyz, a.w + margin);
}

vec3 from_axis(vec3 position, capsule solid)
{
    vec3  arm   = position - solid.start;
    float along = clamp(dot(arm, solid.axis) / max(dot(solid.axis, solid.axis), 1e-12), 0.0, 1.0);
    return arm - along * solid.axis;
}

// Out of a solid by the shortest way.
vec3 push_out(vec3 position, capsule solid)
{
    vec3  out_to = from_axis(position, solid);
    float l      = length(out_to);
    if (l >= solid.radius) return position;
    return position + (l > 1e-9 ? out_to * (solid.radius / l - 1.0) : vec3(0.0, solid.radius, 0.0));
}
