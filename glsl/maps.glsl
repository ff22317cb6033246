// maps.glsl - places in what lights' depth maps show, which are orthographic or, of lights that have a place, in perspective.
#ifndef HAIR_MAPS_GLSL
#define HAIR_MAPS_GLSL

#include "draw_params.glsl"

// Texture coordinates and depth. What is behind the light, where perspective has nothing, is outside of all maps; what
// is farther than a map shows is as far as it shows.
vec3 place_in_map(uint map, vec3 position)
{
    vec4 at = draw.shadow[map] * vec4(position, 1.0);
    return at.w > 1e-6 ? vec3(at.xy / at.w, min(at.z / at.w, 1.0)) : vec3(-9.0, -9.0, 0.0);
}

float distance_to_light(uint number, vec3 position)
{
    vec4 place = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_TO];
    return length(place.xyz - place.w * position);
}

// How far behind what has this depth a place at depth z and so far from its light is, along the light. m
float metres_behind(uint number, float z, float depth, float from_light)
{
    vec4 map = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MAP];
    // In perspective 1 / distance is linear in depth.
    return (z - depth) * (map.w > 0.0 ? from_light / max(map.w - depth, 1e-6) : map.z);
}

// Depth by m along the light there.
float depth_by_metre(uint number, float z, float from_light)
{
    vec4 map = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MAP];
    return map.w > 0.0 ? max(map.w - z, 1e-6) / max(from_light, 1e-6) : 1.0 / max(map.z, 1e-6);
}

#endif
