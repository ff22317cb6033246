BEGIN(hair_look)
#undef GROUP
#define GROUP "color"
COLOR(hair_look, color.root, 0.13, 0.055, 0.024, 0, 1, 0, 1, "",
      "Reflectance of dense hair at the root, linear rgb.")
COLOR(hair_look, color.tip, 0.26, 0.13, 0.06, 0, 1, 0, 1, "",
      "Reflectance of dense hair at the tip, linear rgb.")
FLOAT(hair_look, color.spread, 0.4, 0, 1, 0, 1, LINEAR, "",
      "Relative variation of brightness between strands.")
FLOAT(hair_look, color.hue_spread, 0, 0, 1, 0, 1, LINEAR, "",
      "Relative variation of red against blue between strands.")
CURVE(hair_look, color.tint_red, 1, 1, 1, 1, 1, 1, 1, 1, 0, 4, 0, 2, "",
      "Multiple of the red of color.root to color.tip.")
CURVE(hair_look, color.tint_green, 1, 1, 1, 1, 1, 1, 1, 1, 0, 4, 0, 2, "",
      "Multiple of the green of color.root to color.tip.")
CURVE(hair_look, color.tint_blue, 1, 1, 1, 1, 1, 1, 1, 1, 0, 4, 0, 2, "",
      "Multiple of the blue of color.root to color.tip.")
