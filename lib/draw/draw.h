// draw.h - passes from strands to pixels, with their buffers and parameters.
#ifndef HAIR_DRAW_DRAW_H
#define HAIR_DRAW_DRAW_H

#include "lib/draw/occlusion.h"
#include "lib/draw/raster.h"
#include "lib/draw/sorted_segments.h"
#include "lib/draw/strand_list.h"
#include "lib/draw/view_cache.h"
#include "lib/light/lighting.h"

#include <stdbool.h>

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

struct hair_renderer {
    struct hair_gl* gl;
    struct hair_geometry* geometry;
    struct hair_lighting* lighting;
    uint32_t frame; // Number of the current frame, set by hair_draw_free_unused().
    uint32_t used[HAIR_DRAW_PARTS]; // Frame in which each part was last used.
    uint32_t driver; // Row of paths.inl for this driver.
    // Sphere under the hair, from the groom. xyz is the centre, w the radius in metres.
    hair_vec4 head_sphere;
    int is_cullable; // Nonzero if roots are attached, so that no strand leaves its patch's reach.
    // Nonzero if, besides, neither pins, a skinned scalp nor a stretching solver moves strands out
    // of `extent`.
    int has_attached_roots;
    // Maximum pixels per metre of the hair in the view, for level of detail. 0 disables per-patch
    // level of detail.
    float pixels_per_metre;
    struct hair_extent extent;
    struct hair_strand_list strand_list;
    struct hair_sorted_segments sorted_segments;
    struct hair_raster raster;
    struct hair_view_cache view_cache;
    struct hair_occlusion occlusion;
    // Bounding sphere of the hair in the head's frame. xyz is the centre, w the radius in metres.
    hair_vec4 reach;
};

// Create a renderer of strands and lighting, which must outlive it.
hair_result hair_renderer_create(struct hair_renderer* renderer, struct hair_gl* gl,
                                 const struct hair_groom* groom, struct hair_geometry* geometry,
                                 struct hair_lighting* lighting);
void hair_renderer_destroy(struct hair_renderer* renderer);

// Begin or continue frame number `frame`. Free the parts that recent frames did not use. Defined in
// resource_lru.c.
void hair_draw_free_unused(struct hair_renderer* renderer, uint32_t frame);

// Record that the current frame uses a part. Defined in resource_lru.c.
void hair_draw_use(struct hair_renderer* renderer, int part);

// Read back the vertices of all followers, like hair_geometry_read_vertex_cache(). Keep the cache
// as long as one that is drawn. Defined in resource_lru.c.
hair_result hair_draw_read_vertices(struct hair_renderer* renderer, hair_vec4** out);

// Create the buffers of the strand list and compile its programs. Nonzero `hides` includes
// occlusion culling. Defined in strand_list.c.
hair_result hair_draw_ensure_strand_list(struct hair_renderer* renderer, int occlusion);
// Create the index buffer of an instance of strands. Nonzero `paired` selects two vertices per
// strand point.
hair_result hair_draw_ensure_indices(struct hair_renderer* renderer, int paired);
void hair_draw_free_strand_list(struct hair_renderer* renderer);
// List the strands that are drawn, unless the list is up to date with `params` and the smoothed
// guides. Nonzero `hides` leaves out occluded patches and always rebuilds the list. The inputs of
// followers must be bound.
void hair_draw_update_strand_list(struct hair_renderer* renderer, const struct hair_draw_params* params,
                                  int occlusion);
// Draw the listed strands with the current program. Nonzero `paired` draws triangles between two
// vertices per strand point. Otherwise draw lines.
void hair_draw_issue_strand_list(struct hair_renderer* renderer, int paired);

// Functions of plan.c, for what a view needs.

// Find the row of paths.inl for the driver.
void hair_draw_find_fastest(struct hair_renderer* renderer);
// Return the render path of `view`. Call this once per view, because it may query the viewport. All
// other code reads the path from view->path.
hair_render_path hair_draw_path(const struct hair_renderer* renderer, const hair_view* view);
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
// Return whether vertices of `view` are shaded in a pass before drawing.
bool hair_draw_is_shaded(const hair_view* view, const struct hair_gl_shader* shader);
// Return whether `view` has an occluder depth texture.
bool hair_draw_uses_occlusion(const hair_view* view);

// Functions of variant.c, which chooses the variants of programs.

// Return whether the application's texture colours the strands of `view`.
bool hair_draw_is_textured(const struct hair_renderer* renderer, const hair_view* view);
// Return whether the groom's colours colour the strands of `view`.
bool hair_draw_is_painted(const struct hair_renderer* renderer, const hair_view* view);
// Return whether the draw needs root uvs and the groom has them.
bool hair_draw_wants_uvs(const struct hair_renderer* renderer, const hair_view* view,
                         const struct hair_gl_shader* shader);
// Return the pass that draws. Set *shade to the pass that shades or writes vertices before it, or
// to 0 if there is none.
hair_gl_pass hair_draw_find_passes(const struct hair_renderer* renderer, const hair_view* view,
                                   const struct hair_gl_shader* shader, hair_gl_pass* shade);
// Compile the program of a pass, with the application's shading unless `shader` is NULL.
hair_result hair_draw_ensure_program(struct hair_renderer* renderer, hair_gl_pass pass,
                                     struct hair_gl_shader* shader, GLuint* out);

