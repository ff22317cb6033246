/// hair_diagnostics.h - read-back, solver statistics, the field, timings, reports, and memory.
#ifndef HAIR_HAIR_DIAGNOSTICS_H
#define HAIR_HAIR_DIAGNOSTICS_H

#include <hair/hair_base.h>

// Read-back ---------------------------------------------------------------------------------------

/// Vertices that hair_read_positions() reads.
typedef enum hair_read_source {
    HAIR_READ_GUIDES = 0, ///< Guides at the end of the last substep.
    HAIR_READ_SMOOTH, ///< Guides as drawn, smoothed and interpolated to the current time.
    HAIR_READ_FOLLOWERS ///< All followers as drawn, hair_look.strand.segments + 1 vertices each.
} hair_read_source;

/// Copy vertex positions from the GPU.
///
/// @param source Vertices to read.
/// @param positions Receives xyz per vertex in the world, m. May be NULL if `capacity` is 0.
/// @param capacity Maximum number of vertices to write.
/// @param count Receives the number of vertices that there are.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required. Waits for the GPU unless `capacity` is 0.
HAIR_API hair_result hair_read_positions(hair_instance* hair, hair_read_source source,
                                         float* positions, uint32_t capacity, uint32_t* count);

// Solver statistics -------------------------------------------------------------------------------

/// Statistics of the simulation. Times are counted since the instance was created.
typedef struct hair_solver_stats {
    hair_struct_header header;
    /// Number of times that a substep of a straight guide was repeated with implicit Euler.
    uint32_t euler_fallbacks;
    /// Number of times that a substep, or a part of one, was repeated with follow-the-leader, after
    /// implicit Euler had failed too.
    uint32_t follow_fallbacks;
    /// Number of times that a guide was put back in its rest pose because it was not finite.
    uint32_t reset;
    /// Number of guides that are stiffened to hold their groom against gravity, as
    /// hair_physics.shape.gravity_preload asks.
    uint32_t stiffened;
    /// Maximum multiple of the stiffness at any vertex of these guides. At most 3.
    float max_stiffening;
    /// Length of a substep, s.
    float substep;
    /// Number of times that a guide was stretched in a substep because its root and pins were too
    /// far apart.
    uint32_t overextended;
    /// Number of guides that cannot hold their groom even with three times their stiffness. They
    /// sag.
    uint32_t sagging;
    /// Maximum distance from the groom at which a vertex of these guides rests, m.
    float farthest_sag;
    /// Number of times that a substep of a curved, fine or heavy guide was repeated in parts.
    uint32_t parts;
    /// Number of guides whose stiffness is reduced to the maximum that single precision can solve
    /// with this substep.
    uint32_t softened;
    /// Minimum factor of the stiffness at any vertex of these guides. 1 if no guide is softened.
    float softest;
    /// Number of guides that move at 2 cm/s or more although damping has had the time to stop any
    /// hair. See hair_get_solver_stats().
    uint32_t restless;
    /// Maximum speed of a guide vertex relative to the head in the last substep, m/s.
    float fastest;
    /// Number of times that the energy of a guide has grown within 0.25 s. 0 without
    /// hair_desc.diagnose. See hair_get_solver_stats().
    uint32_t gaining;
    /// Number of guides with a segment whose length error exceeds 1 % after the last substep.
    uint32_t overstretched;
    /// Maximum relative length error of a segment after the last substep.
    float stretch;
} hair_solver_stats;
HAIR_DESC(hair_solver_stats)

/// Write statistics of the simulation to `out`, which comes from hair_solver_stats_default().
///
/// `restless` and `gaining` count only while nothing drives the hair. The head rests, no wind
/// blows, no collider within reach moves, and no setting changes.
///
/// `restless` counts guides that are held at the root. It counts them after 17 / damping plus 18 s
/// per metre of the guide's length, with hair_physics.damping.
///
/// `gaining` counts under HAIR_SOLVER_DIRECT and HAIR_SOLVER_ACCURATE. The energy is the sum of
/// motion, gravity, bending, twist, and the restoring force to the rest pose. It must not grow, and
/// must fall by at least half of what damping dissipates. Hair with cohesion or pressure_stiffness
/// and skinned scalps are not counted.
///
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Waits for the GPU.
HAIR_API hair_result hair_get_solver_stats(hair_instance* hair, hair_solver_stats* out);

