// params.h - one draw's parameters, from the application's view and look to the head's own coordinates.
#ifndef HAIR_DRAW_PARAMS_H
#define HAIR_DRAW_PARAMS_H

#include "lib/draw/draw.h"

// `view` NULL: only what places followers.
void hair_draw_write_params(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);

// The world matrix `m` for positions from the head's origin: its last column gains m times that origin.
hair_mat4 hair_mat4_from_head(const float m[16], const struct hair_pose* head);

// The maps of a light of a view: which one, and of OpenGL what it shows of hair and of bodies, 0: nothing.
struct hair_light_maps {
    uint32_t light;
    GLuint shadow, body;
};

// A view's projection with the jitter, for the viewport that is set.
void hair_draw_project(const struct hair_draw* draw, const hair_view* view, float projection[16]);

// window.c: from clip space to the viewport, xy and z in [0, 1]; and of depth that is farther what the host's depth test goes by, 1 or
// -1. 0: it tells no near from far.
void hair_draw_find_unit(struct hair_gl* gl, float to_unit[16]);
float hair_draw_find_sign(struct hair_gl* gl);

// lights.c: of them what is about light; and the lights that have maps, in their order, and how many there are.
void hair_draw_write_lights(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);
uint32_t hair_view_maps(const hair_view* view, struct hair_light_maps out[HAIR_SHADOW_MAPS]);

// detail.c: side of the cells in which light is found for a view, m; and of them what is about the level of detail. Those about
// the view are there.
float hair_draw_cell(const struct hair_draw* draw, const hair_view* view);
void hair_draw_write_detail(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);
// Leave out what the view does not show, though no level of detail does: of paths that ask for each patch in each view.
void hair_draw_cull_patches(const struct hair_draw* draw, const hair_view* view,
                            struct hair_draw_params* out);

// solids.c: of what is drawn for debugging, where a slice lies, `place` of the way through the box.
void hair_draw_write_slice(const struct hair_field_box* box, hair_slice slice, float place,
                           struct hair_shown_params* params);

// cull.c: where a picture of so many pixels ends with what may reach into it, as a multiple of w.
double hair_draw_edge(float pixels, float jitter);
// How thick strands are at most, m, which a map and the groom make some thicker than. And what of `window`, the lower corner and the upper of
// texture coordinates, hair can be in that is held.
double hair_draw_thickest(const struct hair_draw* draw, const hair_lod* lod);
void hair_draw_find_window(const struct hair_draw* draw, const struct hair_pose* head, const hair_lod* lod,
                           const hair_mat4* to_texture, float window[4]);

// strand.c: of the above, what a look makes of a strand's way; and how far it takes it from there at most, in its lengths
// and, beside that, in m.
void hair_draw_write_strand(const hair_look* look, struct hair_strand_look* out);
float hair_look_most_stray(const hair_look* look);
float hair_look_most_aside(const hair_look* look);
float hair_curve_most(const hair_curve* curve);
// tint.c: what colours strands have.
void hair_draw_write_tint(const hair_look* look, struct hair_tint* out);
// Whether it kinks, curls or cuts strands, which takes programs of its own.
int hair_look_is_styled(const hair_look* look);

#endif
