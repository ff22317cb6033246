// body.c - public calls on bodies, which are collision meshes that deform.
#include "lib/api/api.h"
#include "lib/collide/body_mesh.h"

#include <string.h>

#define LONGEST_STRIDE 4096u // Maximum stride of positions, bytes.

void hair_body_empty(struct hair_context_member* member)
{
    hair_body* body = (hair_body*)member;
    // The pool drops the distances if no collider refers to the mesh.
    hair_collision_mesh_release(body->mesh);
    body->mesh = NULL;
    hair_body_grid_destroy(&body->grid);
}

hair_result hair_body_create_grid(hair_body* body)
{
    hair_context* context = body->context;
    hair_gl_enter(&context->gl);
    hair_result result = hair_body_grid_create(&body->grid, &context->sdf_pool, body->mesh, body->triangles,
                                               body->desc.triangle_count, body->desc.vertex_count);
    if (!result) hair_body_grid_update(&body->grid, body->position);
    if (result) hair_body_grid_destroy(&body->grid);
    return hair_leave(context, result);
}

static hair_result fill_body(hair_body* body, const hair_body_desc* desc)
{
    const hair_host* host = &body->context->host;
    float lower[3], upper[3];
    HAIR_TRY(hair_body_mesh_build(host, desc, lower, upper, &body->mesh));
    body->mesh->home = &body->context->sdf_pool;
    size_t indices = 3 * (size_t)desc->triangle_count;
    body->triangles = hair_alloc(host, indices, sizeof *body->triangles);
    body->position = hair_alloc(host, desc->vertex_count, 3 * sizeof *body->position);
    body->next = hair_alloc(host, desc->vertex_count, 3 * sizeof *body->next);
    if (!body->triangles || !body->position || !body->next) return hair_fail_memory(host, "a body");
    memcpy(body->triangles, desc->triangles, indices * sizeof *body->triangles);
    hair_body_mesh_place(body->mesh, desc->positions, desc->vertex_count, 12, body->position);
    HAIR_TRY(hair_body_create_grid(body));
    hair_body_mesh_change(body->mesh, lower, upper);
    return HAIR_OK;
}

hair_result hair_body_create(hair_context* context, const hair_body_desc* desc, hair_body** out)
{
    HAIR_TRY(hair_check_context(context));
    const hair_host* host = &context->host;
    hair_body_desc own;
    HAIR_TRY(HAIR_COPY_IN(host, hair_body_desc, desc, &own));
    if (!own.positions) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_body_desc.positions is NULL");
    if (!own.triangles) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_body_desc.triangles is NULL");
    if (!out) return hair_fail(host, HAIR_ERROR_ARGUMENT, "out is NULL");
    HAIR_TRY(hair_check_current(context));
    hair_body* body = hair_alloc(host, 1, sizeof *body);
    if (!body) return hair_fail_memory(host, "a body");
    body->context = context;
    body->desc = own;
    hair_context_add(context, &body->member, hair_body_empty);
    hair_result result = fill_body(body, &own);
    body->desc.positions = NULL;
    body->desc.triangles = NULL;
    if (result) {
        hair_body_destroy(body);
        return result;
    }
    *out = body;
    return HAIR_OK;
}

void hair_body_destroy(hair_body* body)
{
    if (!body) return;
    hair_host host = body->context->host;
    hair_context_tell_left(body->context);
    hair_context_remove(body->context, &body->member);
    hair_free(&host, body->triangles);
    hair_free(&host, body->position);
    hair_free(&host, body->next);
    hair_free(&host, body);
}

const hair_collision_mesh* hair_body_get_mesh(const hair_body* body)
{
    return body ? body->mesh : NULL;
}

static hair_result check_body(const hair_body* body)
{
    if (!body) return HAIR_ERROR_ARGUMENT;
    if (!body->context->is_dead) return HAIR_OK;
    return hair_fail(&body->context->host, HAIR_ERROR_ARGUMENT,
                     "hair_body: its context is destroyed or abandoned");
}

static hair_result check_stride(hair_context* context, size_t stride)
{
    if (stride < 12 || stride > LONGEST_STRIDE || stride % 4)
        return hair_fail(&context->host, HAIR_ERROR_ARGUMENT,
                         "hair_body: stride is %zu, not a multiple of 4 in [12, %u]", stride, LONGEST_STRIDE);
    return hair_check_current(context);
}

hair_result hair_body_set_positions(hair_body* body, const float* positions, uint32_t count, size_t stride)
{
    HAIR_TRY(check_body(body));
    hair_context* context = body->context;
    const hair_host* host = &context->host;
    float lower[3], upper[3], *last = body->position;
    if (!positions) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_body: positions is NULL");
    if (count != body->desc.vertex_count)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_body: count is %u, not the %u of the body", count,
                         body->desc.vertex_count);
    HAIR_TRY(check_stride(context, stride));
    HAIR_TRY(hair_body_mesh_measure(host, &body->desc, positions, stride, lower, upper));
    hair_body_mesh_place(body->mesh, positions, count, stride, body->next);
    bool is_same = memcmp(body->next, last, 3 * (size_t)count * sizeof *last) == 0;
    if (is_same && !body->is_from_buffer) return HAIR_OK;
    body->is_from_buffer = false;
    body->position = body->next;
    body->next = last;
    hair_gl_enter(&context->gl);
    hair_body_grid_update(&body->grid, body->position);
    hair_body_mesh_change(body->mesh, lower, upper);
    return hair_leave(context, HAIR_OK);
}

hair_result hair_body_set_position_buffer(hair_body* body, uint32_t gl_buffer, size_t offset, size_t stride)
{
    HAIR_TRY(check_body(body));
    hair_context* context = body->context;
    const hair_body_desc* desc = &body->desc;
    size_t from = 0, size = 0;
    HAIR_TRY(check_stride(context, stride));
    hair_result result = hair_check_position_buffer(context, "hair_body", "vertices", gl_buffer, offset,
                                                    stride, desc->vertex_count, &from, &size);
    if (result) return hair_check_lost(context, result);
    struct hair_body_input input = {.buffer = gl_buffer,
                                    .offset = from,
                                    .size = size,
                                    .first = (uint32_t)((offset - from) / 4),
                                    .stride = (uint32_t)(stride / 4),
                                    .lower = desc->lower,
                                    .upper = desc->upper};
    hair_gl_enter(&context->gl);
    result = hair_body_grid_update_from(&body->grid, &input);
    if (!result) {
        body->is_from_buffer = true;
        hair_body_mesh_change(body->mesh, desc->lower, desc->upper);
    }
    return hair_leave(context, result);
}
