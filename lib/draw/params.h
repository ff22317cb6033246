// params.h - parameters of one draw, from the application's view and look to the head's
// coordinates.
#ifndef HAIR_DRAW_PARAMS_H
#define HAIR_DRAW_PARAMS_H

#include "lib/draw/draw.h"

#include <stdbool.h>

// Write all parameters of a draw. NULL `view` writes only those that place followers.
void hair_draw_write_params(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);

// Shadow maps of one light of a view. `light` is the index of the light. `shadow` is the hair
// shadow map, and `body` the opaque shadow map. 0 means no map.
struct hair_light_maps {
    uint32_t light;
    GLuint shadow, body;
};

// Functions of camera.c.

// Return the world matrix `m` for positions from the head's origin. Its last column gains m times
// that origin.
hair_mat4 hair_mat4_from_head(const float m[16], const struct hair_pose* head);
// Return the position that the view matrix maps to the origin, -R^-1 t. An orthographic projection,
// whose last row is (0, 0, 0, 1), has parallel rays. Return the direction to the eye for it, with w
// = 0.
hair_vec4 hair_draw_find_eye(const hair_mat4* view, const float projection[16]);
// Compute the projection of a view with its jitter, for the current viewport.
void hair_draw_project(const struct hair_draw* draw, const hair_view* view, float projection[16]);
// Write the matrix from clip space to the viewport, with xy and z in [0, 1].
void hair_draw_clip_to_unit_matrix(struct hair_gl* gl, float to_unit[16]);
// Return 1 if the application's depth test treats larger depth as farther, -1 if smaller. Return 0
// if it does not order depths.
float hair_draw_depth_direction(struct hair_gl* gl);

// Write the parameters of lights. Defined in lights.c.
void hair_draw_write_lights(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);
// Write the lights of `view` that have shadow maps, in order. Return their number. Defined in
// bindings.c.
uint32_t hair_view_maps(const hair_view* view, struct hair_light_maps out[HAIR_SHADOW_MAPS]);

// Return the cell size of the self-shadow grid for a view, in metres. Defined in lod.c.
float hair_draw_cell(const struct hair_draw* draw, const hair_view* view);
// Write the parameters of the level of detail. The matrices of the view must be written before.
void hair_draw_write_lod(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                         struct hair_draw_params* out);
// Enable view culling of patches even without a level of detail. Paths that query every patch in
// each view use this.
void hair_draw_cull_patches(const struct hair_draw* draw, const hair_view* view,
                            struct hair_draw_params* out);

// Write the plane of a slice, `place` of the way through the box. Defined in colliders.c.
void hair_draw_write_slice(const struct hair_field_box* box, hair_slice slice, float place,
                           struct hair_debug_params* params);

// Return the edge of a picture of `pixels` as a multiple of w, with a margin for strands that reach
// into it. Defined in cull.c.
double hair_draw_edge(float pixels, float jitter);
// Return the maximum width of strands in metres, before maps and the groom widen some of them.
double hair_draw_thickest(const struct hair_draw* draw, const hair_lod* lod);
// Shrink `window` to the part that hair can be in while its roots are attached. `window` holds the
// lower and the upper corner in texture coordinates.
void hair_draw_find_window(const struct hair_draw* draw, const struct hair_pose* head, const hair_lod* lod,
                           const hair_mat4* to_texture, float window[4]);

// Write the look's curves along a strand. Defined in look_curves.c.
void hair_draw_write_strand(const hair_look* look, struct hair_strand_look* out);
// Return the maximum distance of a strand from its guided path, as a fraction of its length.
float hair_look_max_stray(const hair_look* look);
// Return the maximum distance that curls and frizz add to it, in metres.
float hair_look_max_offset(const hair_look* look);
// Return the maximum of a curve.
float hair_curve_max(const hair_curve* curve);
// Write the colours of strands. Defined in strand_color.c.
void hair_draw_write_tint(const hair_look* look, struct hair_tint* out);
// Return whether the look frizzes, curls or cuts strands, which needs program variants. Defined
// in look_curves.c.
bool hair_look_is_styled(const hair_look* look);

#endif
