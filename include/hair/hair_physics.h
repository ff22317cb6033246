/// hair_physics.h - simulation: solver, material, head and scalp, wind, colliders, pins, steps.
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

/// Return a wind source with all defaults.
/// OpenGL: not used. Any thread.
static inline hair_wind_source hair_wind_source_default(void)
{
    hair_wind_source source = {{0, 0, 0}, {0, 0, 0}, 5, 0.05f};
    return source;
}

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
    uint32_t source_count; ///< [0, 4]. Default 0.
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

// Collision meshes --------------------------------------------------------------------------------

/// Input of hair_collision_mesh_create(), a triangle mesh. The library stores the distance to the
/// mesh on a grid.
///
/// A mesh is closed if every edge, identified by the positions of its vertices, is used equally
/// often in both directions. A closed mesh has an inside. An open mesh is treated as a shell, with
/// a warning in the log. Triangles may touch, cross and be degenerate.
typedef struct hair_collision_mesh_desc {
    hair_struct_header header;
    /// Callbacks, kept as long as the collision mesh. NULL selects the allocator of the C library
    /// and disables the log.
    const hair_host* host; ///< Default NULL.
    /// Vertex positions, xyz each, in the local space of the mesh. Required.
    const float* positions; ///< m. [-1e6, 1e6].
    /// Three vertex indices per triangle, counter-clockwise seen from outside. Required.
    const uint32_t* triangles;
    uint32_t vertex_count; ///< [1, 16777216].
    uint32_t triangle_count; ///< [1, 16777216].
    /// Number of voxels along the longest side of the grid. Ignored if voxel_size is set.
    uint32_t resolution; ///< [8, 256]. Default 64.
    /// Size of a voxel, enlarged if the longest side would have more than 256. HAIR_AUTO selects
    /// the size by `resolution`.
    float voxel_size; ///< m. [0, 1e6]. Default HAIR_AUTO.
    /// Thickness of the shell of an open mesh, at least two voxels.
    float thickness; ///< m. [0, 1e6]. Default 0.
    /// Space around the surface that the grid covers too, for hair_collider.rounding.
    float padding; ///< m. [0, 1e6]. Default 0.
} hair_collision_mesh_desc;
HAIR_DESC(hair_collision_mesh_desc)

/// Create a collision mesh: compute the distance to the triangles at every node of the grid. Takes
/// seconds for fine grids or millions of triangles.
///
/// @param desc Mesh, copied.
/// @param out Receives the collision mesh.
/// Errors: HAIR_ERROR_ARGUMENT, also for a mesh below 1e-6 m, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_collision_mesh_create(const hair_collision_mesh_desc* desc,
                                                hair_collision_mesh** out);

/// Destroy a collision mesh. Colliders may still use the mesh. NULL does nothing.
/// OpenGL: not used. Any thread.
HAIR_API void hair_collision_mesh_destroy(hair_collision_mesh* mesh);

/// Grid of a collision mesh.
typedef struct hair_collision_mesh_info {
    hair_struct_header header;
    bool is_closed; ///< True if the mesh is closed, false if the mesh is a shell.
    uint32_t unused; ///< Number of triangles that use a vertex twice.
    uint32_t size[3]; ///< Number of nodes along each axis of the grid.
    float voxel_size; ///< Distance between neighbouring nodes, m.
    float thickness; ///< Thickness of the shell, m. 0 for a closed mesh.
    float lower[3]; ///< Lower corner of the bounds of the surface, m.
    float upper[3]; ///< Upper corner of the bounds of the surface, m.
    uint64_t bytes; ///< CPU memory, bytes.
} hair_collision_mesh_info;
HAIR_DESC(hair_collision_mesh_info)

/// Write the grid of a collision mesh to `out`, which comes from
/// hair_collision_mesh_info_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_collision_mesh_describe(const hair_collision_mesh* mesh,
                                                  hair_collision_mesh_info* out);

// Colliders ---------------------------------------------------------------------------------------

/// Shape of a collider in its local space, centred at the origin.
typedef enum hair_shape {
    HAIR_SHAPE_SPHERE = 0, ///< size[0] is the radius.
    HAIR_SHAPE_CAPSULE, ///< size[0] is the radius. size[1] is half the length of the axis, local y.
    HAIR_SHAPE_BOX, ///< size holds half of each side length.
    HAIR_SHAPE_CYLINDER, ///< size[0] is the radius. size[1] is half the height along local y.
    HAIR_SHAPE_CONE, ///< size[0] is the radius of the base at y = -size[1]. The tip is at +size[1].
    HAIR_SHAPE_PLANE, ///< The half space below local y = 0.
    HAIR_SHAPE_MESH ///< hair_collider.mesh, scaled by hair_collider.scale.
} hair_shape;

