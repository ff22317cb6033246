// user_shader.glsl - placeholder for the application's shader. See hair_shader_desc in hair.h. This
// text leaves the look of hair unchanged.
vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f), 1.0); }
