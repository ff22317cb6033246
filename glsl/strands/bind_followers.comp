// bind_followers.comp - new offsets of followers on a skinned scalp. The scalp stretches between
// their guides, so their roots are placed by their root bindings and the offsets follow from the
// roots. One thread per follower.
#version 450 core
#include "sim/scalp_buffers.glsl"
#include "strands/packed_frame.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_POSITION) uniform samplerBuffer position_texture;
layout(binding = HAIR_UNIT_FRAME) uniform usamplerBuffer frame_texture;
layout(std430, binding = HAIR_BIND_FOLLOWER) buffer follower_buffer { hair_follower follower[]; };
layout(std140, binding = HAIR_BIND_STEP) uniform step_buffer { hair_step_params params; };

vec3 root_of(uint guide) { return texelFetch(position_texture, int(guide * on.smooth_vertices)).xyz; }

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= on.followers) return;
    hair_root_binding root_binding = root_bindings[on.guides + i];
    uint  g     = follower[i].guide0;
    vec3  away  = vec3(root_binding.away_x, root_binding.away_y, root_binding.away_z);
    vec3 root =
        rotate(params.rotation_now,
               bound_point(root_binding) + rotate(root_transforms[g].turn[HAIR_ROOT_TRANSFORM_END], away));
    vec3  first = root_of(g);
    float w1 = follower[i].weight1, w2 = follower[i].weight2;
    vec3 blended =
        (1.0 - w1 - w2) * first + w1 * root_of(follower[i].guide1) + w2 * root_of(follower[i].guide2);
    uvec2 frame   = texelFetch(frame_texture, int(g * on.smooth_vertices)).xy;
    vec4  back    = quat_conjugate(unpack_frame(frame));
    vec3  single = rotate(back, root - first), own = rotate(back, root - blended);
    // Values that are not finite come from the application. Guides did not follow them either.
    if (!is_sound(vec4(single, 0.0)) || !is_sound(vec4(own, 0.0))) return;
    follower[i].offset[0].xyz = single;
    if (follower[i].multi < 0.0) return; // It moves with displacements.
    follower[i].offset[1].w   = own.x;
    follower[i].offset[2].w   = own.y;
    follower[i].offset[3].w   = own.z;
}
