// geometry.h - strands of an instance: smoothed guides and the followers between them. It has the
// buffers, the look, follower collision and the vertex cache of followers.
#ifndef HAIR_STRANDS_GEOMETRY_H
#define HAIR_STRANDS_GEOMETRY_H

#include "lib/strands/follower_collision.h"
#include "lib/strands/history.h"
#include "lib/strands/smooth.h"
#include "lib/strands/vertex_cache.h"

#include <stdbool.h>

// Buffer of followers and of their shapes.
struct hair_follower_buffer {
    GLuint buffer;
    GLuint texture; // Buffer texture of `buffer`, for stages without storage buffers.
    float max_width; // Maximum factor of the look's radius by the groom and by groups.
    bool is_shared; // The buffer is that of all instances of the groom, and nothing writes it.
};

// Factors by which the looks of groups differ from the look.
struct hair_group_look_buffer {
    GLuint factors; // Uniform buffer of hair_group_factors. 0 if no group differs.
    float max_curl_radius, max_frizz; // Maxima of all groups.
};

// Factors by which the looks of single strands differ from those of their groups.
struct hair_strand_factor_buffer {
    GLuint buffer, texture; // 0 if the groom has no such factors.
    uint32_t slots, count; // See hair_strand_look.
    float max[HAIR_FACTORS]; // Maximum of all followers. 1 without factors.
};

struct hair_geometry {
    struct hair_gl* gl;
    const struct hair_groom* groom;
    struct hair_smooth smooth; // Smoothed guides.
    const struct hair_lengths* lengths; // Lengths of followers.
    hair_look look; // Look after hair_look_apply_wetness().
    struct hair_strand_look strand_look; // Curves of `look`, for shaders.
    struct hair_follower_buffer follower;
    struct hair_group_look_buffer groups;
    struct hair_strand_factor_buffer factors;
    GLuint patch, patch_texture; // Buffer of patches, and its buffer texture.
    GLuint params; // Uniform buffer of hair_draw_params, which each user writes before its passes.
    uint32_t followers, patches, smooth_vertices, guides, shape_vertices;
    uint32_t max_isolines; // Maximum number of isolines in a patch.
    uint32_t map_sets;
    float push_out_weight; // Displayed fraction of the displacement by follower collision.
    // Run of smooth.comp for which roots of followers last moved with the scalp.
    uint32_t bound_run;
    struct hair_follower_collision_state follower_collision;
    struct hair_vertex_cache vertex_cache;
    struct hair_vertex_history history; // Vertices of followers, for motion vectors.
    // Vertices of followers and smoothed guides, for the application. Its frames are not those of
    // views.
    struct hair_vertex_history host_history, guide_history;
    GLuint uv, uv_texture; // Root uvs. 0 until needed.
};

// Create the smoothed guides and the buffers of followers. `look` is one after
// hair_look_apply_wetness(). If `uses_prepass`, a prepass finds followers inside colliders.
hair_result hair_geometry_create(struct hair_geometry* geometry, struct hair_gl* gl,
                                 const struct hair_groom* groom, const struct hair_sim* sim,
                                 const hair_look* look, bool uses_prepass);
void hair_geometry_destroy(struct hair_geometry* geometry);
// Set the look, after hair_look_apply_wetness(). A different look outdates follower collision and
// the vertex cache.
void hair_geometry_set_look(struct hair_geometry* geometry, const hair_look* look);
// Make the buffer of factors of all groups.
hair_result hair_geometry_make_group_looks(const struct hair_geometry* geometry,
                                           const struct hair_group_factors factors[HAIR_STRAND_GROUPS],
                                           struct hair_group_look_buffer* out);
// Exchange the buffer of factors.
void hair_geometry_swap_group_looks(struct hair_geometry* geometry, struct hair_group_look_buffer* groups);
// Record that the guides have moved. They are smoothed again before the next draw.
void hair_geometry_invalidate_guides(struct hair_geometry* geometry);
// Smooth the guides, and move the roots of followers with a skinned scalp, unless both are up to
// date.
void hair_geometry_ensure_guides(struct hair_geometry* geometry, struct hair_sim* sim);
// Return the number of vertices of all smoothed guides.
uint32_t hair_geometry_count_smoothed(const struct hair_geometry* geometry);
// Return the buffer of the positions of smoothed guides. xyz is from the head's origin, m.
GLuint hair_geometry_smoothed_positions(const struct hair_geometry* geometry);
// Return whether the look shows any follower.
bool hair_geometry_shows_followers(const struct hair_geometry* geometry);

