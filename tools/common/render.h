// render.h - The picture around the hair, with background, head, shadow maps, multisampling and
// tone mapping to 8 bits.
#ifndef HAIR_TOOLS_COMMON_RENDER_H
#define HAIR_TOOLS_COMMON_RENDER_H

#include "tools/common/camera.h"
#include "tools/common/image.h"
#include "tools/common/head_rig.h"

struct hair_render_desc {
    uint32_t width, height;
    uint32_t samples; // requested samples per pixel, the driver may have fewer
    uint32_t supersample; // pixels drawn for one of the picture, in each direction
    bool linear; // requests hair_image.linear
    // Leaves the picture in hair_render_texture(), in one tile.
    bool on_gpu;
};

struct hair_render;

// Create a renderer. Return an exit status for the tool, after printing any error. All functions
// here need a current OpenGL 4.5 context.
int hair_render_create(const char* tool, const struct hair_render_desc* desc, struct hair_render** out);
void hair_render_destroy(struct hair_render* render); // NULL is allowed.

// Free a renderer without OpenGL calls, before its context ends or after its context is lost. The
// OpenGL objects end with the context. NULL is allowed.
void hair_render_abandon(struct hair_render* render);

// Set the mesh that is drawn beside the hair. With `whole`, the whole mesh moves with the head.
// Otherwise it bends at the neck.
void hair_render_set_mesh(struct hair_render* render, const struct head_mesh* mesh, bool whole);

// Move the vertices of the mesh, which has as many as before.
void hair_render_move_mesh(struct hair_render* render, const struct head_mesh* mesh);

// Move the chest of the built-in head by breath in all following pictures. See
// hair_head_rig_breath().
void hair_render_set_breath(struct hair_render* render, float breath);

// Draw further hair in all following pictures, with the passes of the hair. The array must live as
// long.
void hair_render_set_more_hair(struct hair_render* render, hair_instance* const* hair, uint32_t count);

// Draw the scene with its head at `transform`, and read the picture. The picture lives as long as
// the renderer. With hair_render_desc.on_gpu, the picture has a size but no pixels.
int hair_render_frame(struct hair_render* render, const struct hair_scene* scene, const float transform[16],
                      float reach, hair_instance* hair, const struct hair_image** out);

// Shift the following pictures to the left and up, in pixels.
void hair_render_set_shift(struct hair_render* render, const float shift[2]);

// Draw the depth of the mesh into the bound framebuffer, as a camera of `matrices` sees it.
void hair_render_depth(const struct hair_render* render, const struct hair_scene* scene,
                       const float transform[16], const struct hair_matrices* matrices);

// Return the sRGB-encoded picture as an OpenGL texture, whose first row is the top of the picture.
unsigned hair_render_texture(const struct hair_render* render);

// Return the linear colours before exposure as an OpenGL texture, in the same order.
unsigned hair_render_linear_texture(const struct hair_render* render);

#endif
