/// hair_physics.h - solver, physics, head and scalp motion, wind, colliders, pins and steps.
#ifndef HAIR_HAIR_PHYSICS_H
#define HAIR_HAIR_PHYSICS_H

#include <hair/hair_base.h>

typedef enum hair_solver {
    HAIR_SOLVER_DIRECT = 0, ///< Second order, exact lengths, implicit bending. Robust; the default.
    HAIR_SOLVER_ACCURATE, ///< Second order without damping of its own, finer substeps: least error.
    HAIR_SOLVER_FOLLOW, ///< Follow the leader, one pass: cheapest. Never stretches, never converges.
    HAIR_SOLVER_REDBLACK ///< Tariq 2010: Verlet, red/black constraints, `redblack.iterations` times. Stretches.
} hair_solver;

typedef enum hair_root {
    HAIR_ROOT_CLAMPED = 0, ///< Held by the scalp in place and direction.
    HAIR_ROOT_HINGED, ///< Held in place, free to turn.
    HAIR_ROOT_FREE ///< Held by nothing.
} hair_root;

/// How hair moves. Of redblack only: those in redblack; it has none of: youngs_modulus to tip_mass, drag to pressure_stiffness.
typedef struct hair_physics {
    hair_struct_header header;
    float gravity[3]; ///< m/s^2. [-1000, 1000]. Default (0, -9.81, 0).
    /// Decay rate c of the velocity v relative to the air's velocity u: dv/dt = -c (v - u). The default
    /// stands for the drag of a hair among others. With a `drag` of 0.1, the law of hair_wind lets a level
    /// hair of the default radius and density fall at v = 2.3 m/s, which is a rate of g / v = 4.3 1/s.
    /// Without wind only this rate acts, because it is much cheaper than the law.
    float damping; ///< 1/s. [0, 1000]. Default 4.
    /// Pull to the rest pose near the root, as a frequency.
    float shape_frequency_root; ///< Hz. [0, 30]. Default 4.
    float shape_frequency_tip; ///< The same at the tip; linear between. Hz. [0, 30]. Default 1.
    struct {
        /// Angular force to the rest angle with the segment before.
        float angular_hz; ///< Hz. [0, 30]. Default 8.
        float bend; ///< Angular constraint: share removed by an iteration. [0, 1]. Default 0.1.
        uint32_t iterations; ///< Of constraints in a substep. [1, 256]. Default 20.
    } redblack; ///< Used by HAIR_SOLVER_REDBLACK only.
    float collision_margin; ///< Distance kept to colliders. m. [0, 0.1]. Default 0.001.
    float youngs_modulus; ///< Young's modulus of a hair. Pa. [0, 1e12]. Default 4e9.
    float poisson_ratio; ///< Poisson's ratio: how much softer twist is than bending. [0, 0.5]. Default 0.45.
    float fiber_radius; ///< Of a section's circle of like area. m. [1e-6, 1e-3]. Default 4e-5.
    float fiber_density; ///< kg/m^3. [1, 1e5]. Default 1300.
    float flatness; ///< Short by long axis of its section. [0.03, 1]. Default 1.
    float stiffness_root; ///< Of bending and twist, as a multiple, at the root. [0, 1e4]. Default 1.
    float stiffness_tip; ///< The same at the tip; linear between. [0, 1e4]. Default 1.
    /// Fraction of gravity that the rest shape bears. 1 keeps the groom.
    float gravity_preload; ///< [0, 1]. Default 1.
    hair_root root; ///< Default HAIR_ROOT_CLAMPED.
    float tip_mass; ///< Hung on the tip, as a multiple of the strand's mass. [0, 1e4]. Default 0.
    /// Multiple of the law of hair_wind, which holds for a single hair. A lock of n hairs of diameter d that
    /// fill the fraction f of a cylinder has the diameter D = d sqrt(n / f). With the law's coefficient C,
    /// a hair of the lock has D C(Re_D) / (n d C(Re_d)) times the drag of a single hair. This is 0.1 at
    /// 2 m/s for n = 64 and f = 0.3. Use 1 for a single hair.
    float drag; ///< [0, 10]. Default 0.1.
    float friction; ///< Coulomb's coefficient with colliders, whose own multiplies it. [0, 10]. Default 0.3.
    /// Decay rate of the velocity of hair relative to the rigid motion of the hair around. Cohesion and volume keep the
    /// momentum and the angular momentum of all hair together. They do not reach hair that is off the head and farther
    /// from it than it is long.
    float cohesion; ///< 1/s. [0, 1000]. Default 0.
    /// How hair resists being denser than at rest, as a gas does, by its speed of sound squared: it is e times as
    /// dense at the foot of a height of pressure_stiffness / gravity. At most what crosses half a cell of the grid, 1 cm or
    /// more, in 1/120 s.
    float pressure_stiffness; ///< m^2/s^2. [0, 100]. Default 0.
    /// Level of detail: the share of the solver's own substeps that is made, in halves: 1, 1/2, 1/4, … They are as much
    /// longer, but none is longer than 1/60 s; steps that complete none only move on what is drawn, which is one
    /// substep behind. Of redblack, which stretches the more the fewer they are, nothing is left out.
    float substep_rate; ///< [0.0625, 1]. Default 1.
    /// Hair that is this near to where it comes to rest sleeps: hair_step then calls no OpenGL and costs next to nothing.
    /// It wakes when the head moves by a quarter of this, and when physics, wind, pins, a skinned scalp or colliders within
    /// reach change; in wind that moves of its own it stays awake. At 0 it never sleeps. It falls asleep at the same step in
    /// every run unless the GPU is behind by four steps and 0.1 s, as no GPU is whose pictures are shown: that is not waited
    /// for, and hair then falls asleep later.
    float sleep_threshold; ///< m. [0, 0.01]. Default 1e-4.
    /// The rate instead, where it is lower, of hair that has not been seen for 0.25 s: that no hair_draw showed any of, nor
    /// hair_read_positions asked for. In the step after it is seen again the rate is what it was; nothing jumps then.
    float offscreen_substep_rate; ///< [0.0625, 1]. Default 1.
} hair_physics;
HAIR_DESC(hair_physics)

