// draw_params.glsl - the uniform buffer of draw passes, at its slot of shared.h.
#ifndef HAIR_DRAW_PARAMS_GLSL
#define HAIR_DRAW_PARAMS_GLSL

#include "shared.h"

layout(std140, binding = HAIR_BIND_DRAW) uniform draw_buffer { hair_draw_params draw; };

#endif
