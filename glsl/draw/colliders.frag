// colliders.frag - a collider, found by sphere tracing along the ray (Hart 1996) with the distance
// function of the distance field, and shaded. Only the part behind the slice is drawn.
#version 450 core
#include "draw/debug_params.glsl"
#include "field/shape.glsl"
#include "light/lights.glsl"

#define STEPS 96

layout(location = 0) in vec3 box_position;
layout(location = 1) flat in vec3 face;
layout(location = 2) flat in int number;
layout(location = 0) out vec4 color;

hair_field_collider own; // The collider, with its own axes in place of the head's.

vec3 normal_at(vec3 p, float h)
{
    const vec2 k = vec2(1.0, -1.0);
    return normalize(
        k.xyy * collider_distance(own, p + h * k.xyy) + k.yyx * collider_distance(own, p + h * k.yyx) +
        k.yxy * collider_distance(own, p + h * k.yxy) + k.xxx * collider_distance(own, p + h * k.xxx));
}

void main()
{
    hair_debug_collider shown = params.shown[number];
    vec4             turn  = quat_conjugate(shown.collider.rotation), back = quat_conjugate(params.rotation);
    own          = shown.collider;
    own.rotation = vec4(0.0, 0.0, 0.0, 1.0);
    own.position.xyz = vec3(0.0);

    // Ray from the eye, or from in front of the box, through this point on the box's far side, in
    // the collider's axes.
    vec3  eye    = rotate(turn, rotate(back, draw.eye.xyz) - draw.eye.w * shown.collider.position.xyz);
    vec3  extent = shown.upper.xyz - shown.lower.xyz;
    vec3  start  = draw.eye.w > 0.0 ? eye : box_position + 2.0 * length(extent) * eye;
    vec3  way    = normalize(box_position - start);
    if (dot(way, face) <= 0.0) discard;
    float last = distance(box_position, start), t = 0.0;
    vec3  a = (shown.lower.xyz - start) / way, b = (shown.upper.xyz - start) / way, enter = min(a, b);
    t = max(t, max(enter.x, max(enter.y, enter.z)));

    vec3  normal = rotate(turn, params.plane.xyz);
    float height = dot(normal, start) + dot(params.plane.xyz, shown.collider.position.xyz) - params.plane.w;
    float slope  = dot(normal, way);
    if (params.plane.xyz != vec3(0.0)) {
        // The part on the eye's side of the plane is cut away.
        if (height * slope >= 0.0) discard;
        t = max(t, -height / slope);
    }
    float fine = 2e-5 * length(extent);
    bool  cut  = collider_distance(own, start + t * way) < 0.0, found = cut;
    for (int i = 0; i < STEPS && t < last && !found; ++i) {
        float away = collider_distance(own, start + t * way);
        found      = away < fine;
        t += found ? 0.0 : away;
    }
    if (!found || t > last) discard;

    if (cut) t += 0.01 * length(extent); // The cut lies behind the slice that is drawn there.
    vec3 p      = start + t * way;
    vec3 facing = cut ? -way : normal_at(p, 10.0 * fine);
    vec3 hue    = 0.5 + 0.35 * cos(6.2831853 * (0.38196601 * float(own.number) + vec3(0.0, 0.33, 0.67)));
    vec3 at     = shown.collider.position.xyz + rotate(shown.collider.rotation, p);
    vec3 normal_there = rotate(params.rotation, rotate(shown.collider.rotation, facing)),
         sum = sky_at(normal_there);
    for (uint i = 0u; i < draw.lights; ++i) {
        hair_beam beam = beam_at(i, rotate(params.rotation, at));
        sum += 0.3 * beam.irradiance * max(dot(normal_there, beam.to), 0.0);
    }
    color = vec4(min(hue * sum, HAIR_MAX_LIGHT), 1.0);
    if (cut) color.rgb *= 0.4;
    vec4 clip    = to_clip(at);
    gl_FragDepth = clamp(params.depth.x + params.depth.y * clip.z / clip.w, 0.0, 1.0);
}
