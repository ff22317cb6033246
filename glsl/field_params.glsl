// field_params.glsl - the uniform buffer of passes that write or read the distance field, at its
// slot of shared.h.
#ifndef HAIR_FIELD_PARAMS_GLSL
#define HAIR_FIELD_PARAMS_GLSL

#include "shared.h"

layout(std140, binding = HAIR_BIND_FIELD) uniform field_buffer { hair_field_params field; };

#endif
