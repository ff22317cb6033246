/// hair_diagnostics.h - read-back, statistics, the field, timings, reports and memory.
#ifndef HAIR_HAIR_DIAGNOSTICS_H
#define HAIR_HAIR_DIAGNOSTICS_H

#include <hair/hair_base.h>

typedef enum hair_read_source {
    HAIR_READ_GUIDES = 0, ///< Vertices of the guides where the last substep left them.
    HAIR_READ_SMOOTH, ///< Vertices of the guides as drawn: smoothed, interpolated to now.
    HAIR_READ_FOLLOWERS ///< Vertices of all followers as drawn: look.segments + 1 each.
} hair_read_source;

/// Copy positions, xyz each, world, of at most `capacity` vertices. `count` becomes how many there are. Waits.
HAIR_API hair_result hair_read_positions(hair_instance* hair, hair_read_source source, float* positions,
                                         uint32_t capacity, uint32_t* count);

/// What went wrong since the instance was created, and how it was borne.
typedef struct hair_solver_stats {
    hair_struct_header header;
    uint32_t euler_fallbacks; ///< Times that a substep of a straight guide was redone by implicit Euler.
    /// Times that a substep, or a part of one, was redone by follow-the-leader after that.
    uint32_t follow_fallbacks;
    uint32_t reset; ///< Times that a guide was put back in its rest pose: it was not finite.
    /// Guides made stiffer to hold their groom against gravity, as `gravity_preload` asks.
    uint32_t stiffened;
    float max_stiffening; ///< Greatest multiple of the stiffness at any vertex of these guides. At most 3.
    float substep; ///< Length of a substep. s.
    /// Times that a guide was stretched in a substep: what holds it was too far apart.
    uint32_t overextended;
    uint32_t sagging; ///< Guides that three times their stiffness does not hold: they sag from the groom.
    float farthest_sag; ///< Greatest distance from the groom at which a vertex of these guides rests. m.
    uint32_t parts; ///< Times that a substep of a guide that is curved, fine or heavy was redone in parts.
    /// Guides whose stiffness is reduced to what single precision can solve at this substep.
    uint32_t softened;
    float softest; ///< Least factor of the stiffness at any vertex of these guides. 1: none is softened.
    /// Guides that still move at 2 cm/s though damping had the time to calm any hair: see below.
    uint32_t restless;
    float fastest; ///< Greatest speed of a guide vertex relative to the head, over the last substep. m/s.
    /// Times that the energy of a guide grew in 0.25 s, with hair_desc.diagnose: see below.
    uint32_t gaining;
    /// Guides with a segment whose length is off by more than 1 % after the last substep.
    uint32_t overstretched;
    float stretch; ///< Greatest relative error of a segment's length after the last substep.
} hair_solver_stats;
HAIR_DESC(hair_solver_stats)

/// Report how the simulation fares. Waits for the GPU.
///
/// `restless` and `gaining` look at hair that nothing drives: the head rests, no wind blows, no collider within reach moves,
/// and no setting changes. `restless` allows 17 s / damping, and 18 s for every metre of a guide's length, and looks at guides
/// that are held at the root. `gaining` counts under the solvers direct and accurate. There the energy of motion, gravity,
/// bending, twist and the pull to the rest pose may not grow, and falls by at least half of what damping takes. It looks
/// neither at hair with cohesion or pressure_stiffness nor at a skinned scalp.
HAIR_API hair_result hair_get_solver_stats(hair_instance* hair, hair_solver_stats* out);

/// The field: how far the nearest collider is, in a box in the head's frame around the hair at rest and a quarter of the
/// longest strand beyond it. Along its longest side are 32 to 256 voxels, of the side that hair_desc asks for as far as
/// that allows. Exact at the middles of voxels for every shape but collision meshes, between them to be interpolated.
typedef struct hair_field_info {
    hair_struct_header header;
    /// Of OpenGL: 3D, R16F. m, below 0 inside. 0: no collider reaches into the box.
    uint32_t distance_texture;
    /// 3D, R32UI: which of hair_set_colliders is nearest; 4294967295: none near. Or 0.
    uint32_t collider_texture;
    uint32_t size[3]; ///< Voxels along the head's x, y and z.
    float voxel; ///< Side of one. m.
    float far; ///< Of colliders farther than this it says so and no more; and so of all beyond the box. m.
    float transform[16]; ///< World to texture coordinates: the box is [0, 1]^3.
} hair_field_info;
HAIR_DESC(hair_field_info)

