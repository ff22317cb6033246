/// hair_view.h - drawing: passes, level of detail, shaders, lights and views.
#ifndef HAIR_HAIR_VIEW_H
#define HAIR_HAIR_VIEW_H

#include <hair/hair_base.h>

// Passes ------------------------------------------------------------------------------------------

/// Output of a draw.
typedef enum hair_pass {
    /// Shaded colour, with depth.
    HAIR_PASS_COLOR = 0,
    /// Depth only, for shadow maps and depth pre-passes. Colour attachments stay unchanged.
    HAIR_PASS_DEPTH,
    /// Debug view of the guides as lines. The colour shows the stretch, from blue at -2 % to red at
    /// +2 %.
    HAIR_PASS_GUIDES,
    /// Debug view of the colliders, shaded, and of a slice of the field. See hair_slice.
    HAIR_PASS_COLLIDERS,
    /// Motion vectors, with depth. They are the displacement on the screen since the previous
    /// frame, see hair_view.frame_index. The target has floats. x and y are in viewports, to the
    /// right and up, without jitter. The other channels are 0 and 1. Needs memory for the vertices
    /// of two frames, 40 bytes each.
    HAIR_PASS_MOTION,
    /// Indices, with depth. The target has unsigned integers: 1 + strand, 1 + guide of the strand,
    /// and the position along the strand from 0 to 65535.
    HAIR_PASS_ID,
    /// Debug view of the wind of the last step, as arrows in a hair_slice. HAIR_SLICE_NONE means
    /// HAIR_SLICE_Z here. Gray arrows are as fast as the ambient wind, blue arrows slower, and red
    /// arrows twice as fast. Draws nothing without wind.
    HAIR_PASS_WIND,
    /// Opacity of the hair as seen from a light, to shadow other geometry. The view is that of
    /// hair_light.shadow_matrix. The value is the fraction of each texel that strands of true width
    /// cover, times hair_view.opacity. The fraction does not depend on the texel size, and the
    /// texture may be filtered. The target has floats, for example R16F, and is cleared to 0.
    /// Geometry behind the hair then receives 1 - opacity of the light. The pass sets blending and
    /// restores it. Depth is tested with the current settings and not written. Attach the depth of
    /// hair_light.opaque_shadow_map, so that only hair in front of the first opaque surface counts.
    HAIR_PASS_OPACITY
} hair_pass;

/// Way in which followers become pixels. All paths draw the same image.
typedef enum hair_render_path {
    /// Tessellation into isolines, from patches of one point.
    HAIR_RENDER_PATH_TESSELLATION = 0,
    /// Vertex cache, written once for all views until the hair moves. It takes 24 bytes per vertex,
    /// and 8 more for shading per view of HAIR_PASS_COLOR. With a hair_lod, the cache holds the
    /// drawn vertices of one view instead. It takes 40 bytes per vertex, or 24 for lines. This
    /// applies to HAIR_PASS_COLOR and HAIR_PASS_DEPTH without a shader. For other views with a
    /// hair_lod, the vertex shader computes the drawn vertices, and hair_report() names the pass
    /// "procedural".
    HAIR_RENDER_PATH_CACHED,
    /// Rasterization in compute shaders, from the vertex cache, and composition of tiles into the
    /// framebuffer. Fastest on GPUs with few raster units.
    ///
    /// Applies to ribbons of HAIR_PASS_COLOR and HAIR_PASS_DEPTH with HAIR_COVERAGE_MSAA, up to 16
    /// samples, and without a shader at HAIR_SHADE_PIXELS. Applies to HAIR_PASS_OPACITY with one
    /// sample, if depth is not tested, or against level 0 of a 2D texture and without
    /// GL_EQUAL, GL_NOTEQUAL and GL_NEVER. Other views use HAIR_RENDER_PATH_CACHED.
    ///
    /// Blending applies only to the nearest strand. Depth functions other than less and greater
    /// count as less. With a hair_lod, each view writes its vertices, 32 bytes each. The image
    /// takes 8 bytes per sample of every pixel that the hair can reach, or 4 for depth and
    /// opacity, plus one half of this.
    HAIR_RENDER_PATH_COMPUTE,
    /// The fastest path for the view on this driver, by a built-in table of measured drivers.
    /// Drivers that are not in the table use HAIR_RENDER_PATH_CACHED. Nothing is timed while hair
    /// is drawn. hair_context_tune() measures the paths of a driver.
    ///
    /// Vertices or samples may exceed the driver's limits, hair_set_memory_limit() or the memory.
    /// The view is then drawn by a path without them. hair_report() tells which path it is.
    HAIR_RENDER_PATH_AUTO
} hair_render_path;

