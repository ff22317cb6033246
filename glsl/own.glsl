// own.glsl - what a host's shader stands in place of: see hair_shader_desc in hair.h. As it is here, hair looks as without
// one.
vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f), 1.0); }
