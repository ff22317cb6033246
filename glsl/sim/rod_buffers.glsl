// rod_buffers.glsl - the buffers of the solvers of rods, beside the state.
layout(std430, binding = HAIR_BIND_ROD) readonly buffer rod_buffer { hair_rod rod[]; };
layout(std430, binding = HAIR_BIND_HISTORY) buffer history_buffer { hair_history history[]; };
layout(std430, binding = HAIR_BIND_MATERIAL) buffer material_buffer { vec4 material[]; };
#ifdef HAIR_MIXED
layout(std430, binding = HAIR_BIND_BEND) coherent buffer bend_buffer { vec4 bend[]; };
#else
layout(std430, binding = HAIR_BIND_REDUCTION) readonly buffer reduction_buffer { vec4 reduction[]; };
#endif
