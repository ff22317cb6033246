// head_body.h - The neck and the garment of the bust as a body that hair collides with. The neck
// bends, and the chest breathes.
#ifndef HAIR_TOOLS_COMMON_HEAD_BODY_H
#define HAIR_TOOLS_COMMON_HEAD_BODY_H

#include "tools/common/head_rig.h"

#include <hair/hair_body.h>

// A body of zeros is none.
struct hair_head_body {
    hair_body* body;
    float *rest, *moved; // xyz per vertex, m, at rest and now
    uint32_t count; // number of vertices
    float box[2][3]; // lower and upper corner of the box that the vertices stay in, m
};

// Create the body at rest. OpenGL is required.
hair_result hair_head_body_create(hair_context* context, struct hair_head_body* out);
// Move the body with the head at `transform`, and the front of the chest forwards by `breath`, in
// m. OpenGL is required.
hair_result hair_head_body_move(struct hair_head_body* body, const float transform[16], float breath);
// Destroy the body. OpenGL is required if there is a body.
void hair_head_body_destroy(struct hair_head_body* body);

#endif
