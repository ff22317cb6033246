// hit.frag - the number of a vertex that is inside a collider.
#version 450 core

layout(location = 0) flat in float found;
layout(location = 0) out float first;

void main() { first = found; }
