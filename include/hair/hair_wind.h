/// hair_wind.h - wind: ambient, local sources, turbulence and a fluid.
///
/// The set calls below take effect with the next hair_step().
#ifndef HAIR_HAIR_WIND_H
#define HAIR_HAIR_WIND_H

#include <hair/hair_base.h>

// Wind --------------------------------------------------------------------------------------------

/// Model of the air flow around head and colliders.
typedef enum hair_wind_model {
    /// Formulas. See hair_wind.shelter. Cheap.
    HAIR_WIND_AMBIENT = 0,
    /// A fluid on a grid around the hair, with the wakes of the head and of all colliders in the
    /// field. The fluid advances by 1/60 s, or by a substep if that is longer. hair_reset() and
    /// hair_teleport() restart the fluid with the ambient wind. hair_load() restarts it too, unless
    /// hair_wind.fluid.resolution and hair_wind.fluid.grid_size equal the saved ones.
    HAIR_WIND_FLUID
} hair_wind_model;

/// Pressure projection method of the fluid. With the default number of iterations, less than a
/// thousandth of the divergence is left.
typedef enum hair_projection {
    HAIR_PROJECTION_MULTIGRID = 0, ///< Multigrid cycles. By far the fastest. Default.
    HAIR_PROJECTION_RELAXATION, ///< Successive over-relaxation of Gauss-Seidel sweeps.
    HAIR_PROJECTION_JACOBI ///< Jacobi sweeps (Tariq 2010).
} hair_projection;

/// A local wind source, added to the ambient wind. Start from hair_wind_source_default().
typedef struct hair_wind_source {
    float position[3]; ///< Centre of the mouth in the world. m. [-1e9, 1e9]. Default 0.
    /// Direction of a jet in the world, of any length. 0 makes a source that blows in all
    /// directions.
    float direction[3]; ///< [-1e6, 1e6]. Default 0.
    /// Speed of the air at the mouth. A source without a direction draws air in if its speed is
    /// negative.
    float speed; ///< m/s. [-1000, 1000]. Default 5.
    float radius; ///< Radius of the mouth. m. [0.001, 100]. Default 0.05.
} hair_wind_source;
HAIR_PLAIN_DESC(hair_wind_source)

/// Wind and its drag on guides.
///
/// Guides have the drag of cylinders of hair_physics.fiber.radius. Across a guide, the drag
/// coefficient is 1 + 9.75 Re^-0.744, the form of White 1991, with the Reynolds number Re. Along a
/// guide, the drag follows from the analogy of momentum and heat transfer. Guides stand for locks,
/// whose hairs shelter each other. For this reason hair_physics.drag is below 1 by default.
/// hair_physics.damping stands for the drag of the same air. Across and along a guide, therefore,
/// the greater of damping and the law acts.
typedef struct hair_wind {
    hair_struct_header header;
    hair_wind_model model; ///< Default HAIR_WIND_AMBIENT.
    float velocity[3]; ///< Velocity of the air in the world. m/s. [-1000, 1000]. Default 0.
    /// Drag law in still air. True applies the law also where no wind blows, at the cost of a wind.
    /// A level hair then falls at 0.47 m/s when hair_physics.drag is 1. False leaves still air to
    /// hair_physics.damping, whose default lets every hair fall at 2.45 m/s.
    bool still_air; ///< Default false.
    /// Strength with which spheres divert ambient wind and gusts, by potential flow upstream and a
    /// wake downstream. The spheres are the head, estimated from the roots, and the largest
    /// colliders of at most 0.5 m around it.
    float shelter; ///< [0, 1]. Default 1.
    float density; ///< Density of the air. kg/m^3. [0.001, 1000]. Default 1.204.
    float viscosity; ///< Dynamic viscosity of the air. Pa s. [1e-7, 1]. Default 1.82e-5.
    /// Turbulence of the wind.
    struct {
        /// Turbulence intensity of gusts, the standard deviation of each component of the velocity
        /// as a fraction of the wind's speed. The turbulence is isotropic with von Karman's
        /// spectrum, and the wind carries it along.
        float intensity; ///< [0, 2]. Default 0.
        /// Integral length scale of the turbulence. Gusts are several times as long.
        float length; ///< m. [0.1, 1000]. Default 1.
        uint32_t seed; ///< Seed of the turbulence. Default 1.
    } turbulence;
    /// Local sources, source_count of them. They are copied. NULL if there are none.
    const hair_wind_source* sources; ///< Default NULL.
    uint32_t source_count; ///< Number of local sources. [0, 4]. Default 0.
    /// 3D OpenGL texture of floats with a wind field of the application, added to the other wind.
    /// Texels hold xyz in m/s along the world axes. Every step reads the texture. Values that are
    /// not finite, positions outside the texture and a deleted texture count as 0. 0 disables it.
    uint32_t texture; ///< Default 0.
    /// Affine transform from the world to texture coordinates.
    float texture_transform[16]; ///< Default identity.
    /// Parameters of HAIR_WIND_FLUID.
    struct {
        /// Number of grid cells along a side of the fluid, rounded up to a multiple of 16.
        uint32_t resolution; ///< [16, 128]. Default 32.
        /// Side length of the fluid's grid. HAIR_AUTO is 1.5 times the longest side of the field.
        float grid_size; ///< m. [0, 100]. Default HAIR_AUTO.
        hair_projection projection; ///< Default HAIR_PROJECTION_MULTIGRID.
        /// Number of cycles or sweeps of the projection per 1/60 s. HAIR_AUTO selects a sufficient
        /// number.
        uint32_t projection_iterations; ///< [0, 10000]. Default HAIR_AUTO.
        /// Number of strands that slow the fluid, like a porous medium. They lie where the guides
        /// are. Each strand takes from the air the force that hair_physics.drag gives to a guide. A
        /// scalp has about 100000. 0 lets the fluid flow through hair without resistance.
        uint32_t drag_strand_count; ///< [0, 10000000]. Default 0.
    } fluid;
} hair_wind;
HAIR_DESC(hair_wind)

/// Set the wind of an instance. Turbulence continues without a jump, and hair_reset() restarts it.
/// HAIR_SOLVER_REDBLACK ignores wind.
///
/// @param wind Wind, copied. NULL or the defaults disable wind at no cost.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION. HAIR_ERROR_OPENGL with a texture only.
/// OpenGL: required only with hair_wind.texture. Does not wait for the GPU.
HAIR_API hair_result hair_set_wind(hair_instance* hair, const hair_wind* wind);

/// Write the wind of an instance to `out`, which comes from hair_wind_default(). `sources` points
/// to memory of the instance, and is valid until the next hair_set_wind() or hair_destroy().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_wind(const hair_instance* hair, hair_wind* out);

#endif
