// patch.vert - the empty one-point patch. It passes on only the number of the patch and of its
// part.
#version 450 core

layout(location = 0) flat out uvec2 vertex_patch; // Number of the patch, number of the part.

void main() { vertex_patch = uvec2(gl_VertexID, gl_InstanceID); }
