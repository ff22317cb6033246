// head_body.c - The neck and the garment of the bust as a body that hair collides with.
#include "tools/common/head_body.h"

#include <cglm/cglm.h>

#include <stdlib.h>
#include <string.h>

#define VOXEL 0.008f // m
#define ROOM 0.06f // m, from the body at rest to its box

static void find_box(struct hair_head_body* body)
{
    for (int k = 0; k < 3; ++k) body->box[0][k] = INFINITY, body->box[1][k] = -INFINITY;
    for (size_t i = 0; i < 3 * (size_t)body->count; ++i) {
        body->box[0][i % 3] = fminf(body->box[0][i % 3], body->rest[i] - ROOM);
        body->box[1][i % 3] = fmaxf(body->box[1][i % 3], body->rest[i] + ROOM);
    }
}

hair_result hair_head_body_create(hair_context* context, struct hair_head_body* out)
{
    struct head_solid solid;
    struct hair_head_body made = {0};
    hair_body_desc desc = hair_body_desc_default();
    float longest = 0;
    if (head_body_create(&solid)) return HAIR_ERROR_MEMORY;
    made.rest = solid.positions, made.count = solid.vertex_count;
    made.moved = malloc((size_t)made.count * 3 * sizeof *made.moved);
    find_box(&made);
    for (int k = 0; k < 3; ++k) {
        desc.lower[k] = made.box[0][k], desc.upper[k] = made.box[1][k];
        longest = fmaxf(longest, desc.upper[k] - desc.lower[k]);
    }
    desc.positions = made.rest;
    desc.triangles = solid.triangles;
    desc.vertex_count = made.count;
    desc.triangle_count = solid.triangle_count;
    desc.resolution = (uint32_t)ceilf(longest / VOXEL);
    hair_result result =
        made.moved ? hair_body_create(context, &desc, &made.body) : (hair_result)HAIR_ERROR_MEMORY;
    free(solid.triangles);
    if (result)
        hair_head_body_destroy(&made);
    else
        *out = made;
    return result;
}

hair_result hair_head_body_move(struct hair_head_body* body, const float transform[16], float breath)
{
    struct hair_head_pose pose = hair_head_pose_at(transform, breath, false);
    for (size_t i = 0; i < body->count; ++i) {
        float* to = body->moved + 3 * i;
        hair_head_pose_move(&pose, body->rest + 3 * i, to);
        for (int k = 0; k < 3; ++k) to[k] = glm_clamp(to[k], body->box[0][k], body->box[1][k]);
    }
    return hair_body_set_positions(body->body, body->moved, body->count, 3 * sizeof(float));
}

void hair_head_body_destroy(struct hair_head_body* body)
{
    hair_body_destroy(body->body);
    free(body->moved);
    free(body->rest);
    *body = (struct hair_head_body){0};
}