// Functions of follower_buffer.c.

// Make a buffer of followers and their shapes. If `is_shared`, they are those of the groom, and all
// instances of the groom have one buffer.
hair_result hair_geometry_make_followers(const struct hair_geometry* geometry,
                                         const struct hair_follower* followers, bool is_shared,
                                         struct hair_follower_buffer* out);
void hair_geometry_free_followers(struct hair_gl* gl, struct hair_follower_buffer* followers);
// Exchange the buffer of followers.
void hair_geometry_swap_followers(struct hair_geometry* geometry, struct hair_follower_buffer* followers);

// Functions of followers.c, which every file of this folder may use.

// Return the number of vertices of all followers, look.segments + 1 each.
size_t hair_geometry_count_vertices(const struct hair_geometry* geometry);
// Return the number of vertices of a vertex cache with room for a fraction of the strands, as in
// hair_draw_params. Defined in vertex_cache.c.
size_t hair_geometry_count_cached(const struct hair_geometry* geometry, uint32_t fraction);
// Return the cache_fraction of hair_draw_params for views that draw at most `fraction` of the
// strands of each patch. Room that there is stays, until many views in sequence need much less.
// Defined in vertex_cache.c.
uint32_t hair_geometry_choose_cached_fraction(struct hair_geometry* geometry, double fraction);
// Return the number of work groups per patch of a pass over the fraction `fraction` of all
// vertices.
uint32_t hair_geometry_chunk_count(const struct hair_geometry* geometry, double fraction);
// Write the parameters that place all followers in full detail. All other parameters are 0.
void hair_geometry_write_params(const struct hair_geometry* geometry, struct hair_draw_params* out);
// Return the maximum radius of strands in metres, before a level of detail widens them.
double hair_geometry_max_radius(const struct hair_geometry* geometry);
// Return the maximum distance that curls and frizz of all followers move a strand, in metres.
float hair_geometry_max_offset(const struct hair_geometry* geometry);
// Bind the factors of groups, if there are any. Occlusion culling has its parameters in their slot.
void hair_geometry_bind_group_looks(const struct hair_geometry* geometry);
// Bind the buffers, textures and parameters that the vertices of followers are computed from.
void hair_geometry_bind(struct hair_geometry* geometry);
// Return whether followers have been cut, which needs program variants.
bool hair_geometry_has_lengths(const struct hair_geometry* geometry);
// Return `pass` with the features that the look, the looks of groups and of strands, and the
// lengths of followers need.
hair_gl_pass hair_geometry_add_style(const struct hair_geometry* geometry, hair_gl_pass pass);
// Return whether displayed followers have met colliders, which needs program variants.
bool hair_geometry_has_hits(const struct hair_geometry* geometry);
// Return `pass` with the features that the look and, near colliders, follower collision need.
hair_gl_pass hair_geometry_choose_variant(const struct hair_geometry* geometry, hair_gl_pass pass);

// Functions of look_curves.c.

// Write the look's curves along a strand.
void hair_look_write_curves(const hair_look* look, struct hair_strand_look* out);
// Return the maximum distance of a strand from its guided path, as a fraction of its length.
float hair_look_max_stray(const hair_look* look);
// Return the maximum distance that curls and frizz add to it, in metres.
float hair_look_max_offset(const hair_look* look);
// Return the maximum of a curve.
float hair_curve_max(const hair_curve* curve);
// Return whether the look frizzes, curls or cuts strands, which needs program variants.
bool hair_look_is_styled(const hair_look* look);

// Functions of scalp_roots.c.

// Prepare followers for a skinned scalp.
hair_result hair_geometry_create_scalp_roots(struct hair_geometry* geometry, struct hair_sim* sim);
// Move the roots of followers with the skinned scalp, once the guides are smoothed.
void hair_geometry_bind_followers(struct hair_geometry* geometry, struct hair_sim* sim);

// Functions of root_uvs.c.

// Return whether the groom has root uvs.
bool hair_geometry_has_uvs(const struct hair_geometry* geometry);
// Create the buffer and the texture of root uvs.
hair_result hair_geometry_ensure_uvs(struct hair_geometry* geometry);
void hair_geometry_free_uvs(struct hair_geometry* geometry);

