// shadow_map.glsl - positions in the depth maps of lights. The maps are orthographic, or in
// perspective for lights with a position.
#ifndef HAIR_SHADOW_MAP_GLSL
#define HAIR_SHADOW_MAP_GLSL

#include "draw_params.glsl"

// Return texture coordinates and depth of a position in a map. A position behind a perspective
// light is outside every map. A position beyond the map's far plane gets the far plane's depth.
vec3 find_place_in_map(uint map, vec3 position)
{
    vec4 at = draw.shadow[map] * vec4(position, 1.0);
    return at.w > 1e-6 ? vec3(at.xy / at.w, min(at.z / at.w, 1.0)) : vec3(-9.0, -9.0, 0.0);
}

// Return texture coordinates of a place in a rectangle of draw.map_part. Those of the border of the
// texture, which is far away, stand for places outside the rectangle.
vec2 find_in_part(uint part, vec2 at)
{
    vec4 own = draw.map_part[part];
    bool is_inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
    return is_inside ? own.xy + own.zw * at : vec2(-9.0);
}

// Return the depth of a texel as it grows away from the light, also if the map has reversed depth.
float depth_from_light(uint map, float texel)
{
    return (draw.reversed_maps >> map & 1u) != 0u ? 1.0 - texel : texel;
}

float distance_to_light(uint number, vec3 position)
{
    vec4 place = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_TO];
    return length(place.xyz - place.w * position);
}

// Return the distance, along the light, of a position behind a surface of the given depth, m. z is
// the depth of the position, and from_light its distance to the light.
float metres_behind(uint number, float z, float depth, float from_light)
{
    vec4 map = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MAP];
    // In perspective 1 / distance is linear in depth.
    return (z - depth) * (map.w > 0.0 ? from_light / max(map.w - depth, 1e-6) : map.z);
}

// Return the increase of depth per metre along the light.
float depth_by_metre(uint number, float z, float from_light)
{
    vec4 map = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MAP];
    return map.w > 0.0 ? max(map.w - z, 1e-6) / max(from_light, 1e-6) : 1.0 / max(map.z, 1e-6);
}

#endif
