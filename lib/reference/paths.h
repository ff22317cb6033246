/// paths.h - light among fibres of hair by the paths that it takes from strand to strand, in double precision.
#ifndef HAIR_REFERENCE_PATHS_H
#define HAIR_REFERENCE_PATHS_H

#include "lib/reference/fibre.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HAIR_REFERENCE_MOST_COLORS 16 ///< Channels, three to a colour as one sees it.
#define HAIR_REFERENCE_MOST_LIGHTS 8

/// Strands of one radius that are straight between vertices. One scatters light as one fibre does, from where a ray passes
/// nearest to its axis, and does not hide itself.
struct hair_reference_hair {
    const float* positions; ///< count * each * 3, from root to tip. m.
    uint32_t count;
    uint32_t each; ///< Vertices.
    double radius; ///< m.
    struct hair_reference_fibre fibre;
    const double* mu; ///< Per colour: absorption per radius.
    uint32_t colors;
    const double* to_light; ///< Per light 3: unit, towards it. Far off, of irradiance 1.
    uint32_t lights;
    double sky; ///< Radiance on all sides.
};

/// Of all rays that meet hair.
struct hair_reference_glow {
    uint64_t met; ///< Rays.
    /// Mean radiance of each light and colour; that of the sky is in the first light's.
    double often[HAIR_REFERENCE_MOST_LIGHTS][HAIR_REFERENCE_MOST_COLORS];
    double once[HAIR_REFERENCE_MOST_LIGHTS]
               [HAIR_REFERENCE_MOST_COLORS]; ///< Of light that one strand has scattered.
    double error[HAIR_REFERENCE_MOST_LIGHTS][HAIR_REFERENCE_MOST_COLORS]; ///< Standard error of `often`.
};

/// Of rays from `from` on along `way`, 3 each, ways unit. seed: any.
void hair_reference_paths(const struct hair_reference_hair* hair, const double* from, const double* way,
                          uint64_t rays, uint64_t seed, struct hair_reference_glow* out);

#ifdef __cplusplus
}
#endif

#endif
