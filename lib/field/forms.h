// forms.h - pool of the distance grids of collision meshes. All instances of a context share one
// copy of each grid.
#ifndef HAIR_FIELD_FORMS_H
#define HAIR_FIELD_FORMS_H

#include "lib/collide/collision_mesh.h"
#include "lib/gl/gl.h"

struct hair_pooled_form {
    const hair_collision_mesh* form; // Referenced mesh. NULL if the place is free.
    uint32_t users; // Number of colliders that use it.
    uint32_t first; // First of its nodes.
};

struct hair_forms {
    struct hair_gl* gl;
    GLuint nodes; // Buffer of floats, in metres.
    GLuint texture; // Buffer texture of `nodes`. 0 until hair_forms_need_texture().
    size_t used, room; // Used nodes and capacity.
    struct hair_pooled_form* pooled;
    uint32_t count, capacity; // Number of places, and capacity.
};

// Add a user of `form`. Its place stays `place` until hair_forms_drop().
hair_result hair_forms_take(struct hair_forms* forms, const hair_collision_mesh* form, uint32_t* place);
// Remove a user.
void hair_forms_drop(struct hair_forms* forms, uint32_t place);

// Create the buffer texture, for passes that have no storage buffer left.
hair_result hair_forms_need_texture(struct hair_forms* forms);

#endif