/// Primitive that strands are drawn as.
typedef enum hair_primitive {
    HAIR_PRIMITIVE_RIBBONS = 0, ///< Camera-facing ribbons of true width.
    HAIR_PRIMITIVE_LINES ///< Lines, one pixel wide. Cheaper.
} hair_primitive;

/// Antialiasing of strands that are thinner than a pixel.
typedef enum hair_coverage {
    /// Multisampling of opaque ribbons of true width. With one sample a pixel, thin hair is noisy.
    /// Default.
    HAIR_COVERAGE_MSAA = 0,
    /// Analytic coverage, the fraction of a pixel that a ribbon covers, whatever the number of
    /// samples. Applies to ribbons of HAIR_PASS_COLOR. Segments are sorted from far to near and
    /// blended over the image where the depth test passes. Draw opaque geometry first, and
    /// instances from far to near, because the pass does not write depth. Colours are premultiplied
    /// by alpha. Needs 32 bytes per vertex of all followers, whatever the image size. Segments
    /// whose depth differs by less than 1/16384 of the hair's extent may be in any order.
    HAIR_COVERAGE_ALPHA
} hair_coverage;

/// Slice through the field, perpendicular to an axis of the head. Colliders in front of the slice
/// are cut away. The slice is blue outside, red inside and white at the surface, with a line for
/// every voxel of distance.
typedef enum hair_slice {
    HAIR_SLICE_NONE = 0,
    HAIR_SLICE_X,
    HAIR_SLICE_Y,
    HAIR_SLICE_Z
} hair_slice;

// Level of detail ---------------------------------------------------------------------------------

