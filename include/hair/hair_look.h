/// hair_look.h - looks: shape, colour and shading of the drawn strands.
#ifndef HAIR_HAIR_LOOK_H
#define HAIR_HAIR_LOOK_H

#include <hair/hair_base.h>

// Curves ------------------------------------------------------------------------------------------

/// A function along a strand, given by 8 values. at[i] is the value at i/7 of the length, from root
/// to tip. The interpolation is a monotone cubic without overshoot (Fritsch and Butland 1984).
typedef struct hair_curve {
    float at[8]; ///< Values at 0, 1/7, ... 1 of the length.
} hair_curve;

/// Return the curve that goes linearly from `root` to `tip`.
/// OpenGL: not used. Any thread.
HAIR_API hair_curve hair_curve_line(float root, float tip);

// Choices -----------------------------------------------------------------------------------------

/// Interpolation of followers between guides. Followers of HAIR_STRAND_SET_FULL keep the shape of
/// their strand in every case, and move with three guides.
typedef enum hair_interpolation {
    /// Blend of the two methods below by hair_look.clump.weight along the strand.
    HAIR_INTERPOLATION_MIXED = 0,
    /// Constant offset from one guide, in the guide's frame (Tariq 2010). Makes locks, and ropes in
    /// the extreme.
    HAIR_INTERPOLATION_SINGLE,
    /// Weighted mean of three guides (Tariq 2010). Makes full and even hair.
    HAIR_INTERPOLATION_MULTI
} hair_interpolation;

/// Handling of followers that enter colliders which their guides miss. Costs nothing when no
/// collider is within reach.
typedef enum hair_follower_collision {
    /// Push followers out of colliders, smoothly and preserving their length. Default.
    HAIR_FOLLOWER_COLLISION_PUSH_OUT = 0,
    /// Below its first vertex inside a collider, a follower follows its own guide alone (Tariq
    /// 2010).
    HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE,
    /// Let followers pass through colliders.
    HAIR_FOLLOWER_COLLISION_NONE
} hair_follower_collision;

/// Cross section of curls, perpendicular to their axis.
typedef enum hair_curl_shape {
    HAIR_CURL_SHAPE_HELIX = 0, ///< A circle per turn.
    HAIR_CURL_SHAPE_EXAMPLE ///< curl.profile_x and curl.profile_z. See hair_look_fit_curl().
} hair_curl_shape;

/// Model of light scattering by strands.
typedef enum hair_shading {
    /// Scattering through fibres (Marschner et al. 2003) and between them, by two streams (Zinke et
    /// al. 2008; Kubelka and Munk 1931) whose weights are fitted to path tracing. Default.
    HAIR_SHADING_FIBRES = 0,
    /// Kajiya and Kay 1989 with two highlights. Cheaper, and needs no table.
    HAIR_SHADING_LINES
} hair_shading;

/// Self-shadowing method.
typedef enum hair_self_shadow {
    /// At every drawn vertex, from its distance behind the depth in the light's
    /// hair_light.hair_shadow_map, times hair_look.self_shadow.absorption. Needs no memory, but
    /// hardly separates single strands.
    HAIR_SELF_SHADOW_DEPTH = 0,
    /// Once for the vertices of all strands, whose light values are stored. The light is attenuated
    /// by hair_light.hair_shadow_map along the segments of strands, and by a density grid of the
    /// hair. The grid also covers lights without a hair_shadow_map, the sky, and the colliders. The
    /// light is computed once for all views with the same hair_view.frame_index.
    HAIR_SELF_SHADOW_STRANDS
} hair_self_shadow;

// Looks -------------------------------------------------------------------------------------------

