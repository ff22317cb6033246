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
/// The call computes the gravity preload of all guides again in the next hair_step(), which takes
/// part of the time of hair_create().
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

#endif