typedef enum hair_preset {
    HAIR_PRESET_NATURAL = 0, ///< The defaults.
    HAIR_PRESET_FINE, ///< Thin and light: bends easily, stops soon.
    HAIR_PRESET_THICK, ///< Stiff, swings long.
    HAIR_PRESET_WET, ///< Heavy, soft, sticks to skin.
    HAIR_PRESET_FRIZZY, ///< Flat hairs that hold each other off: stiff, airy.
    HAIR_PRESET_COUNT
} hair_preset;

/// Make `physics`, which its default function has made, of a kind of hair: sets youngs_modulus, fiber_radius,
/// fiber_density, flatness, stiffness, damping and friction, and leaves the rest. [any thread]
HAIR_API hair_result hair_physics_preset(hair_physics* physics, hair_preset preset);
HAIR_API const char* hair_preset_name(hair_preset preset); ///< "natural", "fine", … NULL beyond the last.

HAIR_API hair_result hair_set_physics(hair_instance* hair, const hair_physics* physics);

/// Move the head. The next step carries the roots there, shortest way, evenly over its substeps.
HAIR_API hair_result hair_set_transform(hair_instance* hair, const float transform[16]);

/// Skin the scalp: at the next step it is to be where these positions have the vertices of the groom's scalp, xyz every
/// `stride` bytes, a multiple of 4 in [12, 4096]. `count` is that of the groom. `to_world`: where they are given, rigid;
/// NULL: in the world. Roots ride on the triangles they sit on, evenly over the step, shifted and turned as these are.
/// The first time, hair comes from where the scalp is at rest: hair_reset places it. A scalp that is not given anew
/// goes along with the head, so give it anew with every hair_set_transform that the head's bone asks for. The field,
/// the crowd and hair_get_bounds go by the head alone, which should be where the scalp is.
HAIR_API hair_result hair_set_scalp(hair_instance* hair, const float* positions, uint32_t count,
                                    size_t stride, const float to_world[16]);

/// The same out of an OpenGL buffer, which is read at the call, on the GPU: what shaders wrote before is seen, and
/// nothing is waited for. `offset` is that of the first position, in bytes. Roots of triangles with what is not finite
/// stay as they are against the head.
HAIR_API hair_result hair_set_scalp_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset,
                                           size_t stride, const float to_world[16]);