FLOAT(hair_look, color.root_darkening, 0, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the colour that is lost at the root.")
FLOAT(hair_look, color.root_darkening_length, 0.15, 0.001, 1, 0.01, 0.5, LINEAR, "",
      "Fraction of the strand over which the colour recovers from color.root_darkening.")
FLOAT(hair_look, color.streaks, 0, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the strands that have color.streak_color.")
COLOR(hair_look, color.streak_color, 0.6, 0.42, 0.22, 0, 1, 0, 1, "",
      "Reflectance of these strands from root to tip, linear rgb.")
FLOAT(hair_look, color.streak_clumping, 0.8, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the strands that have a streak exactly when their guide has one.")
FLOAT(hair_look, color.groom_colors, 1, 0, 1, 0, 1, LINEAR, "",
      "Blend weight of hair_groom_desc.colors, if the groom has them, over the colours from color.root "
      "to color.tip.")
#undef GROUP
#define GROUP "shading"
ENUM(hair_look, shading.model, HAIR_SHADING_FIBRES,
      "Model of light scattering by strands.", "fibres", "lines")
PAIR(hair_look, shading.roughness, 0.3, 0.4, "along", "round", 0.05, 1, 0.1, 0.8, LINEAR, "",
      "Roughness along and around the fibre.")
FLOAT(hair_look, shading.roughness_spread, 0, 0, 1, 0, 1, LINEAR, "",
      "Relative variation of shading.roughness between strands.")
FLOAT(hair_look, shading.cuticle_tilt, 0.05, 0, 0.3, 0, 0.15, LINEAR, "radians",
      "Tilt of the cuticle scales, which shifts the highlights.")
FLOAT(hair_look, shading.cuticle_tilt_spread, 0.25, 0, 1, 0, 1, LINEAR, "",
      "Relative variation of shading.cuticle_tilt between strands.")
FLOAT(hair_look, shading.scattering, 1, 0, 1, 0, 1, LINEAR, "",
      "Weight of light that arrives from other fibres by multiple scattering.")
PAIR(hair_look, shading.specular, 0.05, 0.5, "white", "tinted", 0, 4, 0, 1, LINEAR, "",
      "Strength of the white and of the coloured highlight.")
PAIR(hair_look, shading.gloss, 60, 15, "white", "tinted", 1, 1000, 5, 200, LOG, "",
      "Exponent of the white and of the coloured highlight.")
FLOAT(hair_look, shading.sparkle, 0, 0, 1, 0, 1, LINEAR, "",
      "Strength of the glitter of the coloured highlight along strands.")
#undef GROUP
#define GROUP "strand"
FLOAT(hair_look, strand.radius, 1.5e-4, 1e-6, 0.01, 3e-5, 1e-3, LOG, "m", "Radius of a drawn strand.")
CURVE(hair_look, strand.taper, 1, 0.99, 0.96, 0.91, 0.84, 0.74, 0.63, 0.5, 0, 4, 0, 1.5, "",
      "Multiple of strand.radius along the strand.")
FLOAT(hair_look, strand.length, 1, 0.01, 1, 0.05, 1, LINEAR, "",
      "Drawn fraction of the length of every strand.")
FLOAT(hair_look, strand.length_variation, 0, 0, 1, 0, 1, LINEAR, "",
      "Maximum fraction by which strands are shortened at random.")
UINT(hair_look, strand.segments, 32, 1, 256, 4, 64, LINEAR, "", "Number of line segments of a drawn strand.")
#undef GROUP
#define GROUP "clump"
ENUM(hair_look, clump.interpolation, HAIR_INTERPOLATION_MIXED,
      "Interpolation of followers between guides.", "mixed", "single", "multi")
CURVE(hair_look, clump.weight, 0, 0, 0.07, 0.18, 0.32, 0.46, 0.56, 0.6, 0, 1, 0, 1, "",
      "Blend weight of HAIR_INTERPOLATION_MIXED along the strand.")
CURVE(hair_look, clump.width, 1, 1, 1, 1, 1, 1, 1, 1, 0, 4, 0, 2, "",
      "Multiple of the offsets from a single guide along the strand.")
#undef GROUP
#define GROUP "strays"
FLOAT(hair_look, strays.fraction, 0.1, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the strands that stray over their whole length.")
CURVE(hair_look, strays.distance, 0, 0, 0.01, 0.02, 0.02, 0.02, 0.02, 0.02, 0, 1, 0, 0.1, "",
      "Displacement of these strands along the strand, as a fraction of their length.")
FLOAT(hair_look, strays.tip_fraction, 0.3, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the strands that stray near their tips.")
CURVE(hair_look, strays.tip_distance, 0, 0, 0, 0, 0.001, 0.004, 0.012, 0.025, 0, 1, 0, 0.1, "",
      "Displacement of these strands along the strand, as a fraction of their length.")
FLOAT(hair_look, strays.frizz_fraction, 1, 0, 1, 0, 1, LINEAR, "", "Fraction of the strands that have frizz.")
CURVE(hair_look, strays.frizz, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0, 0.01, "m",
      "Amplitude of the frizz of these strands, along the strand.")
FLOAT(hair_look, strays.frizz_wavelength, 0.015, 0.001, 1, 0.003, 0.1, LOG, "m",
      "Length of one wave of the frizz.")
#undef GROUP
#define GROUP "curl"
FLOAT(hair_look, curl.radius, 0, 0, 0.1, 0, 0.03, LINEAR, "m", "Radius of curls or waves.")
CURVE(hair_look, curl.profile, 0, 0.6, 0.9, 1, 1, 1, 1, 1, 0, 2, 0, 1.5, "",
      "Multiple of curl.radius along the strand.")
FLOAT(hair_look, curl.wavelength, 0.05, 0.001, 10, 0.01, 0.3, LOG, "m",
      "Length of one turn along the strand.")
FLOAT(hair_look, curl.turns, 0, 0, 100, 0, 20, LINEAR, "",
      "Number of turns from root to tip, in addition to the turns of curl.wavelength.")
FLOAT(hair_look, curl.flatness, 0, 0, 1, 0, 1, LINEAR, "",
      "Flatness of the curls, 0 for a helix and 1 for a wave in a plane.")
FLOAT(hair_look, curl.left_fraction, 0, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the guides whose strands turn to the left.")
FLOAT(hair_look, curl.guide_phase, 1, 0, 1, 0, 1, LINEAR, "turns",
      "Random phase difference of curls between guides.")
FLOAT(hair_look, curl.strand_phase, 0.1, 0, 1, 0, 1, LINEAR, "turns",
      "Random phase difference of curls between the strands of one guide.")
FLOAT(hair_look, curl.spread, 0.1, 0, 0.9, 0, 0.5, LINEAR, "",
      "Relative variation of the radius and the length of turns between strands.")
FLOAT(hair_look, curl.guide_spread, 0, 0, 0.9, 0, 0.5, LINEAR, "",
      "Relative variation of the radius and the length of turns between guides.")
FLOAT(hair_look, curl.variation, 0, 0, 0.9, 0, 0.5, LINEAR, "",
      "Relative variation of the radius and the length of turns along the strand.")
ENUM(hair_look, curl.shape, HAIR_CURL_SHAPE_HELIX,
      "Cross section of curls, perpendicular to their axis.", "helix", "example")
ARRAY(hair_look, curl.profile_x, 16, -1, 1,
      "First component of the displacement at i/16 of a turn of HAIR_CURL_SHAPE_EXAMPLE, across the "
      "strand, as a multiple of curl.radius.")
ARRAY(hair_look, curl.profile_z, 16, -1, 1,
      "Second component of this displacement, perpendicular to the first and to the strand.")
#undef GROUP
#define GROUP "self_shadow"
ENUM(hair_look, self_shadow.method, HAIR_SELF_SHADOW_DEPTH, "Self-shadowing method.", "depth", "strands")
FLOAT(hair_look, self_shadow.absorption, 200, 0, 10000, 0, 1000, LINEAR, "1/m",
      "Extinction coefficient of the hair, the mean number of strands that light meets per metre.")
FLOAT(hair_look, self_shadow.cell, 0.004, 0.001, 1, 0.002, 0.02, LOG, "m",
      "Minimum cell size of the density grid of HAIR_SELF_SHADOW_STRANDS.")
#undef GROUP
#define GROUP "followers"
FLOAT(hair_look, followers.density, 1, 0, 1, 0, 1, LINEAR, "", "Fraction of the followers that are drawn.")
FLOAT(hair_look, followers.map_set, 0, 0, 3, 0, 3, LINEAR, "", "Index into hair_groom_desc.map_sets.")
ENUM(hair_look, followers.collision, HAIR_FOLLOWER_COLLISION_PUSH_OUT,
      "Handling of followers that enter colliders which their guides miss.", "push_out", "single_guide",
      "none")
#undef GROUP
#define GROUP ""
FLOAT(hair_look, wetness, 0, 0, 1, 0, 1, LINEAR, "",
      "Wetness, which darkens and smooths hair, draws strands together and flattens strays.")
#undef GROUP
#define GROUP "pigment"
FLOAT(hair_look, pigment.weight, 0, 0, 1, 0, 1, LINEAR, "",
      "Blend weight of the colour of the pigments over color.root and color.tip.")
FLOAT(hair_look, pigment.eumelanin, 1.3, 0, 20, 0.05, 10, LOG, "",
      "Amount of eumelanin, which is black and brown.")
FLOAT(hair_look, pigment.pheomelanin, 0.2, 0, 20, 0, 5, LINEAR, "",
      "Amount of pheomelanin, which is red.")
FLOAT(hair_look, pigment.tip_fraction, 0.7, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the pigments, without dye, that sun and washing have left at the tip.")
COLOR(hair_look, pigment.dye, 1, 1, 1, 0, 1, 0, 1, "",
      "Reflectance of dense hair with the dye and without pigment, linear rgb.")
#undef GROUP
#define GROUP ""
FLOAT(hair_look, flatness, 1, 0.2, 1, 0.2, 1, LINEAR, "",
      "Ratio of the axes of the elliptic cross section of fibres, for their scattering of light.")
END
BEGIN(hair_group_look)
FLOAT(hair_group_look, radius, 1, 0, 4, 0, 4, LINEAR, "", "Multiple of the radius of the strands.")
#undef GROUP
#define GROUP "color"
BOOL(hair_group_look, color.enabled, false,
      "Switch of the colours below, which replace those of hair_look and of the groom.")
COLOR(hair_group_look, color.root, 0.13, 0.055, 0.024, 0, 1, 0, 1, "",
      "Linear rgb reflectance at the root.")
COLOR(hair_group_look, color.tip, 0.26, 0.13, 0.06, 0, 1, 0, 1, "", "Linear rgb reflectance at the tip.")
#undef GROUP
#define GROUP "curl"
FLOAT(hair_group_look, curl.radius, 1, 0, 4, 0, 4, LINEAR, "", "Multiple of hair_look.curl.radius.")
FLOAT(hair_group_look, curl.frequency, 1, 0, 4, 0, 4, LINEAR, "",
      "Multiple of the number of turns along the strand.")
#undef GROUP
#define GROUP ""
FLOAT(hair_group_look, frizz, 1, 0, 4, 0, 4, LINEAR, "", "Multiple of hair_look.strays.frizz.")
FLOAT(hair_group_look, clump, 1, 0, 1, 0, 1, LINEAR, "", "Multiple of the blend weight of locks.")
FLOAT(hair_group_look, roughness, 1, 0.2, 4, 0.2, 4, LINEAR, "", "Multiple of the roughness along the fibre.")
END
