// scalp_binding.h - the scalp at rest and the root bindings to it, as scalp motion needs them.
#ifndef HAIR_GROOM_SCALP_BINDING_H
#define HAIR_GROOM_SCALP_BINDING_H

#include <stdatomic.h>

#include "lib/base/host.h"
#include "glsl/shared.h"

// Immutable once made, except the reference count. A groom may be freed before its instances.
struct hair_root_bindings {
    hair_host host; // owner of the memory
    atomic_uint holders;
    uint32_t vertex_count;
    uint32_t count; // guides, then followers
    float* positions; // xyz per vertex of the scalp, in the space of the strands
    struct hair_root_binding* binding;
};

// Add a reference. Any thread. NULL is ignored. Return `root_bindings`.
struct hair_root_bindings* hair_root_bindings_retain(struct hair_root_bindings* root_bindings);
// Remove a reference and free `root_bindings` with the last one. Any thread. NULL is ignored.
void hair_root_bindings_release(struct hair_root_bindings* root_bindings);

#endif
