// backtrace.glsl - the position from which fluid comes, or to which it goes, in a step. The path
// uses the velocity at its midpoint, as the last step left it. Positions are in the box of the last
// step.
#include "wind/sample.glsl"

layout(binding = HAIR_UNIT_AIR) uniform sampler3D air_texture; // m/s, at the centres of cells.

// Return the displacement over the step, in cells. It is clamped, because faster fluid comes from
// outside the box in any case.
vec3 way_at(vec3 place)
{
    vec3 way = fluid.shift.w * textureLod(air_texture, place / float(fluid.cells), 0.0).xyz;
    return clamp(way, vec3(-4.0 * float(fluid.cells)), vec3(4.0 * float(fluid.cells)));
}

vec3 backtrace(vec3 place, float direction)
{
    vec3 middle = place + 0.5 * direction * way_at(place);
    return place + direction * way_at(middle);
}
