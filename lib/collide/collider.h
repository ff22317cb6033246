// collider.h - the colliders as the application sets them: checked, and paired with their previous
// poses.
#ifndef HAIR_COLLIDE_COLLIDER_H
#define HAIR_COLLIDE_COLLIDER_H

#include <stdbool.h>

#include "lib/base/host.h"
#include "lib/base/pose.h"
#include "glsl/shared.h"

#define HAIR_MAX_COLLIDERS 1048576u // Maximum number of an instance.
// Number of colliders from which a dispatch has less to do, because a thread may meet many of them,
// one after the other.
#define HAIR_MANY_COLLIDERS 1024

// A list of colliders. It holds references to their collision meshes.
struct hair_collider_list {
    hair_collider* collider;
    uint32_t count, capacity;
};

struct hair_colliders {
    const void* home; // hair_sdf_pool of the context, which has the distances of bodies
    // `previous` is the list of the previous step. It has room for as many colliders as `current`
    // has.
    struct hair_collider_list current, previous;
    uint32_t* match; // index in `previous` of each collider of `current`, or HAIR_UNMATCHED
    uint32_t* generation; // of the mesh of each collider of `previous`, at the last step
    uint32_t generations; // number of those. They may be fewer than `previous` has.
    uint32_t capacity; // of match and of generation
    uint32_t capsules; // result of hair_colliders_capsules()
    uint32_t bodies; // result of hair_colliders_bodies()
    uint32_t contacts; // number of all but collision meshes without data
    uint32_t meshes; // number of collision meshes among the contacts
    uint32_t deforming; // number of meshes of bodies among the collision meshes
    int changed; // 1 if `current` differs from `previous`
};

#define HAIR_UNMATCHED UINT32_MAX

// Set `count` colliders, `stride` bytes apart. On failure nothing has changed.
hair_result hair_colliders_set(const hair_host* host, struct hair_colliders* colliders,
                               const hair_collider* from, uint32_t count, size_t stride);

// Set the current list to that of `from`. A collision mesh may be missing, because hair_load() did
// not find the mesh. On failure nothing has changed.
hair_result hair_colliders_copy(const hair_host* host, struct hair_colliders* colliders,
                                const struct hair_colliders* from);

// Set both lists to saved colliders. A collision mesh may be missing, and its collider then touches
// nothing.
hair_result hair_colliders_restore(const hair_host* host, struct hair_colliders* colliders,
                                   const hair_collider* now, uint32_t count, const hair_collider* before,
                                   uint32_t count_before);
void hair_colliders_free(const hair_host* host, struct hair_colliders* colliders);

// Return the i-th collider at the previous step, or its current state if it was not there.
const hair_collider* hair_colliders_previous(const struct hair_colliders* colliders, uint32_t i);

// Return whether the i-th collider is a body that has changed its shape since the last step.
bool hair_colliders_has_deformed(const struct hair_colliders* colliders, uint32_t i);
// Return whether any collider has.
bool hair_colliders_have_deformed(const struct hair_colliders* colliders);

// Write the HAIR_STEP_COLLIDERS spheres and capsules nearest to the head, in their order, relative
// to its start and end poses. Return their number.
uint32_t hair_colliders_capsules(const struct hair_colliders* colliders, const struct hair_pose* head_before,
                                 const struct hair_pose* head_now,
                                 struct hair_capsule out[HAIR_STEP_COLLIDERS]);

// Write the nearest colliders except collision meshes in the same way: a capsule around each, and
// the collider itself.
uint32_t hair_colliders_bodies(const struct hair_colliders* colliders, const struct hair_pose* head_before,
                               const struct hair_pose* head_now,
                               struct hair_capsule around[HAIR_STEP_COLLIDERS],
                               struct hair_contact_body out[HAIR_STEP_COLLIDERS]);

// Return the number of the colliders that hair_colliders_bodies() writes. `index` receives their
// indices in the current list.
uint32_t hair_colliders_nearest(const struct hair_colliders* colliders, const struct hair_pose* head_now,
                                uint32_t index[HAIR_STEP_COLLIDERS]);

// Return the i-th collider in the same way. A collision mesh must have its data. The offset of its
// nodes is not set.
struct hair_contact hair_colliders_contact(const struct hair_colliders* colliders, uint32_t i,
                                           const struct hair_pose* head_before,
                                           const struct hair_pose* head_now);

// Compute the centre and half the sides of the bounding box, in the collider's own axes and without
// rounding.
void hair_collider_extent(const hair_collider* collider, hair_vec3* middle, hair_vec3* half);

// End the step: `current` becomes `previous`.
void hair_colliders_end_step(struct hair_colliders* colliders);

// Forget the previous poses, because they do not show how colliders move.
void hair_colliders_reset(struct hair_colliders* colliders);

#endif