/// A rigid body that hair collides with. Start from hair_collider_default().
typedef struct hair_collider {
    hair_shape shape; ///< Default HAIR_SHAPE_SPHERE.
    float position[3]; ///< Position in the world. m. [-1e9, 1e9]. Default 0.
    float rotation[4]; ///< Rotation in the world, a unit quaternion xyzw. Default identity.
    /// Dimensions of the shape, see hair_shape. They must be above 0 unless `rounding` is above 0.
    /// Half the length of a capsule may be 0.
    float size[3]; ///< m. [0, 1e6]. Default 0.
    /// Distance by which the shape grows on all sides, which rounds its edges.
    float rounding; ///< m. [0, 1e6]. Default 0.
    float scale; ///< Scale factor of HAIR_SHAPE_MESH. [1e-6, 1e6]. Default 1.
    /// Multiple of hair_physics.collision.friction, the coefficient of Coulomb friction.
    float friction; ///< [0, 100]. Default 1.
    /// Mesh of HAIR_SHAPE_MESH. It is kept alive as long as the collider is set. NULL for other
    /// shapes.
    const hair_collision_mesh* mesh; ///< Default NULL.
    /// Key that identifies the collider from step to step. 0 identifies it by its index.
    uint64_t key; ///< Default 0.
} hair_collider;

/// Return a collider with all defaults.
/// OpenGL: not used. Any thread.
static inline hair_collider hair_collider_default(void)
{
    hair_collider collider = {
        HAIR_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0}, 0, 1, 1, NULL, 0};
    return collider;
}

/// Replace the colliders of an instance.
///
/// A collider moves over the next step from its pose at the last step. Colliders are matched by
/// key, and colliders without a key by index, so keep their order. A collider that is new or has
/// changed its shape starts at its pose.
///
/// Guides collide with all colliders. If more than 64 colliders are within some centimetres of a
/// vertex, the vertex collides with the 64 nearest. Under HAIR_SOLVER_REDBLACK, guides collide only
/// with the 64 spheres and capsules nearest to the head. A guide touches colliders with its
/// vertices. A rod or the edge of a plate that is thinner than a segment can therefore pass between
/// two vertices. Followers and the field use all colliders.
///
/// @param colliders Colliders, copied. May be NULL if `count` is 0.
/// @param count Number of colliders. [0, 1048576].
/// @param stride sizeof(hair_collider).
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_colliders(hair_instance* hair, const hair_collider* colliders,
                                        uint32_t count, size_t stride);

/// Compute the world bounds of all hair on the way from the last step to the current pose of the
/// head. Colliders outside the bounds need not be set. Hair with HAIR_ROOT_FREE may leave the
/// bounds.
///
/// @param lower Receives the lower corner, m.
/// @param upper Receives the upper corner, m.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_bounds(const hair_instance* hair, float lower[3], float upper[3]);

// Pins --------------------------------------------------------------------------------------------

/// Space in which a pin is fixed.
typedef enum hair_pin_to {
    HAIR_PIN_HEAD = 0, ///< Fixed to the head, as a clip or hair that is tied back.
    HAIR_PIN_WORLD ///< Fixed in the world, as a hand or a hook.
} hair_pin_to;

/// A vertex of a guide that is held in place and turns freely. Start from hair_pin_default().
typedef struct hair_pin {
    /// Index of the guide, in the order of HAIR_READ_GUIDES of hair_read_positions().
    uint32_t guide; ///< Default 0.
    /// Index of the vertex in the guide, from 1. An index beyond the last vertex selects the tip.
    uint32_t vertex; ///< Default 4294967295.
    hair_pin_to to; ///< Default HAIR_PIN_HEAD.
    /// Position in groom space for HAIR_PIN_HEAD, and in the world for HAIR_PIN_WORLD.
    float position[3]; ///< m. [-1e9, 1e9]. Default 0.
} hair_pin;

/// Return a pin with all defaults.
/// OpenGL: not used. Any thread.
static inline hair_pin hair_pin_default(void)
{
    hair_pin pin = {0, UINT32_MAX, HAIR_PIN_HEAD, {0, 0, 0}};
    return pin;
}

/// Replace the pins of an instance.
///
/// The next step carries each pinned vertex to its position, evenly over its substeps. A vertex
/// that is no longer pinned keeps its velocity. A guide that is pinned farther away than its length
/// stretches, see hair_solver_stats.overextended.
///
/// @param pins Pins of different vertices, copied. May be NULL if `count` is 0.
/// @param count Number of pins. [0, 1048576]. 0 under HAIR_SOLVER_REDBLACK, which has no pins.
/// @param stride sizeof(hair_pin).
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_pins(hair_instance* hair, const hair_pin* pins, uint32_t count,
                                   size_t stride);

// Steps -------------------------------------------------------------------------------------------

/// Advance the simulation.
///
/// A step consists of substeps of fixed length, see hair_desc.substep. The motion does not depend
/// on the frame rate, because the drawn hair is interpolated to the current time. The same inputs
/// give the same bits on the same driver, except as hair_physics.sleep_threshold says.
///
/// @param dt Time in s, at least 0. 0 does nothing. A time beyond hair_desc.max_dt is shortened to
///     max_dt, with one warning in the log.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required unless the hair is asleep. Does not wait for the GPU.
HAIR_API hair_result hair_step(hair_instance* hair, float dt);

/// Put every strand at rest, in its rest pose, under the current transform.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_reset(hair_instance* hair);

#endif