/// How air goes around head and colliders.

typedef enum hair_wind_model {
    HAIR_WIND_AMBIENT = 0, ///< By formulas: see hair_wind.shelter. Cheap.
    /// As a fluid on a grid around the hair: with a wake, and lee behind the head. Of what the field knows.
    /// It moves on in 1/60 s, or a substep if that is longer; hair_reset and hair_teleport begin anew with the wind, and
    /// so does hair_load unless resolution and grid_size are as they were saved.
    HAIR_WIND_FLUID
} hair_wind_model;

/// How the fluid is kept from being pressed together. The defaults leave less than a thousandth of what was to be done.
typedef enum hair_projection {
    HAIR_PROJECTION_MULTIGRID = 0, ///< Cycles over ever coarser grids: the fastest by far; the default.
    HAIR_PROJECTION_RELAXATION, ///< Sweeps of Gauss and Seidel that go beyond.
    HAIR_PROJECTION_JACOBI ///< Tariq 2010: sweeps of Jacobi.
} hair_projection;

/// What blows from a place, on top of the wind. Start from hair_wind_source_default.
typedef struct hair_wind_source {
    float position[3]; ///< World. m. [-1e9, 1e9]. Default 0.
    float direction[3]; ///< Of a jet, any length. 0: it blows to all sides. [-1e6, 1e6]. Default 0.
    /// At its mouth; of a source to all sides below 0: it draws in.
    float speed; ///< m/s. [-1000, 1000]. Default 5.
    float radius; ///< Of the mouth. m. [0.001, 100]. Default 0.05.
} hair_wind_source;

static inline hair_wind_source hair_wind_source_default(void)
{
    hair_wind_source source = {{0, 0, 0}, {0, 0, 0}, 5, 0.05f};
    return source;
}

/// Air that moves. By it guides are dragged along as cylinders of hair_physics.fiber_radius in a flow: across them with a
/// coefficient of 1 + 9.75 Re^-0.744, the form of White 1991, along them as heat passes from them. Guides stand for locks,
/// whose hairs shelter each other: so hair_physics.drag is below 1. hair_physics.damping stands for the
/// drag of the same air. Across and along a guide, therefore, the greater of damping and the law acts.
typedef struct hair_wind {
    hair_struct_header header;
    hair_wind_model model; ///< Default HAIR_WIND_AMBIENT.
    float velocity[3]; ///< Of the air, in the world. m/s. [-1000, 1000]. Default 0.
    /// 1 applies the law also where no wind blows, at the cost of a wind. A level hair then falls at
    /// 0.47 m/s when hair_physics.drag is 1. 0 leaves still air to hair_physics.damping, whose default lets
    /// every hair fall at 2.45 m/s.
    uint32_t still_air; ///< [0, 1]. Default 0.
    float density; ///< Of the air. kg/m^3. [0.001, 1000]. Default 1.204.
    float viscosity; ///< Of the air, dynamic. Pa s. [1e-7, 1]. Default 1.82e-5.
    uint32_t resolution; ///< Of the fluid: cells along a side, up to a multiple of 16. [16, 128]. Default 32.
    float grid_size; ///< Of the fluid: its side. m. 0 (half as long again as the field's) to 100. Default 0.
    hair_projection projection; ///< Of the fluid. Default HAIR_PROJECTION_MULTIGRID.
    uint32_t projection_iterations; ///< Or sweeps, of that, in 1/60 s. 0 (what suffices) to 10000. Default 0.
    /// Gusts are turbulence, of the same statistics every way, that the wind carries along: von Karman's spectrum.
    /// Standard deviation of each component, as a share of the wind's speed.
    float turbulence_intensity; ///< [0, 2]. Default 0.
    /// Integral length scale: gusts are some times as long.
    float turbulence_length; ///< m. [0.1, 1000]. Default 1.
    uint32_t seed; ///< Of gusts. Default 1.
    /// How much the head, as far as its place is told from roots, and the largest colliders of up to 0.5 m around it divert
    /// wind and gusts, as balls: before them by potential flow, behind by a wake.
    float shelter; ///< [0, 1]. Default 1.
    const hair_wind_source* sources; ///< Copied. NULL: none.
    uint32_t source_count; ///< [0, 4]. Default 0.
    /// The application's own wind, on top of all this: xyz in m/s along the world's axes. Read while steps run, and 0 where
    /// it is not finite, outside, and when it has been deleted.
    uint32_t texture; ///< Of OpenGL: 3D, of floats. 0: none. Default 0.
    float texture_transform[16]; ///< World to its coordinates. Affine. Default identity.
    /// Hair slows the fluid as porous matter does: as so many strands that lie where guides are, each of which takes from
    /// air what hair_physics.drag gives to a guide. A scalp has some 100000. 0: air blows through hair as through nothing.
    uint32_t drag_strand_count; ///< [0, 10000000]. Default 0.
} hair_wind;
HAIR_DESC(hair_wind)

