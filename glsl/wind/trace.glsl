// trace.glsl - where air comes from and goes to in a step: by the middle of its way, in the air as the last step left it.
// Places are in the box as it was then.
#include "wind/sample.glsl"

layout(binding = HAIR_UNIT_AIR) uniform sampler3D air_texture; // m/s, at the middles of cells

// In cells over the step. Faster than that it comes from outside in any case.
vec3 way_at(vec3 place)
{
    vec3 way = fluid.shift.w * textureLod(air_texture, place / float(fluid.cells), 0.0).xyz;
    return clamp(way, vec3(-4.0 * float(fluid.cells)), vec3(4.0 * float(fluid.cells)));
}

vec3 trace(vec3 place, float direction)
{
    vec3 middle = place + 0.5 * direction * way_at(place);
    return place + direction * way_at(middle);
}