/// Level of detail, the fraction of the strands and segments that a view draws.
///
/// All changes are continuous. Drawn strands become wider, so that they cover as much as all
/// strands would. They also move inwards among their neighbours by as much as they are widened.
/// Lines have no width, so they cover less. HAIR_SELF_SHADOW_STRANDS computes the light of drawn
/// strands only.
///
/// Small hair does not get new light in every frame, by light_pixels. It need not move in every
/// frame, by motion_pixels, and need not simulate all of its guides, by guide_pixels.
///
/// With per_patch, two more details depend on the size on the screen. Cells of
/// HAIR_SELF_SHADOW_STRANDS are at least 1 pixel large. Followers are pushed out of colliders only
/// if 5 mm are more than a pixel, and fully from 2 pixels on. A view that does not show this
/// displacement does not compute it. With HAIR_SELF_SHADOW_STRANDS and a hair_shadow_map, followers
/// are pushed out as far as in the map.
typedef struct hair_lod {
    hair_struct_header header;
    /// Maximum fraction of the strands that are drawn.
    float strand_fraction; ///< [0, 1]. Default 1.
    /// Maximum fraction of hair_look.strand.segments per strand.
    float segment_fraction; ///< [0, 1]. Default 1.
    /// Exponent e of the width. Strands become wider by the drawn fraction to the power of -e.
    float width_exponent; ///< [0, 2]. Default 1.
    /// Selection by the size on the screen of each patch of strands, by the members below. False
    /// uses the members above for all patches.
    bool per_patch; ///< Default true.
    /// Minimum width of a strand on the screen. Strands that would be thinner are drawn with this
    /// width, and in proportionally smaller number.
    float strand_pixels; ///< Pixels. [0.01, 100]. Default 0.25.
    /// Minimum length of a segment on the screen. Strands with shorter segments get fewer segments.
    float segment_pixels; ///< Pixels. [0.1, 1000]. Default 1.5.
    /// Minimum fraction of the strands of a patch that are drawn.
    float min_strand_fraction; ///< [0.001, 1]. Default 0.05.
    /// Factor of the projected size that selects the level of detail.
    float importance; ///< [0, 1000]. Default 1.
    /// Factor of the projected size of hair behind the head, whose position is estimated from the
    /// roots. Below 1, hair that the head certainly occludes is not drawn. The application must
    /// then draw the head. Hair outside the view is never drawn.
    float occluded_importance; ///< [0, 1]. Default 1.
    /// Size of hair at rest on the screen up to which its light is computed in every second frame
    /// only. With half of the size it is computed in every third frame, and with a third of it in
    /// every fourth. A frame is a step of the instance. Instances at different positions take
    /// turns. This is the light of HAIR_SELF_SHADOW_STRANDS. 0 computes it in every frame.
    float light_pixels; ///< Pixels. [0, 10000]. Default 128.
    /// Size of hair at rest on the screen up to which only every second hair_step() moves it. With
    /// half of the size it is every third, and with a third of it every fourth, by turns as above.
    /// The step that moves hair advances by the time of all. Its substeps are longer by as much,
    /// see hair_physics.substep_rate. In the other frames, hair follows the head rigidly, and
    /// HAIR_RENDER_PATH_COMPUTE draws the vertices of the frame before, moved with the head.
    ///
    /// Motion then depends on views. A view that cannot draw those vertices steps the hair first:
    /// another path or pass, one with a shader, motion vectors or occlusion culling, or from
    /// another side. So does a call that reads the hair. The largest hair of all views in colour
    /// counts. Hair with pins, targets, a skinned scalp, a free root or recorded contacts is
    /// stepped in every frame, and so is that of HAIR_SOLVER_REDBLACK. 0 steps all hair in every
    /// frame.
    float motion_pixels; ///< Pixels. [0, 10000]. Default 0.
    /// Size of hair at rest on the screen up to which only half of the guides are simulated. With
    /// half of the size it is a quarter, and with a quarter of it an eighth. The other guides turn
    /// as the simulated guides beside them do, keep their lengths, and do not collide. Hair that
    /// changes its level goes on from its shape, within about a second.
    ///
    /// Motion then depends on views. The largest hair of all views in colour counts. Kinds of hair
    /// that motion_pixels excepts simulate all guides. 0 simulates all guides of any hair.
    float guide_pixels; ///< Pixels. [0, 10000]. Default 0.
} hair_lod;
HAIR_DESC(hair_lod)

// Shaders -----------------------------------------------------------------------------------------

/// Shader stage in which the application's shading runs.
typedef enum hair_shade_at {
    /// Per vertex of a strand, like the built-in shading. Cheap. Pixels are interpolated.
    HAIR_SHADE_VERTICES = 0,
    /// In the fragment shader, which may declare and write further outputs.
    HAIR_SHADE_PIXELS
} hair_shade_at;

