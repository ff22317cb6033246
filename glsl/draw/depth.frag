// depth.frag - depth only, for shadow maps and prepasses. With HAIR_SHARES it writes how much of a
// texel a strand covers, for opacity maps of a light.
#version 450 core
#ifdef HAIR_SHARES
#include "draw_params.glsl"
#include "coverage.glsl"

layout(location = 0) out vec4 opacity;

void main() { opacity = vec4(coverage_of(strand_share) * draw.viewport.w); }
#else
void main() {}
#endif
