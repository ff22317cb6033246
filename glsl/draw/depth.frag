// depth.frag - nothing but depth: shadow maps and pre-passes.
#version 450 core

void main() {}