// Draw all patches with the current program. Defined in patches.c.
void hair_geometry_draw_patches(struct hair_geometry* geometry);

// Functions of prepass.c.

// Create the image and the framebuffer of the prepass.
hair_result hair_geometry_ensure_prepass(struct hair_geometry* geometry);
// Write the first vertex of each follower inside a collider to follower_collision.image. The inputs
// of followers must be bound.
void hair_geometry_run_prepass(struct hair_geometry* geometry);

// Functions of follower_collision.c.

// Find the followers inside colliders and push them out. Call this before followers are drawn or
// written. NULL `field` means that no collider is near. `margin` is the distance that guides keep
// from colliders, in metres.
hair_result hair_geometry_update_follower_collision(struct hair_geometry* geometry,
                                                    const struct hair_collider_field* field, float margin);
// Compile the programs of follower collision.
hair_result hair_geometry_ensure_hit_programs(struct hair_geometry* geometry);
// Return whether follower collision is up to date with the guides and colliders.
bool hair_geometry_has_follower_collision(const struct hair_geometry* geometry);
// Set the field of the colliders that block light until the next update. NULL means that none is
// near.
void hair_geometry_set_blockers(struct hair_geometry* geometry, const struct hair_collider_field* field);
// Mark follower collision and the vertex cache as outdated. Call this when followers or colliders
// change, but guides do not move.
void hair_geometry_invalidate(struct hair_geometry* geometry);
void hair_geometry_free_follower_collision(struct hair_geometry* geometry);

// Functions of history.c.

// Create the buffer of the previous frame's vertices of followers. `history` is one of the
// geometry.
hair_result hair_geometry_ensure_history(struct hair_geometry* geometry, struct hair_vertex_history* history);
void hair_geometry_free_history(struct hair_geometry* geometry, struct hair_vertex_history* history);
// Begin frame number `frame` of followers, or continue it. The vertices must be up to date.
void hair_geometry_begin_history(struct hair_geometry* geometry, struct hair_vertex_history* history,
                                 const struct hair_pose* head, uint32_t frame);
// Keep the vertices that previous frames displayed, before they are overwritten.
void hair_geometry_save_history(struct hair_geometry* geometry);
// Return whether vertices of followers of a previous frame are kept.
bool hair_geometry_has_history(const struct hair_geometry* geometry);
// Create the buffer of the previous frame's smoothed guides, and begin frame number `frame`, or
// continue it. The guides must be up to date.
hair_result hair_geometry_begin_guide_history(struct hair_geometry* geometry, const struct hair_pose* head,
                                              uint32_t frame);
// Keep the smoothed guides that the previous frame displayed, before they are overwritten.
void hair_geometry_save_guide_history(struct hair_geometry* geometry);
// Forget the previous frame, because the hair has jumped.
void hair_geometry_forget_history(struct hair_geometry* geometry);
// Move the previous frame's positions with a head that is teleported.
void hair_geometry_teleport_history(struct hair_geometry* geometry, const struct hair_pose* from,
                                    const struct hair_pose* to);
// Bind the previous frame's vertices.
void hair_geometry_bind_history(struct hair_geometry* geometry);

// Functions of vertex_cache.c.

// Write the vertex cache unless it is up to date. With parameters of a view in `drawn`, write only
// the vertices that the view draws, on every call.
hair_result hair_geometry_ensure_vertex_cache(struct hair_geometry* geometry,
                                              const struct hair_draw_params* drawn);
// Return whether the cache holds up-to-date vertices of all followers.
bool hair_geometry_has_vertex_cache(const struct hair_geometry* geometry);
// Bind the vertex cache.
void hair_geometry_bind_vertex_cache(struct hair_geometry* geometry);
void hair_geometry_free_vertex_cache(struct hair_geometry* geometry);
// Create the buffer of shaded vertices.
hair_result hair_geometry_ensure_shaded(struct hair_geometry* geometry);
void hair_geometry_free_shaded(struct hair_geometry* geometry);
// Read back the vertices of all followers. xyz is the position from the head's origin, w the
// radius. The caller frees *out, and has checked that there are at most UINT32_MAX vertices.
hair_result hair_geometry_read_vertex_cache(struct hair_geometry* geometry, hair_vec4** out);

#endif
