/// hair_physics.h - simulation: solver, material, head and scalp, steps.
///
/// The set calls below take effect with the next hair_step().
#ifndef HAIR_HAIR_PHYSICS_H
#define HAIR_HAIR_PHYSICS_H

#include <hair/hair_base.h>

// Physics -----------------------------------------------------------------------------------------

/// Time integration of the guides. It is chosen when an instance is created, see hair_desc.solver.
typedef enum hair_solver {
    /// Second order, exact lengths, implicit bending. Robust. Default.
    HAIR_SOLVER_DIRECT = 0,
    /// Second order without numerical damping, with shorter substeps. Smallest error.
    HAIR_SOLVER_ACCURATE,
    /// Follow-the-leader in one pass. Cheapest. Never stretches, but does not converge.
    HAIR_SOLVER_FOLLOW,
    /// Verlet integration with red/black constraints in hair_physics.redblack.iterations (Tariq
    /// 2010). Stretches. For comparison.
    HAIR_SOLVER_REDBLACK
} hair_solver;

/// Boundary condition of guides at the root.
typedef enum hair_root {
    HAIR_ROOT_CLAMPED = 0, ///< The scalp holds position and direction.
    HAIR_ROOT_HINGED, ///< The scalp holds the position. The strand turns freely.
    HAIR_ROOT_FREE ///< Nothing holds the strand.
} hair_root;

