/// hair_view.h - views, lights, level of detail, shaders and drawing. [GL]
#ifndef HAIR_HAIR_VIEW_H
#define HAIR_HAIR_VIEW_H

#include <hair/hair_base.h>

typedef enum hair_pass {
    HAIR_PASS_COLOR = 0, ///< Shaded, with depth.
    HAIR_PASS_DEPTH, ///< Depth only: shadow maps and pre-passes.
    HAIR_PASS_GUIDES, ///< Debug: simulated strands as lines, by stretch: blue -2 % to red +2 %.
    HAIR_PASS_COLLIDERS, ///< Debug: what hair collides with, shaded; and a slice of the field, see hair_slice.
    /// With depth: how far hair has moved on the screen since the frame before, see hair_view.frame_index. To a float target: x and
    /// y in viewports, to the right and up, without jitter; 0 and 1 beside. Keeps the vertices of two frames: 40 bytes each.
    HAIR_PASS_MOTION,
    /// With depth: numbers. To an unsigned integer target: 1 + strand, 1 + its guide, place along it from 0 to 65535.
    HAIR_PASS_ID,
    /// Debug: the air of the last step, if there is wind, as arrows in a hair_slice; HAIR_SLICE_NONE is HAIR_SLICE_Z here.
    /// Grey ones are as fast as the wind, blue ones slower, red ones twice as fast.
    HAIR_PASS_WIND,
    /// What hair takes of a light that it is seen from, as hair_light.shadow_matrix does, for what it falls on: the share of
    /// each texel that strands of true width cover, times hair_view.opacity, whatever size texels have; it is fit to be
    /// filtered. To a float target, R16F will do, that was cleared to 0: what lies behind has 1 - opacity of the light.
    /// Blending is set for it and put back; depth is tested as that is set, and not written. Attach the depth map of
    /// bodies, hair_light.opaque_shadow_map: then only hair before the first body counts, which is what falls on it.
    HAIR_PASS_OPACITY
} hair_pass;

/// How followers become what is drawn: the picture is the same.
typedef enum hair_render_path {
    HAIR_RENDER_PATH_TESSELLATION = 0, ///< Isolines, from one-point patches.
    HAIR_RENDER_PATH_INSTANCED, ///< No tessellator: vertices by their numbers, for the strands that are drawn.
    HAIR_RENDER_PATH_CACHED, ///< Vertices written once, for all views until hair moves: 24 bytes each; and
    ///< shaded for each view of colour before it draws them: 8 more. With a
    ///< hair_lod those of what is drawn are written for each view: 40 bytes, of
    ///< lines 24; only of HAIR_PASS_COLOR and HAIR_PASS_DEPTH and without a
    ///< shader, else as HAIR_RENDER_PATH_INSTANCED.
    /// As HAIR_RENDER_PATH_CACHED, but pixels too are made by compute, and come to the framebuffer as rectangles: for GPUs of which
    /// few units draw. Of HAIR_PASS_COLOR and HAIR_PASS_DEPTH as ribbons, by samples, without a shader that shades pixels;
    /// all else is drawn as by HAIR_RENDER_PATH_CACHED. With a hair_lod vertices are written for each view, 32 bytes. What is
    /// blended is blended once, the nearest. Depth functions other than less and greater are taken for less. Up to 16 samples;
    /// memory: 8 bytes, of depth alone 4, for each sample of the pixels that hair can be in, and half as many again.
    HAIR_RENDER_PATH_COMPUTE,
    HAIR_RENDER_PATH_AUTO ///< What was measured to be the fastest on this driver: by its name, never by timing. hair_report says
    ///< which it is.
} hair_render_path;

typedef enum hair_primitive {
    HAIR_PRIMITIVE_RIBBONS = 0, ///< Camera-facing, of true width.
    HAIR_PRIMITIVE_LINES ///< One pixel wide: the cheap setting.
} hair_primitive;

/// How pixels come to show strands that are thinner than they are.
typedef enum hair_coverage {
    HAIR_COVERAGE_MSAA = 0, ///< By their samples, which see opaque ribbons of true width; the default.
    /// Of HAIR_PASS_COLOR, for ribbons only: by the share of the pixel that they cover, whatever its samples. Segments are
    /// sorted from far to near and blended over what is there, as far as its depth lets them: draw the body before, the
    /// hair's own depth is not written. Colours are multiplied by alpha. Memory: 32 bytes for each vertex of all followers,
    /// whatever the picture's size; what lies between each other by less than 1/16384 of the hair's extent is in any order.
    HAIR_COVERAGE_ALPHA
} hair_coverage;

/// A slice through the field, at right angles to one of the head's axes. The colliders before it are cut away.
/// Blue is outside, red inside, white the surface; a line for every voxel from it.
typedef enum hair_slice { HAIR_SLICE_NONE = 0, HAIR_SLICE_X, HAIR_SLICE_Y, HAIR_SLICE_Z } hair_slice;

