// draw.h - passes from strands to pixels, with their buffers and parameters.
#ifndef HAIR_DRAW_DRAW_H
#define HAIR_DRAW_DRAW_H

#include "lib/draw/batch.h"
#include "lib/draw/fastest.h"
#include "lib/draw/host_buffers.h"
#include "lib/draw/occlusion.h"
#include "lib/draw/plan.h"
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
    float importance; // Maximum importance of a patch.
};

// Resources that only some views need, in the order in which they are made.
enum hair_draw_resource {
    HAIR_RESOURCE_FIBRES,
    HAIR_RESOURCE_STRAND_LIST,
    HAIR_RESOURCE_OCCLUSION,
    HAIR_RESOURCE_VERTEX_CACHE,
    HAIR_RESOURCE_RASTER,
    HAIR_RESOURCE_VIEW_CACHE,
    HAIR_RESOURCE_SHADED,
    HAIR_RESOURCE_ROOT_UVS,
    HAIR_RESOURCE_SORTED_SEGMENTS,
    HAIR_RESOURCE_HISTORY,
    HAIR_RESOURCE_SELF_SHADOW,
    HAIR_RESOURCE_REFLECTANCE,
    HAIR_RESOURCE_STRAND_INDEX,
    HAIR_RESOURCE_HOST_HISTORY,
    HAIR_RESOURCE_GUIDE_HISTORY,
    HAIR_RESOURCE_GUIDE_TANGENTS,
    HAIR_RESOURCES
};

// Light of vertices that was computed last, which later frames may use.
struct hair_light_age {
    uint32_t interval; // Number of frames for which light is kept. 0 or 1 computes it in each.
    uint32_t pace; // hair_sim.interval, as the view that is drawn has it.
    uint32_t turn; // Number that lets instances compute their light in different frames.
    uint32_t frame; // Frame of the light.
    uint32_t frame_index; // hair_view.frame_index of the view whose light was computed.
    uint32_t lights; // Values of a vertex. 0 without light.
    double fraction; // About which fraction of the strands have light.
};

// Push out of colliders in the shadow maps that were drawn last.
struct hair_map_push_out {
    float weight; // Displayed fraction of the displacement, the largest in `frame`.
    uint32_t frame;
};

struct hair_renderer {
    struct hair_gl* gl;
    struct hair_geometry* geometry;
    struct hair_lighting* lighting;
    uint32_t frame; // Number of the current frame, set by hair_draw_free_unused().
    uint32_t last_used[HAIR_RESOURCES]; // Frame in which each resource was last used.
    const struct hair_fastest* fastest; // Paths that HAIR_RENDER_PATH_AUTO selects, of the context.
    size_t scarce_vertices; // Vertices that the memory did not hold. 0 if it held all.
    uint32_t scarce_frame; // Frame in which it did not.
    // Sphere under the hair, from the groom. xyz is the centre, w the radius in metres.
    hair_vec4 head_sphere;
    int is_cullable; // Nonzero if roots are attached, so that no strand leaves its patch's reach.
    // Nonzero if, besides, neither pins, a skinned scalp nor a stretching solver moves strands out
    // of `extent`.
    int has_attached_roots;
    // Maximum pixels per metre of the hair in the view, for level of detail. 0 disables per-patch
    // level of detail.
    float pixels_per_metre;
    // Ratio of the samples of the framebuffer to those that compute rasterisation finds. 0 or 1
    // finds all.
    uint32_t sample_divisor;
    struct hair_light_age light_age;
    struct hair_map_push_out map_push_out;
    struct hair_extent extent;
    hair_vec3 rest_size; // Size of the box around the hair at rest, in metres.
    struct hair_strand_list strand_list;
    struct hair_sorted_segments sorted_segments;
    struct hair_raster raster;
    struct hair_view_cache view_cache;
    struct hair_batch* batch; // Batch of the context.
    struct hair_occlusion occlusion;
    struct hair_host_buffers host;
    // Bounding sphere of the hair in the head's frame. xyz is the centre, w the radius in metres.
    hair_vec4 reach;
};

