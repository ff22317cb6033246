// shadow_map.h - Shadow maps of a light, with depth of opaque geometry, depth of hair, and opacity
// of hair.
#ifndef HAIR_TOOLS_COMMON_SHADOW_MAP_H
#define HAIR_TOOLS_COMMON_SHADOW_MAP_H

#include <stdbool.h>

#define HAIR_SHADOW_SIZE 2048 // texels per side

enum hair_shadow_part { HAIR_SHADOW_BODY, HAIR_SHADOW_HAIR, HAIR_SHADOW_OPACITY, HAIR_SHADOW_PARTS };

// OpenGL names. The opacity is drawn with the depth of opaque geometry attached, therefore only
// hair in front of that geometry shadows it.
struct hair_shadow_map {
    unsigned texture[HAIR_SHADOW_PARTS], framebuffer[HAIR_SHADOW_PARTS];
    int size;
};

// Create the parts before `parts`, with `size` texels per side. Maps of another size are replaced.
// Return false if OpenGL has no memory. Delete the map in either case. A map of zeros is empty.
bool hair_shadow_map_make(struct hair_shadow_map* map, enum hair_shadow_part parts, int size);
void hair_shadow_map_delete(struct hair_shadow_map* map);

// Bind and clear a part for drawing. Set its viewport and enable the depth test.
void hair_shadow_map_begin(const struct hair_shadow_map* map, enum hair_shadow_part part);

// Create a sampler that compares depths.
unsigned hair_shadow_sampler(void);

#endif