/// From the next step on the air moves so. NULL, or the defaults: there is no wind, and nothing is paid for it. Gusts go
/// on from where they are, whatever else of it changes; hair_reset begins them anew. redblack has no wind.
HAIR_API hair_result hair_set_wind(hair_instance* hair, const hair_wind* wind);

// Collision meshes: no GPU, [any thread] -------------------------------------------------------------------------------

/// The shape of a collider by a triangle mesh, kept as the distance to it at the nodes of a grid. A mesh is closed
/// when at every edge as many triangles pass one way as the other, by the positions of vertices; then it has an
/// inside. An open one is taken for a shell, and the log warns. Triangles may touch, cross and be degenerate.
typedef struct hair_collision_mesh_desc {
    hair_struct_header header;
    /// NULL: the C library's allocator, no log. Kept as long as the collision mesh is.
    const hair_host* host;
    const float* positions; ///< xyz per vertex, in the collision mesh's own space. m. [-1e6, 1e6]. Required.
    const uint32_t* triangles; ///< Three indices each, counter-clockwise from outside. Required.
    uint32_t vertex_count; ///< [1, 16777216].
    uint32_t triangle_count; ///< [1, 16777216].
    uint32_t resolution; ///< Voxels along the longest side. [8, 256]. Default 64.
    /// Their size instead, as far as 256 of them suffice.
    float voxel_size; ///< m. 0 (by resolution) to 1e6. Default 0.
    float thickness; ///< Of the shell that an open mesh is; at least 2 voxels. m. [0, 1e6]. Default 0.
    float padding; ///< Kept around the surface too, for colliders rounded by it. m. [0, 1e6]. Default 0.
} hair_collision_mesh_desc;
HAIR_DESC(hair_collision_mesh_desc)

/// Take the distance to the mesh at every node of the grid. Seconds for a fine grid or for millions of triangles.
HAIR_API hair_result hair_collision_mesh_create(const hair_collision_mesh_desc* desc,
                                                hair_collision_mesh** out);
HAIR_API void hair_collision_mesh_destroy(hair_collision_mesh* mesh);

typedef struct hair_collision_mesh_info {
    hair_struct_header header;
    uint32_t closed; ///< 1: the mesh has an inside. 0: it is a shell.
    uint32_t unused; ///< Triangles that use a vertex twice.
    uint32_t size[3]; ///< Nodes of the grid along each axis.
    float voxel_size; ///< Between two of them. m.
    float thickness; ///< Of the shell. 0 where there is none. m.
    float lower[3], upper[3]; ///< Bounds of the surface. m.
    uint64_t bytes; ///< Of memory.
} hair_collision_mesh_info;
HAIR_DESC(hair_collision_mesh_info)

HAIR_API hair_result hair_collision_mesh_describe(const hair_collision_mesh* mesh,
                                                  hair_collision_mesh_info* out);

typedef enum hair_shape {
    HAIR_SHAPE_SPHERE = 0, ///< size[0]: radius.
    HAIR_SHAPE_CAPSULE, ///< size[0]: radius. size[1]: half the length of its axis, which is local y.
    HAIR_SHAPE_BOX, ///< size: half the lengths of its sides.
    HAIR_SHAPE_CYLINDER, ///< size[0]: radius. size[1]: half its height, along local y.
    HAIR_SHAPE_CONE, ///< size[0]: radius of its base, at local y = -size[1]. Its tip is at +size[1].
    HAIR_SHAPE_PLANE, ///< All that is below local y = 0.
    HAIR_SHAPE_MESH ///< `mesh`, `scale` times as large.
} hair_shape;