/// Appearance of the drawn strands. Members are grouped by topic. Strays, frizz and curls are
/// disabled, at no cost, when their fraction, curve or radius is 0. A displacement curve should be
/// 0 at the root, or strands leave the scalp.
typedef struct hair_look {
    hair_struct_header header;

    /// Colours of strands. See hair_look_color() and hair_look.pigment.
    struct {
        /// Reflectance of dense hair at the root, linear rgb.
        float root[3]; ///< [0, 1]. Default (0.13, 0.055, 0.024).
        /// Reflectance of dense hair at the tip, linear rgb.
        float tip[3]; ///< [0, 1]. Default (0.26, 0.13, 0.06).
        /// Relative variation of brightness between strands.
        float spread; ///< [0, 1]. Default 0.4.
        /// Relative variation of red against blue between strands.
        float hue_spread; ///< [0, 1]. Default 0.
        /// Multiple of the red of color.root to color.tip. The tints are linear between their 8
        /// values. Tinted colours are clamped to 1.
        hair_curve tint_red; ///< [0, 4]. Default 1.
        /// Multiple of the green of color.root to color.tip.
        hair_curve tint_green; ///< [0, 4]. Default 1.
        /// Multiple of the blue of color.root to color.tip.
        hair_curve tint_blue; ///< [0, 4]. Default 1.
        /// Fraction of the colour that is lost at the root.
        float root_darkening; ///< [0, 1]. Default 0.
        /// Fraction of the strand over which the colour recovers from color.root_darkening.
        float root_darkening_length; ///< [0.001, 1]. Default 0.15.
        /// Fraction of the strands that have color.streak_color.
        float streaks; ///< [0, 1]. Default 0.
        /// Reflectance of these strands from root to tip, linear rgb.
        float streak_color[3]; ///< [0, 1]. Default (0.6, 0.42, 0.22).
        /// Fraction of the strands that have a streak exactly when their guide has one.
        float streak_clumping; ///< [0, 1]. Default 0.8.
        /// Blend weight of hair_groom_desc.colors, if the groom has them, over the colours from
        /// color.root to color.tip. Variation, streaks and color.root_darkening apply to the blend.
        float groom_colors; ///< [0, 1]. Default 1.
    } color;

    /// Scattering of light by a strand.
    struct {
        hair_shading model; ///< Default HAIR_SHADING_FIBRES.
        /// Roughness along and around the fibre. HAIR_SHADING_FIBRES only.
        float roughness[2]; ///< [0.05, 1]. Default (0.3, 0.4).
        /// Relative variation of shading.roughness between strands.
        float roughness_spread; ///< [0, 1]. Default 0.
        /// Tilt of the cuticle scales, which shifts the highlights. HAIR_SHADING_FIBRES only.
        float cuticle_tilt; ///< Radians. [0, 0.3]. Default 0.05.
        /// Relative variation of shading.cuticle_tilt between strands.
        float cuticle_tilt_spread; ///< [0, 1]. Default 0.25.
        /// Weight of light that arrives from other fibres by multiple scattering.
        /// HAIR_SHADING_FIBRES only.
        float scattering; ///< [0, 1]. Default 1.
        /// Strength of the white and of the coloured highlight. HAIR_SHADING_LINES only.
        float specular[2]; ///< [0, 4]. Default (0.05, 0.5).
        /// Exponent of the white and of the coloured highlight. HAIR_SHADING_LINES only.
        float gloss[2]; ///< [1, 1000]. Default (60, 15).
        /// Strength of the glitter of the coloured highlight along strands. HAIR_SHADING_LINES
        /// only.
        float sparkle; ///< [0, 1]. Default 0.
    } shading;

    /// Size of strands.
    struct {
        /// Radius of a drawn strand. A drawn strand may stand for several hairs.
        float radius; ///< m. [1e-6, 0.01]. Default 1.5e-4.
        /// Multiple of strand.radius along the strand.
        hair_curve taper; ///< [0, 4]. Default (1, 0.99, 0.96, 0.91, 0.84, 0.74, 0.63, 0.5).
        /// Drawn fraction of the length of every strand. The rest is cut off at the tip.
        float length; ///< [0.01, 1]. Default 1.
        /// Maximum fraction by which strands are shortened at random.
        float length_variation; ///< [0, 1]. Default 0.
        /// Number of line segments of a drawn strand.
        uint32_t segments; ///< [1, 256]. Default 32.
    } strand;

    /// Locks, by the interpolation of followers between guides.
    struct {
        hair_interpolation interpolation; ///< Default HAIR_INTERPOLATION_MIXED.
        /// Blend weight of HAIR_INTERPOLATION_MIXED along the strand. 0 is MULTI. 1 is SINGLE.
        hair_curve weight; ///< [0, 1]. Default (0, 0, 0.07, 0.18, 0.32, 0.46, 0.56, 0.6).
        /// Multiple of the offsets from a single guide along the strand.
        hair_curve width; ///< [0, 4]. Default 1.
    } clump;

    /// Strays and frizz.
    struct {
        /// Fraction of the strands that stray over their whole length.
        float fraction; ///< [0, 1]. Default 0.1.
        /// Displacement of these strands along the strand, as a fraction of their length.
        hair_curve distance; ///< [0, 1]. Default (0, 0, 0.01, 0.02, 0.02, 0.02, 0.02, 0.02).
        /// Fraction of the strands that stray near their tips.
        float tip_fraction; ///< [0, 1]. Default 0.3.
        /// Displacement of these strands along the strand, as a fraction of their length.
        hair_curve tip_distance; ///< [0, 1]. Default (0, 0, 0, 0, 0.001, 0.004, 0.012, 0.025).
        /// Fraction of the strands that have frizz.
        float frizz_fraction; ///< [0, 1]. Default 1.
        /// Amplitude of the frizz of these strands, along the strand.
        hair_curve frizz; ///< m. [0, 0.1]. Default 0.
        /// Length of one wave of the frizz.
        float frizz_wavelength; ///< m. [0.001, 1]. Default 0.015.
    } strays;

    /// Curls and waves. See hair_look_fit_curl().
    struct {
        /// Radius of curls or waves. Curls wind around the path that the strand has without them,
        /// in the frame of its guide. They preserve the reach of the strand, and the drawn strand
        /// is longer. A turn needs about eight strand.segments.
        float radius; ///< m. [0, 0.1]. Default 0.
        /// Multiple of curl.radius along the strand.
        hair_curve profile; ///< [0, 2]. Default (0, 0.6, 0.9, 1, 1, 1, 1, 1).
        /// Length of one turn along the strand.
        float wavelength; ///< m. [0.001, 10]. Default 0.05.
        /// Number of turns from root to tip, in addition to the turns of curl.wavelength.
        float turns; ///< [0, 100]. Default 0.
        /// Flatness of the curls, 0 for a helix and 1 for a wave in a plane.
        float flatness; ///< [0, 1]. Default 0.
        /// Fraction of the guides whose strands turn to the left.
        float left_fraction; ///< [0, 1]. Default 0.
        /// Random phase difference of curls between guides.
        float guide_phase; ///< Turns. [0, 1]. Default 1.
        /// Random phase difference of curls between the strands of one guide.
        float strand_phase; ///< Turns. [0, 1]. Default 0.1.
        /// Relative variation of the radius and the length of turns between strands.
        float spread; ///< [0, 0.9]. Default 0.1.
        /// Relative variation of the radius and the length of turns between guides. Strands of one
        /// guide share the variation.
        float guide_spread; ///< [0, 0.9]. Default 0.
        /// Relative variation of the radius and the length of turns along the strand. Strands of
        /// one guide share the variation.
        float variation; ///< [0, 0.9]. Default 0.
        hair_curl_shape shape; ///< Default HAIR_CURL_SHAPE_HELIX.
        /// First component of the displacement at i/16 of a turn of HAIR_CURL_SHAPE_EXAMPLE, across
        /// the strand, as a multiple of curl.radius.
        float profile_x[16]; ///< [-1, 1]. Default 0.
        /// Second component of this displacement, perpendicular to the first and to the strand.
        float profile_z[16]; ///< [-1, 1]. Default 0.
    } curl;

    /// Shadow of the hair on itself.
    struct {
        hair_self_shadow method; ///< Default HAIR_SELF_SHADOW_DEPTH.
        /// Extinction coefficient of the hair, the mean number of strands that light meets per
        /// metre. HAIR_SELF_SHADOW_DEPTH only, which adds about half a strand that maps do not
        /// show.
        float absorption; ///< 1/m. [0, 10000]. Default 200.
        /// Minimum cell size of the density grid of HAIR_SELF_SHADOW_STRANDS.
        float cell; ///< m. [0.001, 1]. Default 0.004.
    } self_shadow;

    /// Number of followers, and their collision.
    struct {
        /// Fraction of the followers that are drawn.
        float density; ///< [0, 1]. Default 1.
        /// Index into hair_groom_desc.map_sets. A fractional index blends two neighbouring sets.
        float map_set; ///< [0, 3]. Default 0.
        hair_follower_collision collision; ///< Default HAIR_FOLLOWER_COLLISION_PUSH_OUT.
    } followers;

    /// Wetness, which darkens and smooths hair, draws strands together and flattens strays. Water
    /// changes the values above, not the way that they are drawn. HAIR_PRESET_WET makes hair also
    /// move like wet hair.
    float wetness; ///< [0, 1]. Default 0.

    /// Colour of natural hair by its pigments, and dye. Light is absorbed by the melanin of the
    /// fibre (d'Eon et al. 2011) and by the dye, so that dark hair stays dark under a light dye.
    /// See hair_look_find_colors().
    struct {
        /// Blend weight of the colour of the pigments over color.root and color.tip.
        float weight; ///< [0, 1]. Default 0.
        /// Amount of eumelanin, which is black and brown. 0.3 is blond, 1.3 is brown and 8 is black
        /// (Pharr et al. 2023).
        float eumelanin; ///< [0, 20]. Default 1.3.
        /// Amount of pheomelanin, which is red.
        float pheomelanin; ///< [0, 20]. Default 0.2.
        /// Fraction of the pigments, without dye, that sun and washing have left at the tip.
        float tip_fraction; ///< [0, 1]. Default 0.7.
        /// Reflectance of dense hair with the dye and without pigment, linear rgb. White is no dye.
        float dye[3]; ///< [0, 1]. Default 1.
    } pigment;

    /// Ratio of the axes of the elliptic cross section of fibres, for their scattering of light.
    /// Fibres of a lock lie in all directions around their axis, so the mean of all directions is
    /// drawn. Highlights of flat fibres are fainter. HAIR_SHADING_FIBRES only.
    float flatness; ///< [0.2, 1]. Default 1.
} hair_look;
HAIR_DESC(hair_look)

