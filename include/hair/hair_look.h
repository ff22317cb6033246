/// hair_look.h - shape, colour and shading of strands.
#ifndef HAIR_HAIR_LOOK_H
#define HAIR_HAIR_LOOK_H

#include <hair/hair_base.h>

/// What becomes of followers that come into colliders, though no guide does. Where there are no colliders in reach, nothing
/// is done and nothing paid for it.
typedef enum hair_follower_collision {
    HAIR_FOLLOWER_COLLISION_PUSH_OUT = 0, ///< Led round them, smoothly, as long as they were; the default.
    HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE, ///< Tariq 2010: below the first vertex inside, each follows its own guide alone.
    HAIR_FOLLOWER_COLLISION_NONE ///< They go through.
} hair_follower_collision;

/// A number along a strand, smooth and without going beyond its neighbours: at[i] at i/7 of the length from the root.
typedef struct hair_curve {
    float at[8];
} hair_curve;

/// The curve that goes evenly from one number to another.
static inline hair_curve hair_curve_line(float root, float tip)
{
    hair_curve curve;
    for (int i = 0; i < 8; ++i) curve.at[i] = root + (tip - root) * (float)i / 7;
    return curve;
}

/// What followers between guides are made of. Those that a groom of full strands binds have one guide each.
typedef enum hair_interpolation {
    HAIR_INTERPOLATION_MIXED = 0, ///< Both of the below, by hair_look.clump along the strand.
    HAIR_INTERPOLATION_SINGLE, ///< Tariq 2010: offsets from one guide, in its frame. Locks, at worst ropes.
    HAIR_INTERPOLATION_MULTI ///< Tariq 2010: the weighted mean of three guides. Full and even.
} hair_interpolation;

typedef enum hair_curl_shape {
    HAIR_CURL_SHAPE_HELIX = 0, ///< A circle a turn.
    HAIR_CURL_SHAPE_EXAMPLE ///< curl_profile_x and curl_profile_z: see hair_look_fit_curl.
} hair_curl_shape;

/// How strands scatter light.
typedef enum hair_shading {
    HAIR_SHADING_FIBRES =
        0, ///< Marschner et al. 2003, Zinke et al. 2008: light goes through strands; the default.
    HAIR_SHADING_LINES ///< Kajiya and Kay 1989 with two highlights: cheaper, needs no table.
} hair_shading;

/// How light is found that hair leaves to itself.
typedef enum hair_self_shadow {
    /// At every vertex that is drawn, by how far it lies behind what its light's hair_shadow_map shows, times
    /// hair_look.absorption. Needs no memory, and tells little of single strands.
    HAIR_SELF_SHADOW_DEPTH = 0,
    /// Once for the vertices of all strands, which takes memory for them: by what lies along their segments in front of them
    /// in the hair_shadow_map, and by a grid of how much hair there is, which also knows about lights that have no
    /// hair_shadow_map, about the sky, and about hair_set_colliders. For views of one hair_view.frame_index it is found once.
    HAIR_SELF_SHADOW_STRANDS
} hair_self_shadow;