// Create a renderer of strands and lighting, which must outlive it like `batch` and `fastest`.
// `bounds` are the lower and the upper corner of the hair in the head's frame.
void hair_renderer_create(struct hair_renderer* renderer, struct hair_gl* gl, const struct hair_groom* groom,
                          const hair_vec3 bounds[2], struct hair_geometry* geometry,
                          struct hair_lighting* lighting, struct hair_batch* batch,
                          const struct hair_fastest* fastest);
void hair_renderer_destroy(struct hair_renderer* renderer);
// Set whether roots are fixed to the groom, and whether all strands are attached to it. Culling
// depends on both.
void hair_renderer_set_attachment(struct hair_renderer* renderer, bool has_fixed_roots,
                                  bool has_attached_strands);

// Functions of resources.c.

// Make the resources that a plan needs, whose passes must be compiled.
hair_result hair_draw_ensure_resources(struct hair_renderer* renderer, struct hair_draw_plan* plan);
// Make the textures of a plan that machine code depends on, before programs are compiled.
hair_result hair_draw_ensure_textures(struct hair_renderer* renderer, struct hair_draw_plan* plan);
// Begin or continue frame number `frame`. Free the resources that recent frames did not use.
void hair_draw_free_unused(struct hair_renderer* renderer, uint32_t frame);
// Free all resources.
void hair_draw_free_resources(struct hair_renderer* renderer);
// Read back the vertices of all followers, like hair_geometry_read_vertex_cache(). Keep the cache
// as long as one that is drawn.
hair_result hair_draw_read_vertices(struct hair_renderer* renderer, hair_vec4** out);

// Compute the light that reaches each vertex, for a plan with self-shadowing. Defined in
// view_light.c.
hair_result hair_draw_ensure_self_shadow(struct hair_renderer* renderer, struct hair_draw_plan* plan);

// Create the buffers of the strand list, and the indices of an instance of strands. Defined in
// strand_list.c.
hair_result hair_draw_ensure_strand_list(struct hair_renderer* renderer, struct hair_draw_plan* plan);
void hair_draw_free_strand_list(struct hair_renderer* renderer);
// List the strands that are drawn, unless the list is up to date with `params` and the smoothed
// guides. With occlusion culling, leave out occluded patches and always rebuild the list. The
// inputs of followers must be bound.
void hair_draw_update_strand_list(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                                  const struct hair_draw_params* params);
// Return the full instances of listed strands in a draw, of which a GPU takes little time.
uint32_t hair_draw_instances_at_once(const struct hair_renderer* renderer);
// Issue the draws of a kind of HAIR_LIST_KINDS with the bound vertex array.
void hair_draw_issue_commands(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                              uint32_t kind, GLenum mode, GLenum type);
// Draw the listed strands with the current program. A paired plan draws triangles between two
// vertices per strand point. Otherwise draw lines.
void hair_draw_issue_strand_list(struct hair_renderer* renderer, const struct hair_draw_plan* plan);

// Functions of plan.c.

// Make the plan of a view. Call this once per view, because it may query the viewport. `shader` is
// the application's. NULL selects the built-in shading.
void hair_draw_make_plan(const struct hair_renderer* renderer, const hair_view* view,
                         struct hair_gl_shader* shader, struct hair_draw_plan* out);
// Note that memory ran out for a plan. Return whether HAIR_RENDER_PATH_AUTO may select a path
// without cached vertices instead.
bool hair_draw_avoid_cache(struct hair_renderer* renderer, const struct hair_draw_plan* plan);
// Return whether the pass draws coverage, either blended colour or the opacity seen from a light.
bool hair_draw_uses_analytic_coverage(const hair_view* view);
// Return whether `view` draws motion vectors, alone or beside colour.
bool hair_draw_has_motion(const hair_view* view);
// Return whether `view` has an occluder depth texture.
bool hair_draw_uses_occlusion(const hair_view* view);

// Functions of variant.c.

// Write the passes of a plan. `state` has the features OCCLUSION if patches are tested for
// occlusion, HITS if followers have met colliders, and COLLIDERS if colliders block light.
void hair_draw_find_passes(const struct hair_renderer* renderer, hair_gl_pass state,
                           struct hair_draw_plan* plan);
// Compile the passes of a plan.
hair_result hair_draw_compile(struct hair_renderer* renderer, struct hair_draw_plan* plan);
// Compile all passes that drawing by the plan may need. If `may_collide`, include those for
// followers that have met colliders.
hair_result hair_draw_precompile(struct hair_renderer* renderer, struct hair_draw_plan* plan,
                                 bool may_collide);

