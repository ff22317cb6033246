// body_grid.c - the passes that compute the signed distance to a body.
//
// Triangles write their distance and index to the nodes around them, and cross columns of nodes. A
// column crosses a closed surface inwards and outwards, so the sum of its crossings is the winding
// number of each node. Farther nodes get the nearest point of the surface along one axis after
// another, in two rounds.
//
// Only columns along x that have a node whose distance may change are computed. These are the nodes
// that are no nearer to the surface than to the triangles that move.
#include "lib/field/body_grid.h"

#include <string.h>

static uint32_t nodes_of(const hair_collision_mesh* mesh)
{
    return mesh->size[0] * mesh->size[1] * mesh->size[2];
}

static hair_result make_grid_buffers(struct hair_body_grid* grid, const uint32_t* triangles)
{
    struct hair_gl* gl = grid->gl;
    const hair_gl_category none = HAIR_GL_NO_CATEGORY;
    size_t nodes = nodes_of(grid->mesh), positions = 3 * (size_t)grid->vertex_count * sizeof(float);
    HAIR_TRY(hair_gl_uniform(gl, none, "hair body", sizeof(struct hair_body_params), &grid->params));
    HAIR_TRY(hair_gl_uniform(gl, none, "hair body upload", positions, &grid->upload));
    HAIR_TRY(hair_gl_storage(gl, none, "hair body positions", positions, NULL, &grid->position));
    HAIR_TRY(hair_gl_storage(gl, none, "hair body positions", positions, NULL, &grid->before));
    HAIR_TRY(hair_gl_storage(gl, none, "hair body triangles",
                             3 * (size_t)grid->triangle_count * sizeof *triangles, triangles,
                             &grid->triangle));
    HAIR_TRY(
        hair_gl_storage(gl, none, "hair body crossings", nodes * sizeof(int32_t), NULL, &grid->crossing));
    HAIR_TRY(hair_gl_storage(gl, none, "hair body points", nodes * sizeof(hair_vec4), NULL, &grid->point));
    HAIR_TRY(hair_gl_storage(gl, none, "hair body change", sizeof(struct hair_body_change),
                             &(struct hair_body_change){.lower_x = UINT32_MAX}, &grid->change));
    uint32_t* nearest = hair_alloc(&gl->host, nodes, sizeof *nearest);
    if (!nearest) return hair_fail_memory(&gl->host, "a body");
    memset(nearest, 0xff, nodes * sizeof *nearest); // No triangle is near.
    hair_result result =
        hair_gl_storage(gl, none, "hair body nearest", nodes * sizeof *nearest, nearest, &grid->nearest);
    hair_free(&gl->host, nearest);
    return result;
}

hair_result hair_body_grid_create(struct hair_body_grid* grid, struct hair_sdf_pool* pool,
                                  hair_collision_mesh* mesh, const uint32_t* triangles,
                                  uint32_t triangle_count, uint32_t vertex_count)
{
    *grid = (struct hair_body_grid){
        .gl = pool->gl, .mesh = mesh, .vertex_count = vertex_count, .triangle_count = triangle_count};
    HAIR_TRY(hair_gl_ensure_programs(grid->gl, HAIR_GL_BODY_MOVED, HAIR_GL_BODY_LINE_LAST, 0));
    HAIR_TRY(make_grid_buffers(grid, triangles));
    HAIR_TRY(hair_sdf_pool_acquire_body(pool, mesh, &grid->place));
    grid->pool = pool;
    return HAIR_OK;
}

void hair_body_grid_destroy(struct hair_body_grid* grid)
{
    struct hair_gl* gl = grid->gl;
    if (!gl) return;
    if (grid->pool) hair_sdf_pool_release(grid->pool, grid->place);
    GLuint* buffers[] = {&grid->params,   &grid->upload,  &grid->position, &grid->before, &grid->triangle,
                         &grid->crossing, &grid->nearest, &grid->point,    &grid->change};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; ++i) hair_gl_free_buffer(gl, buffers[i]);
    *grid = (struct hair_body_grid){0};
}

static struct hair_body_params params_of(const struct hair_body_grid* grid)
{
    const hair_collision_mesh* mesh = grid->mesh;
    return (struct hair_body_params){.nodes_x = mesh->size[0],
                                     .nodes_y = mesh->size[1],
                                     .nodes_z = mesh->size[2],
                                     .first = grid->pool->pooled[grid->place].first,
                                     .triangles = grid->triangle_count,
                                     .is_closed = mesh->info.is_closed,
                                     .voxel = mesh->voxel,
                                     .shell = mesh->info.thickness / 2,
                                     .origin = {mesh->origin[0], mesh->origin[1], mesh->origin[2], 0},
                                     .vertices = grid->vertex_count};
}

