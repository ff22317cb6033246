/// hair_body.h - bodies that deform: triangle meshes whose vertices move from frame to frame, to
/// collide with.
///
/// The mesh of hair_body_get_mesh() is used as any collision mesh is:
///
///     hair_collider collider = hair_collider_default();
///     collider.shape = HAIR_SHAPE_MESH;
///     collider.mesh = hair_body_get_mesh(body);
///     hair_set_colliders(hair, &collider, 1, sizeof collider);
///
/// and then, in every frame, hair_body_set_positions() and hair_step().
#ifndef HAIR_HAIR_BODY_H
#define HAIR_HAIR_BODY_H

#include <hair/hair_base.h>

/// Input of hair_body_create(), a triangle mesh and the space in which its vertices move.
///
/// A body is closed if every edge, identified by the positions of its vertices, is used equally
/// often in both directions. A closed body has an inside, also where it crosses itself. An open
/// body is treated as a shell, with a warning in the log. Triangles may be degenerate.
///
/// A two-sided body, for example cloth, is a shell whether it is closed or open, without a warning.
/// Hair stays on the side of the surface on which it is.
typedef struct hair_body_desc {
    hair_struct_header header;
    /// First vertex positions, xyz each, in the local space of the collider. Required.
    const float* positions; ///< m.
    /// Three vertex indices per triangle, counter-clockwise seen from outside. Required.
    const uint32_t* triangles;
    uint32_t vertex_count; ///< Number of vertices. [1, 786432].
    uint32_t triangle_count; ///< Number of triangles. [1, 262144].
    /// Number of voxels along the longest side of the box from `lower` to `upper`.
    uint32_t resolution; ///< [8, 128]. Default 64.
    /// Lower corner of the box in which all vertices stay. Move the collider with the body to keep
    /// the box small.
    float lower[3]; ///< m. [-1e6, 1e6]. Default 0.
    /// Upper corner of the box in which all vertices stay, above `lower`. Required.
    float upper[3]; ///< m. [-1e6, 1e6]. Default 0.
    /// Thickness of the shell of an open or two-sided body, at least two voxels.
    float thickness; ///< m. [0, 1e6]. Default 0.
    /// Key by which hair_load() finds the body among the colliders. 0 stands for a hash of the
    /// triangles and of the numbers above.
    uint64_t key; ///< Default 0.
    bool two_sided; ///< Permission for hair on both sides of the surface. Default false.
} hair_body_desc;
HAIR_DESC(hair_body_desc)

/// Create a body.
///
/// @param desc Mesh, copied.
/// @param out Receives the body.
/// Errors: HAIR_ERROR_ARGUMENT, also for a vertex outside the box, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL, HAIR_ERROR_CONTEXT_LOST, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_body_create(hair_context* context, const hair_body_desc* desc,
                                      hair_body** out);

/// Destroy a body. Colliders may still use its mesh, which keeps its last shape. NULL does nothing.
/// After hair_context_restore() the mesh of a destroyed body touches nothing.
/// OpenGL: required, but not for an orphan. Does not wait for the GPU.
HAIR_API void hair_body_destroy(hair_body* body);

/// Return the mesh of a body, for hair_collider.mesh of instances of the same context. The mesh
/// lives as long as the body and the colliders that use it. hair_collision_mesh_info.lower and
/// upper are bounds of the last two shapes. Return NULL for NULL, and for an orphan.
/// OpenGL: not used. Thread of the context.
HAIR_API const hair_collision_mesh* hair_body_get_mesh(const hair_body* body);

/// Move the vertices of a body. Call this once before each hair_step(). Over that step of each
/// instance the surface moves evenly from the shape before to the new one, and friction carries
/// hair along. Nothing is computed if no vertex has moved.
///
/// @param positions Vertex positions, xyz each, in the local space of the collider, copied.
/// @param count Number of vertices, that of the body.
/// @param stride Distance from vertex to vertex, bytes. A multiple of 4 in [12, 4096].
/// Errors: HAIR_ERROR_ARGUMENT, also for a vertex outside the box, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL, HAIR_ERROR_CONTEXT_LOST.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_body_set_positions(hair_body* body, const float* positions,
                                             uint32_t count, size_t stride);

/// Move the vertices of a body to positions in an OpenGL buffer, as hair_body_set_positions() does
/// for an array. The buffer is read by the GPU, in order with other commands, and may be written
/// again afterwards. The distances are computed also if no vertex has moved.
///
/// A vertex outside the box is moved to the box. A vertex that is not finite stays where it was.
/// After hair_context_restore() the body has the positions of its last array.
///
/// @param gl_buffer Buffer with xyz of each vertex, three floats, m.
/// @param offset Offset of the first vertex, bytes. A multiple of 4.
/// @param stride Distance from vertex to vertex, bytes. A multiple of 4 in [12, 4096].
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_CONTEXT_LOST.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_body_set_position_buffer(hair_body* body, uint32_t gl_buffer,
                                                   size_t offset, size_t stride);

#endif
