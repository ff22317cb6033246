// shaders.h - GLSL of everything that a capture draws except the hair.
#ifndef HAIR_TOOLS_COMMON_SHADERS_H
#define HAIR_TOOLS_COMMON_SHADERS_H

// Locations of uniforms, in C and in GLSL.
#define HAIR_AT_HEAD 0
#define HAIR_AT_VIEW 1
#define HAIR_AT_PROJECTION 2
#define HAIR_AT_HEIGHTS 3
#define HAIR_AT_EYE 4
#define HAIR_AT_LIGHTS 5 // number of lights
#define HAIR_AT_BREATH 6
#define HAIR_AT_AMBIENT 7
#define HAIR_AT_TILE 10
#define HAIR_AT_CENTRE 11
#define HAIR_AT_EDGE 12
#define HAIR_AT_ASPECT 13
#define HAIR_AT_SUPERSAMPLE 14
#define HAIR_AT_EXPOSURE 15
#define HAIR_AT_HEIGHT 16
// Taps of a shadow map. A constant would be unrolled, which is slower on llvmpipe.
#define HAIR_AT_TAPS 17
#define HAIR_AT_HAIR 18
// Arrays of 16 lights, see struct hair_lit of scene_lights.h.
#define HAIR_AT_LIGHT_TO 32
#define HAIR_AT_LIGHT 48
#define HAIR_AT_AXIS 64
#define HAIR_AT_MORE 80
#define HAIR_AT_MAP 96 // index of each light's shadow maps, -1 if none
// Arrays of 4 shadow maps.
#define HAIR_AT_SHADOW 112
#define HAIR_AT_TEXEL 116

extern const char hair_whole_vert[]; // whole picture, without vertices
extern const char hair_background_frag[]; // gradient
extern const char hair_mesh_vert[]; // mesh that moves with the head
extern const char hair_scalp_motion_frag[]; // skin with shadows of itself and of hair
extern const char hair_nothing_frag[]; // depth only
extern const char hair_tone_frag[]; // tone mapping to 8 bits

// Link a program and return its OpenGL name. Return 0 after printing an error.
unsigned hair_shaders_link(const char* tool, const char* vert, const char* frag);

#endif
