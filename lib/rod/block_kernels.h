// block_kernels.h - steps of the search for how a block of guides holds its groom. See
// gravity_preload.c.
#ifndef HAIR_ROD_BLOCK_KERNELS_H
#define HAIR_ROD_BLOCK_KERNELS_H

#include "lib/rod/block.h"

struct hair_block_kernels {
    // Compute the shape of the guides and the pose that equals the groom. The rounded frames, the
    // vectors of segments in `place`, the lengths and the physics are set. Guides with a vertex
    // that does not resist become inactive. `scalp` has the frames at the roots.
    void (*find_shape)(struct hair_block*, const struct hair_lanes4* scalp);
    // Prepare tests of the groom. The pose is the groom.
    void (*prepare_groom)(struct hair_block*);
    // Find where the groom can be held with the present stiffness.
    void (*test_groom)(struct hair_block*);
    // Stiffen the guides by 1 + `amount` at the root.
    void (*stiffen)(struct hair_block*);
    // Set turns and places of the pose from its frames.
    void (*place)(struct hair_block*);
    // Move the pose of active guides to a stable equilibrium under `gravity` times the load, by at
    // most `steps` steps of Newton's method.
    void (*settle)(struct hair_block*);
    // Find where the pose can be held. Set `rest` to the rest shape that holds the pose.
    void (*test_pose)(struct hair_block*);
    // Set the stress of the pose to the stress that the rest strain causes in the groom.
    void (*find_result)(struct hair_block*);
};

// Return the functions for the instructions of this processor.
const struct hair_block_kernels* hair_block_kernels(void);

#endif
