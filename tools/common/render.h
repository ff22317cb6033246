// render.h - the picture around the hair: background, head, shadow map, many samples, and the way to 8 bits.
#ifndef HAIR_TOOLS_COMMON_RENDER_H
#define HAIR_TOOLS_COMMON_RENDER_H

#include "tools/common/camera.h"
#include "tools/common/image.h"
#include "tools/common/rig.h"

struct hair_render_desc {
    uint32_t width, height;
    uint32_t samples; // asked for; the driver may have fewer
    uint32_t supersample; // pixels drawn for one of the picture, in each direction
    bool linear; // hair_image.linear is wanted
};

struct hair_render;

// Return what the tool should exit with, having complained. Needs OpenGL 4.5 current, as does what follows.
int hair_render_create(const char* tool, const struct hair_render_desc* desc, struct hair_render** out);
void hair_render_destroy(struct hair_render* render); // Takes NULL.

// What is drawn beside the hair; `whole`: all of it moves with the head, else it bends at the neck.
void hair_render_set_mesh(struct hair_render* render, const struct head_mesh* mesh, bool whole);

// Draw the scene with its head at `transform`, and read the picture, which lives as long as the render.
int hair_render_frame(struct hair_render* render, const struct hair_scene* scene, const float transform[16],
                      float reach, hair_instance* hair, const struct hair_image** out);

#endif