/// Shading by the application, a text in GLSL 4.50 that defines
///
///     vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f) + 0.1 * f.color, 1.0); }
///
/// The function returns the light towards the eye and, for HAIR_SHADE_PIXELS, alpha. Values that
/// are not finite or below 0 become 0.
///
/// A hair_fragment has these members:
///
///     vec3 position    position relative to the head's origin, m, along the world axes
///     vec3 tangent     unit direction of the strand
///     vec3 to_eye      unit direction to the eye
///     float t          position along the strand, from 0 at the root to 1 at the tip
///     float random     random number of the strand in [0, 1)
///     float across     position across a ribbon, from -1 to 1, and 0 per vertex
///     vec3 color       reflectance
///     vec2 uv          texture coordinates of the root on the scalp, 0 if there are none
///     uint strand      index of the strand
///     uint lock        index of the guide
///     uint seed        random seed of the strand
///
/// The text may call these functions:
///
///     vec3 hair_shade_ours(hair_fragment f)                  the built-in shading
///     vec3 hair_world(hair_fragment f)                       the position in the world, m
///     uint hair_lights()                                     the number of lights of the view
///     vec3 hair_light(hair_fragment f, uint i, out vec3 to)  unshadowed irradiance of light i, and
///                                                            the direction to the light
///     float hair_light_through(hair_fragment f, uint i)      transmittance of hair and opaque
///                                                            geometry towards light i
///     vec3 hair_sky(hair_fragment f)                         irradiance of the surroundings
///     float hair_sky_through(hair_fragment f)                fraction of the surroundings that no
///                                                            hair hides, an estimate without
///                                                            HAIR_SELF_SHADOW_STRANDS
///     vec3 hair_reflect(hair_fragment f, vec3 to, vec3 irradiance, float through)
///                                                            the built-in shading of a light of
///                                                            the application, from the unit
///                                                            direction `to`. Hair lets the
///                                                            fraction `through` of it pass
///
/// A shader at HAIR_SHADE_PIXELS may declare outputs from location 1 on. Location 1 is taken in
/// views with hair_view.motion_output.
///
/// The text may use uniform buffers from binding 8 on and textures from unit 24 on. At
/// HAIR_SHADE_PIXELS it may also use storage buffers from binding 8 on. The application binds them.
/// Other names of the library are visible and may change, so give your own names a prefix.
typedef struct hair_shader_desc {
    hair_struct_header header;
    /// Name in error messages, as in "label:12: ...". NULL selects "shader".
    const char* label; ///< Default NULL.
    /// Text of the shader, without #version. Required. It is copied.
    const char* glsl;
    hair_shade_at at; ///< Default HAIR_SHADE_VERTICES.
} hair_shader_desc;
HAIR_DESC(hair_shader_desc)

/// Create a shader and compile the variant that most views use. Other variants are compiled when a
/// view first needs them.
///
/// @param context Context. The shader is of no use after it.
/// @param desc Text and name, copied.
/// @param out Receives the shader.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL if the text does not compile,
///     with the first error in the log, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_shader_create(hair_context* context, const hair_shader_desc* desc,
                                        hair_shader** out);

/// Destroy a shader. NULL does nothing.
/// OpenGL: required, but not for an orphan. Does not wait for the GPU.
HAIR_API void hair_shader_destroy(hair_shader* shader);

// Lights ------------------------------------------------------------------------------------------

/// Kind of a light.
typedef enum hair_light_kind {
    HAIR_LIGHT_DIRECTIONAL = 0, ///< A light at infinity, such as the sun.
    HAIR_LIGHT_POINT, ///< A light that shines in all directions.
    HAIR_LIGHT_SPOT ///< A light that shines into a cone.
} hair_light_kind;

/// Range of depth in clip space, as glClipControl() sets it.
typedef enum hair_depth_range {
    /// The range that is set when hair_draw() is called. Default.
    HAIR_DEPTH_RANGE_CURRENT = 0,
    /// GL_NEGATIVE_ONE_TO_ONE, the range of OpenGL without glClipControl().
    HAIR_DEPTH_RANGE_NEGATIVE_ONE_TO_ONE,
    /// GL_ZERO_TO_ONE.
    HAIR_DEPTH_RANGE_ZERO_TO_ONE
} hair_depth_range;