static void bind_grid(struct hair_body_grid* grid, const struct hair_body_params* params)
{
    struct hair_gl* gl = grid->gl;
    // In the order of the slots from HAIR_BIND_BODY_POSITION on.
    const GLuint storage[] = {grid->position, grid->triangle, grid->nearest, grid->pool->nodes,
                              grid->crossing, grid->point,    grid->before,  grid->change};
    hair_gl_write_uniform(gl, grid->params, sizeof *params, params);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_BODY, 1, &grid->params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_BODY_POSITION, 8, storage);
}

static uint32_t groups_of(uint32_t threads)
{
    return (threads + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE;
}

static void run_lines(struct hair_gl* gl, hair_gl_pass pass, uint32_t lines)
{
    hair_gl_run(gl, pass, (lines + HAIR_BODY_THREADS - 1) / HAIR_BODY_THREADS);
}

// Compute the distances to the current positions.
static void compute_nodes(struct hair_body_grid* grid, bool is_first)
{
    struct hair_gl* gl = grid->gl;
    const uint32_t* size = grid->mesh->size;
    struct hair_body_params params = params_of(grid);
    params.is_first = is_first;
    bind_grid(grid, &params);
    hair_gl_run(gl, HAIR_GL_BODY_MOVED, groups_of(grid->triangle_count));
    hair_gl_run(gl, HAIR_GL_BODY_REACH, groups_of(nodes_of(grid->mesh)));
    hair_gl_run(gl, HAIR_GL_BODY_SCATTER, grid->triangle_count);
    run_lines(gl, HAIR_GL_BODY_LINE_FIRST, size[1] * size[2]);
    run_lines(gl, HAIR_GL_BODY_LINE_Y, size[0] * size[2]);
    run_lines(gl, HAIR_GL_BODY_LINE_Z, size[0] * size[1]);
    run_lines(gl, HAIR_GL_BODY_LINE_X, size[1] * size[2]);
    run_lines(gl, HAIR_GL_BODY_LINE_Y, size[0] * size[2]);
    run_lines(gl, HAIR_GL_BODY_LINE_LAST, size[0] * size[1]);
}

static void keep_last_shape(struct hair_body_grid* grid)
{
    GLuint last = grid->before;
    grid->before = grid->position;
    grid->position = last;
}

void hair_body_grid_update(struct hair_body_grid* grid, const float* positions)
{
    struct hair_gl* gl = grid->gl;
    GLsizeiptr bytes = (GLsizeiptr)(3 * (size_t)grid->vertex_count * sizeof *positions);
    // The GPU copies the positions, in order with the dispatches of the last update.
    hair_gl_write_uniform(gl, grid->upload, (size_t)bytes, positions);
    bool is_first = !grid->has_shape;
    if (is_first) hair_gl_copy_buffer(gl, grid->upload, grid->before, 0, 0, bytes);
    if (!is_first) keep_last_shape(grid);
    grid->has_shape = true;
    hair_gl_copy_buffer(gl, grid->upload, grid->position, 0, 0, bytes);
    compute_nodes(grid, is_first);
}

hair_result hair_body_grid_update_from(struct hair_body_grid* grid, const struct hair_body_input* input)
{
    struct hair_gl* gl = grid->gl;
    const float *first = grid->mesh->origin, voxel = grid->mesh->voxel;
    const GLintptr at = (GLintptr)input->offset;
    const GLsizeiptr size = (GLsizeiptr)input->size;
    HAIR_ASSERT(grid->has_shape && input->stride >= 3);
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_BODY_UNPACK));
    struct hair_body_params params = params_of(grid);
    const float *lower = input->lower, *upper = input->upper;
    params.lower = (hair_vec4){(lower[0] - first[0]) / voxel, (lower[1] - first[1]) / voxel,
                               (lower[2] - first[2]) / voxel, 0};
    params.upper = (hair_vec4){(upper[0] - first[0]) / voxel, (upper[1] - first[1]) / voxel,
                               (upper[2] - first[2]) / voxel, 0};
    params.given_first = input->first;
    params.given_stride = input->stride;
    keep_last_shape(grid);
    bind_grid(grid, &params);
    hair_gl_bind_ranges(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GIVEN, 1, &input->buffer, &at, &size);
    // Shaders of the application may have written the buffer.
    hair_gl_barrier(gl, GL_SHADER_STORAGE_BARRIER_BIT);
    hair_gl_run(gl, HAIR_GL_BODY_UNPACK, groups_of(grid->vertex_count));
    compute_nodes(grid, false);
    return HAIR_OK;
}
