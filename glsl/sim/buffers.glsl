// buffers.glsl - storage and uniform buffers of compute passes, at the slots of shared.h.
#include "shared.h"
#include "workgroup.glsl"

layout(std430, binding = HAIR_BIND_GUIDE) readonly buffer guide_buffer { hair_guide guide[]; };
layout(std430, binding = HAIR_BIND_REST) readonly buffer rest_buffer { hair_rest rest[]; };
layout(std430, binding = HAIR_BIND_STATE) buffer state_buffer { hair_state state[]; };
layout(std430, binding = HAIR_BIND_SOLVER_STATS) buffer solver_stats_buffer { uint solver_stats[]; };
layout(std430, binding = HAIR_BIND_POSITION) buffer position_buffer { vec4 smooth_position[]; };
layout(std430, binding = HAIR_BIND_FRAME) buffer frame_buffer { uvec2 smooth_frame[]; };
layout(std140, binding = HAIR_BIND_STEP) uniform step_buffer { hair_step_params params; };
