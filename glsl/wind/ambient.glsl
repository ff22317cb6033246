// ambient.glsl - the ambient wind and its gusts at a position in the coordinates of fluid.glsl, at
// the start of the step.
#include "wind/fluid.glsl"
#include "wind/gust.glsl"

vec3 ambient_at(vec3 place)
{
    return fluid.wind.xyz +
           gust_of(fluid.gust_turn, fluid.gust_from, fluid.wind.w, fluid.lower.xyz + fluid.lower.w * place);
}