/// A light. At most four lights of a view may have a hair_shadow_map or an opaque_shadow_map.
typedef struct hair_light {
    hair_struct_header header;
    hair_light_kind kind; ///< Default HAIR_LIGHT_DIRECTIONAL.
    /// Direction to the light in the world, of any length other than 0. For a spot, it is the
    /// direction from the centre of the lit area to the light. Ignored by points.
    float direction[3]; ///< [-1e6, 1e6]. Default (0.4, 0.8, 0.45).
    float position[3]; ///< Position of a point or spot in the world. m. [-1e9, 1e9]. Default 0.
    /// Irradiance, linear rgb. For a point or spot, it is the irradiance at a distance of 1 m.
    float color[3]; ///< [0, 1e6]. Default 3.
    /// Distance beyond which a point or spot does not shine. 0 disables this limit.
    float range; ///< m. [0, 1e6]. Default 0.
    /// Distance below which the light of a point or spot does not increase any more.
    float source_radius; ///< m. [0.001, 1000]. Default 0.05.
    /// Half angle of the cone in which a spot has full brightness.
    float inner_angle; ///< Radians. [0, 1.57]. Default 0.3.
    /// Half angle of the cone outside which a spot does not shine. It is greater than inner_angle.
    float outer_angle; ///< Radians. [0, 1.57]. Default 0.5.
    /// 2D depth texture of the hair, rendered from the light with HAIR_PASS_DEPTH. It attenuates
    /// the light. Opaque geometry in the texture attenuates only as hair would. A red channel of 16
    /// bits or more may hold the depth too. An array, a cube map or an array of cube maps, with
    /// immutable storage (glTexStorage), may hold the map in a layer. HAIR_SELF_SHADOW_STRANDS
    /// expects that the map was drawn with the lod of this view. 0 disables it.
    uint32_t hair_shadow_map; ///< Default 0.
    /// Transform from the world to the clip space of both shadow maps. It is orthographic or, for
    /// points and spots, in perspective. Depth grows away from the light, unless
    /// shadow_depth_reversed is true.
    float shadow_matrix[16]; ///< Default identity.
    /// 2D depth texture of opaque geometry, such as head, clothes and walls, rendered from the
    /// light. It blocks the light. Its format is as that of hair_shadow_map. 0 disables it.
    uint32_t opaque_shadow_map; ///< Default 0.
    /// Distance behind opaque_shadow_map up to which hair is lit.
    float opaque_bias; ///< m. [0, 1]. Default 0.003.
    /// Range of depth in the clip space of shadow_matrix, that with which both shadow maps were
    /// drawn. It may differ from the range of the view.
    hair_depth_range shadow_depth_range; ///< Default HAIR_DEPTH_RANGE_CURRENT.
    /// Reversed depth of both shadow maps. True means that depth falls away from the light, so that
    /// the maps were drawn with GL_GREATER and cleared to 0.
    bool shadow_depth_reversed; ///< Default false.
    /// Part of hair_shadow_map that is seen by shadow_matrix, such as a cascade. Hair outside the
    /// part is lit.
    struct {
        /// Layer of an array, or face of a cube map in the order of OpenGL. 0 for other textures.
        uint32_t layer; ///< [0, 65535]. Default 0.
        /// Lower left corner of a rectangle of an atlas, as a fraction of the texture.
        float offset[2]; ///< [0, 1]. Default 0.
        /// Width and height of the rectangle, as fractions of the texture. They end in the texture.
        float size[2]; ///< [1e-4, 1]. Default 1.
    } hair_shadow_part;
    /// Part of opaque_shadow_map that is seen by shadow_matrix, as hair_shadow_part.
    struct {
        /// Layer of an array, or face of a cube map in the order of OpenGL. 0 for other textures.
        uint32_t layer; ///< [0, 65535]. Default 0.
        /// Lower left corner of a rectangle of an atlas, as a fraction of the texture.
        float offset[2]; ///< [0, 1]. Default 0.
        /// Width and height of the rectangle, as fractions of the texture. They end in the texture.
        float size[2]; ///< [1e-4, 1]. Default 1.
    } opaque_shadow_part;
} hair_light;
HAIR_DESC(hair_light)

// Views -------------------------------------------------------------------------------------------

