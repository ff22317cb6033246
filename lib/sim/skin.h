// skin.h - a scalp that the host skins: given before a step, and roots that ride on it.
//
// Where a root is and how it is turned is kept against the head, so that what moves or places the head takes it along.
#ifndef HAIR_SIM_SKIN_H
#define HAIR_SIM_SKIN_H

#include "lib/base/pose.h"
#include "lib/gl/gl.h"
#include "lib/groom/seats.h"

struct hair_skin { // But for `seats` all 0 until a scalp is first given.
    struct hair_seats* seats; // held; NULL: the groom has no scalp
    GLuint ride, seat, rest, scalp[2], params; // buffers, as in shared.h; the scalp of the last step, and
        // that to come
    GLuint texture; // of the rides
    struct hair_pose space; // in which that to come is given, in the world
    int fresh; // it has been given since the last step
    hair_vec4 rotation, offset; // from that of the last step to the head, as in shared.h
};

struct hair_sim;

int hair_skin_is_on(const struct hair_sim* sim);
void hair_skin_free(struct hair_sim* sim);

// Make what it takes, once: as if the scalp had been at rest so far. There are seats.
hair_result hair_skin_make(struct hair_sim* sim);

// What is to be the scalp at the next step: xyz per vertex; or out of a buffer that holds it from `first` on, every
// `stride` floats, as one that is bound from `offset` on for `size` bytes. It has been made.
void hair_skin_give(struct hair_sim* sim, const float* positions, const struct hair_pose* space);
void hair_skin_give_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size, uint32_t first,
                           uint32_t stride, const struct hair_pose* space);

// Where roots go in so many substeps of a step, the last from one share of it to another; or, resetting, are at once.
// `again`: more of the step that it has been called for. The head is where it is to be.
void hair_skin_ride(struct hair_sim* sim, int again, uint32_t substeps, float before, float after);
void hair_skin_reset(struct hair_sim* sim);

// The scalp is at rest, and always was: rides that say so, which the caller frees, and what becomes of those there are.
hair_result hair_skin_make_still(struct hair_sim* sim, GLuint* out);
void hair_skin_forget(struct hair_sim* sim, GLuint still);

// What passes that know of rides read; and, for those that write followers, all the buffers.
void hair_skin_bind(struct hair_sim* sim);
void hair_skin_bind_all(struct hair_sim* sim, uint32_t followers);

#endif
