// draw.h - guides to pixels: what patches are drawn in which batches, with which parameters.
#ifndef HAIR_DRAW_DRAW_H
#define HAIR_DRAW_DRAW_H

#include "lib/draw/fibre.h"
#include "lib/draw/expanded.h"
#include "lib/draw/hidden.h"
#include "lib/draw/hits.h"
#include "lib/draw/listed.h"
#include "lib/draw/motion.h"
#include "lib/draw/raster.h"
#include "lib/draw/self_shadow.h"
#include "lib/draw/sorted.h"
#include "lib/draw/staged.h"

// The table of fibre.h, made when it is first needed, of the fibres that were asked for last.
struct hair_fibres {
    GLuint texture;
    struct hair_fibre of;
};

// tint.c: make a look as wet as it is asked to be.
void hair_look_soak(hair_look* look);

// How far hair gets whose roots are held, in the head's frame: from the box of roots, and how long it is. m
struct hair_extent {
    hair_vec3 lower, upper;
    float reach, length;
};

// What only some views need: it is made when one first does, and freed once for long none has.
enum {
    HAIR_DRAW_LISTED,
    HAIR_DRAW_EXPANDED,
    HAIR_DRAW_SHADED,
    HAIR_DRAW_MOTION,
    HAIR_DRAW_SORTED,
    HAIR_DRAW_RASTER,
    HAIR_DRAW_STAGED,
    HAIR_DRAW_FIBRES,
    HAIR_DRAW_UVS,
    HAIR_DRAW_SELF_SHADOW,
    HAIR_DRAW_HIDDEN,
    HAIR_DRAW_PARTS
};

struct hair_draw {
    struct hair_gl* gl;
    uint32_t frame; // as tidy.c was told,
    uint32_t used[HAIR_DRAW_PARTS]; // and in which each was last needed
    hair_look look; // soaked
    GLuint follower, patch, params; // buffers
    GLuint follower_texture, patch_texture; // the first two, for stages without storage buffers
    uint32_t followers, patches, smooth_vertices, guides;
    uint32_t most_isolines; // of a patch
    uint32_t map_sets;
    uint32_t driver; // row of paths.inl
    hair_vec4 skull; // of the groom
    int bounded; // roots are held: no strand leaves its patch's reach
    int held; // and neither ties, a skinned scalp nor a solver that stretches takes it anywhere else
    // Of the view: how many pixels a metre is at most to its level of detail, 0: that does not matter; and the share of what
    // leads followers round solids that it shows.
    float pixels, led;
    uint32_t seated; // for which run of smooth.comp followers are
    struct hair_extent extent;
    struct hair_hits hits;
    struct hair_listed listed;
    struct hair_expanded expanded;
    struct hair_fibres fibres;
    struct hair_motion motion;
    struct hair_sorted sorted;
    struct hair_raster raster;
    struct hair_staged staged;
    struct hair_self_shadow self_shadow;
    struct hair_hidden hidden;
    struct hair_seats* seats; // where roots are on the scalp; NULL: there is none
    GLuint uv, uv_texture; // 0 until they are needed
    GLuint paint, paint_texture; // colours of the groom; 0: it has none
    hair_vec4 reach; // where hair can be, in the head's frame: a ball, w: its radius, m
};

hair_result hair_draw_create(struct hair_draw* draw, struct hair_gl* gl, const struct hair_groom* groom,
                             const struct hair_sim* sim);
void hair_draw_destroy(struct hair_draw* draw);

// seats.c: make ready for a skinned scalp; and put followers where it has them, once they are smooth.
hair_result hair_draw_make_seats(struct hair_draw* draw, struct hair_sim* sim);
void hair_draw_seat(struct hair_draw* draw, const struct hair_smooth* smooth, struct hair_sim* sim);

// hits.c: find the followers that are inside solids, and lead them out, before either of the below. `field`: NULL: no
// solid is near. margin: what guides keep from solids, m.
hair_result hair_draw_meet_solids(struct hair_draw* draw, const struct hair_smooth* smooth,
                                  const struct hair_solid_field* field, float margin);
hair_result hair_draw_need_hit_programs(struct hair_draw* draw);
int hair_draw_has_met_solids(const struct hair_draw* draw,
                             const struct hair_smooth* smooth); // since they moved
void hair_draw_free_hits(struct hair_draw* draw);
// prepass.c: with everything bound that makes followers, leave the first vertex inside in hits.image.
hair_result hair_draw_make_prepass(struct hair_draw* draw);
void hair_draw_run_prepass(struct hair_draw* draw);
void hair_draw_patches(struct hair_draw* draw); // all of them, with the program that is current
// The program of `pass` that the look asks for; and of a pass that draws or expands, that heeds what was found where there was
// a solid.
hair_gl_pass hair_draw_styled(const struct hair_draw* draw, hair_gl_pass pass);
hair_gl_pass hair_draw_choose(const struct hair_draw* draw, hair_gl_pass pass);
hair_result hair_draw_need(struct hair_draw* draw, hair_gl_pass* pass); // and compile it
// Buffers, textures and parameters of passes that make followers.
void hair_draw_bind(struct hair_draw* draw, const struct hair_smooth* smooth);

