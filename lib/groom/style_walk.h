// style_walk.h - the way of a guide of a built-in haircut around the bust.
//
// A guide turns towards a pull, which is the comb near the root and gravity farther along. It is
// pushed out of the bust to a clearance that grows along the strand. Hair from higher up thus lies
// over hair from below.
#ifndef HAIR_GROOM_STYLE_WALK_H
#define HAIR_GROOM_STYLE_WALK_H

#include "lib/groom/style_path.h"

// Path of the hair of one root.
struct hair_style_walk {
    hair_vec3 comb; // tangent to the skull at the root
    float rise; // fraction of the skull's normal in the root's direction
    float clearance; // distance from the bust, far from the root, m
    float lift; // distance over which the clearance is reached, m
    float gravity; // turn rate towards down, far from the root, 1/m
    float hold; // distance over which the comb gives way to gravity, m
    float press; // fraction of the height above the clearance that a step removes
    float inward; // turn rate towards the neck near the tip, 1/m
    float inward_below; // height below which hair turns inwards, m
    float split; // turn rate to the front or the back of the shoulder, 1/m
    float ridge; // z at which hair parts to the front and the back of a shoulder, m
    float floor; // height at which the hair is cut, m
    float face; // distance kept from the face, m
    float fringe; // height at which hair over the forehead is cut, m, or 0
    float max; // maximum length, m
};

// Trace a guide from its root until it is cut or has its maximum length.
void hair_style_trace(const struct hair_style_walk* walk, hair_vec3 root, struct hair_style_path* path);

// Trace a guide of a length, which is cut nowhere.
void hair_style_trace_to(struct hair_style_walk* walk, hair_vec3 root, float length,
                         struct hair_style_path* path);

// Trace hair that is cut at a height, so that every root has its own length of at least `min`.
// `scale` then multiplies that length.
void hair_style_trace_cut(struct hair_style_walk* walk, hair_vec3 root, float scale, float min,
                          struct hair_style_path* path);

#endif