// Select the level of detail for a plan, which is drawn or lit next. NULL selects all followers in
// full detail. Followers show their whole collision displacement where it covers two pixels. They
// show none where it covers one pixel, and then need no collision. Defined in lod.c.
void hair_draw_select_lod(struct hair_renderer* renderer, const struct hair_pose* head,
                          const struct hair_draw_plan* plan);
// Return the pixels per metre at the point of the hair's bounding sphere that is nearest to the
// eye. With an orthographic projection the scale is constant.
float hair_draw_pixels_per_metre(const struct hair_renderer* renderer, const struct hair_pose* head,
                                 const hair_view* view);
// Return the importance with which a default level of detail draws everything at this scale.
float hair_draw_full_importance(const struct hair_renderer* renderer, float pixels_per_metre);
// Compute the maximum extent of the hair. Defined in cull.c.
void hair_draw_find_extent(struct hair_renderer* renderer, const struct hair_groom* groom);
// Return whether hair with attached roots cannot be inside `view`, which must be validated.
bool hair_draw_is_out_of_view(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view);

// Bind the textures that the passes of a plan have in common.
void hair_draw_bind_plan(struct hair_renderer* renderer, const struct hair_draw_plan* plan);
// Let a plan draw the vertices that the view cache has, if hair has not moved against the head
// since, and only the camera differs a little. The head was at `from` then, where
// hair_draw_prepare() needs it, and is at `to`. Return false if hair must be stepped first. Defined
// in kept_vertices.c.
bool hair_draw_keep_vertices(struct hair_renderer* renderer, const struct hair_pose* from,
                             const struct hair_pose* to, struct hair_draw_plan* plan);
// Draw no vertices of earlier frames, because the look of the hair has changed.
void hair_draw_forget_vertices(struct hair_renderer* renderer);
// Run all passes of a plan before the one that draws, with the head's origin at `head`. The view
// must be validated. `head` must be valid until hair_draw_finish().
hair_result hair_draw_prepare(struct hair_renderer* renderer, const struct hair_pose* head,
                              struct hair_draw_plan* plan);
// Run the pass that draws. What hair_draw_prepare() has bound must still be bound. Heads of a batch
// are drawn by hair_batch_draw() instead.
void hair_draw_finish(struct hair_renderer* renderer, const struct hair_draw_plan* plan);

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

// Create the buffers of sorted segments. Defined in sorted_segments.c.
hair_result hair_draw_ensure_sorted_segments(struct hair_renderer* renderer, struct hair_draw_plan* plan);
void hair_draw_free_sorted_segments(struct hair_renderer* renderer);
// Sort the segments of the listed strands from far to near.
void hair_draw_sort(struct hair_renderer* renderer);
// Draw the sorted segments with the current program. The caller enables blending.
void hair_draw_issue_sorted_segments(struct hair_renderer* renderer, const struct hair_draw_plan* plan);

// Create the buffers of per-view vertices. Defined in view_cache.c.
hair_result hair_draw_ensure_view_cache(struct hair_renderer* renderer, struct hair_draw_plan* plan);
// Free the buffers, and the place in the batch.
void hair_draw_free_view_cache(struct hair_renderer* renderer);
// Run the pass plan->shade, which writes the per-view vertices of the listed strands, or shades the
// cached vertices. Bind the result. The inputs of drawing must be bound.
void hair_draw_write_vertices(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                              const struct hair_draw_params* params);

// Find the depth test that opacity by compute rasterisation makes. Return false if the framebuffer
// has several samples, or a depth that is not a texture. Defined in raster.c.
bool hair_draw_find_depth_test(struct hair_gl* gl, struct hair_depth_test* out);
// Find the pixels of the window that hair may cover, and their sample positions. Return false if
// there are none.
bool hair_draw_find_raster(const struct hair_renderer* renderer, const struct hair_pose* head,
                           struct hair_draw_plan* plan);
