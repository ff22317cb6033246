/// paths.h - Path tracing of light among hair fibres, in double precision.
#ifndef HAIR_TESTS_REFERENCE_PATHS_H
#define HAIR_TESTS_REFERENCE_PATHS_H

#include "tests/reference/fibre.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HAIR_REFERENCE_MAX_COLORS 16 ///< Channels, three per RGB colour.
#define HAIR_REFERENCE_MAX_LIGHTS 8

/// Strands of one radius that are straight between vertices. A strand scatters light as one fibre
/// does, at the point of its axis closest to the ray. It does not occlude itself.
struct hair_reference_hair {
    const float* positions; ///< count * each * 3 numbers from root to tip, m.
    uint32_t count;
    uint32_t each; ///< Vertices per strand.
    double radius; ///< m.
    struct hair_reference_fibre fibre;
    const double* mu; ///< Absorption per radius of each colour.
    uint32_t colors;
    /// Unit vectors towards distant lights of irradiance 1, 3 numbers per light.
    const double* to_light;
    uint32_t lights;
    double sky; ///< Radiance of a uniform sky.
};

/// Results over all rays that hit hair.
struct hair_reference_glow {
    uint64_t met; ///< Number of rays that hit hair.
    /// Mean radiance per light and colour. The first light includes the sky.
    double often[HAIR_REFERENCE_MAX_LIGHTS][HAIR_REFERENCE_MAX_COLORS];
    /// Part scattered by one strand only.
    double once[HAIR_REFERENCE_MAX_LIGHTS][HAIR_REFERENCE_MAX_COLORS];
    /// Standard error of `often`.
    double error[HAIR_REFERENCE_MAX_LIGHTS][HAIR_REFERENCE_MAX_COLORS];
};

/// Trace rays from `from` along the unit vectors `way`, 3 numbers each. `seed` is the seed of the
/// random numbers.
void hair_reference_paths(const struct hair_reference_hair* hair, const double* from, const double* way,
                          uint64_t rays, uint64_t seed, struct hair_reference_glow* out);

#ifdef __cplusplus
}
#endif

#endif
