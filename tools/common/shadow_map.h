// shadow_map.h - what is seen from a light: depth of bodies, depth of hair, and how much of the light hair takes.
#ifndef HAIR_TOOLS_COMMON_SHADOW_MAP_H
#define HAIR_TOOLS_COMMON_SHADOW_MAP_H

#include <stdbool.h>

#define HAIR_SHADOW_SIZE 2048 // texels to each side of one that is seen from near by

enum hair_shadow_part { HAIR_SHADOW_BODY, HAIR_SHADOW_HAIR, HAIR_SHADOW_OPACITY, HAIR_SHADOW_PARTS };

// OpenGL names. What hair takes is drawn with the depth of bodies attached: only hair before them falls on them.
struct hair_shadow_map {
    unsigned texture[HAIR_SHADOW_PARTS], framebuffer[HAIR_SHADOW_PARTS];
    int size;
};

// The parts before `parts`, of so many texels to each side, in place of those of another size. False: OpenGL has no memory for
// them. Delete them also then; of zeros there is nothing.
bool hair_shadow_map_make(struct hair_shadow_map* map, enum hair_shadow_part parts, int size);
void hair_shadow_map_delete(struct hair_shadow_map* map);

// Make a part that which is drawn into: cleared, with its viewport and depth tested.
void hair_shadow_map_begin(const struct hair_shadow_map* map, enum hair_shadow_part part);

// A sampler that compares depths.
unsigned hair_shadow_sampler(void);

#endif
