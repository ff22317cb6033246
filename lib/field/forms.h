// forms.h - the grids of forms in one buffer, each there once for all instances of a context that have solids of it.
#ifndef HAIR_FIELD_FORMS_H
#define HAIR_FIELD_FORMS_H

#include "lib/collide/form.h"
#include "lib/gl/gl.h"

struct hair_pooled_form {
    const hair_form* form; // held; NULL: the place is free
    uint32_t users; // solids
    uint32_t first; // of its nodes
};

struct hair_forms {
    struct hair_gl* gl;
    GLuint nodes; // buffer: float[], m
    GLuint texture; // the same; 0 until hair_forms_need_texture
    size_t used, room; // nodes
    struct hair_pooled_form* pooled;
    uint32_t count, capacity; // of places
};

// One solid more that has the form, at `place` for as long as it has.
hair_result hair_forms_take(struct hair_forms* forms, const hair_form* form, uint32_t* place);
void hair_forms_drop(struct hair_forms* forms, uint32_t place);

// For passes that have no storage buffer to spare.
hair_result hair_forms_need_texture(struct hair_forms* forms);

#endif
