// draw.h - passes from smoothed guides to pixels, with their buffers and parameters.
#ifndef HAIR_DRAW_DRAW_H
#define HAIR_DRAW_DRAW_H

#include "lib/draw/fibre.h"
#include "lib/draw/vertex_cache.h"
#include "lib/draw/occlusion.h"
#include "lib/draw/follower_collision.h"
#include "lib/draw/strand_list.h"
#include "lib/draw/motion.h"
#include "lib/draw/raster.h"
#include "lib/draw/self_shadow.h"
#include "lib/draw/sorted_segments.h"
#include "lib/draw/view_cache.h"

#include <stdbool.h>

// Texture of the table in fibre.h, created on demand for the fibre parameters requested last.
struct hair_fibres {
    GLuint texture;
    struct hair_fibre of;
};

// Apply the wetness of a look to its other settings. Defined in strand_color.c.
void hair_look_apply_wetness(hair_look* look);

// Maximum extent of the hair in the head's frame while roots are attached.
struct hair_extent {
    // Box of the roots.
    hair_vec3 lower, upper;
    // Maximum distance of a strand from its root, and length of the longest strand, in metres.
    float reach, length;
};

// Resources that only some views need. Each is created on demand, and freed once no view has used
// it for long.
enum {
    HAIR_DRAW_STRAND_LIST,
    HAIR_DRAW_VERTEX_CACHE,
    HAIR_DRAW_SHADED,
    HAIR_DRAW_MOTION,
    HAIR_DRAW_SORTED_SEGMENTS,
    HAIR_DRAW_RASTER,
    HAIR_DRAW_VIEW_CACHE,
    HAIR_DRAW_FIBRES,
    HAIR_DRAW_UVS,
    HAIR_DRAW_SELF_SHADOW,
    HAIR_DRAW_OCCLUSION,
    HAIR_DRAW_PARTS
};

struct hair_draw {
    struct hair_gl* gl;
    uint32_t frame; // Number of the current frame, set by hair_draw_free_unused().
    uint32_t used[HAIR_DRAW_PARTS]; // Frame in which each part was last used.
    hair_look look; // Look after hair_look_apply_wetness().
    GLuint follower, patch, params; // Buffers of followers, patches and draw parameters.
    // Buffer textures of the first two, for stages without storage buffers.
    GLuint follower_texture, patch_texture;
    uint32_t followers, patches, smooth_vertices, guides;
    uint32_t max_isolines; // Maximum number of isolines in a patch.
    uint32_t map_sets;
    uint32_t driver; // Row of paths.inl for this driver.
    // Sphere under the hair, from the groom. xyz is the centre, w the radius in metres.
    hair_vec4 head_sphere;
    int is_cullable; // Nonzero if roots are attached, so that no strand leaves its patch's reach.
    // Nonzero if, besides, neither pins, a skinned scalp nor a stretching solver moves strands out
    // of `extent`.
    int has_attached_roots;
    // Maximum pixels per metre of the hair in the view, for level of detail. 0 disables per-patch
    // level of detail. `led` is the displayed fraction of the displacement by follower collision.
    float pixels_per_metre, push_out_weight;
    uint32_t bound_run; // Run of smooth.comp for which roots of followers last moved with the scalp.
    struct hair_extent extent;
    struct hair_follower_collision_state follower_collision;
    struct hair_strand_list strand_list;
    struct hair_vertex_cache vertex_cache;
    struct hair_fibres fibres;
    struct hair_motion motion;
    struct hair_sorted_segments sorted_segments;
    struct hair_raster raster;
    struct hair_view_cache view_cache;
    struct hair_self_shadow_state self_shadow;
    struct hair_occlusion occlusion;
    struct hair_root_bindings* root_bindings; // Root bindings to the scalp. NULL if there is no scalp.
    GLuint uv, uv_texture; // Root uvs. 0 until needed.
    GLuint groom_color, groom_color_texture; // Colours of the groom. 0 if there are none.
    // Bounding sphere of the hair in the head's frame. xyz is the centre, w the radius in metres.
    hair_vec4 reach;
};

hair_result hair_draw_create(struct hair_draw* draw, struct hair_gl* gl, const struct hair_groom* groom,
                             const struct hair_sim* sim);
void hair_draw_destroy(struct hair_draw* draw);

// Prepare followers for a skinned scalp. Defined in scalp_roots.c.
hair_result hair_draw_create_scalp_roots(struct hair_draw* draw, struct hair_sim* sim);
// Move the roots of followers with the skinned scalp, once the guides are smoothed. Defined in
// scalp_roots.c.
void hair_draw_bind_followers(struct hair_draw* draw, const struct hair_smooth* smooth, struct hair_sim* sim);

