// targets.glsl - targets of guides and their weights.
#include "rotation.glsl"

layout(std430, binding = HAIR_BIND_TARGET_POSITION) readonly buffer target_position_buffer
{
    float target_position[];
};
layout(std430, binding = HAIR_BIND_TARGET) buffer target_buffer { vec4 target[]; };
layout(std140, binding = HAIR_BIND_TARGET_PARAMS) uniform target_params_buffer { hair_target_params blend; };

// Distance from the head's origin beyond which a target is ignored, m.
#define FARTHEST_TARGET 1e4

// Return the target of vertex i at the end of the step, in the head's frame.
vec3 target_in_head(uint i)
{
    vec3 at = vec3(target_position[3u * i], target_position[3u * i + 1u], target_position[3u * i + 2u]);
    return rotate(blend.rotation, at + blend.offset.xyz);
}

// Return the point at which a guide with the vertex `tip` as its tip is cut, on the segment from
// `before` to `end`.
vec3 cut_point(uint tip, vec3 before, vec3 end)
{
    return before + rest[tip - 1u].position.w * direction_or(end - before, vec3(0.0, -1.0, 0.0));
}

// Return whether a guide with the vertex `tip` as its tip has been cut.
bool is_cut(uint tip) { return rest[tip].position.w > 0.0; }

// Return whether a target is finite and near. The comparison is by bits, because compilers may
// remove comparisons with NaN.
bool is_near(vec3 v)
{
    return all(lessThan(floatBitsToUint(v) & 0x7fffffffu, uvec3(floatBitsToUint(FARTHEST_TARGET))));
}
