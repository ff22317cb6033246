// lights.glsl - light that arrives at a point, from each light and from the surroundings.
#ifndef HAIR_LIGHTS_GLSL
#define HAIR_LIGHTS_GLSL

#include "draw_params.glsl"

struct hair_beam {
    vec3 to;         // Unit direction to the light.
    vec3 irradiance; // On a plane that faces the light.
};

hair_beam beam_at(uint number, vec3 position)
{
    uint at = number * HAIR_LIGHT_VECTORS;
    vec4 place = draw.light[at + HAIR_LIGHT_TO], color = draw.light[at + HAIR_LIGHT_COLOR];
    vec4 axis = draw.light[at + HAIR_LIGHT_AXIS], more = draw.light[at + HAIR_LIGHT_MORE];
    vec3  way    = place.xyz - place.w * position;
    float square = dot(way, way);
    // In its middle any direction will do.
    vec3  to     = square > 1e-12 ? way * inversesqrt(square) : vec3(0.0, 1.0, 0.0);
    float cone   = clamp((dot(axis.xyz, to) - axis.w) * more.x, 0.0, 1.0);
    float ranges = square * more.y, window = clamp(1.0 - ranges * ranges, 0.0, 1.0);
    return hair_beam(to, color.rgb * (cone * cone * window * window / max(square, color.w)));
}

float sky_on(mat4 sky, vec3 normal, vec3 side)
{
    mat3 bent = mat3(sky);
    float across = dot(normal, bent * normal) * 2.0 + dot(side, bent * side);
    return sky[3][3] + 1.5707963 * dot(sky[3].xyz, normal) + across * 0.3333333;
}

// Return the irradiance on the half of a cylinder that faces a unit normal. It is the mean over the
// normals around the cylinder, weighted by their visible area.
vec3 sky_round(vec3 normal, vec3 side)
{
    vec3 found = vec3(sky_on(draw.sky[0], normal, side), sky_on(draw.sky[1], normal, side),
                      sky_on(draw.sky[2], normal, side));
    return max(found, 0.0);
}

// Return the irradiance on a plane.
vec3 sky_at(vec3 normal)
{
    vec4 n = vec4(normal, 1.0);
    return max(vec3(dot(n, draw.sky[0] * n), dot(n, draw.sky[1] * n), dot(n, draw.sky[2] * n)), 0.0);
}

#endif
