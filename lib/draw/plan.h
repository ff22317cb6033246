// plan.h - everything that one view draws, resolved once.
#ifndef HAIR_DRAW_PLAN_H
#define HAIR_DRAW_PLAN_H

#include "lib/base/pose.h"
#include "lib/draw/raster.h"
#include "lib/draw/render_path.h"
#include "lib/gl/commands.h"

#include <stdbool.h>

// Source of the vertices that a view draws.
enum hair_vertex_source {
    HAIR_VERTICES_TESSELLATED, // The tessellator computes them.
    // The vertex shader computes them, for the strands of the strand list.
    HAIR_VERTICES_PROCEDURAL,
    HAIR_VERTICES_CACHED, // The vertex cache has those of all followers.
    HAIR_VERTICES_PER_VIEW, // The view cache has those of the strand list.
};

// Blending of strands into the framebuffer.
enum hair_blending {
    HAIR_BLENDING_NONE,
    HAIR_BLENDING_UNSORTED, // Blended by coverage, in any order.
    HAIR_BLENDING_SORTED, // Blended by coverage, from far to near.
};

#define HAIR_DRAW_MAX_PASSES 21

struct hair_draw_plan {
    const hair_view* view;
    struct hair_gl_shader* shader; // Shading by the application. NULL selects the built-in shading.
    hair_render_path path; // Never HAIR_RENDER_PATH_AUTO.
    enum hair_vertex_source vertices;
    bool is_computed; // Compute shaders rasterise segments.
    enum hair_blending blending;
    bool is_paired; // Ribbons are triangles between two vertices per strand point.
    bool has_sides; // Per-view vertices are in clip space, on both sides of a ribbon.
    bool has_strand_list; // Strands are drawn from the strand list.
    bool is_textured; // The application's texture colours the strands.
    bool is_painted; // The groom's colours colour the strands.
    bool has_root_uvs; // Programs read root uvs.
    bool has_motion_output; // Motion vectors are a second output, beside colour.
    struct hair_depth_test depth_test; // The test that computed opacity makes.
    uint32_t light_values; // Number of light values per vertex. 0 without self-shadowing.
    // The view cache keeps the vertices of an earlier frame. `view` is then `moved_view`, the view
    // from the head of that frame.
    bool keeps_vertices;
    bool is_of_batch; // The head is drawn with others, by hair_batch_draw().
    hair_view moved_view;

    // Written by hair_draw_prepare().
    const struct hair_pose* head;
    bool has_occlusion; // Patches are tested for occlusion.
    struct hair_occlusion_params occlusion;
    bool is_empty; // Compute rasterisation has no pixels to cover.
    struct hair_raster_params raster;
    hair_gl_pass features; // Features of all passes. Each pass has those that it supports.

    // All passes that the view runs, in order. Written by hair_draw_find_passes().
    hair_gl_pass pass[HAIR_DRAW_MAX_PASSES];
    uint32_t pass_count;
    hair_gl_pass draw; // Pass that draws. The last of `pass`.
    hair_gl_pass shade; // Pass that shades or writes vertices before. 0 if there is none.
    GLuint draw_program, shade_program; // Their programs, written by hair_draw_compile().
};

#endif