/// Set the look of an instance. The next hair_draw() uses it.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_look(hair_instance* hair, const hair_look* look);

/// Write the look of an instance to `out`, which comes from hair_look_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_look(const hair_instance* hair, hair_look* out);

/// Look of a group of strands, as far as it differs from the look of the instance.
typedef struct hair_group_look {
    hair_struct_header header;
    /// Multiple of the radius of the strands.
    float radius; ///< [0, 4]. Default 1.
    /// Colours of the strands.
    struct {
        /// Switch of the colours below, which replace those of hair_look and of the groom.
        /// Variation, streaks, root darkening and wetness of hair_look apply to them.
        bool enabled; ///< Default false.
        float
            root[3]; ///< Linear rgb reflectance at the root. [0, 1]. Default (0.13, 0.055, 0.024).
        /// Linear rgb reflectance at the tip.
        float tip[3]; ///< [0, 1]. Default (0.26, 0.13, 0.06).
    } color;
    /// Curls and waves, as far as hair_look.curl has them.
    struct {
        /// Multiple of hair_look.curl.radius.
        float radius; ///< [0, 4]. Default 1.
        /// Multiple of the number of turns along the strand.
        float frequency; ///< [0, 4]. Default 1.
    } curl;
    /// Multiple of hair_look.strays.frizz.
    float frizz; ///< [0, 4]. Default 1.
    /// Multiple of the blend weight of locks. See hair_look.clump. 0 is HAIR_INTERPOLATION_MULTI.
    float clump; ///< [0, 1]. Default 1.
    /// Multiple of the roughness along the fibre. Highlights widen in proportion.
    float roughness; ///< [0.2, 4]. Default 1.
} hair_group_look;
HAIR_DESC(hair_group_look)

