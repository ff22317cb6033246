// shaders.h - GLSL of what a capture draws beside the hair.
#ifndef HAIR_TOOLS_COMMON_SHADERS_H
#define HAIR_TOOLS_COMMON_SHADERS_H

// Locations of uniforms, in C and in GLSL.
#define HAIR_AT_HEAD 0
#define HAIR_AT_VIEW 1
#define HAIR_AT_PROJECTION 2
#define HAIR_AT_BEND 3
#define HAIR_AT_EYE 4
#define HAIR_AT_LIGHTS 5 // how many
#define HAIR_AT_AMBIENT 7
#define HAIR_AT_TILE 10
#define HAIR_AT_CENTRE 11
#define HAIR_AT_EDGE 12
#define HAIR_AT_ASPECT 13
#define HAIR_AT_SUPERSAMPLE 14
#define HAIR_AT_EXPOSURE 15
#define HAIR_AT_HEIGHT 16
#define HAIR_AT_TAPS 17 // of a shadow map: no constant, since unrolled they cost llvmpipe twice as much
// Of 16 each: struct hair_lit of scene_lights.h
#define HAIR_AT_LIGHT_TO 32
#define HAIR_AT_LIGHT 48
#define HAIR_AT_AXIS 64
#define HAIR_AT_MORE 80
#define HAIR_AT_MAP 96 // of which the first three of struct hair_shadow_map are; -1: none
// Of 4 maps each.
#define HAIR_AT_SHADOW 112
#define HAIR_AT_TEXEL 116

extern const char hair_whole_vert[]; // all of the picture, no vertices needed
extern const char hair_background_frag[]; // a calm gradient
extern const char hair_mesh_vert[]; // what moves with the head
extern const char hair_skin_frag[]; // lit, past itself and through hair
extern const char hair_nothing_frag[]; // depth alone
extern const char hair_tone_frag[]; // from light to 8 bits

// The name of a program; 0: it does not compile, and `tool` has complained.
unsigned hair_shaders_link(const char* tool, const char* vert, const char* frag);

#endif
