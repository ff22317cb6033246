// shown.glsl - solids that are drawn for debugging: their buffer, and what lies between the head's frame and the picture.
#include "draw_params.glsl"
#include "rotation.glsl"

layout(std140, binding = HAIR_BIND_SHOWN) uniform shown_buffer { hair_shown_params params; };

// Of a position in the head's frame.
vec4 to_clip(vec3 position)
{
    return draw.view_to_clip * (draw.view * vec4(rotate(params.rotation, position), 1.0));
}
