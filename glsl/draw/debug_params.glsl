// debug_params.glsl - colliders that are drawn for debugging: their buffer, and the transformation
// from the head's frame to clip space.
#include "draw_params.glsl"
#include "rotation.glsl"

layout(std140, binding = HAIR_BIND_DEBUG) uniform debug_buffer { hair_debug_params params; };

// Return the clip-space position of a point in the head's frame.
vec4 to_clip(vec3 position)
{
    return draw.view_to_clip * (draw.view * vec4(rotate(params.rotation, position), 1.0));
}
