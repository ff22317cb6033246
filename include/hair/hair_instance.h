/// hair_instance.h - one head of living hair.
#ifndef HAIR_HAIR_INSTANCE_H
#define HAIR_HAIR_INSTANCE_H

#include <hair/hair_context.h>
#include <hair/hair_groom.h>
#include <hair/hair_look.h>
#include <hair/hair_physics.h>

typedef enum hair_thread_mapping {
    HAIR_THREAD_MAPPING_AUTO = 0, ///< By driver and number of guides, never by timing.
    HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, ///< A work group per guide, a thread per vertex. redblack has no other by compute.
    /// A thread per guide: fastest on software rasterisers, which may not let one thread do all for long guides among many
    /// colliders. Then a work group does, as on hardware for guides of more than 128 vertices.
    HAIR_THREAD_MAPPING_THREAD_PER_GUIDE,
    /// Of redblack, on a rigid head, for comparison: without compute shaders, as Tariq 2010 under Direct3D 10: vertices are
    /// captured by transform feedback, from one buffer into another, for every phase of every iteration. To be created and
    /// stepped without transform feedback of the host under way. hair_solver_stats.reset counts nothing.
    HAIR_THREAD_MAPPING_FEEDBACK
} hair_thread_mapping;

/// How the first vertex of a follower that is inside a collider is found: the answer is the same.
typedef enum hair_hit_method {
    HAIR_HIT_METHOD_AUTO = 0, ///< The faster: by compute.
    HAIR_HIT_METHOD_COMPUTE, ///< Vertices are gone through up to the first.
    HAIR_HIT_METHOD_PREPASS ///< Tariq 2010: vertices are drawn as points, a texel per follower keeps the least.
} hair_hit_method;

typedef struct hair_desc {
    hair_struct_header header;
    const char* label; ///< Name in the log and in GPU debuggers. NULL: "hair".
    hair_solver solver; ///< Default HAIR_SOLVER_DIRECT.
    float substep; ///< Length of a substep. s. 0 (as the solver wants) to 0.1, from 1e-5 on. Default 0.
    hair_thread_mapping thread_mapping; ///< Of guides to GPU threads. Default HAIR_THREAD_MAPPING_AUTO.
    float max_dt; ///< Longest a step advances; beyond, time slows. s. [1e-3, 1]. Default 0.1.
    const hair_physics* physics; ///< NULL: the defaults.
    const hair_look* look; ///< NULL: the defaults.
    float transform[16]; ///< Groom to world. Rigid, by at most 1e9 m. Default identity.
    float field_voxel; ///< Side of a voxel of the field, see hair_field_info. m. [0.0005, 1]. Default 0.005.
    hair_hit_method hit_method; ///< Default HAIR_HIT_METHOD_AUTO.
    /// 1 watches the energy of guides for hair_solver_stats.gaining. It costs a dispatch in each step in which nothing drives hair.
    uint32_t diagnose; ///< [0, 1]. Default 0.
} hair_desc;
HAIR_DESC(hair_desc)

HAIR_API hair_result hair_create(hair_context* context, const hair_groom* groom, const hair_desc* desc,
                                 hair_instance** out);
HAIR_API void hair_destroy(hair_instance* hair);

/// Write all that the coming motion depends on but settings (physics, wind, look): strands, head, colliders, pins, air, how
/// far gusts have gone, the time since the last substep; of collision meshes only a mark. `size` becomes the bytes it takes, also when `capacity` is too
/// small, which is an error; NULL and a capacity of 0 only ask for it. Waits.
HAIR_API hair_result hair_save(hair_instance* hair, void* bytes, size_t capacity, size_t* size);

/// Go on from what hair_save wrote, here or elsewhere: with the same settings and inputs the same driver gives
/// the same bits. Any bytes may be given: what is no saved state is refused, and so is one of guides with other
/// numbers of vertices, of another solver or of another hair_desc.substep. Where that is 0, substeps go on as long
/// as the solver wants them with the physics that are set here. Collision meshes are those of the same content that the
/// instance's colliders have; others are not there until the colliders are set again.
HAIR_API hair_result hair_load(hair_instance* hair, const void* bytes, size_t size);

#endif