/// Set the look of one group of strands, see hair_groom_desc.strand_groups. The next hair_draw()
/// uses it. The call uploads the followers or their colours again, so it is not for every frame.
///
/// @param group Group. [0, 7].
/// @param look Look of the group. NULL selects the defaults, which cost nothing.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_group_look(hair_instance* hair, uint32_t group,
                                         const hair_group_look* look);

/// Write the look of one group of strands to `out`, which comes from hair_group_look_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_group_look(const hair_instance* hair, uint32_t group,
                                         hair_group_look* out);

// Presets of shape --------------------------------------------------------------------------------

/// Preset of the shape of strands, for hair_look_apply_preset().
typedef enum hair_look_preset {
    HAIR_LOOK_NATURAL = 0, ///< The defaults.
    HAIR_LOOK_STRAIGHT, ///< Sleek, with hardly any strays.
    HAIR_LOOK_WAVY, ///< Locks in flat waves of 85 mm.
    HAIR_LOOK_CURLY, ///< Curling locks, 24 mm wide, with a turn every 50 mm.
    HAIR_LOOK_COILY, ///< Curling strands, 9 mm wide, with a turn every 18 mm.
    HAIR_LOOK_FRIZZY, ///< Frizz of every strand.
    HAIR_LOOK_SHORT, ///< A third of the length, uneven.
    // Types of Walker's scale, by the diameter of a curl and the length of a turn along it. The
    // diameters of types 3 and 4 are those of the objects that hairdressers compare curls with.
    // Lengths of turns have no published source.
    HAIR_LOOK_2A, ///< Loose waves near the tips, 18 mm wide, 120 mm long.
    HAIR_LOOK_2B, ///< Waves from half the length, 20 mm wide, 90 mm long.
    HAIR_LOOK_2C, ///< Deep waves, 22 mm wide, 65 mm long.
    HAIR_LOOK_3A, ///< Loose curls, 25 mm wide as sidewalk chalk, 55 mm long.
    HAIR_LOOK_3B, ///< Ringlets, 14 mm wide as a marker, 34 mm long.
    HAIR_LOOK_3C, ///< Corkscrews, 8 mm wide as a pencil, 21 mm long.
    HAIR_LOOK_4A, ///< Coils, 5 mm wide as a crochet hook, 13 mm long.
    HAIR_LOOK_4B, ///< Zigzag coils, 4 mm wide as the spring of a pen, 9 mm long.
    HAIR_LOOK_4C, ///< Tight coils, 3 mm wide as a coffee stirrer, 7 mm long.
    HAIR_LOOK_COUNT
} hair_look_preset;

