// export_velocity.comp - the fluid's velocity at the centres of cells, as a texture. One thread per
// cell.
#version 450 core
#include "wind/fluid.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_IMAGE_AIR, rgba16f) writeonly uniform image3D air_image;

void main()
{
    uint i = thread();
    if (i >= fluid.cells * fluid.cells * fluid.cells) return;
    ivec3 at = place_of(i, fluid.cells);
    vec3  speed;
    for (int axis = 0; axis < 3; ++axis)
        speed[axis] = 0.5 * (texelFetch(velocity_texture, face_of(axis, at)).x +
                             texelFetch(velocity_texture, face_of(axis, at + axis_of(axis))).x);
    imageStore(air_image, at, vec4(speed, 0.0));
}