/// Level of detail: how much of the hair is drawn. Of the strands that are left out those that are drawn make up the
/// width, so that they cover as much, and move inwards among their neighbours as far as they reach out farther to either side;
/// lines, which have no width, cannot. All changes continuously. HAIR_SELF_SHADOW_STRANDS finds
/// light for what is drawn only. Dynamic, its cells are no smaller than 2 pixels, and followers are led round colliders as far as 5 mm
/// are more than a pixel, in full where they are 2: where no view shows that, it is not found out either.
typedef struct hair_lod {
    hair_struct_header header;
    float strand_fraction; ///< Share of the strands that is drawn, at most. [0, 1]. Default 1.
    float segment_fraction; ///< Share of hair_look.segments that they have, at most. [0, 1]. Default 1.
    float width_exponent; ///< Strands are 1 / share to this power as wide. [0, 2]. Default 1.
    uint32_t per_patch; ///< 1: by patch, as follows. 0: alike everywhere, as above. [0, 1]. Default 1.
    /// Strands that would be thinner on the screen than this are drawn so wide, and as many fewer. Pixels.
    float strand_pixels; ///< [0.01, 100]. Default 0.25.
    float segment_pixels; ///< Length of a segment on the screen, likewise. [0.1, 1000]. Default 4.
    /// Share of the strands of a patch that is left, at least.
    float min_strand_fraction; ///< [0.001, 1]. Default 0.05.
    float importance; ///< Hair is taken for as many times as large as it appears. [0, 1000]. Default 1.
    /// The same for hair that a head hides whose place is told from its roots. Below 1 what the head is certain to hide
    /// is not drawn: then the head must be. What is not in view never is.
    float occluded_importance; ///< [0, 1]. Default 1.
} hair_lod;
HAIR_DESC(hair_lod)

/// Where the host's own shading runs.
typedef enum hair_shade_at {
    HAIR_SHADE_VERTICES = 0, ///< Of strands, as ours: cheap. Pixels get what lies between.
    HAIR_SHADE_PIXELS ///< In the fragment shader, whose other outputs it may declare and write.
} hair_shade_at;

/// Shading of the host's own: GLSL 4.50 that has
///     vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f) + 0.1 * f.color, 1.0); }
/// and whatever that needs: uniform buffers from binding 8 on, textures from unit 24 on and, of pixels, storage buffers from
/// binding 8 on, which the host binds. It returns light towards the eye and, of pixels, alpha. It may call
///     vec3 hair_shade_ours(hair_fragment f)            what would be without it
///     vec3 hair_world(hair_fragment f)                 where it is in the world, m
///     uint hair_lights()                               of the view
///     vec3 hair_light(hair_fragment f, uint i, out vec3 to)  the i-th's irradiance without shadow; to: its direction
///     float hair_light_through(hair_fragment f, uint i)      share of it that comes through hair and bodies
///     vec3 hair_sky(hair_fragment f)                   irradiance of the surroundings
/// A hair_fragment has: vec3 position (from the head's origin, m, world axes), tangent, to_eye (unit); float t (0 root, 1
/// tip), random (the strand's own, [0, 1)), across (a ribbon, -1 to 1; 0 at vertices); vec3 color (reflectance); vec2 uv (of
/// the root on the scalp; 0 where the groom has none); uint strand, lock (its guide), seed. The rest of the library's names
/// are in sight too and may change: give your own a prefix. What is not finite or below 0 becomes 0.
typedef struct hair_shader_desc {
    hair_struct_header header;
    const char* label; ///< In errors, before the line: "label:12: …". NULL: "shader".
    const char* glsl; ///< Its text, without #version. Required.
    hair_shade_at at; ///< Default HAIR_SHADE_VERTICES.
} hair_shader_desc;
HAIR_DESC(hair_shader_desc)

/// A text that does not compile is HAIR_ERROR_OPENGL, its first error in the log. Programs are made as views need them.
HAIR_API hair_result hair_shader_create(hair_context* context, const hair_shader_desc* desc,
                                        hair_shader** out);
HAIR_API void hair_shader_destroy(hair_shader* shader); ///< Before its context.

typedef enum hair_light_kind {
    HAIR_LIGHT_DIRECTIONAL = 0, ///< So far away that all of its light comes from one side: the sun.
    HAIR_LIGHT_POINT, ///< A lamp that shines everywhere.
    HAIR_LIGHT_SPOT ///< One that shines into a cone.
} hair_light_kind;