// The field ---------------------------------------------------------------------------------------

/// The field, the distance to the nearest collider as a 3D texture.
///
/// The field covers a box in the frame of the head. The box contains the hair at rest and a margin
/// of a quarter of the longest strand. The longest side has 32 to 256 voxels, of the size
/// hair_desc.field_voxel if this range allows it. At voxel centres the distance is exact for every
/// shape but HAIR_SHAPE_MESH. Interpolate between voxel centres.
typedef struct hair_field_info {
    hair_struct_header header;
    /// 3D texture of format R16F with the distance in m, negative inside. 0 if no collider reaches
    /// into the box.
    uint32_t distance_texture;
    /// 3D texture of format R32UI with the index of the nearest collider in hair_set_colliders(),
    /// or 4294967295 if none is near. May be 0. hair_get_field() makes it. From then on it takes 4
    /// bytes a voxel.
    uint32_t collider_texture;
    /// Number of voxels along the x, y and z axes of the head.
    uint32_t size[3];
    /// Size of a voxel, m.
    float voxel;
    /// Maximum distance that the field stores, m. It holds for all colliders farther away, and
    /// everywhere outside the box.
    float far;
    /// Transform from the world to texture coordinates, in which the box is [0, 1]^3.
    float transform[16];
} hair_field_info;
HAIR_DESC(hair_field_info)

/// Update the field to the colliders and the head of the last step, for shaders of the application.
/// The call writes only what has moved. The library owns the textures. They stay valid and
/// unchanged until the next call for this instance.
///
/// @param out Receives the field. It comes from hair_field_info_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_get_field(hair_instance* hair, hair_field_info* out);

// Timings -----------------------------------------------------------------------------------------

/// GPU time of a pass.
typedef struct hair_timing {
    /// Label and features of the pass, such as "sim/direct_curved_32". Valid as long as the
    /// context.
    const char* pass;
    /// GPU time of the last finished run, ms. 0 before the first.
    float ms;
    /// Number of runs since the context was created.
    uint32_t runs;
    /// Total GPU time of the finished runs, ms. If more than four runs are in flight, only the
    /// newest four count.
    double total_ms;
} hair_timing;

/// Write the GPU time of every pass that a call has needed so far, if hair_context_desc.timings is
/// true. A pass keeps its index. Return the number of passes. Return 0 if `context` is
/// NULL or abandoned, or if its OpenGL context is not current.
///
/// @param out Receives the timings. NULL only counts the passes.
/// @param capacity Maximum number of timings to write.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API uint32_t hair_get_timings(hair_context* context, hair_timing* out, uint32_t capacity);

// Reports -----------------------------------------------------------------------------------------

/// Reason why a stage has not run in a frame.
typedef enum hair_skip_reason {
    /// The stage has run.
    HAIR_SKIP_REASON_NONE = 0,
    /// The hair is asleep, see hair_physics.sleep_threshold.
    HAIR_SKIP_REASON_ASLEEP,
    /// The result of an earlier run is still valid.
    HAIR_SKIP_REASON_UNCHANGED,
    /// No view has shown any of the hair.
    HAIR_SKIP_REASON_OUT_OF_VIEW,
    /// No collider is near the hair.
    HAIR_SKIP_REASON_NONE_NEAR,
    /// The settings do not need the stage, for example without cohesion, with a rigid head, on
    /// another render path, or with wind that is not HAIR_WIND_FLUID.
    HAIR_SKIP_REASON_NOT_WANTED,
    /// The hair is in motion, but no substep was due.
    HAIR_SKIP_REASON_NOT_DUE,
    /// No call has needed the stage.
    HAIR_SKIP_REASON_NOT_CALLED
} hair_skip_reason;

/// Return a static text for a reason, or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_skip_reason_string(hair_skip_reason reason);

/// One stage of the work of an instance in a frame. A frame lasts from one hair_step() to the next.
typedef struct hair_report_row {
    const char* stage; ///< Name of the stage, such as "solve", a static text.
    const char* pass; ///< Last pass of the stage, as in hair_timing. NULL if none has run.
    hair_skip_reason skip_reason; ///< HAIR_SKIP_REASON_NONE if the stage has run.
    uint32_t runs; ///< Number of passes that have run.
    /// GPU time, ms, from the start of the first to the end of the last of consecutive passes. 0
    /// without hair_context_desc.timings.
    float ms;
    uint64_t bytes; ///< OpenGL memory of the stage, bytes.
} hair_report_row;

