/// hair_colliders.h - collision meshes, colliders and pins.
///
/// The set calls below take effect with the next hair_step().
#ifndef HAIR_HAIR_COLLIDERS_H
#define HAIR_HAIR_COLLIDERS_H

#include <hair/hair_base.h>

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
    uint32_t vertex_count; ///< Number of vertices. [1, 16777216].
    uint32_t triangle_count; ///< Number of triangles. [1, 16777216].
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
    HAIR_SHAPE_MESH, ///< hair_collider.mesh, scaled by hair_collider.scale.
    /// size holds the half axes. Those below 1/256 of the longest are taken as that long.
    HAIR_SHAPE_ELLIPSOID
} hair_shape;

/// A rigid body that hair collides with. Start from hair_collider_default().
typedef struct hair_collider {
    hair_shape shape; ///< Default HAIR_SHAPE_SPHERE.
    float position[3]; ///< Position in the world. m. [-1e9, 1e9]. Default 0.
    float rotation[4]; ///< Rotation in the world, a unit quaternion xyzw. Default identity.
    /// Dimensions of the shape, see hair_shape. They must be above 0 unless `rounding` is above 0.
    /// Half the length of a capsule may be 0. The shape ignores the others.
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
HAIR_PLAIN_DESC(hair_collider)

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

// Contacts ----------------------------------------------------------------------------------------

/// Contacts of the hair of an instance with one collider, over all steps since the last report.
typedef struct hair_collider_contact {
    uint64_t key; ///< hair_collider.key.
    uint32_t collider; ///< Index of the collider in hair_set_colliders().
    /// Number of guide vertices that touched the collider, each counted once per step.
    uint32_t vertices;
    float position[3]; ///< Mean place of the impulses in the world, m.
    /// Mean unit normal of the collider's surface there, outwards. 0 without a mean.
    float normal[3];
    float impulse[3]; ///< Impulse of the hair on the collider, N s.
    /// Angular impulse of the hair on the collider about hair_collider.position, N m s.
    float angular_impulse[3];
} hair_collider_contact;

/// Record the impulses between the hair of an instance and its colliders from the next step on, for
/// hair_get_contacts(). Hair that records them does not sleep near colliders. An instance that does
/// not record them has no pass, memory or shader code for them.
///
/// Substeps that HAIR_SOLVER_DIRECT or HAIR_SOLVER_ACCURATE repeat with follow-the-leader do not
/// conserve momentum, see hair_solver_stats.follow_fallbacks. Followers that are pushed out of
/// colliders have no impulses. The drag of wind on a push itself is not part of its impulse.
///
/// @param strands Number of strands whose mass each guide has. The impulses are multiples of it. 0
///     stops the record, and drops what has not been reported. [0, 1e6]. Default 0.
/// Errors: HAIR_ERROR_ARGUMENT, also under HAIR_SOLVER_FOLLOW and HAIR_SOLVER_REDBLACK, which move
///     hair without forces, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_record_contacts(hair_instance* hair, float strands);

/// Report the contacts of all steps that the GPU has finished and that have not been reported. Each
/// impulse is reported once. Colliders without contact are left out. The contacts are in the order
/// of their keys, then of their indices.
///
/// An application that simulates bodies applies each impulse and angular impulse to the body of the
/// collider. Momentum then is conserved. The forces of hair that is much heavier than a body may
/// throw the body off. A fast body passes through hair that is taut between pins.
///
/// @param wait True reports all steps, and waits until the GPU has finished them. Results are then
///     the same in every run. False does not wait. The newest steps may be reported later.
/// @param contacts Receives the contacts. May be NULL if `capacity` is 0.
/// @param stride sizeof(hair_collider_contact).
/// @param capacity Maximum number of contacts to write. If there are more contacts, all are kept
///     for the next call.
/// @param count Receives the number of contacts that there are.
/// Errors: HAIR_ERROR_ARGUMENT, also without hair_record_contacts(), HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL.
/// OpenGL: required. Waits for the GPU only if `wait` is true.
HAIR_API hair_result hair_get_contacts(hair_instance* hair, bool wait,
                                       hair_collider_contact* contacts, size_t stride,
                                       uint32_t capacity, uint32_t* count);

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
    uint32_t vertex; ///< [1, 4294967295]. Default 4294967295.
    hair_pin_to to; ///< Default HAIR_PIN_HEAD.
    /// Position in groom space for HAIR_PIN_HEAD, and in the world for HAIR_PIN_WORLD.
    float position[3]; ///< m. [-1e9, 1e9]. Default 0.
} hair_pin;
HAIR_PLAIN_DESC(hair_pin)

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

#endif