// Find the followers inside colliders and push them out. Call this before followers are drawn or
// written. NULL `field` means that no collider is near. `margin` is the distance that guides keep
// from colliders, in metres. Defined in follower_collision.c.
hair_result hair_draw_update_follower_collision(struct hair_draw* draw, const struct hair_smooth* smooth,
                                                const struct hair_collider_field* field, float margin);
// Compile the programs of follower collision.
hair_result hair_draw_ensure_hit_programs(struct hair_draw* draw);
// Return whether follower collision is up to date with the guides and colliders.
bool hair_draw_has_follower_collision(const struct hair_draw* draw, const struct hair_smooth* smooth);
void hair_draw_free_follower_collision(struct hair_draw* draw);
// Create the image and the framebuffer of the prepass. Defined in prepass.c.
hair_result hair_draw_make_prepass(struct hair_draw* draw);
// Write the first vertex of each follower inside a collider to hits.image. The inputs of followers
// must be bound.
void hair_draw_run_prepass(struct hair_draw* draw);

// Begin or continue frame number `frame`. Free the parts that recent frames did not use. Defined in
// resource_lru.c.
void hair_draw_free_unused(struct hair_draw* draw, uint32_t frame);

// Return whether the groom has root uvs. Defined in root_uvs.c.
bool hair_draw_has_uvs(const struct hair_draw* draw);
// Create the buffer and the texture of root uvs.
hair_result hair_draw_ensure_uvs(struct hair_draw* draw);
void hair_draw_free_uvs(struct hair_draw* draw);

// Create or update the fibre table for the current look. Defined in fibres.c.
hair_result hair_draw_ensure_fibres(struct hair_draw* draw);
void hair_draw_free_fibres(struct hair_draw* draw);

// Compute the light that reaches each vertex, if the look requests self-shadowing for `view`.
// Defined in self_shadow.c.
hair_result hair_draw_find_light(struct hair_draw* draw, const struct hair_smooth* smooth,
                                 const struct hair_pose* head, const hair_view* view);
void hair_draw_free_self_shadow(struct hair_draw* draw);

// Create the buffers of the strand list and compile its programs. Nonzero `hides` includes
// occlusion culling. Defined in strand_list.c.
hair_result hair_draw_ensure_strand_list(struct hair_draw* draw, int occlusion);
// Create the index buffer of an instance of strands. Nonzero `paired` selects two vertices per
// strand point.
hair_result hair_draw_ensure_indices(struct hair_draw* draw, int paired);
void hair_draw_free_strand_list(struct hair_draw* draw);
// List the strands that are drawn, unless the list is up to date with `params` and the smoothed
// guides. Nonzero `hides` leaves out occluded patches and always rebuilds the list. The inputs of
// followers must be bound.
void hair_draw_update_strand_list(struct hair_draw* draw, const struct hair_smooth* smooth,
                                  const struct hair_draw_params* params, int occlusion);
// Draw the listed strands with the current program. Nonzero `paired` draws triangles between two
// vertices per strand point. Otherwise draw lines.
void hair_draw_issue_strand_list(struct hair_draw* draw, int paired);

// Functions of plan.c, for what a view needs.

// Find the row of paths.inl for the driver.
void hair_draw_find_fastest(struct hair_draw* draw);
// Return the render path of `view`. Call this once per view, because it may query the viewport. All
// other code reads the path from view->path.
hair_render_path hair_draw_path(const struct hair_draw* draw, const hair_view* view);
// Return whether the path reads the vertex cache of all followers.
bool hair_draw_uses_vertex_cache(const hair_view* view);
// Return whether the path reads per-view vertices.
bool hair_draw_uses_view_cache(const hair_view* view);
// Return whether per-view vertices are in clip space, ready to draw.
bool hair_draw_caches_sides(const hair_view* view);
// Return whether strands are blended by their coverage of pixels.
bool hair_draw_uses_alpha(const hair_view* view);
// Return whether the pass draws coverage, either blended colour or the opacity seen from a
// light.
bool hair_draw_uses_analytic_coverage(const hair_view* view);
// Return whether ribbons are drawn without a geometry shader, from two vertices per strand
// point.
bool hair_draw_is_paired(const hair_view* view);
// Return whether a light of the colour pass has an opaque shadow map.
bool hair_draw_is_blocked(const hair_view* view);
// Return whether vertices of `view` are shaded in a pass before drawing.
bool hair_draw_is_shaded(const hair_view* view, const struct hair_gl_shader* shader);
// Return whether `view` has an occluder depth texture.
bool hair_draw_uses_occlusion(const hair_view* view);
// Return the number of light values per vertex, or 0 without self-shadowing.
uint32_t hair_draw_light_value_count(const struct hair_draw* draw, const hair_view* view);
// Return the number of vertices of all followers, look.segments + 1 each.
size_t hair_draw_count_vertices(const struct hair_draw* draw);

