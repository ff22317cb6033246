// depth.frag - depth only, for shadow maps and prepasses. With HAIR_ALPHA_COVERAGE it writes how
// much of a texel a strand covers, for opacity maps of a light.
#version 450 core
#ifdef HAIR_ALPHA_COVERAGE
#include "draw_params.glsl"
#include "draw/coverage.glsl"

layout(location = 7) noperspective in vec4 strand_fraction;
layout(location = 0) out vec4 opacity;

void main() { opacity = vec4(coverage_of(strand_fraction) * draw.viewport.w); }
#else
void main() {}
#endif