/// Encoding of colours in the framebuffer.
typedef enum hair_encoding {
    /// Linear light, for floats and for framebuffers with GL_FRAMEBUFFER_SRGB. Default.
    HAIR_ENCODING_LINEAR = 0,
    /// sRGB values (IEC 61966-2-1), for framebuffers that are shown as they are. Samples and
    /// transparency are then averaged as sRGB values. Colours above 1 continue the curve.
    HAIR_ENCODING_SRGB
} hair_encoding;

/// Input of hair_draw().
typedef struct hair_view {
    hair_struct_header header;
    hair_pass pass; ///< Default HAIR_PASS_COLOR.
    hair_render_path render_path; ///< Default HAIR_RENDER_PATH_AUTO.
    hair_primitive primitive; ///< Default HAIR_PRIMITIVE_RIBBONS.
    float view[16]; ///< World to view. Default identity.
    /// View to clip space, without jitter. Reversed and infinite depth are supported.
    float projection[16]; ///< Default identity.
    /// Lights, light_count of them. NULL selects light_count lights of hair_light_default().
    const hair_light* lights; ///< Default NULL.
    uint32_t light_count; ///< Number of lights. [0, 16]. Default 1.
    /// Irradiance of uniform surroundings, linear rgb.
    float ambient[3]; ///< [0, 1e6]. Default 0.35.
    /// Radiance of the surroundings, added to `ambient`, as 9 spherical harmonics of rgb each.
    /// Order and scale are those of Ramamoorthi and Hanrahan 2001, over the world axes: 1, y, z, x,
    /// xy, yz, 3 z^2 - 1, xz, x^2 - y^2. NULL disables it.
    const float* sky; ///< [-1e6, 1e6]. Default NULL.
    /// Slice of HAIR_PASS_COLLIDERS and HAIR_PASS_WIND.
    hair_slice slice; ///< Default HAIR_SLICE_NONE.
    /// Position of the slice along its axis, as a fraction of the field's box.
    float slice_at; ///< [0, 1]. Default 0.5.
    /// Level of detail. NULL draws everything.
    const hair_lod* lod; ///< Default NULL.
    /// Shader of HAIR_PASS_COLOR, from the context of the instance. NULL selects
    /// hair_look.shading.model.
    hair_shader* shader; ///< Default NULL.
    hair_coverage coverage; ///< Default HAIR_COVERAGE_MSAA.
    /// Opacity of the covered area, for HAIR_COVERAGE_ALPHA and HAIR_PASS_OPACITY.
    float opacity; ///< [0, 1]. Default 1.
    /// Displacement of the image to the right and up, for temporal antialiasing.
    float jitter[2]; ///< Pixels. [-64, 64]. Default 0.
    /// Number of the frame, for motion vectors and HAIR_SELF_SHADOW_STRANDS. Draws with the same
    /// index share one previous frame: the last one drawn with motion vectors and a different
    /// index. Count frames, and motion vectors are right for several views and any number of steps
    /// between them. 0 makes every draw a frame of its own. Hair has no motion in the first frame,
    /// after hair_reset() or hair_load(), and after a change of the number of segments.
    /// hair_teleport() moves the previous frame along.
    uint32_t frame_index; ///< Default 0.
    float prev_view[16]; ///< `view` of the previous frame. Default identity.
    float prev_projection[16]; ///< `projection` of the previous frame. Default identity.
    /// 2D texture of linear colours, sampled at the root's hair_groom_desc.scalp_uvs with the
    /// texture's own filter. It multiplies the colours of strands in HAIR_PASS_COLOR. 0, or a groom
    /// without uvs, disables it.
    uint32_t color_texture; ///< Default 0.
    /// 2D depth texture of your opaque geometry, for occlusion culling. Patches of strands that are
    /// wholly behind it are not drawn, on any path. The texture may also be the bound depth
    /// attachment. It may have any size, and covers the viewport. glDepthFunc determines which side
    /// is behind, so reversed depth works. A function that is neither less nor greater disables
    /// culling. glDepthRange and glClipControl must be as they were when the texture was drawn.
    /// HAIR_PASS_GUIDES, HAIR_PASS_COLLIDERS and HAIR_PASS_WIND ignore the texture. 0 disables it.
    uint32_t occluder_depth; ///< Default 0.
    /// Transform from the world to the clip space of occluder_depth, which may be that of the
    /// previous frame. Hair that has come out from behind an occluder since then appears one frame
    /// late. Hair outside that image is drawn. All 0 selects `projection` times `view`.
    float occluder_matrix[16]; ///< Default 0.
    /// Encoding of what HAIR_PASS_COLOR writes. Hair that appears too dark lacks one.
    hair_encoding encode; ///< Default HAIR_ENCODING_LINEAR.
    /// Motion vectors as a second output of HAIR_PASS_COLOR, into draw buffer 1, which has floats
    /// like the target of HAIR_PASS_MOTION. They are the values of that pass, and need its memory.
    /// Each sample that receives a colour receives a motion vector, so a resolve by averaging
    /// averages both. With HAIR_COVERAGE_ALPHA motion vectors are blended like colours and
    /// premultiplied by alpha, so draw the motion of the background before. Without draw buffer 1
    /// they are lost. HAIR_RENDER_PATH_COMPUTE applies without a hair_lod and without a shader at
    /// HAIR_SHADE_PIXELS. Other views use HAIR_RENDER_PATH_CACHED. False computes nothing.
    bool motion_output; ///< Default false.
} hair_view;
HAIR_DESC(hair_view)