// Functions of variant.c, which chooses the variants of programs.

// Return `pass` with the styling features that the look needs.
hair_gl_pass hair_draw_styled(const struct hair_draw* draw, hair_gl_pass pass);
// Return `pass` with the features that the look and, near colliders, follower collision need.
hair_gl_pass hair_draw_choose(const struct hair_draw* draw, hair_gl_pass pass);
// Apply hair_draw_choose() to *pass and compile its program.
hair_result hair_draw_ensure(struct hair_draw* draw, hair_gl_pass* pass);
// Return whether the application's texture colours the strands of `view`.
bool hair_draw_is_textured(const struct hair_draw* draw, const hair_view* view);
// Return whether the groom's colours colour the strands of `view`.
bool hair_draw_is_painted(const struct hair_draw* draw, const hair_view* view);
// Return whether the draw needs root uvs and the groom has them.
bool hair_draw_wants_uvs(const struct hair_draw* draw, const hair_view* view,
                         const struct hair_gl_shader* shader);
// Return the pass that draws. Set *shade to the pass that shades or writes vertices before it, or
// to 0 if there is none.
hair_gl_pass hair_draw_find_passes(const struct hair_draw* draw, const hair_view* view,
                                   const struct hair_gl_shader* shader, hair_gl_pass* shade);
// Compile the program of a pass, with the application's shading unless `shader` is NULL.
hair_result hair_draw_ensure_program(struct hair_draw* draw, hair_gl_pass pass, struct hair_gl_shader* shader,
                                     GLuint* out);

// Functions of bindings.c, for bindings that several passes read.

// Bind the buffers, textures and parameters that the vertices of followers are computed from.
void hair_draw_bind(struct hair_draw* draw, const struct hair_smooth* smooth);
// Bind the vertex cache.
void hair_draw_bind_vertex_cache(struct hair_draw* draw);
// Bind the previous frame's vertices.
void hair_draw_bind_motion(struct hair_draw* draw);
// Bind the application's shadow maps to their texture units.
void hair_draw_bind_shadows(struct hair_draw* draw, const hair_view* view);

// Draw all patches with the current program. Defined in tessellated.c.
void hair_draw_patches(struct hair_draw* draw);

// Select the level of detail for `view`, which is drawn or lit next. NULL selects all followers in
// full detail. Followers show their whole collision displacement where it covers two pixels. They
// show none where it covers one pixel, and then need no collision. Defined in lod.c.
void hair_draw_select_lod(struct hair_draw* draw, const struct hair_pose* head, const hair_view* view);
// Return the number of work groups per patch of a pass over the fraction `share` of all vertices.
uint32_t hair_draw_chunks(const struct hair_draw* draw, double fraction);

// Compute the maximum extent of the hair. Defined in cull.c.
void hair_draw_find_extent(struct hair_draw* draw, const struct hair_groom* groom);
// Return whether hair with attached roots cannot be inside `view`, which must be validated.
bool hair_draw_is_out_of_view(const struct hair_draw* draw, const struct hair_pose* head,
                              const hair_view* view);

// Compile all programs that drawing `view` needs. Nonzero `may_meet` includes those for followers
// that have met colliders.
hair_result hair_draw_ensure_programs(struct hair_draw* draw, const hair_view* view,
                                      struct hair_gl_shader* shader, int may_meet);

// Draw `view`, which must be validated, with the head's origin at `head`. `shader` is the
// application's. NULL selects the built-in shading.
hair_result hair_draw_run(struct hair_draw* draw, const struct hair_smooth* smooth,
                          const struct hair_pose* head, const hair_view* view, struct hair_gl_shader* shader);

// Draw the colliders, and a slice of the field if `view` requests it. A slice needs an up-to-date
// field.
hair_result hair_draw_colliders(struct hair_draw* draw, const struct hair_collider_field* field,
                                const hair_collider* colliders, uint32_t count, const struct hair_pose* head,
                                const hair_view* view);

// Draw the wind as of the last step, in and around the field's box. NULL `fluid` means that there
// is no fluid. Defined in air.c.
hair_result hair_draw_air(struct hair_draw* draw, const struct hair_wind_state* air, const hair_wind* wind,
                          const struct hair_fluid* fluid, const struct hair_field_box* box,
                          const struct hair_pose* head, const hair_view* view);

// Write the vertex cache unless it is up to date. With parameters of a view in `drawn`, write only
// the vertices that the view draws, on every call. Defined in vertex_cache.c.
hair_result hair_draw_ensure_vertex_cache(struct hair_draw* draw, const struct hair_smooth* smooth,
                                          const struct hair_draw_params* drawn);