// tidy.c: a frame begins, or goes on; free what none of the last ones needed.
void hair_draw_tidy(struct hair_draw* draw, uint32_t frame);

// places.c: where roots are by the scalp's uvs, of a groom that has them.
int hair_draw_has_uvs(const struct hair_draw* draw);
hair_result hair_draw_need_uvs(struct hair_draw* draw);
void hair_draw_free_uvs(struct hair_draw* draw);

// fibres.c: the table that colour needs, with the look as it is.
hair_result hair_draw_need_fibres(struct hair_draw* draw);
void hair_draw_free_fibres(struct hair_draw* draw);

// self_shadow.c: find what light comes to vertices, if the look wants that for `view`; and how many numbers of each vertex
// there are then, else 0. The texture of those, and the host's shadow maps, where shaders look for them.
hair_result hair_draw_find_light(struct hair_draw* draw, const struct hair_smooth* smooth,
                                 const struct hair_pose* head, const hair_view* view);
uint32_t hair_draw_lit(const struct hair_draw* draw, const hair_view* view);
void hair_draw_bind_shadows(struct hair_draw* draw, const hair_view* view);
void hair_draw_free_self_shadow(struct hair_draw* draw);

// listed.c: what draws without a tessellator, and what OpenGL draws their segments by. With everything bound that makes
// followers, list those that are drawn; draw them with the program that is current, by their ends or `paired` by both sides
// of those.
hair_result hair_draw_make_listed(struct hair_draw* draw, int hides);
hair_result hair_draw_make_indices(struct hair_draw* draw, int paired);
void hair_draw_free_listed(struct hair_draw* draw);
// Unless they are listed, as `params` and the smoothed guides have them; without those that are hidden, where that was asked.
void hair_draw_list(struct hair_draw* draw, const struct hair_smooth* smooth,
                    const struct hair_draw_params* params, int hides);
void hair_draw_listed(struct hair_draw* draw, int paired);

// path.c: look the driver up; the path that `view` is drawn by, found once, since GL may be asked for its viewport: all else
// reads it from view->path.
void hair_draw_find_fastest(struct hair_draw* draw);
hair_path hair_draw_path(const struct hair_draw* draw, const hair_view* view);
// Whether the path takes vertices of all followers, that are written once; or has its own. Whether a view wants shares of pixels,
int hair_draw_expands(const hair_view* view);
int hair_draw_stages(const hair_view* view);
int hair_draw_stages_sides(const hair_view* view); // in clip space, to be drawn as they are
int hair_draw_is_shared(const hair_view* view);
int hair_draw_covers(const hair_view* view); // or these alone, of a light's opacity
// Ribbons of vertices that are there take no geometry shader, but each twice.
int hair_draw_is_paired(const hair_view* view);
// lights.c: whether it has maps of bodies that block lights.
int hair_draw_is_blocked(const hair_view* view);

// detail.c: `view` is what is drawn or lit next; NULL: all followers are asked for as they are. What leads them round solids is
// shown where it moves them by two pixels, and not at all where by one: then they need not meet any.
void hair_draw_look(struct hair_draw* draw, const struct hair_pose* head, const hair_view* view);

// cull.c: how far hair gets; and whether so far none of it is in what `view` shows, which has been checked.
void hair_draw_find_extent(struct hair_draw* draw, const struct hair_groom* groom);
int hair_draw_is_out_of_view(const struct hair_draw* draw, const struct hair_pose* head,
                             const hair_view* view);

// All programs that drawing so runs, also once followers have met solids where there `may_meet` any.
hair_result hair_draw_need_programs(struct hair_draw* draw, const hair_view* view,
                                    struct hair_gl_shader* shader, int may_meet);

// Draw as `view` asks, with the head's origin at `head`. `view` has been checked. shader: of the host; NULL: ours.
hair_result hair_draw_run(struct hair_draw* draw, const struct hair_smooth* smooth,
                          const struct hair_pose* head, const hair_view* view, struct hair_gl_shader* shader);

// Draw solids, and where `view` asks for it a slice of the field, which then is up to date.
hair_result hair_draw_solids(struct hair_draw* draw, const struct hair_solid_field* field,
                             const hair_solid* solids, uint32_t count, const struct hair_pose* head,
                             const hair_view* view);

