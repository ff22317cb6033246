// patch.vert - the empty one-point patch: only its number, and that of the part of it.
#version 450 core

layout(location = 0) flat out uvec2 vertex_patch; // number, part

void main() { vertex_patch = uvec2(gl_VertexID, gl_InstanceID); }
