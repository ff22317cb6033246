// params.h - parameters of one draw, from the application's view and look to the head's
// coordinates.
#ifndef HAIR_DRAW_PARAMS_H
#define HAIR_DRAW_PARAMS_H

#include "lib/draw/draw.h"

#include <stdbool.h>

// Write all parameters of a draw.
void hair_draw_write_params(const struct hair_renderer* renderer, const struct hair_pose* head,
                            const hair_view* view, struct hair_draw_params* out);

// Functions of camera.c.

// Return the middle of the hair, from the head's origin.
hair_vec3 hair_draw_find_middle(const struct hair_renderer* renderer, const struct hair_pose* head);
// Return the position that the view matrix maps to the origin, -R^-1 t. An orthographic projection,
// whose last row is (0, 0, 0, 1), has parallel rays. Return the direction to the eye for it, with w
// = 0.
hair_vec4 hair_draw_find_eye(const hair_mat4* view, const float projection[16]);
// Compute the projection of a view with its jitter, for the current viewport.
void hair_draw_project(const struct hair_renderer* renderer, const hair_view* view, float projection[16]);
// Write the matrix from clip space to the viewport, with xy and z in [0, 1].
void hair_draw_clip_to_unit_matrix(const struct hair_gl* gl, float to_unit[16]);
// Return 1 if the application's depth test treats larger depth as farther, -1 if smaller. Return 0
// if it does not order depths.
float hair_draw_depth_direction(const struct hair_gl* gl);

// Return the cell size of the self-shadow grid for a view, in metres. Defined in lod.c.
float hair_draw_cell(const struct hair_renderer* renderer, const hair_view* view);
// Return about which fraction of all strands a level of detail draws. NULL draws all.
double hair_draw_estimate_fraction(const struct hair_renderer* renderer, const hair_lod* lod);
// Return the maximum number of strands that a view may draw.
uint32_t hair_draw_max_strands(const struct hair_renderer* renderer, const struct hair_pose* head,
                               const hair_view* view);
// Return the maximum fraction of the strands of a patch that a view may draw. A patch draws whole
// strands.
double hair_draw_max_fraction(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view);
// Write the parameters of the level of detail. The matrices of the view must be written before.
void hair_draw_write_lod(const struct hair_renderer* renderer, const struct hair_pose* head,
                         const hair_view* view, struct hair_draw_params* out);
// Enable view culling of patches even without a level of detail. Paths that query every patch in
// each view use this.
void hair_draw_cull_patches(const struct hair_renderer* renderer, const hair_view* view,
                            struct hair_draw_params* out);

// Write the plane of a slice, `place` of the way through the box. Defined in colliders.c.
void hair_draw_write_slice(const struct hair_field_box* box, hair_slice slice, float place,
                           struct hair_debug_params* params);

// Return the edge of a picture of `pixels` as a multiple of w, with a margin for strands that reach
// into it. Defined in cull.c.
double hair_draw_edge(float pixels, float jitter);
// Return the maximum radius of drawn strands in metres.
double hair_draw_max_radius(const struct hair_renderer* renderer, const hair_lod* lod);
// Return the maximum radius in metres before the groom and groups widen some strands.
double hair_draw_max_look_radius(const struct hair_renderer* renderer, const hair_lod* lod);
// Return the minimum w of clip space at any hair while its roots are attached.
double hair_draw_min_w(const struct hair_renderer* renderer, const struct hair_pose* head,
                       const hair_view* view);
// Shrink `window` to the part that hair can be in while its roots are attached. `window` holds the
// lower and the upper corner in texture coordinates.
void hair_draw_find_window(const struct hair_renderer* renderer, const struct hair_pose* head,
                           const hair_lod* lod, const hair_mat4* to_texture, float window[4]);

#endif