/// Apply a preset of shape to a look. The call sets strand.taper, strand.length and
/// strand.length_variation, and all members of `clump`, `strays` and `curl`. It raises
/// strand.segments to the number that the turns of 0.4 m of hair need. Other members keep their
/// values. Diameters and lengths of turns hold where curl.profile is 1.
///
/// @param look Look to change, from hair_look_default().
/// @param preset Preset below HAIR_LOOK_COUNT.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION. They are not logged.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_look_apply_preset(hair_look* look, hair_look_preset preset);

/// Return the name of a preset, such as "natural", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_look_name(hair_look_preset preset);

/// Fit the curls of a look to an example, which is one turn or wave of a strand. The look repeats
/// the example. Sets `shape`, `profile_x`, `profile_z`, `radius`, `wavelength` and `turns` of
/// hair_look.curl.
///
/// @param look Look to change, from hair_look_default().
/// @param positions Vertices of the example in order, xyz each, in m. The axis of the curl is the
///     direction from the first vertex to the last. These are 0.001 to 10 m apart. No vertex is
///     farther than 0.1 m from the axis.
/// @param vertex_count Number of vertices. [3, 65536].
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION. They are not logged.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_look_fit_curl(hair_look* look, const float* positions,
                                        uint32_t vertex_count);

// Presets of colour -------------------------------------------------------------------------------

/// Preset of the colour of strands, for hair_look_color().
typedef enum hair_color {
    HAIR_COLOR_BROWN = 0, ///< The defaults.
    HAIR_COLOR_DARK_BROWN,
    HAIR_COLOR_BLACK,
    HAIR_COLOR_BLOND,
    HAIR_COLOR_RED,
    HAIR_COLOR_AUBURN,
    HAIR_COLOR_GRAY,
    HAIR_COLOR_WHITE,
    HAIR_COLOR_BLUE, ///< Dyed hair.
    HAIR_COLOR_COUNT
} hair_color;

/// Set color.root, color.tip and color.spread of a look, and pigment.weight to 0. Other members
/// keep their values.
///
/// @param look Look to change, from hair_look_default().
/// @param color Colour below HAIR_COLOR_COUNT.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION. They are not logged.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_look_color(hair_look* look, hair_color color);

/// Compute the reflectance of dense dry hair at the root and at the tip, linear rgb. These are
/// color.root and color.tip, blended with the colour of hair_look.pigment. The latter depends on
/// shading.roughness around the fibre. Brows and short hair of an application can follow them.
///
/// @param look Look, from hair_look_default().
/// @param root Receives the reflectance at the root.
/// @param tip Receives the reflectance at the tip.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION. They are not logged.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_look_find_colors(const hair_look* look, float root[3], float tip[3]);

/// Return the name of a colour, such as "dark_brown", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_color_name(hair_color color);

#endif