// Return whether the cache holds up-to-date vertices of all followers.
bool hair_draw_has_vertex_cache(const struct hair_draw* draw, const struct hair_smooth* smooth);
void hair_draw_free_vertex_cache(struct hair_draw* draw);

// Create the buffer of shaded vertices. Defined in vertex_colors.c.
hair_result hair_draw_ensure_shaded(struct hair_draw* draw);
void hair_draw_free_shaded(struct hair_draw* draw);
// Shade the vertices with `program`. The inputs of drawing must be bound.
void hair_draw_shade(struct hair_draw* draw, hair_gl_pass pass, GLuint program, uint32_t chunks);

// Create the buffer of the previous frame's vertices. Defined in motion.c.
hair_result hair_draw_ensure_motion(struct hair_draw* draw);
void hair_draw_free_motion(struct hair_draw* draw);
// Begin frame number `frame`, or continue it. The vertices must be up to date.
void hair_draw_begin_motion(struct hair_draw* draw, const struct hair_pose* head, uint32_t frame);
// Keep the vertices that the previous frame displayed, before they are overwritten.
void hair_draw_save_history(struct hair_draw* draw);
// Move the previous frame's positions with a head that is teleported.
void hair_draw_teleport_history(struct hair_draw* draw, const struct hair_pose* from,
                                const struct hair_pose* to);

// Create the buffers of sorted segments and compile their programs. Defined in sorted_segments.c.
hair_result hair_draw_ensure_sorted_segments(struct hair_draw* draw);
void hair_draw_free_sorted_segments(struct hair_draw* draw);
// Sort the segments of the listed strands from far to near.
void hair_draw_sort(struct hair_draw* draw);
// Draw the sorted segments with the current program. The caller enables blending.
void hair_draw_issue_sorted_segments(struct hair_draw* draw);

// Create the buffers of per-view vertices. Defined in view_cache.c.
hair_result hair_draw_ensure_view_cache(struct hair_draw* draw, const hair_view* view);
void hair_draw_free_view_cache(struct hair_draw* draw);
// Write the per-view vertices of the listed strands and bind them in place of the vertex cache.
void hair_draw_expand_view(struct hair_draw* draw, hair_gl_pass pass, GLuint program);

// Find the pixels of the window that hair may cover, and their sample positions. Return false if
// there are none. Defined in raster.c.
bool hair_draw_find_raster(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                           struct hair_raster_params* out);
// Create the buffers of compute rasterisation. HAIR_GL_WITH(DEPTH) in `with` selects depth without
// colour. HAIR_GL_WITH(WIDENED) selects per-view vertices.
hair_result hair_draw_ensure_raster(struct hair_draw* draw, hair_gl_pass with,
                                    const struct hair_raster_params* params);
// Find the nearest segment at each sample. The inputs of drawing must be bound.
void hair_draw_rasterise(struct hair_draw* draw, hair_gl_pass with, struct hair_raster_params* params);
// Draw the rasterised samples into the framebuffer with the current program.
void hair_draw_resolve_tiles(struct hair_draw* draw, const struct hair_raster_params* params);
void hair_draw_free_raster(struct hair_draw* draw);

// Compute the parameters of occlusion culling. Return false if no patch can be tested. Defined in
// occlusion.c.
bool hair_draw_find_occlusion(const struct hair_draw* draw, const struct hair_pose* head,
                              const hair_view* view, struct hair_occlusion_params* out);
// Create the buffers and compile the programs of occlusion culling.
hair_result hair_draw_ensure_occlusion(struct hair_draw* draw, const struct hair_occlusion_params* params);
// Find the occluded patches. The inputs of followers must be bound.
void hair_draw_cull_occluded(struct hair_draw* draw, const hair_view* view,
                             struct hair_occlusion_params* params);
void hair_draw_free_occlusion(struct hair_draw* draw);

// Blending state of the application. Functions of blend.c.
struct hair_blend {
    GLint equation[2], factor[4];
    GLboolean blends, writes_depth;
};
// Blend by alpha and write no depth, until hair_draw_end_blend() restores the state saved in *was.
void hair_draw_begin_blend(struct hair_gl* gl, struct hair_blend* was);
void hair_draw_end_blend(struct hair_gl* gl, const struct hair_blend* was);

// Read back the vertices of all followers. xyz is the position from the head's origin, w the
// radius. The caller frees *out, and has checked that there are at most UINT32_MAX vertices.
hair_result hair_draw_read_vertex_cache(struct hair_draw* draw, const struct hair_smooth* smooth,
                                        hair_vec4** out);

#endif