// Select the level of detail for `view`, which is drawn or lit next. NULL selects all followers in
// full detail. Followers show their whole collision displacement where it covers two pixels. They
// show none where it covers one pixel, and then need no collision. Defined in lod.c.
void hair_draw_select_lod(struct hair_renderer* renderer, const struct hair_pose* head,
                          const hair_view* view);
// Compute the maximum extent of the hair. Defined in cull.c.
void hair_draw_find_extent(struct hair_renderer* renderer, const struct hair_groom* groom);
// Return whether hair with attached roots cannot be inside `view`, which must be validated.
bool hair_draw_is_out_of_view(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view);

// Compile all programs that drawing `view` needs. Nonzero `may_meet` includes those for followers
// that have met colliders.
hair_result hair_draw_ensure_programs(struct hair_renderer* renderer, const hair_view* view,
                                      struct hair_gl_shader* shader, int may_meet);

// Draw `view`, which must be validated, with the head's origin at `head`. `shader` is the
// application's. NULL selects the built-in shading.
hair_result hair_draw_run(struct hair_renderer* renderer, const struct hair_pose* head, const hair_view* view,
                          struct hair_gl_shader* shader);

// Draw the colliders, and a slice of the field if `view` requests it. A slice needs an up-to-date
// field.
hair_result hair_draw_colliders(struct hair_renderer* renderer, const struct hair_collider_field* field,
                                const hair_collider* colliders, uint32_t count, const struct hair_pose* head,
                                const hair_view* view);

// Draw the wind as of the last step, in and around the field's box. NULL `fluid` means that there
// is no fluid. Defined in air.c.
hair_result hair_draw_air(struct hair_renderer* renderer, const struct hair_wind_state* air,
                          const hair_wind* wind, const struct hair_fluid* fluid,
                          const struct hair_field_box* box, const struct hair_pose* head,
                          const hair_view* view);

// Shade the cached vertices with `program`. The inputs of drawing must be bound. Defined in
// vertex_colors.c.
void hair_draw_shade(struct hair_renderer* renderer, hair_gl_pass pass, GLuint program, uint32_t chunks);

// Create the buffers of sorted segments and compile their programs. Defined in sorted_segments.c.
hair_result hair_draw_ensure_sorted_segments(struct hair_renderer* renderer);
void hair_draw_free_sorted_segments(struct hair_renderer* renderer);
// Sort the segments of the listed strands from far to near.
void hair_draw_sort(struct hair_renderer* renderer);
// Draw the sorted segments with the current program. The caller enables blending.
void hair_draw_issue_sorted_segments(struct hair_renderer* renderer);

// Create the buffers of per-view vertices. Defined in view_cache.c.
hair_result hair_draw_ensure_view_cache(struct hair_renderer* renderer, const hair_view* view);
void hair_draw_free_view_cache(struct hair_renderer* renderer);
// Write the per-view vertices of the listed strands and bind them in place of the vertex cache.
void hair_draw_expand_view(struct hair_renderer* renderer, hair_gl_pass pass, GLuint program);

// Find the pixels of the window that hair may cover, and their sample positions. Return false if
// there are none. Defined in raster.c.
bool hair_draw_find_raster(const struct hair_renderer* renderer, const struct hair_pose* head,
                           const hair_view* view, struct hair_raster_params* out);
// Create the buffers of compute rasterisation. HAIR_GL_WITH(DEPTH) in `with` selects depth without
// colour. HAIR_GL_WITH(WIDENED) selects per-view vertices.
hair_result hair_draw_ensure_raster(struct hair_renderer* renderer, hair_gl_pass with,
                                    const struct hair_raster_params* params);
// Find the nearest segment at each sample. The inputs of drawing must be bound.
void hair_draw_rasterise(struct hair_renderer* renderer, hair_gl_pass with,
                         struct hair_raster_params* params);
// Draw the rasterised samples into the framebuffer with the current program.
void hair_draw_resolve_tiles(struct hair_renderer* renderer, const struct hair_raster_params* params);
void hair_draw_free_raster(struct hair_renderer* renderer);

// Compute the parameters of occlusion culling. Return false if no patch can be tested. Defined in
// occlusion.c.
bool hair_draw_find_occlusion(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view, struct hair_occlusion_params* out);
// Create the buffers and compile the programs of occlusion culling.
hair_result hair_draw_ensure_occlusion(struct hair_renderer* renderer,
                                       const struct hair_occlusion_params* params);
// Find the occluded patches. The inputs of followers must be bound.
void hair_draw_cull_occluded(struct hair_renderer* renderer, const hair_view* view,
                             struct hair_occlusion_params* params);
void hair_draw_free_occlusion(struct hair_renderer* renderer);

// Blending state of the application. Functions of blend.c.
struct hair_blend {
    GLint equation[2], factor[4];
    GLboolean blends, writes_depth;
};
// Blend by alpha and write no depth, until hair_draw_end_blend() restores the state saved in *was.
void hair_draw_begin_blend(struct hair_gl* gl, struct hair_blend* was);
void hair_draw_end_blend(struct hair_gl* gl, const struct hair_blend* was);

#endif