/// Sum of the rows of a report.
typedef struct hair_report_info {
    hair_struct_header header;
    uint32_t
        frame; ///< Number of the frame, from 1. 0 if no frame is finished. There are no rows then.
    uint32_t age; ///< Number of frames that have begun since.
    float ms; ///< GPU time of all rows, ms.
    uint64_t bytes; ///< OpenGL memory of all rows, bytes, without memory shared by instances.
    /// Number of programs that the driver has compiled for the context. Programs that came from
    /// hair_context_desc.cache do not count.
    uint32_t compiled_programs;
    /// GPU time of the calls of the newest measured frame of the context, ms. 0 without a budget,
    /// see hair_set_budget().
    float budget_used;
    /// Importance that the budget leaves, the hair_lod.importance of views without a hair_lod.
    /// Below 1 it also multiplies that of other views. 0 without a budget.
    float budget_importance;
    /// Factor of hair_physics.substep_rate that the budget leaves to the instance. 1 without a
    /// budget.
    float budget_substep_rate;
    /// Fraction of the samples of a pixel that the budget leaves. 1 without a budget.
    float budget_samples;
} hair_report_info;
HAIR_DESC(hair_report_info)

/// Report every stage of the newest frame that the GPU has finished. Without
/// hair_context_desc.timings, report the newest frame.
///
/// @param wait True reports the newest frame and waits until the GPU has finished it. False does
///     not wait.
/// @param info Receives the sums. It comes from hair_report_info_default().
/// @param rows Receives the rows. May be NULL if `capacity` is 0.
/// @param stride sizeof(hair_report_row).
/// @param capacity Maximum number of rows to write.
/// @param count Receives the number of rows that there are.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Waits for the GPU only if `wait` is true.
HAIR_API hair_result hair_report(hair_instance* hair, bool wait, hair_report_info* info,
                                 hair_report_row* rows, size_t stride, uint32_t capacity,
                                 uint32_t* count);

// Budget ------------------------------------------------------------------------------------------

/// Limit the GPU time that hair_step(), hair_draw() and the calls with lists take in a frame. All
/// instances of the context then give up detail as far as the limit needs, small heads first:
/// - hair_lod.importance falls. Views without a hair_lod get one that draws everything while the
///   time suffices.
/// - The substep rate of hair that is few pixels large, or that no view shows, falls by powers of
///   two. Its light is computed in every second to fourth frame.
/// - HAIR_RENDER_PATH_COMPUTE finds one half, then one quarter of the samples of a pixel.
///
/// hair_report_info tells what is given up. Time is measured by timestamps without waiting. Detail
/// stays as it is while the time is between 80 and 100 % of the budget. A change takes about ten
/// frames to act.
///
/// A frame ends when an instance is stepped that was stepped before, if a view was drawn between.
/// While the hair rests, step it by 0 s. With a budget, motion depends on the time that a GPU
/// takes. Do not set one where a simulation must be repeatable.
///
/// @param ms GPU time of a frame in ms. [0, 1000]. 0 disables the budget and brings back all
///     detail. Default 0.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_budget(hair_context* context, float ms);

// Memory ------------------------------------------------------------------------------------------

/// OpenGL memory of the buffers and textures of a context, its instances, and what they share.
/// Programs and the overhead of the driver are not counted.
typedef struct hair_memory {
    hair_struct_header header;
    uint64_t bytes; ///< Memory in use, bytes.
    uint64_t peak; ///< Maximum memory in use since the context was created, bytes.
    uint64_t limit; ///< Limit of hair_set_memory_limit(), bytes. 0 means no limit.
} hair_memory;
HAIR_DESC(hair_memory)

/// Write the memory of a context to `out`, which comes from hair_memory_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_get_memory(const hair_context* context, hair_memory* out);

/// Limit the OpenGL memory of a context. A call that would exceed the limit returns
/// HAIR_ERROR_MEMORY, logs both numbers, and does nothing. Memory in use is not freed.
///
/// @param bytes Limit in bytes. 0 removes the limit. Default 0.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Thread of the context.
HAIR_API hair_result hair_set_memory_limit(hair_context* context, uint64_t bytes);

#endif