/// How hair looks. What strays, kinks and curls is off where its share, curve or radius is 0, and costs nothing then. A
/// curve that is not 0 at the root takes it off the scalp.
typedef struct hair_look {
    hair_struct_header header;
    float root_color[3]; ///< Reflectance of much hair at the root. [0, 1]. Default (0.13, 0.055, 0.024).
    float tip_color[3]; ///< The same at the tip. [0, 1]. Default (0.26, 0.13, 0.06).
    float color_spread; ///< Relative spread of brightness between strands. [0, 1]. Default 0.4.
    hair_shading shading; ///< Default HAIR_SHADING_FIBRES.
    float roughness[2]; ///< Of fibres, along and round them. [0.05, 1]. Default (0.3, 0.4).
    float cuticle_tilt; ///< Of the scales of fibres, which moves highlights. Radians. [0, 0.3]. Default 0.05.
    float scattering; ///< Share of the light from other fibres that is heeded. [0, 1]. Default 1.
    float specular[2]; ///< Of lines: the white and the coloured highlight. [0, 4]. Default (0.05, 0.5).
    float gloss[2]; ///< Of lines: their exponents. [1, 1000]. Default (60, 15).
    float radius; ///< Of a drawn strand; it may stand for several. m. [1e-6, 0.01]. Default 1.5e-4.
    hair_curve taper; ///< As a share of that. [0, 4]. Default (1, 0.99, 0.96, 0.91, 0.84, 0.74, 0.63, 0.5).
    float length; ///< Share of every strand that is drawn, cut off beyond. [0.01, 1]. Default 1.
    /// The most by which strands are shorter at random, as a share.
    float length_variation; ///< [0, 1]. Default 0.
    hair_interpolation interpolation; ///< Default HAIR_INTERPOLATION_MIXED.
    hair_curve clump; ///< 0 multi, 1 single. [0, 1]. Default (0, 0, 0.07, 0.18, 0.32, 0.46, 0.56, 0.6).
    hair_curve clump_width; ///< Offsets from one guide, as a multiple. [0, 4]. Default 1.
    float tip_stray_fraction; ///< Share of the strands that stray near their tips. [0, 1]. Default 0.3.
    /// How far, in lengths.
    hair_curve tip_stray_distance; ///< [0, 1]. Default (0, 0, 0, 0, 0.001, 0.004, 0.012, 0.025).
    float stray_fraction; ///< Share of the strands that stray all along. [0, 1]. Default 0.1.
    /// How far, in lengths.
    hair_curve stray_distance; ///< [0, 1]. Default (0, 0, 0.01, 0.02, 0.02, 0.02, 0.02, 0.02).
    hair_curve frizz; ///< How far every strand kinks. m. [0, 0.1]. Default 0.
    float frizz_wavelength; ///< From one of its kinks to the next. m. [0.001, 1]. Default 0.015.
    /// Strands turn about the way they would go, in the frame that their guide carries: what they reach stays, and the
    /// strand that is drawn is longer. Turns need some eight `segments` each.
    float curl_radius; ///< Of curls or waves. m. [0, 0.1]. Default 0.
    hair_curve curl_profile; ///< Along the strand, a multiple. [0, 2]. Default (0, 0.6, 0.9, 1, 1, 1, 1, 1).
    float curl_wavelength; ///< Along the strand, of a turn. m. [0.001, 10]. Default 0.05.
    float curl_turns; ///< Beside those, turns from root to tip. [0, 100]. Default 0.
    float curl_flatness; ///< From 0, a helix, to 1, a wave in a plane. [0, 1]. Default 0.
    float curl_left_fraction; ///< Share of the guides whose strands turn to the left. [0, 1]. Default 0.
    float curl_guide_phase; ///< How far apart guides are in their turns. Turns. [0, 1]. Default 1.
    float curl_strand_phase; ///< The same of the strands of one guide. Turns. [0, 1]. Default 0.1.
    float curl_spread; ///< Relative spread of radius and length of turns. [0, 0.9]. Default 0.1.
    hair_curl_shape curl_shape; ///< Default HAIR_CURL_SHAPE_HELIX.
    /// At i/16 of a turn, across the strand, as a share of the radius.
    float curl_profile_x[16]; ///< [-1, 1]. Default 0.
    float curl_profile_z[16]; ///< The same at right angles to it. [-1, 1]. Default 0.
    float absorption; ///< Strands that light meets, of HAIR_SELF_SHADOW_DEPTH. 1/m. [0, 10000]. Default 200.
    float density; ///< Share of the followers drawn. [0, 1]. Default 1.
    uint32_t segments; ///< Line segments of a drawn strand. [1, 256]. Default 32.
    /// Of followers with colliders.
    hair_follower_collision follower_collision; ///< Default HAIR_FOLLOWER_COLLISION_PUSH_OUT.
    float map_set; ///< Of the groom's sets of maps, from 0; between two a blend. [0, 3]. Default 0.
    /// Of the colours from root_color to tip_color, at i/7 of the strand and evenly between. At most 1 comes of it.
    hair_curve tint_red; ///< Times the red. [0, 4]. Default 1.
    hair_curve tint_green; ///< Times the green. [0, 4]. Default 1.
    hair_curve tint_blue; ///< Times the blue. [0, 4]. Default 1.
    float hue_spread; ///< Relative spread of red against blue between strands. [0, 1]. Default 0.
    float roughness_spread; ///< Relative spread of roughness between strands. [0, 1]. Default 0.
    float cuticle_tilt_spread; ///< Relative spread of tilt between strands. [0, 1]. Default 0.25.
    float root_darkening; ///< Share of the colour that is lost at the root. [0, 1]. Default 0.
    float root_darkening_length; ///< Share of the strand over which it comes back. [0.001, 1]. Default 0.15.
    float streaks; ///< Share of the strands that have another colour. [0, 1]. Default 0.
    float streak_color[3]; ///< Theirs, from root to tip. [0, 1]. Default (0.6, 0.42, 0.22).
    float streak_clumping; ///< Share of strands that go by what their lock does. [0, 1]. Default 0.8.
    float sparkle; ///< Of lines: how the coloured highlight glitters along strands. [0, 1]. Default 0.
    /// Water makes hair darker and smoother, draws strands together and holds down what strays: it changes the numbers
    /// above, not how they are drawn. How wet hair moves is a preset of hair_physics.
    float wetness; ///< [0, 1]. Default 0.
    /// Share of the colours that the groom has of its own, if any, in those from root_color to tip_color. Spreads, streaks and
    /// root_darkening go on top.
    float groom_colors; ///< [0, 1]. Default 1.
    hair_self_shadow self_shadow; ///< Default HAIR_SELF_SHADOW_DEPTH.
    /// Of HAIR_SELF_SHADOW_STRANDS: cells of its grid, at least.
    float self_shadow_cell; ///< m. [0.001, 1]. Default 0.004.
} hair_look;
HAIR_DESC(hair_look)