/// Start from hair_collider_default.
typedef struct hair_collider {
    hair_shape shape; ///< Default HAIR_SHAPE_SPHERE.
    float position[3]; ///< World. m. [-1e9, 1e9]. Default 0.
    float rotation[4]; ///< World. Unit quaternion, xyzw. Default identity.
    float size[3]; ///< As the shape says. m. [0, 1e6], above 0 unless it is rounded. Default 0.
    float rounding; ///< Added all round, which rounds edges. m. [0, 1e6]. Default 0.
    float scale; ///< Of a collision mesh. [1e-6, 1e6]. Default 1.
    float friction; ///< Coulomb's coefficient is this times hair_physics.friction. [0, 100]. Default 1.
    const hair_collision_mesh* mesh; ///< Of HAIR_SHAPE_MESH; held as long as the collider is. Default NULL.
    uint64_t key; ///< Tells it from others, from step to step. 0: its place does. Default 0.
} hair_collider;

static inline hair_collider hair_collider_default(void)
{
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0}, 0, 1, 1, NULL, 0};
    return collider;
}

/// Replace the colliders; `stride` is sizeof(hair_collider). count in [0, 1048576]. A collider moves from where the one of
/// its key was at the last step; of those without a key the i-th from where the i-th was, so keep their order. One
/// that was not there, or had another shape, starts where it is. Guides collide with all of them, collision meshes too; of more
/// than 64 within some centimetres of a vertex with the 64 nearest there. Those of redblack collide with spheres and
/// capsules only, the 64 nearest to the head. A guide meets a collider at its vertices: a rod, or the edge of a plate,
/// that is thinner than its segments are long may come between two of them. Followers and the field know all colliders.
HAIR_API hair_result hair_set_colliders(hair_instance* hair, const hair_collider* colliders, uint32_t count,
                                        size_t stride);

typedef enum hair_pin_to {
    HAIR_PIN_HEAD = 0, ///< The head: hair that is tied back, a clip.
    HAIR_PIN_WORLD ///< The world: a hand, a hook.
} hair_pin_to;

/// A vertex of a guide that is held in place, free to turn. Start from hair_pin_default.
typedef struct hair_pin {
    uint32_t guide; ///< As hair_read_positions has them, from 0. Default 0.
    uint32_t vertex; ///< Of the guide, from 1; beyond its last: its tip. Default 4294967295.
    hair_pin_to to; ///< What holds it. Default HAIR_PIN_HEAD.
    float position[3]; ///< In groom space, or in the world. m. [-1e9, 1e9]. Default 0.
} hair_pin;

static inline hair_pin hair_pin_default(void)
{
    hair_pin pin = {0, UINT32_MAX, HAIR_PIN_HEAD, {0, 0, 0}};
    return pin;
}

/// Replace the pins; `stride` is sizeof(hair_pin). count in [0, 1048576], of different vertices; redblack has none.
/// The next step carries each vertex from where it is to its place, evenly over its substeps; one whose pin is gone
/// goes on as it moved. A guide that is tied farther off than it is long is stretched, see hair_solver_stats.overextended.
/// hair_teleport takes pins in the world along.
HAIR_API hair_result hair_set_pins(hair_instance* hair, const hair_pin* pins, uint32_t count, size_t stride);

/// A box in the world that no strand leaves on the way from the last step to where the head is, unless its root is
/// free: what is outside need not be among the colliders.
HAIR_API hair_result hair_get_bounds(const hair_instance* hair, float lower[3], float upper[3]);

/// Advance by `dt` seconds, in substeps of the desc's fixed length: the motion does not depend on the frame
/// rate, and what is drawn is interpolated to now. The same inputs on the same driver give the same bits, but for what
/// hair_physics.sleep_threshold says. No step waits for the GPU.
/// dt >= 0; 0 does nothing; beyond max_dt time slows, and the log says so once.
HAIR_API hair_result hair_step(hair_instance* hair, float dt);

/// Put every strand in its rest pose, at rest, under the current transform.
HAIR_API hair_result hair_reset(hair_instance* hair);

/// Move the head without moving the hair against it: shape and motion go along, nothing swings.
HAIR_API hair_result hair_teleport(hair_instance* hair, const float transform[16]);

#endif