/// Simulation parameters. Members of `redblack` apply only to HAIR_SOLVER_REDBLACK.
/// HAIR_SOLVER_REDBLACK ignores `drag`, `fiber`, `root`, `tip_mass`, `hair_hair` and
/// collision.friction. Of `shape`, it uses only the frequencies.
typedef struct hair_physics {
    hair_struct_header header;
    /// Acceleration by gravity, in the world.
    float gravity[3]; ///< m/s^2. [-1000, 1000]. Default (0, -9.81, 0).
    /// Decay rate c of the velocity v relative to the velocity u of the air, dv/dt = -c (v - u).
    /// The default stands for the drag of a hair among others. With a `drag` of 0.1, the law of
    /// hair_wind lets a level hair of the default radius and density fall at v = 2.3 m/s. This is a
    /// rate of g / v = 4.3 1/s. Without wind only this rate acts, because it is much cheaper than
    /// the law.
    float damping; ///< 1/s. [0, 1000]. Default 4.
    /// Multiple of the drag law of hair_wind, which holds for a single hair. A lock of n hairs of
    /// diameter d that fill the fraction f of a cylinder has the diameter D = d sqrt(n / f). With
    /// the law's coefficient C, a hair of the lock has D C(Re_D) / (n d C(Re_d)) times the drag of
    /// a single hair. This is 0.1 at 2 m/s for n = 64 and f = 0.3. Use 1 for a single hair.
    float drag; ///< [0, 10]. Default 0.1.
    /// A single hair.
    struct {
        /// Young's modulus of the fibre.
        float youngs_modulus; ///< Pa. [0, 1e12]. Default 4e9.
        /// Poisson's ratio of the fibre. It relates the twist stiffness to the bending stiffness.
        float poisson_ratio; ///< [0, 0.5]. Default 0.45.
        /// Radius of the circle with the area of the fibre's cross section.
        float radius; ///< m. [1e-6, 1e-3]. Default 4e-5.
        /// Mass density of the fibre.
        float density; ///< kg/m^3. [1, 1e5]. Default 1300.
        /// Ratio of the short axis to the long axis of the cross section.
        float flatness; ///< [0.03, 1]. Default 1.
    } fiber;
    /// Resistance of guides to deformation, and their rest shape.
    struct {
        /// Multiple of the bending and twist stiffness at the root. The multiple is linear from
        /// root to tip.
        float stiffness_root; ///< [0, 1e4]. Default 1.
        /// Multiple of the bending and twist stiffness at the tip.
        float stiffness_tip; ///< [0, 1e4]. Default 1.
        /// Frequency of the restoring force to the rest pose at the root. The frequency is linear
        /// from root to tip.
        float frequency_root; ///< Hz. [0, 30]. Default 4.
        /// Frequency of the restoring force to the rest pose at the tip.
        float frequency_tip; ///< Hz. [0, 30]. Default 1.
        /// Fraction of gravity that the rest shape balances. 1 preserves the groom under gravity.
        /// Guides are stiffened, at most three times, until their groom is stable under 1.3 times
        /// that gravity.
        float gravity_preload; ///< [0, 1]. Default 1.
    } shape;
    hair_root root; ///< Default HAIR_ROOT_CLAMPED.
    /// Mass attached to the tip, as a multiple of the mass of the strand.
    float tip_mass; ///< [0, 1e4]. Default 0.
    /// Contact with colliders.
    struct {
        /// Distance that hair keeps from colliders.
        float margin; ///< m. [0, 0.1]. Default 0.001.
        /// Coefficient of Coulomb friction with colliders. hair_collider.friction multiplies it.
        float friction; ///< [0, 10]. Default 0.3.
    } collision;
    /// Interaction of hair with the hair around it.
    struct {
        /// Decay rate of the velocity of hair relative to the rigid motion of the hair around it.
        /// Cohesion and pressure_stiffness preserve the total momentum and angular momentum of the
        /// hair. They do not affect hair that is detached from the head and farther from it than
        /// its own length.
        float cohesion; ///< 1/s. [0, 1000]. Default 0.
        /// Resistance of hair to compression beyond its density at rest, as of a gas, by the square
        /// of the speed of sound. Under gravity g, the density grows by a factor e over the height
        /// pressure_stiffness / g. The speed of sound is limited to one half of a grid cell per
        /// 1/120 s. A cell is at least 1 cm.
        float pressure_stiffness; ///< m^2/s^2. [0, 100]. Default 0.
    } hair_hair;
    /// Multiple of the number of substeps, for level of detail. It is rounded up to 1, 1/2, 1/4,
    /// and so on. Substeps become longer by the same factor, up to 1/60 s. Steps that complete no
    /// substep only advance the interpolation of the drawn hair, which is one substep behind.
    /// HAIR_SOLVER_REDBLACK ignores the rate, because it stretches more with fewer substeps.
    float substep_rate; ///< [0.0625, 1]. Default 1.
    /// Substep rate of hair that has not been visible for 0.25 s, if lower than substep_rate. Hair
    /// is visible if hair_draw() has shown any of it, or if hair_read_positions() has read it. The
    /// step after hair becomes visible again returns to substep_rate without a jump.
    float offscreen_substep_rate; ///< [0.0625, 1]. Default 1.
    /// Distance from equilibrium below which hair falls asleep. hair_step() then calls no OpenGL
    /// and costs almost nothing. Hair wakes when the head moves by a quarter of this distance. It
    /// also wakes when physics, wind, pins, a skinned scalp or colliders within reach change. Wind
    /// that varies in time keeps hair awake. 0 disables sleeping. Hair falls asleep at the same
    /// step in every run, unless the GPU is behind by four steps and 0.1 s. The library does not
    /// wait for such a GPU, and hair then falls asleep later.
    float sleep_threshold; ///< m. [0, 0.01]. Default 1e-4.
    /// Parameters of HAIR_SOLVER_REDBLACK.
    struct {
        /// Frequency of the angular force to the rest angle with the previous segment.
        float angular_hz; ///< Hz. [0, 30]. Default 8.
        /// Fraction of the angular error that the constraint removes per iteration.
        float bend; ///< [0, 1]. Default 0.1.
        /// Number of iterations of the constraints per substep.
        uint32_t iterations; ///< [1, 256]. Default 20.
    } redblack;
} hair_physics;
HAIR_DESC(hair_physics)

/// Set the physics of an instance.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_physics(hair_instance* hair, const hair_physics* physics);

/// Write the physics of an instance to `out`, which comes from hair_physics_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_physics(const hair_instance* hair, hair_physics* out);

