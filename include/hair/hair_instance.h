/// hair_instance.h - instances: the simulated hair of one head. Creation, and saved states.
#ifndef HAIR_HAIR_INSTANCE_H
#define HAIR_HAIR_INSTANCE_H

#include <hair/hair_context.h>
#include <hair/hair_groom.h>
#include <hair/hair_look.h>
#include <hair/hair_physics.h>

// Creation ----------------------------------------------------------------------------------------

/// Mapping of guides to GPU threads.
typedef enum hair_thread_mapping {
    /// Mapping selected by driver and number of guides, never by timing.
    HAIR_THREAD_MAPPING_AUTO = 0,
    /// One work group per guide, and one thread per vertex. HAIR_SOLVER_REDBLACK has no other
    /// mapping to compute shaders.
    HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
    /// One thread per guide. Fastest on software rasterizers. Work groups are used instead for long
    /// guides among many colliders on software rasterizers, and for guides of more than 128
    /// vertices on hardware.
    HAIR_THREAD_MAPPING_THREAD_PER_GUIDE,
    /// Transform feedback instead of compute shaders, for comparison, as Tariq 2010 under Direct3D
    /// 10. Every phase of every iteration captures the vertices from one buffer into another.
    /// HAIR_SOLVER_REDBLACK on a rigid head only. Create and step the instance while no transform
    /// feedback of the application is active. hair_solver_stats.reset stays 0.
    HAIR_THREAD_MAPPING_FEEDBACK
} hair_thread_mapping;

/// Method that finds the first vertex of a follower inside a collider. All methods give the same
/// result.
typedef enum hair_hit_method {
    /// The faster method, which is HAIR_HIT_METHOD_COMPUTE.
    HAIR_HIT_METHOD_AUTO = 0,
    /// Search along the vertices in a compute shader.
    HAIR_HIT_METHOD_COMPUTE,
    /// Draw the vertices as points, and keep the minimum index per follower (Tariq 2010).
    HAIR_HIT_METHOD_PREPASS
} hair_hit_method;

/// Input of hair_create().
typedef struct hair_desc {
    hair_struct_header header;
    /// Name in the log and in GPU debuggers, copied. NULL selects "hair".
    const char* label; ///< Default NULL.
    hair_solver solver; ///< Default HAIR_SOLVER_DIRECT.
    /// Length of a substep, at least 1e-5 s. HAIR_AUTO lets the solver choose from the physics.
    float substep; ///< s. [0, 0.1]. Default HAIR_AUTO.
    hair_thread_mapping thread_mapping; ///< Default HAIR_THREAD_MAPPING_AUTO.
    /// Maximum time that one hair_step() advances. Longer steps slow the simulated time.
    float max_dt; ///< s. [1e-3, 1]. Default 0.1.
    /// Initial physics. NULL selects the defaults.
    const hair_physics* physics; ///< Default NULL.
    /// Initial look. NULL selects the defaults.
    const hair_look* look; ///< Default NULL.
    /// Initial pose of the head, groom to world. Rigid, with a translation of at most 1e9 m per
    /// axis.
    float transform[16]; ///< Default identity.
    /// Size of a voxel of the field, see hair_field_info.
    float field_voxel; ///< m. [0.0005, 1]. Default 0.005.
    hair_hit_method hit_method; ///< Default HAIR_HIT_METHOD_AUTO.
    /// Measurement of the energy of guides, for hair_solver_stats.gaining. True enables it. It
    /// costs one dispatch in each step in which nothing drives the hair.
    bool diagnose; ///< Default false.
} hair_desc;
HAIR_DESC(hair_desc)

/// Create an instance in its rest pose.
///
/// @param context Context. The instance is of no use after it.
/// @param groom Haircut. It may be destroyed after this call.
/// @param desc Settings, copied. Not NULL.
/// @param out Receives the instance.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_create(hair_context* context, const hair_groom* groom,
                                 const hair_desc* desc, hair_instance** out);

/// Destroy an instance. NULL does nothing.
/// OpenGL: required, but not for an orphan. Does not wait for the GPU.
HAIR_API void hair_destroy(hair_instance* hair);

// Saved states ------------------------------------------------------------------------------------

/// Write the state that determines the future motion: strands, head, colliders, pins, air,
/// turbulence, and the time since the last substep. The state does not contain physics, wind and
/// look. The state contains only a hash of each collision mesh.
///
/// @param bytes Receives the state. NULL only queries the size.
/// @param capacity Size of `bytes`. 0 if `bytes` is NULL.
/// @param size Receives the size of the state in bytes, also if `capacity` is too small.
/// Errors: HAIR_ERROR_ARGUMENT, also if `capacity` is too small, HAIR_ERROR_OPENGL.
/// OpenGL: required. Waits for the GPU unless `bytes` is NULL.
HAIR_API hair_result hair_save(hair_instance* hair, void* bytes, size_t capacity, size_t* size);

/// Restore a state of hair_save(), also in another process. With the same settings and inputs, the
/// same driver then gives the same bits.
///
/// Any bytes may be passed. The call refuses damaged bytes. It also refuses states of guides with
/// other numbers of vertices, of another solver, or of another hair_desc.substep. If that substep
/// is HAIR_AUTO, substeps continue with the length that the solver chooses for the physics of this
/// instance. Collision meshes are matched by content to the meshes of this instance's colliders.
/// Other mesh colliders are absent until hair_set_colliders() sets them.
///
/// @param bytes State.
/// @param size Size of the state in bytes.
/// Errors: HAIR_ERROR_ARGUMENT for a state of other hair, HAIR_ERROR_FILE for damaged bytes,
///     HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_load(hair_instance* hair, const void* bytes, size_t size);

#endif