/// Draw an instance into the bound framebuffer and viewport, with the current depth function. A
/// program that is not compiled yet is compiled by this call, see hair_precompile(). Colours are
/// linear, so enable GL_FRAMEBUFFER_SRGB or set hair_view.encode where no later pass encodes them.
///
/// @param view What to draw, and how. The textures must exist during the call.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, also if the framebuffer is
///     incomplete, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_draw(hair_instance* hair, const hair_view* view);

/// Draw many instances in one view, in the order of the list. The pixels are those of hair_draw()
/// for each of them.
///
/// A GPU prepares the strands of all instances side by side, as hair_step_list() steps them. An
/// instance that fails is not drawn, and the others are drawn. Small instances with a level of
/// detail are drawn by one call, after the others, where their order does not matter: by
/// HAIR_RENDER_PATH_COMPUTE in colour, with depth tested and written, and without blending, stencil
/// test and logic operation.
///
/// @param list Instances of one context, each at most once. May be NULL if `count` is 0.
/// @param count Number of instances.
/// @param view As in hair_draw(), for all instances. Its shadow maps must have all their shadows.
/// Errors: those of hair_draw(), the first of any instance. HAIR_ERROR_ARGUMENT for the list or the
///     view, and then no instance is drawn.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_draw_list(hair_instance* const* list, uint32_t count,
                                    const hair_view* view);

/// Compile all programs that hair_step() and a hair_draw() of `view` need with the current
/// settings, so that no frame waits for the compiler.
///
/// Call it while something else is shown, until `ready` is true. Also call it before colliders,
/// wind or another look are set on visible hair for the first time. The log says how many programs
/// are to come. hair_report_info.compiled_programs counts them.
///
/// Drivers with KHR_parallel_shader_compile compile in the background. A call begins or finishes at
/// most four programs, and begins nothing after 2 ms. The call sets the driver's number of compiler
/// threads to the maximum. NVIDIA's driver writes machine code while a call finishes a program,
/// which takes up to 0.2 s if its own cache on the disk does not have the program.
///
/// On other drivers each call compiles one program and waits for it. This also holds for programs
/// of a hair_shader on every driver. Software rasterizers compile machine code when a program first
/// runs. There a call compiles one program, or runs one on nothing.
///
/// @param view View to prepare. NULL prepares hair_step() only.
/// @param ready Receives true if all programs are compiled, and false otherwise. Unchanged on
///     failure.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_precompile(hair_instance* hair, const hair_view* view, bool* ready);

#endif
