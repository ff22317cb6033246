/// hair_cut.h - cutting and growing hair while it is simulated.
///
/// A strand that is cut keeps its place, its motion, its curls, its colours and its thickness up to
/// the cut. Its new tip is blunt. A strand that grows does so at its tip. New hair continues the
/// strand by its shape in the groom, and moves as the old tip does. No vertex gains speed.
///
/// The gravity preload holds a strand of any length in its groom, so hair that is at rest stays at
/// rest. The part that is cut off has the hair_physics.tip_mass. Lengths survive hair_reset(), are
/// part of saved states, and take no memory and no time while all strands are whole.
#ifndef HAIR_HAIR_CUT_H
#define HAIR_HAIR_CUT_H

#include <hair/hair_look.h>

/// Set the lengths of guides. Followers become shorter or longer as their guides do.
///
/// A guide keeps at least a quarter of its first segment, but its followers may have no length.
/// HAIR_READ_GUIDES has the vertices beyond a tip at the tip. HAIR_READ_SMOOTH, and
/// hair_get_buffers() of smoothed guides, continue guides straight to their length in the groom.
/// Pins of vertices that are cut off end. A hair_set_pins() after the call pins tips instead.
/// A target of a tip is on the segment between the targets of its neighbours in the groom.
///
/// Cut hair has shaders of its own. hair_precompile() knows them once any hair is cut, so that an
/// application may cut a guide behind a loading screen, and let it grow again.
///
/// The next hair_step() computes the gravity preload of the changed guides again, and writes the
/// rods of all guides. This takes part of the time of hair_create().
///
/// @param first First guide, in the order of HAIR_READ_GUIDES.
/// @param count Number of guides. `first` + `count` is at most hair_groom_info.guide_count.
/// @param fractions Fractions of the lengths of the guides in the groom. [0, 1]. They are copied.
///     NULL makes the guides whole.
/// Errors: HAIR_ERROR_ARGUMENT, also with HAIR_THREAD_MAPPING_FEEDBACK, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_lengths(hair_instance* hair, uint32_t first, uint32_t count,
                                      const float* fractions);

/// Get the fractions of their lengths that guides have, as set by hair_set_lengths().
///
/// @param first First guide.
/// @param count Number of guides, as for hair_set_lengths().
/// @param fractions Receives a fraction per guide. [0, 1].
/// Errors: HAIR_ERROR_ARGUMENT.
HAIR_API hair_result hair_get_lengths(const hair_instance* hair, uint32_t first, uint32_t count,
                                      float* fractions);

/// Shape that cuts hair.
typedef enum hair_cut_shape {
    HAIR_CUT_SHAPE_PLANE = 0, ///< All of space on the side of a plane to which its normal points.
    HAIR_CUT_SHAPE_CAPSULE, ///< All places within a distance of an axis, or of a point.
    /// The surface over which a straight edge moves in a stroke, as that of scissors or of a sword.
    HAIR_CUT_SHAPE_BLADE
} hair_cut_shape;

/// Input of hair_cut().
typedef struct hair_cut_desc {
    hair_struct_header header;
    hair_cut_shape shape; ///< Shape of the cut. Default HAIR_CUT_SHAPE_PLANE.
    /// A point of the plane, or the first end of the axis or the edge, in the world.
    float start[3]; ///< m. [-1e9, 1e9]. Default 0.
    /// Second end of the axis or the edge, in the world. Equal ends make a capsule a sphere.
    float end[3]; ///< m. [-1e9, 1e9]. Default 0.
    /// Normal of the plane in the world, of any length above 0. Hair on its side is cut off.
    float normal[3]; ///< [-1, 1]. Default (0, -1, 0).
    float radius; ///< Radius of the capsule. m. [0, 1e6]. Default 0.01.
    /// Position of `start` when the stroke of a blade begins. Without a stroke it cuts nothing.
    float last_start[3]; ///< m. [-1e9, 1e9]. Default 0.
    /// Position of `end` when the stroke of a blade begins.
    float last_end[3]; ///< m. [-1e9, 1e9]. Default 0.
    /// Groups of strands that are cut. Bit i stands for group i.
    uint32_t groups; ///< [0, 255]. Default 255.
} hair_cut_desc;
HAIR_DESC(hair_cut_desc)

/// Effect of a hair_cut().
typedef struct hair_cut_info {
    hair_struct_header header;
    uint32_t strands; ///< Number of drawn strands that were cut.
    uint32_t guides; ///< Number of guides that were cut.
    /// Length that all drawn strands have lost, m. Curls and frizz count as drawn.
    double length;
} hair_cut_info;
HAIR_DESC(hair_cut_info)

/// Cut all drawn strands where they first meet a shape, from their roots on. Roots inside the shape
/// leave no hair.
///
/// The strands are those of HAIR_READ_FOLLOWERS after the last hair_step(), with their curls, at
/// full density. A guide is cut where it meets the shape itself, but keeps the length of the
/// longest strand that moves with it. hair_get_lengths() before the call tells lengths with which
/// hair_set_lengths() lets hair grow again.
///
/// Pieces are free strands, with the shape and the velocity that the strands have now. They have
/// the look, the physics, the attributes, the colliders and the ambient wind of the hair, and fall
/// until colliders hold them. They have the solver of the hair, or HAIR_SOLVER_DIRECT in place of
/// HAIR_SOLVER_REDBLACK. They cost as much as hair of so many strands. Most of the time of the call
/// is that of their hair_create(). Wherever their field does not reach, single strands may sink
/// into colliders that hold their guides.
///
/// @param cut Shape.
/// @param info Receives the effect, and comes from hair_cut_info_default(). NULL disables it.
/// @param pieces Receives an instance of what falls off, or NULL if nothing longer than 3 mm does.
///     The application steps, draws and destroys it. NULL discards what falls off.
/// Errors: HAIR_ERROR_ARGUMENT, also with HAIR_THREAD_MAPPING_FEEDBACK, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Waits for the GPU.
HAIR_API hair_result hair_cut(hair_instance* hair, const hair_cut_desc* cut, hair_cut_info* info,
                              hair_instance** pieces);

#endif
