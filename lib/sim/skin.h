// skin.h - a scalp that the application skins, and the motion of roots with the scalp. The
// application sets the scalp before a step.
//
// Positions and rotations of roots are kept relative to the head. Whatever moves the head thus
// moves the roots too.
#ifndef HAIR_SIM_SKIN_H
#define HAIR_SIM_SKIN_H

#include "lib/base/pose.h"
#include "lib/gl/gl.h"
#include "lib/groom/seats.h"

// All members but `seats` are 0 until the application first sets a scalp.
struct hair_skin {
    struct hair_seats* seats; // Root bindings, of which a reference is held. NULL without a scalp.
    // Buffers, as in shared.h. scalp[0] is the scalp of the last step, and scalp[1] that of the
    // next.
    GLuint ride, seat, rest, scalp[2], params;
    GLuint texture; // Texture of `ride`.
    struct hair_pose space; // Pose in the world of the space that scalp[1] is given in.
    int fresh; // 1 if a scalp has been set since the last step.
    hair_vec4 rotation, offset; // Transform of scalp[0] to the head's frame, as in shared.h.
};

struct hair_sim;

void hair_skin_free(struct hair_sim* sim);

// Create buffers and programs, once. The scalp counts as at rest so far. `seats` is not NULL.
hair_result hair_skin_make(struct hair_sim* sim);

// Set the scalp of the next step, xyz per vertex. hair_skin_make() has succeeded.
void hair_skin_give(struct hair_sim* sim, const float* positions, const struct hair_pose* space);
// Set the scalp of the next step from `size` bytes of a buffer, from the byte `offset` on. The
// first vertex is at the float `first` of that range, and the vertices are `stride` floats apart.
// hair_skin_make() has succeeded.
void hair_skin_give_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size, uint32_t first,
                           uint32_t stride, const struct hair_pose* space);

// Move the roots with the scalp in a step of `substeps` substeps. The last substep goes from the
// fraction `before` of the step to the fraction `after`. `again` continues the step of the last
// call. The head is already where it is at the end of the step.
void hair_skin_ride(struct hair_sim* sim, int again, uint32_t substeps, float before, float after);
// Move the roots to the scalp at once, without a past.
void hair_skin_reset(struct hair_sim* sim);

// Create the scalp motion of a scalp that was always at rest, in a buffer that the caller frees.
hair_result hair_skin_make_still(struct hair_sim* sim, GLuint* out);
// Replace the scalp motion by a result of hair_skin_make_still(), and put the scalp at rest.
void hair_skin_forget(struct hair_sim* sim, GLuint still);

// Bind all buffers for the passes that write followers.
void hair_skin_bind_all(struct hair_sim* sim, uint32_t followers);

#endif