typedef struct hair_light {
    hair_struct_header header;
    hair_light_kind kind; ///< Default HAIR_LIGHT_DIRECTIONAL.
    /// Towards the light: from anywhere, or of a spot from the middle of what it shines at. Any length. World.
    float direction[3]; ///< [-1e6, 1e6]. Default (0.4, 0.8, 0.45).
    float position[3]; ///< Of a point or spot. World. m. [-1e9, 1e9]. Default 0.
    float color[3]; ///< Its irradiance; of a point or spot that 1 m away. [0, 1e6]. Default 3.
    float range; ///< Of a point or spot: farther it does not shine. m. 0 (any) to 1e6. Default 0.
    float source_radius; ///< Of a point or spot: nearer it gets no brighter. m. [0.001, 1000]. Default 0.05.
    /// Of a spot: half of the angle of its full brightness.
    float inner_angle; ///< Radians. [0, 1.57]. Default 0.3.
    /// And beyond which it does not shine: above inner_angle.
    float outer_angle; ///< Radians. [0, 1.57]. Default 0.5.
    /// Of OpenGL: 2D, depth of hair seen from the light, as HAIR_PASS_DEPTH draws it: what hair lets through of it. Bodies in
    /// it take no more than hair would there. 0: none. One or both textures of up to 4 lights.
    uint32_t hair_shadow_map;
    /// World to clip space of both; orthographic or, of points and spots, in perspective. Depth grows away from the light.
    float shadow_matrix[16]; ///< Default identity.
    uint32_t opaque_shadow_map; ///< The same of what lets no light through: a head, clothes, walls. 0: none.
    float opaque_bias; ///< Hair no farther than this behind what that shows is lit. m. [0, 1]. Default 0.003.
} hair_light;
HAIR_DESC(hair_light)

typedef struct hair_view {
    hair_struct_header header;
    hair_pass pass; ///< Default HAIR_PASS_COLOR.
    hair_render_path render_path; ///< Default HAIR_RENDER_PATH_TESSELLATION.
    hair_primitive primitive; ///< Default HAIR_PRIMITIVE_RIBBONS.
    float view[16]; ///< World to view. Default identity.
    float projection[16]; ///< View to clip. Reversed, infinite depth are fine. Default identity.
    const hair_light* lights; ///< light_count of them. NULL: each as hair_light_default() has it.
    uint32_t light_count; ///< [0, 16]. Default 1.
    float ambient[3]; ///< Irradiance of surroundings that are the same on all sides. [0, 1e6]. Default 0.35.
    /// Radiance of the surroundings beside that, as 9 spherical harmonics of r, g, b each, up to order 2 and as Ramamoorthi
    /// and Hanrahan 2001 order and scale them, over world axes: 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2. Each in
    /// [-1e6, 1e6]. NULL: none.
    const float* sky;
    hair_slice slice; ///< Of HAIR_PASS_COLLIDERS, HAIR_PASS_WIND. Default HAIR_SLICE_NONE.
    float slice_at; ///< Where, as a share of the field's box. [0, 1]. Default 0.5.
    const hair_lod* lod; ///< NULL: all is drawn.
    hair_shader* shader; ///< Of HAIR_PASS_COLOR. NULL: as hair_look.shading says.
    hair_coverage coverage; ///< Default HAIR_COVERAGE_MSAA.
    float opacity; ///< Of HAIR_COVERAGE_ALPHA, HAIR_PASS_OPACITY: of what strands cover. [0, 1]. Default 1.
    float jitter[2]; ///< By which the picture is moved right and up. Pixels. [-64, 64]. Default 0.
    /// Of HAIR_PASS_MOTION. Draws of one number share the frame before, which is the last of another number in which hair was
    /// drawn so: number frames, and it is right for several views, whatever was stepped between. 0: each draw is a frame.
    /// Where there was none, after hair_reset or hair_load, or with another number of segments, hair has stood still;
    /// hair_teleport takes along where it was.
    uint32_t frame_index; ///< Also of HAIR_SELF_SHADOW_STRANDS. Default 0.
    float prev_view[16]; ///< View of the frame before. Default identity.
    float prev_projection[16]; ///< And its projection, without jitter. Default identity.
    /// Of OpenGL: 2D, linear colours that those of strands are multiplied by, where hair_groom_desc.scalp_uvs have their
    /// roots, as the texture itself filters them. 0, or a groom without uvs: none.
    uint32_t color_texture;
    /// Of OpenGL: 2D, depth of what you have drawn that is opaque, as that may be bound to be drawn to as well: patches of strands
    /// that are wholly behind it are not drawn, by any path. Of any size; all of it is what the viewport is. What is behind says
    /// glDepthFunc: reversed depth is fine, by one that is neither less nor greater nothing is hidden. glDepthRange and
    /// glClipControl are as they were when it was drawn. Not of HAIR_PASS_GUIDES, _COLLIDERS and _WIND. 0: none.
    uint32_t occluder_depth;
    /// World to clip space of that, as of the frame before: what since has come out from behind something is drawn a frame late,
    /// and what was not in that picture is drawn. All 0: the view's own, projection times view. Default 0.
    float occluder_matrix[16];
} hair_view;
HAIR_DESC(hair_view)

/// Have all programs compiled that hair_step and a hair_draw of `view` would run with what is set now, so that no frame waits for
/// them: call it while something else is shown until *ready is 1, also before colliders, wind or another look are first set on hair
/// that is on the screen. Drivers with KHR_parallel_shader_compile compile all at once beside what you do, and no call
/// waits; others compile one program a call, as a shader of yours is anywhere. view NULL: only what steps run. On
/// failure *ready is as it was.
HAIR_API hair_result hair_precompile(hair_instance* hair, const hair_view* view, uint32_t* ready);

/// Draw into the bound framebuffer and viewport, with the depth function that is set. An incomplete framebuffer
/// is HAIR_ERROR_OPENGL.
HAIR_API hair_result hair_draw(hair_instance* hair, const hair_view* view);

#endif