typedef enum hair_look_preset {
    HAIR_LOOK_NATURAL = 0, ///< The defaults.
    HAIR_LOOK_STRAIGHT, ///< Sleek: hardly a strand strays.
    HAIR_LOOK_WAVY, ///< Locks in flat waves of 85 mm.
    HAIR_LOOK_CURLY, ///< Locks that turn, 24 mm wide, every 50 mm.
    HAIR_LOOK_COILY, ///< Strands that turn, 9 mm wide, every 18 mm.
    HAIR_LOOK_FRIZZY, ///< Every strand kinks its own way.
    HAIR_LOOK_SHORT, ///< A third of the length, unevenly.
    HAIR_LOOK_COUNT
} hair_look_preset;

/// Make `look`, which its default function has made, of a kind: sets what is from taper to curl_profile_z, raises segments to what
/// turns need in hair of 0.4 m, and leaves the rest. [any thread]
HAIR_API hair_result hair_look_apply_preset(hair_look* look, hair_look_preset preset);
HAIR_API const char*
hair_look_name(hair_look_preset preset); ///< "natural", "straight", … NULL beyond the last.

typedef enum hair_color {
    HAIR_COLOR_BROWN = 0, ///< The defaults.
    HAIR_COLOR_DARK_BROWN,
    HAIR_COLOR_BLACK,
    HAIR_COLOR_BLOND,
    HAIR_COLOR_RED,
    HAIR_COLOR_AUBURN,
    HAIR_COLOR_GRAY,
    HAIR_COLOR_WHITE,
    HAIR_COLOR_BLUE, ///< Dyed.
    HAIR_COLOR_COUNT
} hair_color;

/// Colour `look`: sets root_color, tip_color and color_spread. [any thread]
HAIR_API hair_result hair_look_color(hair_look* look, hair_color color);
HAIR_API const char* hair_color_name(hair_color color); ///< "brown", "dark_brown", … NULL beyond the last.

/// Curl `look` as an example does: one turn or wave of a strand, as [3, 65536] vertices of xyz, m, which is repeated. Its
/// axis runs as from its first vertex to its last, [0.001, 10] m apart; no vertex is farther from it than 0.1 m. Sets curl_shape,
/// curl_profile_x, curl_profile_z, curl_radius, curl_wavelength and curl_turns. [any thread]
HAIR_API hair_result hair_look_fit_curl(hair_look* look, const float* positions, uint32_t vertex_count);

HAIR_API hair_result hair_set_look(hair_instance* hair, const hair_look* look);

#endif
