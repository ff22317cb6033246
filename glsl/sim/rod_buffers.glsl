// rod_buffers.glsl - the buffers of the solvers of rods, beside the state.
//
// The buffer of rods holds the members of struct hair_rod of lib/rod/rod.h, one after the other:
// strain and segment of each vertex, the ratios and the damping of each guide, factor_euler of each
// vertex, factor of each vertex, and the pins. The mixed scheme has no factors. Work groups have no
// `factor`, in place of which they have the reduction. Only pinned hair has pins.
layout(std430, binding = HAIR_BIND_ROD) readonly buffer rod_buffer { vec4 rod[]; };

vec4 rod_strain(uint at) { return rod[2u * at]; }
vec4 rod_segment(uint at) { return rod[2u * at + 1u]; }
vec3 root_ratio_of(uint guide) { return rod[2u * params.vertices + guide].xyz; }
float damping_of(uint guide) { return rod[2u * params.vertices + guide].w; }
vec4 rod_factor_euler(uint at) { return rod[2u * params.vertices + params.guides + at]; }
vec4 rod_factor(uint at) { return rod[3u * params.vertices + params.guides + at]; }

// Return the number of the first pin beyond a vertex, counted from 1. Return 0 if there is none.
float pin_beyond(uint at)
{
    uint first = uint(rod.length()) - (params.vertices + 3u) / 4u;
    return rod[first + at / 4u][at % 4u];
}

layout(std430, binding = HAIR_BIND_HISTORY) buffer history_buffer { hair_history history[]; };
layout(std430, binding = HAIR_BIND_MATERIAL) buffer material_buffer { vec4 material[]; };
#ifdef HAIR_MIXED
layout(std430, binding = HAIR_BIND_BEND) coherent buffer bend_buffer { vec4 bend[]; };
#else
layout(std430, binding = HAIR_BIND_REDUCTION) readonly buffer reduction_buffer { vec4 reduction[]; };
#endif