// air.c: air as the last step had it, around what the field's box holds. fluid: NULL where none is.
hair_result hair_draw_air(struct hair_draw* draw, const struct hair_air* air, const hair_wind* wind,
                          const struct hair_fluid* fluid, const struct hair_field_box* box,
                          const struct hair_pose* head, const hair_view* view);

// expanded.c: vertices of all followers, look.segments + 1 each, written unless they are there; what draws them reads them.
// drawn: parameters of a view, then only of those that it draws, each time. Whether those of all are there; and how many
// work groups of a pass over such a share of them are for each patch.
size_t hair_draw_count_vertices(const struct hair_draw* draw); // of all followers
hair_result hair_draw_need_expanded(struct hair_draw* draw, const struct hair_smooth* smooth,
                                    const struct hair_draw_params* drawn);
int hair_draw_is_expanded(const struct hair_draw* draw, const struct hair_smooth* smooth);
uint32_t hair_draw_chunks(const struct hair_draw* draw, double share);
void hair_draw_free_expanded(struct hair_draw* draw);
void hair_draw_bind_expanded(struct hair_draw* draw);

// shaded.c: whether a view's vertices are shaded before they are drawn; room for that; and do it, with everything bound that draws.
int hair_draw_is_shaded(const hair_view* view, const struct hair_gl_shader* shader);
hair_result hair_draw_need_shaded(struct hair_draw* draw);
void hair_draw_free_shaded(struct hair_draw* draw);
void hair_draw_shade(struct hair_draw* draw, hair_gl_pass pass, GLuint program, uint32_t chunks);

// motion.c: with vertices that are up to date, begin a frame, or go on with it; before vertices are written anew, keep those
// that the frame before has shown; what was seen goes along with a head that is teleported.
hair_result hair_draw_need_motion(struct hair_draw* draw);
void hair_draw_free_motion(struct hair_draw* draw);
void hair_draw_begin_motion(struct hair_draw* draw, const struct hair_pose* head, uint32_t frame);
void hair_draw_keep_shown(struct hair_draw* draw);
void hair_draw_take_along(struct hair_draw* draw, const struct hair_pose* from, const struct hair_pose* to);
void hair_draw_bind_motion(struct hair_draw* draw);

// sorted.c: segments of the strands that are listed from far to near; drawn with the program that is current, blended.
hair_result hair_draw_need_sorted(struct hair_draw* draw);
void hair_draw_free_sorted(struct hair_draw* draw);
void hair_draw_sort(struct hair_draw* draw);
void hair_draw_sorted(struct hair_draw* draw);

// staged.c: room for vertices of listed strands as a view wants them; write them, and have them read in place of those that are
// expanded.
hair_result hair_draw_need_staged(struct hair_draw* draw, const hair_view* view);
void hair_draw_free_staged(struct hair_draw* draw);
void hair_draw_stage(struct hair_draw* draw, hair_gl_pass pass, GLuint program);

// raster.c: where in the window hair is to be looked for, and with what samples; 0: nowhere. `with`: HAIR_GL_WITH(DEPTH),
// else colour too, and HAIR_GL_WITH(WIDENED) of what is staged. Buffers for that; with everything bound that draws expanded strands, find what their samples see; and
// draw that with the program that is current.
int hair_draw_find_raster(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                          struct hair_raster_params* out);
hair_result hair_draw_need_raster(struct hair_draw* draw, hair_gl_pass with,
                                  const struct hair_raster_params* params);
void hair_draw_rasterise(struct hair_draw* draw, hair_gl_pass with, struct hair_raster_params* params);
void hair_draw_compose(struct hair_draw* draw, const struct hair_raster_params* params);
void hair_draw_free_raster(struct hair_draw* draw);

// hidden.c: whether `view` has what may hide hair; and where, if hair can be there at all. Programs and buffers for that; and with
// everything bound that makes followers, find what patches are hidden.
int hair_draw_hides(const hair_view* view);
int hair_draw_find_hiding(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                          struct hair_hide_params* out);
hair_result hair_draw_need_hidden(struct hair_draw* draw, const struct hair_hide_params* params);
void hair_draw_hide(struct hair_draw* draw, const hair_view* view, struct hair_hide_params* params);
void hair_draw_free_hidden(struct hair_draw* draw);

// blend.c: from one to the other, what is drawn is blended by its alpha and writes no depth.
struct hair_blend {
    GLint equation[2], factor[4];
    GLboolean blends, writes_depth;
};
void hair_draw_begin_blend(struct hair_gl* gl, struct hair_blend* was);
void hair_draw_end_blend(struct hair_gl* gl, const struct hair_blend* was);

// Vertices of all followers read back: xyz from the head's origin, radius. The caller frees *out, and has checked that there are no more than
// UINT32_MAX.
hair_result hair_draw_read_expanded(struct hair_draw* draw, const struct hair_smooth* smooth,
                                    hair_vec4** out);

#endif