/// Set the physics of one group of strands, see hair_groom_desc.strand_groups.
///
/// Only damping, fiber.youngs_modulus, the members of `shape`, and tip_mass can differ by group.
/// All other members must be those of the instance, and follow later calls of hair_set_physics().
/// The group that needs the shortest substeps decides their length for all groups.
///
/// @param group Group. [0, 7].
/// @param physics Physics of the group, from hair_get_group_physics(). NULL gives the group the
///     physics of the instance again. Groups with the physics of the instance cost nothing.
/// Errors: HAIR_ERROR_ARGUMENT, also for HAIR_SOLVER_REDBLACK, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_group_physics(hair_instance* hair, uint32_t group,
                                            const hair_physics* physics);

/// Write the physics of one group of strands to `out`, which comes from hair_physics_default().
/// Groups that have not been set have the physics of the instance.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_group_physics(const hair_instance* hair, uint32_t group,
                                            hair_physics* out);

/// Kinds of hair.
typedef enum hair_preset {
    HAIR_PRESET_NATURAL = 0, ///< The defaults.
    HAIR_PRESET_FINE, ///< Thin and light. Bends easily and comes to rest soon.
    HAIR_PRESET_THICK, ///< Stiff. Swings for long.
    HAIR_PRESET_WET, ///< Heavy and soft, with high friction.
    HAIR_PRESET_FRIZZY, ///< Flat hairs that keep each other apart. Stiff, with high drag.
    HAIR_PRESET_COUNT
} hair_preset;

/// Set fiber.youngs_modulus, fiber.radius, fiber.density, fiber.flatness, shape.stiffness_root,
/// shape.stiffness_tip, damping and collision.friction for a kind of hair. Other members keep their
/// values.
///
/// @param physics Physics to change, from hair_physics_default().
/// @param preset Kind of hair below HAIR_PRESET_COUNT.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION. They are not logged.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_physics_preset(hair_physics* physics, hair_preset preset);

/// Return the name of a kind of hair, such as "natural", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_preset_name(hair_preset preset);

// Head and scalp ----------------------------------------------------------------------------------

/// Move the head. The next step carries the roots to the new pose on the shortest path, evenly over
/// its substeps.
///
/// @param transform Groom to world, column-major. Rigid to 1e-3, with a translation of at most 1e9
///     m per axis.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_transform(hair_instance* hair, const float transform[16]);

/// Write the pose of the head that was set last, by any call. Rounding may change the rotation,
/// because the library keeps it as a quaternion.
///
/// @param transform Receives the transform from groom to world, column-major.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_transform(const hair_instance* hair, float transform[16]);

/// Move the head together with the hair. The hair keeps its shape and its motion relative to the
/// head, and does not swing. Pins of HAIR_PIN_WORLD move along.
///
/// @param transform As for hair_set_transform().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_teleport(hair_instance* hair, const float transform[16]);

/// Set the positions of the scalp's vertices, which the application has skinned. The roots move
/// with the triangles that they are bound to, in position and rotation, evenly over the next step.
///
/// The first call moves the scalp from its rest pose. Call hair_reset() to place the hair without
/// this motion. A scalp that is not set again moves with the head. Therefore set it after every
/// hair_set_transform() that follows a bone of the head. The field, the hair-hair grid and
/// hair_get_bounds() follow the head only, so keep the head near the scalp.
///
/// @param positions xyz per vertex, as floats. [-1e9, 1e9]. They are copied.
/// @param count Number of vertices, that of the groom's scalp.
/// @param stride Distance from one vertex to the next in bytes, a multiple of 4 in [12, 4096].
/// @param to_world Rigid transform from the space of `positions` to the world. NULL if the
///     positions are in the world.
/// Errors: HAIR_ERROR_ARGUMENT, also if the groom has no scalp, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_scalp(hair_instance* hair, const float* positions, uint32_t count,
                                    size_t stride, const float to_world[16]);

