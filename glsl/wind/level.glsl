// level.glsl - the multigrid level of a pass. Shaders that need no level do not include this file,
// because each uniform block takes one of the few slots of a stage.
#ifndef HAIR_WIND_LEVEL_GLSL
#define HAIR_WIND_LEVEL_GLSL

#include "wind/fluid.glsl"

layout(std140, binding = HAIR_BIND_LEVEL) uniform level_buffer { hair_fluid_level level; };

#endif