// Create the buffers of compute rasterisation, with room for the samples of this head alone.
hair_result hair_draw_ensure_raster(struct hair_renderer* renderer, struct hair_draw_plan* plan);
// Return how many numbers of hair_samples a prepared plan needs, or 0. A depth pass has one per
// sample.
size_t hair_draw_count_numbers(const struct hair_draw_plan* plan);
// Find the nearest segment at each sample, if compute shaders do. The samples begin at `first`, and
// must stay until hair_draw_finish(). What hair_draw_prepare() has bound must still be bound.
void hair_draw_rasterise(struct hair_renderer* renderer, const struct hair_draw_plan* plan, size_t first);
// Return the work groups that rasterise the segments of a view. Write the threads of a segment.
uint32_t hair_draw_raster_groups(const struct hair_renderer* renderer, const hair_view* view,
                                 struct hair_raster_params* params);
// Run a pass before the one that draws, with its features of a plan.
void hair_draw_run(struct hair_gl* gl, hair_gl_pass row, const struct hair_draw_plan* plan, uint32_t groups);
// Draw lists of tiles by the commands at the beginning of a buffer, with the current program.
void hair_draw_issue_tiles(struct hair_gl* gl, GLuint commands, uint32_t count);
// Draw the rasterised samples into the framebuffer with the current program.
void hair_draw_resolve_tiles(struct hair_renderer* renderer, const struct hair_draw_plan* plan);
void hair_draw_free_raster(struct hair_renderer* renderer);

// Compute the parameters of occlusion culling. Return false if no patch can be tested. Defined in
// occlusion.c.
bool hair_draw_find_occlusion(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view, struct hair_occlusion_params* out);
// Create the buffers of occlusion culling.
hair_result hair_draw_ensure_occlusion(struct hair_renderer* renderer, struct hair_draw_plan* plan);
// Find the occluded patches. The inputs of followers must be bound.
void hair_draw_cull_occluded(struct hair_renderer* renderer, struct hair_draw_plan* plan);
void hair_draw_free_occlusion(struct hair_renderer* renderer);

// Functions of host_buffers.c.

// Write the buffers of smoothed guides, which must be up to date, or of followers, whose collision
// must be up to date. `out` has the attributes wanted and the number of the frame.
hair_result hair_draw_get_guides(struct hair_renderer* renderer, const struct hair_sim* sim,
                                 const struct hair_pose* head, hair_buffers* out);
hair_result hair_draw_get_followers(struct hair_renderer* renderer, const struct hair_pose* head,
                                    hair_buffers* out);
void hair_draw_free_reflectance(struct hair_renderer* renderer);
void hair_draw_free_strand_index(struct hair_renderer* renderer);
void hair_draw_free_guide_tangents(struct hair_renderer* renderer);

// Blending state of the application. Functions of blend.c.
struct hair_blend {
    struct {
        GLint equation[2], factor[4];
        GLboolean blends;
    } buffer[2];
    GLuint buffers; // Number of draw buffers whose state is changed.
    GLboolean writes_depth;
};
// Blend the first `buffers` draw buffers by alpha and write no depth, until hair_draw_end_blend()
// restores the state saved in *was.
void hair_draw_begin_blend(struct hair_gl* gl, GLuint buffers, struct hair_blend* was);
void hair_draw_end_blend(struct hair_gl* gl, const struct hair_blend* was);

#define HAIR_DRAW_BUFFERS 16 // Draw buffers whose colour masks are saved. Drivers have 8.
#define HAIR_DRAW_FIRST_BUFFER 1u // The draw buffer 0, which all passes but depth write, as a bit.
#define HAIR_DRAW_MOTION_BUFFER 2u // The draw buffer 1, for motion vectors beside colour, as a bit.

// Colour masks of the application. Functions of outputs.c.
struct hair_outputs {
    uint32_t closed; // Draw buffers whose masks are changed, as bits.
    GLboolean mask[HAIR_DRAW_BUFFERS][4];
};
// Return the draw buffers that the compiled pass of a plan writes, as bits. A pixel shader of the
// application may declare more than the first.
uint32_t hair_draw_find_outputs(struct hair_gl* gl, const struct hair_draw_plan* plan);
// Keep all draw buffers unchanged but those of the bits `written`, until hair_draw_end_outputs()
// restores the masks saved in *was.
void hair_draw_begin_outputs(struct hair_gl* gl, uint32_t written, struct hair_outputs* was);
void hair_draw_end_outputs(struct hair_gl* gl, const struct hair_outputs* was);

#endif