/// Bring the field up to date with the colliders and the head of the last step, for shaders of the host to read. Only what
/// moved is written. The textures are the library's, and as they are until the next call for this instance.
HAIR_API hair_result hair_get_field(hair_instance* hair, hair_field_info* out);

typedef struct hair_timing {
    const char* pass; ///< Its label and features, as "sim/direct_curved_32". As long as the context.
    float ms; ///< GPU time of its last finished run. 0 before there is one.
    uint32_t runs; ///< Since the context was created.
    double total_ms; ///< GPU time of its finished runs together, but for more than four at once.
} hair_timing;

/// GPU time of every pass that something has needed yet, if the context was created with `timings`. Never waits. Returns how
/// many passes there are; writes at most `capacity`. What was there once stays in its place.
HAIR_API uint32_t hair_get_timings(hair_context* context, hair_timing* out, uint32_t capacity);

/// Why work was done or not.
typedef enum hair_skip_reason {
    HAIR_SKIP_REASON_NONE = 0, ///< It was.
    HAIR_SKIP_REASON_ASLEEP, ///< Hair is at rest, as hair_physics.sleep_threshold has it.
    HAIR_SKIP_REASON_UNCHANGED, ///< What it makes is there and still holds.
    HAIR_SKIP_REASON_OUT_OF_VIEW, ///< No view showed any of the hair.
    HAIR_SKIP_REASON_NONE_NEAR, ///< No collider is near the hair.
    HAIR_SKIP_REASON_NOT_WANTED, ///< Settings ask for none of it: no wind, no cohesion, a rigid head, another path.
    HAIR_SKIP_REASON_NOT_DUE, ///< Its time has not come: no substep fell due, hair is in motion.
    HAIR_SKIP_REASON_NOT_CALLED ///< No call asked for it.
} hair_skip_reason;

HAIR_API const char*
hair_skip_reason_string(hair_skip_reason reason); ///< Static text, NULL beyond the last. [any thread]

/// One kind of work of an instance in a frame, which lasts from one hair_step to the next.
typedef struct hair_report_row {
    const char* stage; ///< Static text: "solve", "smooth", "color", …
    const char* pass; ///< The last pass that ran for it, as in hair_timing. NULL: none did.
    hair_skip_reason skip_reason;
    uint32_t runs; ///< Of passes.
    float ms; ///< GPU time, from the first of passes that follow each other to the last. 0 without timings.
    uint64_t bytes; ///< OpenGL memory that it has.
} hair_report_row;

typedef struct hair_report_info {
    hair_struct_header header;
    uint32_t frame; ///< Counted from 1. 0: none is finished, and there are no rows.
    uint32_t age; ///< Frames that have begun since.
    float ms; ///< Of all rows.
    uint64_t bytes; ///< Of all rows; what instances share is not among them.
} hair_report_info;
HAIR_DESC(hair_report_info)

/// What became of all work in the newest frame that the GPU is done with; without hair_context_desc.timings, in the
/// newest there is. `wait` 1: in the newest, waiting for it. `count` becomes how many rows there are, of which at most
/// `capacity`, `stride` = sizeof(hair_report_row) apart, are written.
HAIR_API hair_result hair_report(hair_instance* hair, uint32_t wait, hair_report_info* info,
                                 hair_report_row* rows, size_t stride, uint32_t capacity, uint32_t* count);

/// OpenGL memory of a context's buffers and textures: of its instances, and what these share. Programs are not counted, nor
/// what a driver adds. Bytes.
typedef struct hair_memory {
    hair_struct_header header;
    uint64_t bytes; ///< In use now.
    uint64_t peak; ///< In use at once, since the context was created.
    uint64_t limit; ///< 0: none.
} hair_memory;
HAIR_DESC(hair_memory)

HAIR_API hair_result hair_get_memory(const hair_context* context, hair_memory* out); ///< No OpenGL.

/// From now on, what would take more than `bytes` in all is HAIR_ERROR_MEMORY, with both numbers in the log, and the call that
/// needed it does nothing: nothing is left out in silence. What is in use stays. 0, the default: no limit. No OpenGL.
HAIR_API hair_result hair_set_memory_limit(hair_context* context, uint64_t bytes);

#endif