/// Set the positions of the scalp's vertices from an OpenGL buffer, in every other respect like
/// hair_set_scalp(). The GPU copies the positions during this call. It sees everything that shaders
/// have written before. Roots on triangles with positions that are not finite keep their pose
/// relative to the head.
///
/// @param gl_buffer Buffer object, not mapped unless persistently.
/// @param offset Offset of the first position in bytes, a multiple of 4.
/// @param stride As for hair_set_scalp().
/// @param to_world As for hair_set_scalp().
/// Errors: HAIR_ERROR_ARGUMENT, also if the groom has no scalp or the buffer is too small,
///     HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_scalp_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset,
                                           size_t stride, const float to_world[16]);

/// Bind the scalp's vertices to joints, so that hair_set_scalp_joints() can skin the scalp on the
/// GPU. Each vertex has four joints. A joint of weight 0 does not move the vertex.
///
/// @param joints Indices of joints, four per vertex, each less than `joint_count`. NULL removes the
///     joints. The other arguments must then be NULL or 0.
/// @param weights Weights of the joints, four per vertex. [0, 1]. Their sum per vertex is 1 within
///     0.01. The library divides by the sum.
/// @param vertex_count Number of vertices, that of the groom's scalp.
/// @param joint_count Number of joints. [1, 65536].
/// Errors: HAIR_ERROR_ARGUMENT, also if the groom has no scalp, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_scalp_weights(hair_instance* hair, const uint16_t* joints,
                                            const float* weights, uint32_t vertex_count,
                                            uint32_t joint_count);

/// Set the positions of the scalp's vertices by joints, in every other respect like
/// hair_set_scalp(). The library skins the scalp at rest on the GPU: a vertex moves to the mean of
/// the positions that its joints would give it, by the weights of hair_set_scalp_weights().
///
/// @param matrices Affine matrix per joint, column-major: the pose of the joint times the inverse
///     of its bind pose. It takes a position in the groom's space to the joints' space. Each number
///     is in [-1e9, 1e9].
/// @param joint_count Number of joints, that of hair_set_scalp_weights().
/// @param to_world Rigid transform from the joints' space to the world. NULL if the joints are in
///     the world.
/// Errors: HAIR_ERROR_ARGUMENT, also without hair_set_scalp_weights(), HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_scalp_joints(hair_instance* hair, const float* matrices,
                                           uint32_t joint_count, const float to_world[16]);

// Steps -------------------------------------------------------------------------------------------

/// Advance the simulation.
///
/// A step consists of substeps of fixed length, see hair_desc.substep. The motion does not depend
/// on the frame rate, because the drawn hair is interpolated to the current time. The same inputs
/// give the same bits on the same driver, except as hair_physics.sleep_threshold says.
///
/// @param dt Time in s, at least 0. 0 does nothing but count as a frame of hair_set_budget(). A
///     time beyond hair_desc.max_dt is shortened to max_dt, with one warning in the log.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required unless the hair is asleep. Does not wait for the GPU.
HAIR_API hair_result hair_step(hair_instance* hair, float dt);

/// Advance many instances by the same time. The result is that of hair_step() for each of them, to
/// the bit.
///
/// A GPU computes the instances side by side, which takes a small part of the time that single
/// calls take for small heads. hair_report() counts the stages of this call, but neither
/// hair_report() nor hair_get_timings() has times of them. An instance that fails stays as it was,
/// and the others are stepped.
///
/// @param list Instances of one context, each at most once. May be NULL if `count` is 0.
/// @param count Number of instances.
/// @param dt As in hair_step(). The max_dt of each instance applies.
/// Errors: those of hair_step(), the first of any instance. HAIR_ERROR_ARGUMENT for the list, and
///     then no instance is stepped.
/// OpenGL: required unless all hair is asleep. Does not wait for the GPU.
HAIR_API hair_result hair_step_list(hair_instance* const* list, uint32_t count, float dt);

/// Put every strand at rest, in its rest pose, under the current transform.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_reset(hair_instance* hair);

#endif
